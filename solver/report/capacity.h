#pragma once
/// @file
/// Reports limit loads of supports with a capacity.

#include <string>

#include "solver/discrete/capacity_balance.h"
#include "solver/resolve/resolved_model.h"
#include "solver/result.h"

namespace snapthrough {

/// @brief Entry of a result for a limit load.
/// @param load_factor of the limit, in the model's units
[[nodiscard]] CapacityLimit capacity_limit(const ResolvedModel& model, const CapacityEnds& ends,
                                           const CapacityEnd& end, double load_factor);

/// @brief Clause that names the members that can move, their motion, the supports that are at their capacity
/// and the load that drives the motion.
[[nodiscard]] std::string capacity_text(const ResolvedModel& model, const CapacityEnds& ends,
                                        const CapacityEnd& end);

}  // namespace snapthrough
