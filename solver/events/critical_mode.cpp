#include "solver/events/critical_mode.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "solver/numeric/pseudo_random.h"

namespace snapthrough {

using Eigen::VectorXd;

namespace {
/// Inverse iteration. Source: rounding; stiff structures, whose lowest mode converges slowly.
struct NullSearch {
  static constexpr int least = 4;           ///< iterations at least
  static constexpr int most = 60;           ///< iterations at most
  static constexpr double settled = 1e-12;  ///< last change of the normalised vector
};
}  // namespace

VectorXd null_vector(EquilibriumProblem& problem, const PathPoint& point, VectorXd start) {
  const VectorXd& weights = problem.metric();
  const auto norm = [&weights](const VectorXd& x) {
    return std::sqrt((x.array().square() * weights.array()).sum());
  };
  problem.set_context(point.context);
  VectorXd residual;
  problem.linearise(point.y, point.lambda, residual);
  VectorXd x = std::move(start);
  double change = 1.0;
  for (int it = 0; it < NullSearch::least || (it < NullSearch::most && change > NullSearch::settled); ++it) {
    VectorXd next = weights.cwiseProduct(x);
    problem.solve(next);
    next /= norm(next);
    change = std::min(norm(next - x), norm(next + x));
    x = std::move(next);
  }
  return x;
}

VectorXd mode_of(EquilibriumProblem& problem, const CriticalEvent& event) {
  const bool limit = event.type != CriticalType::bifurcation;
  if (limit && event.cause == CriticalCause::contact) return event.point.tangent;
  if (event.null.size() > 0) return event.null.col(0);
  return null_vector(problem, event.point, limit ? event.point.tangent : pseudo_random(problem.size(), 1U));
}

}  // namespace snapthrough
