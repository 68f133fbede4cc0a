#include "solver/stability/branch.h"

#include <cmath>

#include "solver/linalg/pseudo_random.h"
#include "solver/stability/critical_mode.h"

namespace snapthrough {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr double kFirstStep = 0.01;  ///< displacement gradient

/// The tangent's null vector in displacements, largest component positive.
VectorXd oriented_null_vector(Continuation& continuation, const PathPoint& point) {
  EquilibriumProblem& problem = continuation.problem();
  const VectorXd x = null_vector(problem, point, pseudo_random(problem.size(), 1U));
  Index largest = 0;
  problem.metric().cwiseSqrt().cwiseProduct(x).cwiseAbs().maxCoeff(&largest);
  return x[largest] < 0.0 ? VectorXd(-x) : x;
}

/// A direction in (y, lambda).
struct Direction {
  VectorXd y;
  double lambda = 0.0;
};

/// Response to the load without its part along the null vector.
Direction load_direction(Continuation& continuation, const PathPoint& point, const VectorXd& null) {
  const PathMetric& metric = continuation.metric();
  Direction out{VectorXd(), 1.0};
  continuation.problem().load(point.y, point.lambda, out.y);
  continuation.problem().solve(out.y);
  out.y -= metric.inner(out.y, 0.0, null, 0.0) * null;
  const double norm = metric.norm(out.y, out.lambda);
  out.y /= norm;
  out.lambda /= norm;
  return out;
}

}  // namespace

std::optional<PathPoint> first_point_of_branch(Continuation& continuation, const PathPoint& bifurcation,
                                               double sign) {
  const PathMetric& metric = continuation.metric();
  continuation.problem().set_holds(bifurcation.holds);
  const VectorXd null = oriented_null_vector(continuation, bifurcation);
  if (!null.allFinite()) return std::nullopt;
  const Direction load = load_direction(continuation, bifurcation, null);
  // both paths' tangents lie in the plane of these two: take the direction across the known one
  const double along_null = metric.inner(null, 0.0, bifurcation.tangent, bifurcation.tangent_lambda);
  const double along_load =
      metric.inner(load.y, load.lambda, bifurcation.tangent, bifurcation.tangent_lambda);
  const double scale = (along_load < 0.0 ? -sign : sign) / std::hypot(along_null, along_load);
  PathPoint from = bifurcation;
  from.tangent = scale * (along_load * null - along_null * load.y);
  from.tangent_lambda = -scale * along_null * load.lambda;
  from.arc_length = 0.0;
  StepSize size{0.0, kFirstStep};
  PathPoint to;
  if (continuation.step(from, size, to) != StepOutcome::advanced) return std::nullopt;
  return to;
}

}  // namespace snapthrough
