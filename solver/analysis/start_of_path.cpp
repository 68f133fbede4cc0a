#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string>

#include "solver/analysis/analyses.h"
#include "solver/analysis/vibration_rule.h"
#include "solver/discrete/given_state.h"
#include "solver/hooks.h"
#include "solver/mesh/dof_map.h"
#include "solver/numeric/number_text.h"
#include "solver/numeric/rounding.h"
#include "solver/report/result_parts.h"
#include "solver/trace/trace.h"

namespace snapthrough {

namespace {

/// Limits of the first state of a path; ratios without unit. Chosen.
struct StartLimits {
  /// Distance of the equilibrium from the given state, over the norm of the given displacements.
  static constexpr double given_state = 0.02;
  static constexpr double first_load = 1e-2;  ///< first step of the constant actions, share of them
  /// Load factor at which the path of a structure begins that has no state without load.
  static constexpr double tight_load = 1e-3;
};

/// Explains why no equilibrium was found under the first small load.
std::string nothing_found(const Structure& structure, const PathStart& start) {
  const Eigen::VectorXd& motion = start.free_motion;
  if (const auto& far = start.far_state) {
    return "the first state that was found lies farther from the unloaded structure than its gaps and "
           "elastic strains explain: displacement gradients (root mean square) of " +
           rounded(far->gradient) + ", those of small displacements are " +
           rounded(far->small_displacement_gradient);
  }
  if (motion.size() == 0)
    return "no equilibrium was found for the first small load: contact alone may not hold the structure";
  return "under the first small load a part of the structure can move freely: nothing presses it onto its "
         "one-sided supports, and nothing else holds it (the motion is largest near node \"" +
         node_of_largest(structure, motion) + "\")";
}

void fail_to_start(const Structure& structure, const PathStart& start, Result& result) {
  const bool loose = start.free_motion.size() > 0;
  fail(result, loose ? "loose_part" : "no_start", nothing_found(structure, start));
}

/// Hands on the first point of a path.
class UnloadedPoint final : public PathObserver {
 public:
  /// @param receive may be empty
  explicit UnloadedPoint(const std::function<void(const PathPoint&)>& receive) : receive_(receive) {}
  void on_point(const PathPoint& point) override {
    if (receive_ && point.arc_length == 0.0) receive_(point);
  }

