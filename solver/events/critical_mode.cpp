#include "solver/events/critical_mode.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "solver/numeric/pseudo_random.h"

namespace snapthrough {

using Eigen::VectorXd;

VectorXd null_vector(EquilibriumProblem& problem, const PathPoint& point, VectorXd start) {
  constexpr int kLeastIterations = 4;
  constexpr int kMostIterations = 60;  // limit for stiff structures, whose lowest mode converges slowly
  constexpr double kSettled = 1e-12;   // change of the normalised vector per iteration
  const VectorXd& weights = problem.metric();
  const auto norm = [&weights](const VectorXd& x) {
    return std::sqrt((x.array().square() * weights.array()).sum());
  };
  problem.set_holds(point.holds);
  VectorXd residual;
  problem.linearise(point.y, point.lambda, residual);
  VectorXd x = std::move(start);
  double change = 1.0;
  for (int it = 0; it < kLeastIterations || (it < kMostIterations && change > kSettled); ++it) {
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
