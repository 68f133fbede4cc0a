#pragma once
/// @file
/// Switching to the other path through a bifurcation.

#include <optional>

#include "solver/events/critical_event.h"
#include "solver/path/path_follower.h"

namespace snapthrough {

/// @brief First point of the path that crosses the known path at a bifurcation.
///
/// The tangents of both paths lie in the plane of the tangent stiffness' null vector and the load response.
/// The step goes orthogonally to the known path in that plane, and the correction is normal to the step, so
/// that it cannot return to the known path. At a multiple bifurcation this is one of several directions.
/// @param bifurcation located bifurcation with the tangent of the known path
/// @param sign +1 or -1: direction along the null vector with its largest displacement positive
/// @return empty when no point was found nearby; its arc length counts from the bifurcation
[[nodiscard]] std::optional<PathPoint> first_point_of_branch(PathFollower& follower,
                                                             const CriticalEvent& bifurcation, double sign);

}  // namespace snapthrough
