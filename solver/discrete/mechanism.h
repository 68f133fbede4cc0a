#pragma once
/// @file
/// Detection of structures that can move without strain.

#include <vector>

#include "solver/model/finding.h"
#include "solver/model/model.h"

namespace snapthrough {

/// @brief A finding with code "mechanism" when the loads do work on a motion of the unloaded structure
/// without strain, with one-sided supports counted as glued; empty otherwise. A motion that no load drives is
/// none: the analysis holds it and tells of it (Result::neutral_motion). With code "too_connected" when that
/// would take too long.
/// @pre the model passed all other checks
[[nodiscard]] std::vector<Finding> find_mechanism(const Model& model);

/// @brief Whether the unloaded structure, with one-sided supports counted as glued, can move without strain.
/// @pre the model passed all other checks
[[nodiscard]] bool can_move(const Model& model);

/// @brief Whether a look at the supports is enough to see that find_mechanism() would find nothing: few
/// straight members and arcs of comparable stiffnesses, all connected and without releases, whose rigid
/// supports alone keep the whole from moving, none of it by a short lever.
/// @return false when this is not so plain
/// @pre the model passed all other checks
[[nodiscard]] bool is_plainly_held(const Model& model);

}  // namespace snapthrough
