#include "solver/path/pinned_motions.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

#include "solver/problem/held_motions.h"

namespace snapthrough {
namespace {

/// What counts as none when nothing resists a motion; ratios.
struct FreeLimits {
  /// Stiffness over that of the structure by unit load factor, and over that with all supports bilateral: a
  /// support on its plateau still has some.
  static constexpr double stiffness = 1e-6;
  static constexpr double rounding = 1e-9;  ///< stiffness by unit load factor that rounding leaves
  static constexpr double no_force = 1e-6;  ///< force of a pin over the parts of the actions along its motion
  static constexpr double residual = 1e-9;  ///< force of a pin as a relative residual of the structure
};

/// Largest force of pins that counts as none: as a residual without the pins, or over the parts of the
/// actions along a motion, added without sign.
double no_force(PointSolver& solver, const Holds& holds, const PathPoint& point) {
  EquilibriumProblem& problem = solver.problem();
  problem.set_holds(nullptr);
  Eigen::VectorXd actions;  // without displacements the residual has the actions alone
  problem.residual(Eigen::VectorXd::Zero(problem.size()), point.lambda, actions);
  Eigen::VectorXd along;
  double largest = 0.0;
  double unit = 0.0;
  for (Eigen::Index i = 0; i < holds.motions.cols(); ++i) {
    problem.force_along(holds.motions.col(i), along);
    largest = std::max(largest, along.cwiseAbs().dot(actions.cwiseAbs()));
    unit = std::max(unit, problem.relative_residual(along, point.y, point.lambda));
  }
  return std::max(FreeLimits::no_force * largest, FreeLimits::residual / unit);
}

/// Stiffness of a motion with all supports bilateral, unloaded.
double stiffness_if_bilateral(PointSolver& solver, const Eigen::VectorXd& motion) {
  Regime bilateral;
  bilateral.contact = Regime::Contact::bilateral;
  const auto alone = std::make_shared<const Holds>(Holds{motion, Eigen::VectorXd::Zero(1), 1.0});
  ++solver.statistics().factorizations;
  const Eigen::VectorXd unloaded = Eigen::VectorXd::Zero(solver.problem().size());
  return motion_stiffness(solver.problem(), alone, unloaded, 0.0, bilateral).stiffness[0];
}

/// Which motions that are pinned at a point are free: they have neither stiffness nor force there.
std::vector<char> free_ones(PointSolver& solver, const MotionStiffness& pinned, double force,
                            const PathPoint& point) {
  const double actions = std::max(1.0, std::abs(point.lambda));  // constant actions may be as large
  std::vector<char> out;
  for (Eigen::Index i = 0; i < pinned.stiffness.size(); ++i) {
    const double stiffness = std::abs(pinned.stiffness[i]);
    bool free = std::abs(pinned.force[i]) <= force && stiffness <= FreeLimits::stiffness * actions;
    if (free && stiffness > FreeLimits::rounding * actions)
      free = stiffness <= FreeLimits::stiffness * stiffness_if_bilateral(solver, pinned.motions.col(i));
    out.push_back(free ? 1 : 0);
  }
  return out;
}

/// @brief Stiffness of pinned motions by the secants of the supports that act at a point. A support on its
/// plateau has no stiffness and yet resists, with all of its force.
MotionStiffness secant_stiffness(PointSolver& solver, const SharedHolds& holds, const PathPoint& point) {
  EquilibriumProblem& problem = solver.problem();
  const Eigen::VectorXd at_rest = Eigen::VectorXd::Zero(problem.size());
  FrozenContact acting = problem.freeze(problem.moving_zones(point.y, at_rest), point.y);
  acting.linearised_at = point.y;
  Regime secants;
  secants.contact = Regime::Contact::frozen;
  secants.frozen = &acting;
  ++solver.statistics().factorizations;
  return motion_stiffness(problem, holds, point.y, point.lambda, secants);
}

/// Motions with a mark.
Eigen::MatrixXd marked(const Eigen::MatrixXd& motions, const std::vector<char>& marks) {
  std::vector<Eigen::Index> columns;
  for (std::size_t i = 0; i < marks.size(); ++i)
    if (marks[i] != 0) columns.push_back(static_cast<Eigen::Index>(i));
  return motions(Eigen::all, columns);
}

/// Pins for motions at the place where they are at a point.
SharedHolds pins(const Eigen::MatrixXd& motions, const PathPoint& point) {
  return std::make_shared<const Holds>(
      Holds{motions, motions.transpose() * point.y.head(motions.rows()), 1.0});
}

}  // namespace

bool may_have_free_motion(const EquilibriumProblem& problem, const PathPoint& from, const PathPoint& to) {
  // a motion that loses its stiffness takes the determinant down by as much
  return problem.free_motions().cols() > 0 &&
         to.log_abs_det < from.log_abs_det + std::log(FreeLimits::stiffness);
}

bool pin_free_motions(PointSolver& solver, const PathPoint& from, PathPoint& to) {
  EquilibriumProblem& problem = solver.problem();
  const double scale = std::max(solver.norm().distance(from, to), kRoundingResidual);
  const auto correct_with = [&](const SharedHolds& holds, PathPoint& point) {
    point.context.holds = holds;
    return solver.correct_at_load(scale, point);
  };
  // where the structure is free, supports that it leaves may still touch it on one side, pressed by rounding
  const SharedHolds all = pins(problem.free_motions(), from);
  PathPoint pinned = to;
  if (!correct_with(all, pinned)) return false;
  const double force = no_force(solver, *all, pinned);
  ++solver.statistics().factorizations;
  const MotionStiffness motions = motion_stiffness(problem, all, pinned.y, pinned.lambda);
  Eigen::MatrixXd free = marked(motions.motions, free_ones(solver, motions, force, pinned));
  const Eigen::Index before = from.context.holds ? from.context.holds->motions.cols() : 0;
  if (free.cols() <= before) return false;
  const MotionStiffness secants = secant_stiffness(solver, pins(free, pinned), pinned);
  free = marked(secants.motions, free_ones(solver, secants, force, pinned));
  if (free.cols() <= before || !correct_with(pins(free, pinned), pinned)) return false;
  const auto response = solver.response_at(pinned, Regime::Contact::unilateral);
  if (!response) return false;
  const double along = solver.norm().metric().inner(response->rate, 1.0, to.tangent, to.tangent_lambda);
  solver.set_tangent(pinned, *response, along < 0.0 ? -1.0 : 1.0);
  to = std::move(pinned);
  return true;
}

bool unpin_resisted_motions(PointSolver& solver, PathPoint& from, const PathPoint& to) {
  if (!from.context.holds) return false;
  const double force = no_force(solver, *from.context.holds, to);
  ++solver.statistics().factorizations;
  const MotionStiffness pinned = motion_stiffness(solver.problem(), from.context.holds, to.y, to.lambda);
  const std::vector<char> free = free_ones(solver, pinned, force, to);
  solver.problem().set_context(from.context);
  for (std::size_t i = 0; i < free.size(); ++i)
    if (free[i] == 0 && from.arc_length == 0.0 && pinned.stiffness[static_cast<Eigen::Index>(i)] < 0.0)
      ++from.negative;  // under the smallest load already
  const Eigen::MatrixXd rest = marked(pinned.motions, free);
  if (rest.cols() == pinned.motions.cols()) return false;
  from.context.holds = rest.cols() > 0 ? pins(rest, from) : nullptr;
  return true;
}

}  // namespace snapthrough
