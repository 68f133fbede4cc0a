#include <cmath>
#include <cstddef>
#include <functional>
#include <stdexcept>
#include <string>

#include "solver/analysis/analyses.h"
#include "solver/discrete/given_state.h"
#include "solver/hooks.h"
#include "solver/numeric/number_text.h"
#include "solver/report/result_parts.h"
#include "solver/trace/trace.h"

namespace snapthrough {

namespace {

/// Explains why no equilibrium was found under the first small load.
std::string nothing_found(const Model& model, const Structure& structure, const Continuation& continuation) {
  const Eigen::VectorXd& motion = continuation.loose_motion();
  if (const auto& far = continuation.far_start()) {
    return "the first state that was found lies farther from the unloaded structure than its gaps and "
           "elastic strains explain: displacement gradients (root mean square) of " +
           rounded(far->moved) + ", those of small displacements are " + rounded(far->explained);
  }
  if (motion.size() == 0)
    return "no equilibrium was found for the first small load: contact alone may not hold the structure";
  std::size_t node = 0;
  double largest = 0.0;
  for (int j = 0; j < structure.nodes; ++j) {
    const double size = motion.segment<2>(3 * j).lpNorm<Eigen::Infinity>();
    if (size <= largest) continue;
    largest = size;
    node = static_cast<std::size_t>(j);
  }
  return "under the first small load a part of the structure can move freely: nothing presses it onto its "
         "one-sided supports, and nothing else holds it (the motion is largest near node \"" +
         model.nodes[node].id + "\")";
}

void fail_to_start(const Model& model, const Structure& structure, const Continuation& continuation,
                   Result& result) {
  const bool loose = continuation.loose_motion().size() > 0;
  fail(result, loose ? "loose_part" : "no_start", nothing_found(model, structure, continuation));
}

/// Converts the end of the constant actions' path to the start of the next path, with constant actions in
/// full: corrects the load factor error of the last step.
PathPoint fully_loaded(Continuation& continuation, const PathPoint& end) {
  PathPoint full = end;
  full.lambda = 0.0;
  const double moved = continuation.metric().norm(end.y, 0.0);
  return moved > 0.0 && continuation.correct_at_load(moved, full) ? full : end;
}

}  // namespace

std::optional<PathPoint> start_at_state(const Model& model, const Structure& structure,
                                        Continuation& continuation, const Analysis& analysis,
                                        Result& result) {
  // allowed distance of the equilibrium over the norm of the given displacements
  constexpr double kNear = 0.02;
  const StartState& state = *analysis.start;
  Eigen::VectorXd given;
  try {
    given = unknowns_of(structure, model, state);
  } catch (const std::invalid_argument& error) {
    fail(result, "no_start", std::string("the given state can't be joined by splines: ") + error.what());
    return std::nullopt;
  }
  auto start =
      continuation.start_from(given, state.load_factor * structure.scales.load, analysis.step.direction);
  const std::string where = " next to the given state at load factor " + number(state.load_factor);
  if (!start) {
    fail(result, "no_start", "no equilibrium was found" + where);
    return std::nullopt;
  }
  if (std::abs(start->lambda) >= continuation.load_bound()) {
    fail(result, "no_start",
         "the structure has no stiffness at the equilibrium" + where +
             ": it is a critical point; give a state of the path beside it");
    return std::nullopt;
  }
  const PathMetric& metric = continuation.metric();
  const double moved = metric.norm(start->y - given, 0.0);
  const double size = metric.norm(given, 0.0);
  if (moved <= kNear * size) return start;
  fail(result, "no_start",
       "the equilibrium that was found" + where + " differs from it by " + rounded(moved / size) +
           " of its displacement gradients (root mean square): it is a state of another model");
  return std::nullopt;
}

std::optional<PathPoint> start_of_path(const Model& model, const Structure& structure,
                                       StructuralProblem& problem, Continuation& continuation,
                                       double direction, const Hooks& hooks, Result& result,
                                       const std::function<void(const PathPoint&)>& on_unloaded) {
  if (!structure.has_constant) {
    auto start = continuation.start(direction);
    if (!start) fail_to_start(model, structure, continuation, result);
    return start;
  }
  problem.set_stage(StructuralProblem::Stage::constant);
  ContinuationOptions options;
  options.largest_first_load = 1e-2;
  Continuation loading(problem, options);
  TraceRules rules;
  rules.load = {{-1.0, 1.0}};
  rules.limit_points = 1;
  TraceSink sink;
  if (on_unloaded)
    sink.on_point = [&on_unloaded](const PathPoint& point) {
      if (point.arc_length == 0.0) on_unloaded(point);
    };
  const TraceOutcome outcome = trace(loading, loading.start(), rules, {}, sink, hooks.stop);
  problem.set_stage(StructuralProblem::Stage::proportional);
  add_statistics(loading.statistics(), result);
  if (outcome.end == TraceEnd::cancelled) {
    fail(result, "cancelled", "cancelled while the constant actions were put on");
    return std::nullopt;
  }
  if (outcome.end == TraceEnd::limit_points ||
      (outcome.end != TraceEnd::load_factor && outcome.last.negative > 0)) {
    fail(result, "constant_actions_limit",
         "the structure can't carry the constant actions: " +
             std::string(outcome.end == TraceEnd::limit_points ? "their limit point is"
                                                               : "the path, unstable by then, was left") +
             " at " + rounded(outcome.last.lambda) + " of them");
    return std::nullopt;
  }
  if (outcome.end == TraceEnd::no_start) {
    fail(result, "constant_actions",
         "the constant actions can't be put on: " + nothing_found(model, structure, loading));
    return std::nullopt;
  }
  if (outcome.end != TraceEnd::load_factor) {
    fail(result, "constant_actions",
         "the constant actions can't be put on: equilibrium was followed to " + rounded(outcome.last.lambda) +
             " of them");
    return std::nullopt;
  }
  auto start =
      continuation.start_at(fully_loaded(continuation, outcome.last).y, direction, outcome.last.holds);
  if (!start) fail_to_start(model, structure, continuation, result);
  return start;
}

}  // namespace snapthrough
