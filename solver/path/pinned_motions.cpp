#include "solver/path/pinned_motions.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

namespace snapthrough {
namespace {

/// Stiffness of a motion by unit load factor below which nothing resists it (scaled, dimensionless).
constexpr double kFree = 1e-6;

NeutralBounds free_bounds(PointSolver& solver, const Holds& holds, const PathPoint& point) {
  const double actions = std::max(1.0, std::abs(point.lambda));  // constant actions may be as large
  return {kFree * actions, no_force(solver.problem(), holds, point.y, point.lambda, actions)};
}

/// Pins for motions at the place where they are at a point.
SharedHolds pins(const Eigen::MatrixXd& motions, const PathPoint& point) {
  return std::make_shared<const Holds>(
      Holds{motions, motions.transpose() * point.y.head(motions.rows()), 1.0});
}

}  // namespace

bool may_have_free_motion(const EquilibriumProblem& problem, const PathPoint& from, const PathPoint& to) {
  // a motion that loses its stiffness takes the determinant down by as much
  return problem.free_motions().cols() > 0 && to.log_abs_det < from.log_abs_det + std::log(kFree);
}

bool pin_free_motions(PointSolver& solver, const PathPoint& from, PathPoint& to) {
  EquilibriumProblem& problem = solver.problem();
  const double scale = std::max(solver.norm().distance(from, to), kRoundingResidual);
  const auto correct_with = [&](const SharedHolds& holds, PathPoint& point) {
    point.holds = holds;
    return solver.correct_at_load(scale, point);
  };
  // where the structure is free, supports that it leaves may still touch it on one side, pressed by rounding
  const SharedHolds all = pins(problem.free_motions(), from);
  PathPoint pinned = to;
  if (!correct_with(all, pinned)) return false;
  pinned.holds = neutral_part(problem, all, pinned.y, pinned.lambda, free_bounds(solver, *all, pinned));
  ++solver.statistics().factorizations;
  const Eigen::Index before = from.holds ? from.holds->motions.cols() : 0;
  if (!pinned.holds || pinned.holds->motions.cols() <= before || !correct_with(pinned.holds, pinned))
    return false;
  const auto response = solver.response_at(pinned, Regime::Contact::unilateral);
  if (!response) return false;
  const double along = solver.norm().metric().inner(response->rate, 1.0, to.tangent, to.tangent_lambda);
  solver.set_tangent(pinned, *response, along < 0.0 ? -1.0 : 1.0);
  to = std::move(pinned);
  return true;
}

bool unpin_resisted_motions(PointSolver& solver, PathPoint& from, const PathPoint& to) {
  if (!from.holds) return false;
  const NeutralBounds bounds = free_bounds(solver, *from.holds, to);
  ++solver.statistics().factorizations;
  const MotionStiffness pinned = motion_stiffness(solver.problem(), from.holds, to.y, to.lambda);
  std::vector<Eigen::Index> free;
  for (Eigen::Index i = 0; i < pinned.stiffness.size(); ++i) {
    if (std::abs(pinned.stiffness[i]) <= bounds.stiffness && std::abs(pinned.force[i]) <= bounds.force)
      free.push_back(i);
    else if (from.arc_length == 0.0 && pinned.stiffness[i] < 0.0)
      ++from.negative;  // under the smallest load already
  }
  if (static_cast<Eigen::Index>(free.size()) == pinned.stiffness.size()) return false;
  SharedHolds rest;
  if (!free.empty()) rest = pins(pinned.motions(Eigen::all, free), from);
  from.holds = rest;
  return true;
}

}  // namespace snapthrough
