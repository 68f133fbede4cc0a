#pragma once
/// @file
/// Switching onto the other path through a bifurcation.

#include <optional>

#include "solver/events/critical_event.h"
#include "solver/path/path_follower.h"

namespace snapthrough {

/// @brief The first point of the path that crosses another one at a bifurcation.
///
/// Both paths' tangents lie in the plane of the tangent stiffness' null vector and the response to the load;
/// the direction taken is the one across the known path in it, and the point is corrected in the plane normal
/// to that, so it cannot fall back. At a bifurcation of higher multiplicity this is one of several
/// directions.
/// @param bifurcation a located bifurcation, with the tangent of the known path
/// @param sign +1 or -1: which way along the null vector (its largest component positive)
/// @return empty when no point was found nearby; otherwise its arc length counts from the bifurcation
[[nodiscard]] std::optional<PathPoint> first_point_of_branch(PathFollower& follower,
                                                             const CriticalEvent& bifurcation, double sign);

}  // namespace snapthrough
