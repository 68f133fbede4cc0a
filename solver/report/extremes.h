#pragma once
/// @file
/// Extreme section forces and displacements over all states.

#include <vector>

#include "solver/result.h"

namespace snapthrough {

/// @brief Extends the extremes that members have over several states by those of one more state.
/// @param members same members in the same order at every call
/// @param extremes one entry per member; empty before the first state
void widen_extremes(const std::vector<MemberState>& members, int branch, double load_factor,
                    std::vector<MemberExtremes>& extremes);

}  // namespace snapthrough
