#pragma once
/// @file
/// What a request needs in memory at the least, known before anything is computed.

#include <cstdint>
#include <vector>

#include "solver/check/check.h"

namespace snapthrough::server {

/// @brief Bytes that no analysis of this request does without: those of a mesh that it gives itself. 0 when
/// the mesh is the solver's choice; such an analysis is bounded while it runs only.
[[nodiscard]] std::int64_t least_memory(const Model& model, const Analysis& analysis);

/// @brief The finding that a request cannot be solved in so much memory; empty when it may be.
/// @pre check(model, analysis) is empty
[[nodiscard]] std::vector<Finding> check_memory(const Model& model, const Analysis& analysis,
                                                std::int64_t limit);

}  // namespace snapthrough::server
