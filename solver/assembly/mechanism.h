#pragma once
/// @file
/// Detection of structures that can move without strain.

#include <vector>

#include "solver/model/check.h"

namespace snapthrough {

/// @brief A finding with code "mechanism" when the unloaded structure, with one-sided supports counted as
/// glued, can be moved by an arbitrarily small force; empty otherwise.
/// @pre the model passed all other checks
[[nodiscard]] std::vector<Finding> find_mechanism(const Model& model);

/// @brief Whether a look at the supports is enough to see that find_mechanism() would find nothing: few
/// straight members and arcs of comparable stiffnesses, all connected and without releases, whose rigid
/// supports alone keep the whole from moving, none of it by a short lever.
/// @return false when this is not so plain
/// @pre the model passed all other checks
[[nodiscard]] bool is_plainly_held(const Model& model);

}  // namespace snapthrough
