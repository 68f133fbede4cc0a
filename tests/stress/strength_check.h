#pragma once
/// @file
/// Checks of stresses over strength, first yield and mobilised shares in a result.

#include <functional>
#include <string>
#include <vector>

#include "solver/model/model.h"
#include "solver/result.h"

namespace snapthrough::testing {

/// @brief Checks stresses over strength by the section forces of the states, and first yield by the stresses
/// of the states before and behind it.
/// @param states of the points of paths, in their order
/// @param fail called with what is wrong; the text begins with the check's name and a colon
void check_strength(const Model& model, const Result& result, const std::vector<int>& states,
                    const std::function<void(const std::string&)>& fail);

}  // namespace snapthrough::testing
