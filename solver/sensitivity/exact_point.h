#pragma once
/// @file
/// A critical point of a path, found again to rounding.

#include <optional>

#include "solver/events/critical_event.h"
#include "solver/events/critical_system.h"

namespace snapthrough {

/// A critical point and the measures of the path that it was found on.
struct LocatedPoint {
  const CriticalEvent& event;
  double load_weight = 0.0;  ///< of the path's metric
  double reach = 0.1;        ///< farthest that the point may be off, in the metric
  double least_load = 0.0;   ///< load that tolerances are relative to at least
};

/// A critical point to rounding.
struct ExactPoint {
  CriticalSolution solution;
  Eigen::Index target = 0;  ///< which of its null motions is the event's
};

/// @return empty where Newton's method does not find it
[[nodiscard]] std::optional<ExactPoint> exact_point(EquilibriumProblem& problem, const PathMetric& metric,
                                                    const LocatedPoint& at, int& factorisations);

}  // namespace snapthrough
