#pragma once
/// @file
/// Critical points of a path, solved to rounding.

#include <optional>

#include "solver/events/critical_event.h"
#include "solver/events/critical_system.h"

namespace snapthrough {

/// Critical point with the norm and scales of its path.
struct LocatedPoint {
  const CriticalEvent& event;
  double load_weight = 0.0;  ///< load weight of the path's metric
  double reach = 0.1;        ///< largest allowed distance from the given point, in the metric
  double least_load = 0.0;   ///< lower bound of the load factor to which tolerances are relative
};

/// Critical point exact to rounding.
struct ExactPoint {
  CriticalSolution solution;
  Eigen::Index target = 0;  ///< index of the null motion that belongs to the event
};

/// @brief Solves for the critical point by Newton's method; empty when the iteration fails.
[[nodiscard]] std::optional<ExactPoint> exact_point(EquilibriumProblem& problem, const PathMetric& metric,
                                                    const LocatedPoint& at, int& factorisations);

}  // namespace snapthrough
