#pragma once
/// @file
/// Size of a mesh that a request gives.

#include "solver/model/analysis.h"
#include "solver/model/model.h"

namespace snapthrough {

/// @brief Number of elements of a given mesh, counted without making it.
/// @pre asked.fixed_mesh, and check() found nothing
[[nodiscard]] long long given_elements(const Model& model, const Discretization& asked);

}  // namespace snapthrough
