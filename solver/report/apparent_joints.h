#pragma once
/// @file
/// Places of a model that look joined in a drawing and are not, or are drawn twice.

#include <vector>

#include "solver/resolve/resolved_model.h"
#include "solver/result.h"

namespace snapthrough {

/// @brief Warnings of a model's geometry, at most one of each code.
///
/// With the tolerance 1e-3 of the shortest member among those that meet there:
/// - `tee_unjoined`: a node lies on a member between its ends, and no spring joins them;
/// - `near_nodes`: two nodes are nearer to each other than the tolerance, no member and no spring joins them,
///   and they are not both supported in x and y;
/// - `stacked_members`: two members between the same nodes have the same axis, to 1e-9 of its length.
///
/// n log n operations for n nodes and members; the search ends early where thousands of nodes lie in one
/// place.
[[nodiscard]] std::vector<Warning> apparent_joints(const ResolvedModel& model);

}  // namespace snapthrough
