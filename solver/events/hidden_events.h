#pragma once
/// @file
/// Signs of critical points between two points of a path that both ends' inertia does not show.

#include <optional>

#include "solver/path/path_point.h"
#include "solver/path/segment.h"

namespace snapthrough {

/// A fall and rise of a motion's stiffness between two points of a path.
struct Dip {
  Eigen::Index mode = 0;  ///< index of the motion among the modes of the first point
  double fraction = 0.5;  ///< fraction of the way where the tangents of the stiffness meet
};

/// @brief Whether the stiffness of a motion falls towards zero at a and rises at b, so that its tangents meet
/// beyond zero: then it may pass zero twice between the points, and leave the inertia as it was.
/// @param length of the way from a to b
/// @return empty as well where modes are not known at both points
[[nodiscard]] std::optional<Dip> find_dip(const PathPoint& a, const PathPoint& b, double length);

/// @brief Fraction of a segment at which the stiffness of a motion may lie beyond zero although its tangents
/// at the ends do not meet there, as before a knee: the stiffness falls from its first value and rises faster
/// than the tangents tell.
[[nodiscard]] std::optional<double> knee_fraction(const Segment& segment);

/// @brief Fraction of a segment at which the cubic through the loads and load rates of both ends turns,
/// although the load does not turn at the ends.
/// @param tolerance least excess of the rates over the load's change, within a segment that is `inside` a
/// step that was searched already: a jump of the rate at a kink has none
[[nodiscard]] std::optional<double> turn_fraction(const Segment& segment, bool inside, double tolerance);

}  // namespace snapthrough
