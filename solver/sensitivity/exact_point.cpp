#include "solver/sensitivity/exact_point.h"

#include <utility>

#include "solver/events/critical_mode.h"
#include "solver/numeric/pseudo_random.h"

namespace snapthrough {

using Eigen::Index;

namespace {

/// Index of the null motion whose stiffness vanishes nearest to a load factor.
Index nearest_target(const CriticalSolution& solution, double lambda) {
  const auto spectrum = solution.spectrum();
  Index target = 0;
  if (spectrum) (solution.lambda + spectrum->distances.array() - lambda).abs().minCoeff(&target);
  return target;
}

}  // namespace

std::optional<ExactPoint> exact_point(EquilibriumProblem& problem, const PathMetric& metric,
                                      const LocatedPoint& at, int& factorisations) {
  const CriticalEvent& event = at.event;
  const bool limit = is_limit(event.type);
  CriticalOptions options;
  options.tolerance = 1e-13;
  options.place = 1e-9;
  options.reach = at.reach;
  options.least_load = at.least_load;
  CriticalGuess guess{event.point.y, event.point.lambda, {}};
  if (event.null.cols() > 0) {
    guess.null = event.null.col(0);
  } else {
    ++factorisations;
    guess.null =
        null_vector(problem, event.point, limit ? event.point.tangent : pseudo_random(problem.size(), 1U));
  }
  std::optional<ExactPoint> best;
  // the second solution updates the derivatives, which lag by one iteration
  for (int time = 0; time < 2; ++time) {
    auto found = limit ? solve_limit_point(problem, metric, guess, options, factorisations)
                       : solve_bifurcation(problem, metric, guess, options, factorisations);
    if (!found) break;
    const Index target = nearest_target(*found, event.point.lambda);
    guess = {found->y, found->lambda, found->null, target};
    best = ExactPoint{*std::move(found), target};
  }
  return best;
}

}  // namespace snapthrough
