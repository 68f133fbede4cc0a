#pragma once
/// @file
/// Extreme section forces and displacements over many states.

#include <vector>

#include "solver/result.h"

namespace snapthrough {

/// @brief Widens extremes by those of one more state at its sampled places.
/// @param members of every state the same, in the same order
/// @param extremes of each member; empty before the first state
void widen_extremes(const std::vector<MemberState>& members, int branch, double load_factor,
                    std::vector<MemberExtremes>& extremes);

}  // namespace snapthrough
