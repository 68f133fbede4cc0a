#pragma once
/// @file
/// Critical points of a path by Newton's method, started from its softest motions.

#include <optional>
#include <vector>

#include "solver/events/critical_event.h"
#include "solver/path/segment.h"

namespace snapthrough {

/// @brief Bifurcations that a path meets, or passes by a small imperfection, after one of its points.
/// @param modes indices of the motions at `from` whose stiffnesses vanish there
/// @param distance estimated distance along the tangent
/// @param reach largest distance from the estimate
/// @param tolerance relative tolerance on the load factor
/// @return bifurcations in path order, with the tangent of the followed path; empty when none is within
/// reach, or when other motions lose their stiffness earlier
/// @pre from.modes is set
[[nodiscard]] std::vector<CriticalEvent> bifurcations_beyond(PointSolver& solver, const PathPoint& from,
                                                             const std::vector<Eigen::Index>& modes,
                                                             double distance, double reach, double tolerance);

/// @brief Locates a simple critical point that is known approximately, for example from a coarser mesh.
/// @param known type, and negative eigenvalues on both sides
/// @param at guess of the point, with the path's direction
/// @param null guess of the null motions, the vanishing one and its neighbours
/// @param reach largest distance from the guess
[[nodiscard]] std::optional<CriticalEvent> critical_point_near(PointSolver& solver,
                                                               const CriticalEvent& known,
                                                               const PathPoint& at, Eigen::MatrixXd null,
                                                               double reach, double tolerance);

/// @brief The simple critical point on a segment whose ends differ by one in their inertia.
/// @param limit true: limit point; false: bifurcation
/// @return empty when Newton's method does not find it between them
[[nodiscard]] std::optional<CriticalEvent> crossing_between(PointSolver& solver, const Segment& segment,
                                                            bool limit, const LocateOptions& options);

}  // namespace snapthrough
