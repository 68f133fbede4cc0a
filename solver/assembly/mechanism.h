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

}  // namespace snapthrough
