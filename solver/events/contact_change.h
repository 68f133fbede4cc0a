#pragma once
/// @file
/// Where contact begins and ends along a path.

#include <functional>
#include <vector>

#include "solver/path/segment.h"

namespace snapthrough {

/// Counts of contact zones, one a support, at a state.
using ZoneCounter = std::function<void(const Eigen::VectorXd& y, std::vector<int>& zones)>;

/// A place of the path where contact zones begin, end, divide or join.
struct ContactChange {
  PathPoint point;
  std::vector<int> before;
  std::vector<int> after;
};

/// @brief Changes of the counts between two neighbouring points of a path, in the order they are met.
///
/// The curve through both ends says where to look; the path is corrected there, and the bracket closes from
/// both sides, in a few corrections a change. Zones that begin and end within one step are not seen.
/// @param at_kink whether the step led round a kink, so that places are told by the displacement alone
/// @param tolerance on the load factor, relative
[[nodiscard]] std::vector<ContactChange> locate_contact_changes(PointSolver& solver, const PathPoint& a,
                                                                const PathPoint& b, bool at_kink,
                                                                const ZoneCounter& count, double tolerance);

}  // namespace snapthrough
