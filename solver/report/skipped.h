#pragma once
/// @file
/// What an analysis does not do because nobody asked for it or nothing needs it.

#include <string>
#include <vector>

#include "solver/model/analysis.h"
#include "solver/model/model.h"

namespace snapthrough {

/// @brief Whether points between the critical ones need not be equilibria to rounding: nobody gets their
/// states, and the mesh was chosen for an accuracy.
[[nodiscard]] bool points_are_not_polished(const Analysis& analysis);

/// @brief Sentences for `diagnostics.skipped`, "what: why", without what the mesh leaves out by itself.
[[nodiscard]] std::vector<std::string> skipped_work(const Model& model, const Analysis& analysis);

}  // namespace snapthrough
