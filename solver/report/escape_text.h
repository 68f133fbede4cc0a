#pragma once
/// @file
/// Loads that one-sided supports cannot hold, in words.

#include <string>

#include "solver/discrete/free_motions.h"
#include "solver/discrete/unilateral_balance.h"
#include "solver/model/model.h"

namespace snapthrough {

/// @brief A clause that names the members that move most, their motion (a turn about a point or node, or a
/// shift, in the model's axes) and the load that does most work on it; of a motion without work, that nothing
/// presses the part onto its supports.
/// @param escape of `motions`, which are those of `model`
[[nodiscard]] std::string escape_text(const Model& model, const FreeMotions& motions, const Escape& escape);

}  // namespace snapthrough
