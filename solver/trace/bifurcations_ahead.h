#pragma once
/// @file
/// Bifurcations that the softest motions of a point show before a step is taken over them.

#include <vector>

#include "solver/events/critical_event.h"
#include "solver/path/point_solver.h"

namespace snapthrough {

/// Bounds on bifurcations that are looked for.
struct BifurcationBounds {
  double tolerance = 1e-9;    ///< relative tolerance on the load factor of a located bifurcation
  double most_broken = 1e-3;  ///< largest imperfection of the first bifurcation; else none is returned
};

/// @brief The bifurcations that the stiffnesses of motions at a point predict within the next step or the one
/// after: a step over them could end on a path that crosses there.
/// @param wanted size of the next step
[[nodiscard]] std::vector<CriticalEvent> predicted_bifurcations(PointSolver& solver, const PathPoint& from,
                                                                double wanted,
                                                                const BifurcationBounds& bounds);

/// @brief The bifurcations that a step passed although its ends have the same inertia: a motion's stiffness
/// fell before them and rises beyond, because the step ended on a path that crosses there, or passes them by.
[[nodiscard]] std::vector<CriticalEvent> bifurcations_stepped_over(PointSolver& solver, const PathPoint& from,
                                                                   const PathPoint& to,
                                                                   const BifurcationBounds& bounds);

}  // namespace snapthrough
