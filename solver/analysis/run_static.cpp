#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "solver/analysis/analyses.h"
#include "solver/newton/contact_state.h"
#include "solver/path/trace.h"
#include "solver/post/neutral_motion.h"
#include "solver/post/state.h"
#include "solver/stability/locate.h"

namespace snapthrough {
namespace {

using Eigen::VectorXd;

/// Keeps the states that were asked for, in the order they were asked for.
class StaticStates {
 public:
  StaticStates(const Model& model, const Analysis& analysis, const Structure& structure)
      : model_(model), analysis_(analysis), structure_(structure), found_(analysis.load_factors.size()) {}

  void set(std::size_t index, const VectorXd& y) {
    State state = make_state(structure_, model_, y, analysis_.load_factors[index] * structure_.scales.load,
                             analysis_.output.points_per_member);
    state.load_factor = analysis_.load_factors[index];
    found_[index] = std::move(state);
  }
  [[nodiscard]] bool has(std::size_t index) const { return found_[index].has_value(); }
  void move_to(Result& result) {
    for (auto& state : found_)
      if (state) result.states.push_back(std::move(*state));
  }

 private:
  const Model& model_;
  const Analysis& analysis_;
  const Structure& structure_;
  std::vector<std::optional<State>> found_;
};

/// Equilibrium at one load factor from the unloaded state: small displacements, contact unilateral.
/// @param holds of motions that nothing resists there; set
bool solve_linear(const Structure& structure, StructuralProblem& problem, double factor, VectorXd& y,
                  SharedHolds& holds, Result& result) {
  const PathMetric metric{&structure.metric, 0.0};
  Workspace work;
  const double lambda = factor * structure.scales.load;
  const SharedHolds soft = held_softly(problem);
  problem.set_holds(soft);
  auto state = find_contact_state(problem, metric, lambda, work, result.diagnostics.factorizations);
  if (soft) {
    holds = state ? neutral_part(problem, soft, state->y, lambda) : nullptr;
    problem.set_holds(holds);
    state = find_contact_state(problem, metric, lambda, work, result.diagnostics.factorizations);
  }
  if (!state) return false;
  result.diagnostics.iterations = result.diagnostics.factorizations;
  result.diagnostics.max_relative_residual =
      std::max(result.diagnostics.max_relative_residual, state->relative_residual);
  y = std::move(state->y);
  return true;
}

/// Follows the path towards the factors of one sign and keeps the states it passes; false when it ends before
/// the last.
bool follow(const Model& model, const Analysis& analysis, const Structure& structure, double direction,
            const Hooks& hooks, StaticStates& states, Result& result) {
  double last = 0.0;
  for (const double factor : analysis.load_factors)
    if (factor * direction > 0.0 || factor == 0.0) last = std::max(last, factor * direction);
  StructuralProblem problem(structure);
  Continuation continuation(problem, {});
  const auto start = start_of_path(model, structure, problem, continuation, direction, hooks, result);
  if (!start) return false;
  for (std::size_t i = 0; i < analysis.load_factors.size(); ++i)
    if (analysis.load_factors[i] == 0.0) states.set(i, start->y);
  if (last == 0.0) return true;
  TraceRules rules;
  const double bound = last * structure.scales.load;
  rules.load = {{-bound, bound}};
  rules.limit_points = 1;
  TraceSink sink;
  NeutralMotionLog neutral(structure, model, result.neutral_motion);
  sink.on_point = [&](const PathPoint& point) {
    neutral.note(point.holds, point.lambda / structure.scales.load);
  };
  sink.on_step = [&](const PathPoint& from, const PathPoint& to) {
    for (std::size_t i = 0; i < analysis.load_factors.size(); ++i) {
      const double target = analysis.load_factors[i] * structure.scales.load;
      const double size = std::abs(to.lambda - from.lambda);
      const bool reached = std::abs(to.lambda - target) <= 1e-11 * std::abs(target);
      if (states.has(i) || (!reached && (from.lambda - target) * (to.lambda - target) > 0.0)) continue;
      if (reached) {
        states.set(i, to.y);
        continue;
      }
      const auto value = [target](const PathPoint& at) { return at.lambda - target; };
      const auto done = [size](const PathPoint&, const PathPoint&, double v) {
        return std::abs(v) <= 1e-12 * size;
      };
      states.set(i, find_root(continuation, continuation.chord(from, to), from, value(from), to, value(to),
                              value, done)
                        .root.y);
    }
  };
  const TraceOutcome outcome = trace(continuation, start, rules, analysis.step, sink, hooks.stop);
  add_statistics(continuation.statistics(), result);
  if (outcome.end == TraceEnd::load_factor) return true;
  const std::string where = number(outcome.last.lambda / structure.scales.load);
  if (outcome.end == TraceEnd::cancelled)
    fail(result, "cancelled", "cancelled at load factor " + where);
  else if (outcome.end == TraceEnd::limit_points)
    fail(result, "beyond_limit_point",
         "the path has a limit point at load factor " + where + ", before the asked ones");
  else
    fail(result, "no_convergence", "the path could not be followed beyond load factor " + where);
  return false;
}

}  // namespace

void run_static(const Model& model, const Analysis& analysis, const Structure& structure, const Hooks& hooks,
                Result& result) {
  StaticStates states(model, analysis, structure);
  result.summary.termination = "load_factors";
  result.summary.message = "equilibrium at " + std::to_string(analysis.load_factors.size()) + " load factors";
  if (analysis.geometry == Geometry::linear) {
    StructuralProblem problem(structure);
    NeutralMotionLog neutral(structure, model, result.neutral_motion);
    for (std::size_t i = 0; i < analysis.load_factors.size(); ++i) {
      VectorXd y;
      SharedHolds holds;
      if (solve_linear(structure, problem, analysis.load_factors[i], y, holds, result)) {
        states.set(i, y);
        neutral.note(holds, analysis.load_factors[i]);
      } else
        fail(result, "no_convergence",
             "no contact state was found at load factor " + number(analysis.load_factors[i]));
    }
  } else {
    const bool falling = std::any_of(analysis.load_factors.begin(), analysis.load_factors.end(),
                                     [](double factor) { return factor < 0.0; });
    const bool growing = std::any_of(analysis.load_factors.begin(), analysis.load_factors.end(),
                                     [](double factor) { return factor >= 0.0; });
    if (growing) static_cast<void>(follow(model, analysis, structure, 1.0, hooks, states, result));
    if (falling) static_cast<void>(follow(model, analysis, structure, -1.0, hooks, states, result));
  }
  for (std::size_t i = 0; i < analysis.load_factors.size() && !result.failure; ++i)
    if (!states.has(i))
      fail(result, "no_convergence", "load factor " + number(analysis.load_factors[i]) + " was not reached");
  states.move_to(result);
}

}  // namespace snapthrough