 private:
  const std::function<void(const PathPoint&)>& receive_;
};

/// A state with its displaced ground and nothing else, where that is an equilibrium; else the state. What
/// ground that does not reach the structure leaves of its displacements is rounding.
Eigen::VectorXd unmoved_if_it_holds(const Structure& structure, StructuralProblem& problem,
                                    const Eigen::VectorXd& y) {
  const Eigen::Index first = DofMap::first<Eigen::Index>(structure.first_ground);
  const Eigen::Index count = DofMap::first<Eigen::Index>(structure.first_stop_node) - first;
  Eigen::VectorXd unmoved = Eigen::VectorXd::Zero(y.size());
  unmoved.segment(first, count) = y.segment(first, count);
  Eigen::VectorXd residual;
  problem.residual(unmoved, 0.0, residual);
  const double rounding = Rounding::distance * unmoved.lpNorm<Eigen::Infinity>();
  return residual.lpNorm<Eigen::Infinity>() <= rounding ? unmoved : y;
}

/// Converts the end of the constant actions' path to the start of the next path, with constant actions in
/// full: corrects the load factor error of the last step.
PathPoint fully_loaded(const Structure& structure, StructuralProblem& problem, PointSolver& solver,
                       PathPoint end) {
  end.y = unmoved_if_it_holds(structure, problem, end.y);
  PathPoint full = end;
  full.lambda = 0.0;
  const double moved = solver.norm().metric().norm(end.y, 0.0);
  return moved > 0.0 && solver.correct_at_load(moved, full) ? full : end;
}

/// Hands what is known of stability on the constant actions' path to the start of the next path: the number
/// of real eigenvalues below zero, of which a tangent that is not symmetric tells the parity alone, and
/// flutter.
void hand_on_stability(const Structure& structure, StructuralProblem& problem, const TraceOutcome& outcome,
                       PathStart& start) {
  PathPoint& point = *start.point;
  point.negative = count_next_to(outcome.last.negative, {point.negative, 0.0, true});
  const bool is_linear = !structure.traits.one_sided || !has_any(problem.contact().marks_at(point.y));
  if (!structure.traits.has_mass || !is_linear || !FlutterSearch(structure).flutters_at(point)) return;
  start.grows_from = 1.0;
  for (const CriticalEvent& event : outcome.critical)
    if (event.type == CriticalType::flutter) start.grows_from = event.point.lambda;
}

}  // namespace

namespace {

/// The first point of a path of a structure that only tension stiffens: under the constant actions, or where
/// these do not stiffen it under a little of the others.
PathStart start_where_tight(const Structure& structure, PointSolver& solver, double direction,
                            Result& result) {
  const double little = direction * StartLimits::tight_load * structure.scales.load;
  for (const double lambda : {0.0, little}) {
    if (lambda == 0.0 && !structure.has_constant) continue;
    Eigen::VectorXd y = Eigen::VectorXd::Zero(structure.size);
    solver.norm().ignore_load();
    if (!solver.find_tight_state(lambda, y) || solver.unresisted_motion().size() > 0) continue;
    PathStart start = start_near(solver, y, lambda, direction);
    if (start) return start;
  }
  fail(result, "no_start",
       "members that only pull do not hold the structure: no stable equilibrium, in which no part hangs on "
       "slack members, was found under its constant actions, nor under " +
           rounded(StartLimits::tight_load) + " of the loads");
  return {};
}

}  // namespace

const std::string& node_of_largest(const Structure& structure, const Eigen::VectorXd& motion) {
  std::size_t node = 0;
  double largest = 0.0;
  for (int j = 0; j < structure.first_ground; ++j) {
    const double size = DofMap::displacement(motion, j).lpNorm<Eigen::Infinity>();
    if (size <= largest) continue;
    largest = size;
    node = static_cast<std::size_t>(j);
  }
  return structure.model->nodes[node].id;
}

PathStart start_at_state(const Structure& structure, PointSolver& solver, const Analysis& analysis,
                         Result& result) {
  const StartState& state = *analysis.start;
  Eigen::VectorXd given;
  try {
    given = unknowns_of(structure, state);
  } catch (const std::invalid_argument& error) {
    fail(result, "no_start", std::string("the given state can't be joined by splines: ") + error.what());
    return {};
  }
  PathStart start =
      start_near(solver, given, state.load_factor * structure.scales.load, analysis.step.direction);
  const std::string where = " next to the given state at load factor " + number(state.load_factor);
  if (!start) {
    fail(result, "no_start", "no equilibrium was found" + where);
    return {};
  }
  if (std::abs(start.point->lambda) >= solver.norm().load_bound()) {
    fail(result, "no_start",
         "the structure has no stiffness at the equilibrium" + where +
             ": it is a critical point; give a state of the path beside it");
    return {};
  }
  const PathMetric& metric = solver.norm().metric();
  const double moved = metric.norm(start.point->y - given, 0.0);
  const double size = metric.norm(given, 0.0);
  if (moved <= StartLimits::given_state * size) return start;
  fail(result, "no_start",
       "the equilibrium that was found" + where + " differs from it by " + rounded(moved / size) +
           " of its displacement gradients (root mean square): it is a state of another model");
  return {};
}

PathStart start_of_path(const Structure& structure, StructuralProblem& problem, PointSolver& solver,
                        double direction, const Hooks& hooks, Result& result,
                        const std::function<void(const PathPoint&)>& on_unloaded) {
  if (structure.traits.loose) return start_where_tight(structure, solver, direction, result);
  if (!structure.has_constant) {
    PathStart start = find_start(solver, direction);
    if (!start) fail_to_start(structure, start, result);
    return start;
  }
  problem.set_stage(StructuralProblem::Stage::constant);
  PathFollower loading(problem);
  TraceRules rules;
  rules.load = {{-1.0, 1.0}};
  rules.limit_points = 1;
  UnloadedPoint unloaded(on_unloaded);
  const PathStart first = find_start(loading.solver(), 1.0, StartLimits::first_load);
  std::optional<FlutterSearch> flutter;
  rules.vibrations = vibration_rule(structure, loading.solver(), rules.locate.tolerance, flutter,
                                    StructuralProblem::Stage::constant);
  const TraceOutcome outcome = trace(loading, first.point, rules, {}, {&unloaded}, hooks.stop);
  problem.set_stage(StructuralProblem::Stage::proportional);
  add_statistics(loading.statistics(), result);
  if (outcome.end == TraceEnd::cancelled) {
    fail(result, "cancelled", "cancelled while the constant actions were put on");
    return {};
  }
  if (outcome.end == TraceEnd::limit_points ||
      (outcome.end != TraceEnd::load_factor && outcome.last.negative > 0)) {
    fail(result, "constant_actions_limit",
         "the structure can't carry the constant actions: " +
             std::string(outcome.end == TraceEnd::limit_points ? "their limit point is"
                                                               : "the path, unstable by then, was left") +
             " at " + rounded(outcome.last.lambda) + " of them");
    return {};
  }
  const bool has_cables = std::ranges::any_of(structure.node_springs, &NodeSpring::is_cable);
  if (has_cables && outcome.end != TraceEnd::load_factor)
    if (PathStart start = start_where_tight(structure, solver, direction, result)) return start;
  if (outcome.end == TraceEnd::no_start) {
    fail(result, "constant_actions",
         "the constant actions can't be put on: " + nothing_found(structure, first));
    return {};
  }
  if (outcome.end != TraceEnd::load_factor) {
    fail(result, "constant_actions",
         "the constant actions can't be put on: equilibrium was followed to " + rounded(outcome.last.lambda) +
             " of them");
    return {};
  }
  PathStart start = start_at_equilibrium(solver, fully_loaded(structure, problem, solver, outcome.last).y,
                                         direction, outcome.last.context);
  if (!start) fail_to_start(structure, start, result);
  if (start && !structure.traits.symmetric) hand_on_stability(structure, problem, outcome, start);
  return start;
}

}  // namespace snapthrough
