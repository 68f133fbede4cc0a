#include "solver/path/kink.h"

#include <array>
#include <optional>
#include <utility>

namespace snapthrough {

using Eigen::VectorXd;

namespace {

/// Numbers of the way round a kink.
struct KinkSearch {
  /// Distances beyond the kink that are tried, over the size of the step that met it.
  static constexpr std::array<double, 4> depths{1e3, 1e2, 1e1, 1e0};
  static constexpr double step_by_depth = 10.0;  ///< length of the step over the distance beyond the kink
  static constexpr int corrections = 60;         ///< most corrections that lower the energy
  /// Largest relative error when an increment is compared with the tangent at its end.
  static constexpr double largest_mismatch = 0.1;
};

/// Whether det [J, -load; tangent] has one sign at both points: parity of the negative eigenvalues times the
/// sense of the load. Its sign is the same on both sides of a kink, because both sides' tangents agree in the
/// plane that separates them.
bool keeps_orientation(const PathPoint& from, const PathPoint& to) {
  return (from.negative % 2 == to.negative % 2) == ((from.tangent_lambda > 0.0) == (to.tangent_lambda > 0.0));
}

/// A point on the tangent at `depth` from `from`, with the path's direction under the supports that act
/// there, in the sense that keeps the orientation; empty where the tangent stiffness is singular.
std::optional<PathPoint> point_beyond(PointSolver& solver, const PathPoint& from, double depth) {
  PathPoint beyond = from;
  beyond.y += depth * from.tangent;
  beyond.lambda += depth * from.tangent_lambda;
  const auto response = solver.response_at(beyond, Regime::Contact::unilateral);
  if (!response) return std::nullopt;
  solver.set_tangent(beyond, *response, 1.0);
  beyond.negative = count_next_to(from.negative, response->tangent);
  if (!keeps_orientation(from, beyond)) reverse(beyond);
  return beyond;
}

/// @brief The equilibrium at the load one step beyond a point, by corrections that lower the energy: where
/// supports touch without pressure any increment of the load changes where they act, in proportion to itself;
/// the last tangent says nothing there, and Newton's method cycles between contact patterns.
/// @param beyond a stable point with the direction of the load and of the first guess
/// @return whether `to` was set: a stable point that its own tangent joins to `from`
bool step_along_least_energy(PointSolver& solver, const PathPoint& from, const PathPoint& beyond, double size,
                             PathPoint& to) {
  if (beyond.tangent_lambda == 0.0) return false;
  to.y = beyond.y + size * beyond.tangent;
  to.lambda = beyond.lambda + size * beyond.tangent_lambda;
  auto outcome = solver.correct_by_least_energy(size, KinkSearch::corrections, to);
  if (outcome.status != CorrectorStatus::converged && from.arc_length == 0.0) {
    // constant actions may leave parts unloaded that lie on stiff supports, as at the start of a path
    const auto state = solver.contact_state(to.lambda, to.context.holds, &from.y);
    if (!state) return false;
    to.y = state->y;
    outcome = solver.correct_by_least_energy(size, KinkSearch::corrections, to);
  }
  if (outcome.status != CorrectorStatus::converged || outcome.tangent.negative > 0) return false;
  const PathMetric& metric = solver.norm().metric();
  const VectorXd displacement = to.y - from.y;
  const double dlambda = to.lambda - from.lambda;
  solver.set_tangent(to, outcome, beyond.negative, displacement, dlambda);
  to.arc_length = from.arc_length + solver.norm().arc(from, to);
  const VectorXd missed = displacement - (dlambda / to.tangent_lambda) * to.tangent;
  return metric.norm(missed, 0.0) <= KinkSearch::largest_mismatch * metric.norm(displacement, dlambda) &&
         (to.tangent_lambda > 0.0) == (dlambda > 0.0);
}

/// The point of the path one step from a point beyond a kink: by Newton's method or, where it is stable, by
/// corrections that lower the energy.
bool step_from_beyond(PointSolver& solver, const StepLimits& limits, const PathPoint& from,
                      const PathPoint& beyond, const StepSizes& sizes, PathPoint& to) {
  Predictor by_tangent;
  const StepMeasures measures = try_step(solver, by_tangent, limits, {beyond, sizes}, to);
  to.arc_length = from.arc_length + solver.norm().arc(from, to);
  if (is_acceptable(measures, limits) && to.negative == beyond.negative) return true;
  return beyond.negative == 0 && step_along_least_energy(solver, from, beyond, sizes.size, to);
}

}  // namespace

bool step_around_kink(PointSolver& solver, const StepLimits& limits, const PathPoint& from,
                      const StepSizes& sizes, PathPoint& to) {
  for (const double depth : KinkSearch::depths) {
    auto beyond = point_beyond(solver, from, depth * sizes.size);
    if (!beyond) continue;
    const StepSizes beyond_sizes{KinkSearch::step_by_depth * depth * sizes.size, sizes.last_full_step};
    if (step_from_beyond(solver, limits, from, *beyond, beyond_sizes, to)) return true;
    if ((from.tangent_lambda > 0.0) == (beyond->tangent_lambda > 0.0)) continue;
    // several supports change at once, and the cause of a change of the inertia may lie beside the path, as
    // at a bifurcation: then the load goes on
    reverse(*beyond);
    if (step_from_beyond(solver, limits, from, *beyond, beyond_sizes, to)) return true;
  }
  return false;
}

PathPoint last_point_before_kink(PointSolver& solver, const StepLimits& limits, const PathPoint& from,
                                 StepSizes sizes) {
  Predictor by_tangent;
  PathPoint last = from;
  PathPoint probe;
  probe.context = from.context;
  const double least = limits.min_step / solver.norm().arc_per_step(from);
  while ((sizes.size *= 0.5) >= least) {
    const StepMeasures measures = try_step(solver, by_tangent, limits, {last, sizes}, probe);
    if (is_acceptable(measures, limits) && probe.negative == from.negative) std::swap(last, probe);
  }
  return last;
}

}  // namespace snapthrough
