#pragma once
/// @file
/// Work that an analysis omits because it is not requested or not needed.

#include <string>
#include <vector>

#include "solver/model/analysis.h"
#include "solver/resolve/resolved_model.h"

namespace snapthrough {

/// @brief Whether points between critical ones may be corrected to less than rounding: their states are not
/// reported, and the mesh is chosen for an accuracy.
[[nodiscard]] bool points_are_not_polished(const Analysis& analysis);

/// @brief Sentences "what: why" for `diagnostics.skipped`, without those of the mesh.
[[nodiscard]] std::vector<std::string> skipped_work(const ResolvedModel& model, const Analysis& analysis);

}  // namespace snapthrough
