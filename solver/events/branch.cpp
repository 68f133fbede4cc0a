#include "solver/events/branch.h"

#include <cmath>

#include "solver/events/critical_mode.h"
#include "solver/numeric/pseudo_random.h"

namespace snapthrough {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

/// Source: docs/decisions/0022.
struct BranchStart {
  static constexpr double step = 0.01;  ///< first step, in the path's norm (displacement gradient)
};

/// Sign of the largest displacement of a motion.
double sense_of(const PathNorm& norm, const VectorXd& motion) {
  Index largest = 0;
  norm.metric().weights->cwiseSqrt().cwiseProduct(motion).cwiseAbs().maxCoeff(&largest);
  return motion[largest] < 0.0 ? -1.0 : 1.0;
}

/// Direction in (y, lambda), of norm one.
struct Direction {
  VectorXd y;
  double lambda = 0.0;
};

/// Response to the load, orthogonal to the null vector, of norm one.
Direction load_direction(PointSolver& solver, const PathPoint& point, const VectorXd& null) {
  const PathMetric& metric = solver.norm().metric();
  Direction out{VectorXd(), 1.0};
  solver.problem().load(point.y, point.lambda, out.y);
  solver.problem().solve(out.y);
  out.y -= metric.inner(out.y, 0.0, null, 0.0) * null;
  const double norm = metric.norm(out.y, out.lambda);
  out.y /= norm;
  out.lambda /= norm;
  return out;
}

/// Direction orthogonal to the known path in the plane of null vector and load response, which contains both
/// paths' tangents. Oriented along the null vector with its largest displacement positive.
Direction direction_across(PointSolver& solver, const PathPoint& point) {
  EquilibriumProblem& problem = solver.problem();
  VectorXd null = null_vector(problem, point, pseudo_random(problem.size(), 1U));
  null *= sense_of(solver.norm(), null);
  const Direction load = load_direction(solver, point, null);
  const PathMetric& metric = solver.norm().metric();
  const double along_null = metric.inner(null, 0.0, point.tangent, point.tangent_lambda);
  const double along_load = metric.inner(load.y, load.lambda, point.tangent, point.tangent_lambda);
  const double scale = (along_load < 0.0 ? -1.0 : 1.0) / std::hypot(along_null, along_load);
  return {scale * (along_load * null - along_null * load.y), -scale * along_null * load.lambda};
}

}  // namespace

std::optional<PathPoint> first_point_of_branch(PathFollower& follower, const CriticalEvent& bifurcation,
                                               double sign) {
  follower.problem().set_context(bifurcation.point.context);
  Direction direction{bifurcation.across, bifurcation.across_lambda};
  if (direction.y.size() == 0) {
    direction = direction_across(follower.solver(), bifurcation.point);
  } else {
    const double along = follower.norm().metric().inner(direction.y, 0.0, bifurcation.null.col(0), 0.0);
    sign *= sense_of(follower.norm(), bifurcation.null.col(0)) * (along < 0.0 ? -1.0 : 1.0);
  }
  if (!direction.y.allFinite()) return std::nullopt;
  PathPoint from = bifurcation.point;
  from.tangent = sign * direction.y;
  from.tangent_lambda = sign * direction.lambda;
  from.arc_length = 0.0;
  StepSize size{0.0, BranchStart::step};
  PathPoint to;
  if (follower.step(from, size, to) != StepOutcome::advanced) return std::nullopt;
  return to;
}

}  // namespace snapthrough
