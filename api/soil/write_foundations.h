#pragma once
/// @file
/// Writes the curves of a pile in layered soil as foundations of a model.

#include <cstddef>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "api/soil/layers.h"
#include "solver/model/finding.h"

namespace snapthrough::api::soil {

/// Returns the id of a foundation: the pile's, and the numbers of its layer, part and curve, which count from
/// 1.
/// @param kind "", or the name of curves beside the lateral ones, such as " axial"
/// @param curve 0: the only one of its layer
[[nodiscard]] std::string foundation_id(const Pile& pile, const Layer& layer, std::string_view kind,
                                        std::size_t curve);

/// @brief Returns an array of foundations with laws by depth, layer by layer, as a model has them.
///
/// docs/howto/convert.md has the formulas. Polls WorkLimit. @pre the profile reaches the pile's tip
/// @param[in,out] numbers number of numbers by depth that the document's laws have so far
/// @param findings gets the layers that have no laws, as "/layers/0", "out_of_range"
[[nodiscard]] nlohmann::json write_foundations(const Profile& profile, const Pile& pile, std::size_t& numbers,
                                               std::vector<Finding>& findings);

}  // namespace snapthrough::api::soil
