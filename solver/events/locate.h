#pragma once
/// @file
/// Locates the critical points between two points of a path.

#include "solver/events/critical_event.h"
#include "solver/path/path_follower.h"

namespace snapthrough {

/// @brief All critical points between two neighbouring points of a path, in the order in which the path meets
/// them.
///
/// The inertia of both ends tells whether something is between them and how much; bisection separates what is
/// close together. A simple point is found by Newton's method from the softest motions of the ends
/// (newton_event.h) or, where these are not known or Newton's method fails, as a zero (root_finder.h) of
/// dlambda/ds (limit point) or of det(J) / (dlambda/ds) (bifurcation), which changes its sign at no limit
/// point. What stays together within the tolerance is one point of higher multiplicity. Pairs that leave the
/// inertia as it was are looked for where hidden_events.h says.
[[nodiscard]] LocatedEvents locate_critical_points(PointSolver& solver, const PathPoint& a,
                                                   const PathPoint& b, const LocateOptions& options);

/// @brief All critical points on a step that led round a kink (StepOutcome::kinked), where places are
/// measured by the displacement alone. A change of inertia that cannot be bracketed there is put at the last
/// point before the kink, with contact as its cause, where that is close to the end of the step; else the
/// step is not on one path.
/// @param size of the step that was taken
[[nodiscard]] LocatedEvents locate_at_kink(PathFollower& follower, const PathPoint& a, const PathPoint& b,
                                           double size, const LocateOptions& options);

}  // namespace snapthrough
