#pragma once
/// @file
/// All laws of a model's foundations, springs and joints.

#include <optional>
#include <string>
#include <vector>

#include "api/plot/document.h"
#include "api/plot/law_group.h"

namespace snapthrough::api::plot {

/// @brief Reads the laws of a model: foundations by the direction of their reaction and by the members that
/// continue one another, then springs, springs against rotation, and joints (`release`).
/// @param id of a spring, a foundation, a foundation in soil, or a member with joints; nullopt: all
/// @throws PlotError when the model has no such law, or one that breaks a rule of docs/requests.md, "Laws"
[[nodiscard]] std::vector<LawGroup> read_law_groups(const Field& model, const std::optional<std::string>& id);

}  // namespace snapthrough::api::plot
