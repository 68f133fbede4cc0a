#pragma once
/// @file
/// Messages on loads that one-sided supports cannot hold.

#include <string>

#include "solver/discrete/free_motions.h"
#include "solver/discrete/unilateral_balance.h"
#include "solver/resolve/resolved_model.h"

namespace snapthrough {

/// @brief Clause that names the members with the largest motion, that motion (rotation about a point, or
/// shift, in the model's axes) and the load that drives it, or states that no load presses the part onto its
/// supports.
/// @param escape a motion of `motions`, which belong to `model`
[[nodiscard]] std::string escape_text(const ResolvedModel& model, const FreeMotions& motions,
                                      const Escape& escape);

/// @brief The members with the largest motion, and that motion: "member "m" can turn clockwise about ...".
[[nodiscard]] std::string motion_of_escape(const ResolvedModel& model, const FreeMotions& motions,
                                           const Escape& escape);
/// @brief Name of the load that does most work on an escape.
[[nodiscard]] std::string driver_of_escape(const FreeMotions& motions, const Escape& escape);

}  // namespace snapthrough
