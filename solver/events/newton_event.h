#pragma once
/// @file
/// Critical points of a path from the stiffnesses of its softest motions, by Newton's method.

#include <optional>
#include <vector>

#include "solver/events/critical_event.h"
#include "solver/path/segment.h"

namespace snapthrough {

/// @brief The bifurcations that a path meets, or passes by a small imperfection, beyond one of its points:
/// that of one motion, or those of several which lose their stiffness close together.
/// @param modes of that point whose stiffnesses vanish there
/// @param distance along the tangent, about
/// @param reach farthest from there
/// @param tolerance on the load factor, relative
/// @return in the order they are met, with the tangent of the path that goes on; none where there are none
/// within reach, or where other motions lose their stiffness before
/// @pre from.modes
[[nodiscard]] std::vector<CriticalEvent> bifurcations_beyond(PointSolver& solver, const PathPoint& from,
                                                             const std::vector<Eigen::Index>& modes,
                                                             double distance, double reach, double tolerance);

/// @brief The simple critical point of a kind that is known from elsewhere, as from a coarser mesh.
/// @param known its type and the inertia on both sides
/// @param at guess of the point, with the path's direction
/// @param null guess of the motion without stiffness, and of those that lose it close by
/// @param reach farthest from the guess
[[nodiscard]] std::optional<CriticalEvent> critical_point_near(PointSolver& solver,
                                                               const CriticalEvent& known,
                                                               const PathPoint& at, Eigen::MatrixXd null,
                                                               double reach, double tolerance);

/// @brief The simple critical point on a segment whose ends differ by one in their inertia.
/// @param limit whether the load turns there
/// @return empty when Newton's method does not find it between them
[[nodiscard]] std::optional<CriticalEvent> crossing_between(PointSolver& solver, const Segment& segment,
                                                            bool limit, const LocateOptions& options);

}  // namespace snapthrough
