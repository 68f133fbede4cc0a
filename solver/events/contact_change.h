#pragma once
/// @file
/// Load factors at which contact zones begin and end along a path.

#include <functional>
#include <vector>

#include "solver/path/segment.h"

namespace snapthrough {

/// Writes the number of contact zones of each support at state y into `zones`.
using ZoneCounter = std::function<void(const Eigen::VectorXd& y, std::vector<int>& zones)>;

/// Path point at which contact zones begin, end, divide or join, with the zone counts on both sides.
struct ContactChange {
  PathPoint last_before;  ///< next to `point`, with the counts before the change
  PathPoint point;
  std::vector<int> before;
  std::vector<int> after;
};

/// @brief Locates all changes of the zone counts between two neighbouring path points, in path order.
///
/// The path is interpolated between both ends to predict a change and corrected there; a bracket shrinks from
/// both sides. A zone that begins and ends within the step is missed.
/// @param at_kink whether the step passes a kink; positions are then measured by the displacement alone
/// @param tolerance on the load factor, relative
[[nodiscard]] std::vector<ContactChange> locate_contact_changes(PointSolver& solver, const PathPoint& a,
                                                                const PathPoint& b, bool at_kink,
                                                                const ZoneCounter& count, double tolerance);

}  // namespace snapthrough
