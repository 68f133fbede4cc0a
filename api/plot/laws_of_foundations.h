#pragma once
/// @file
/// Groups of the laws of foundations. Internal to laws.cpp.

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "api/plot/law_group.h"
#include "api/plot/model.h"

namespace snapthrough::api::plot {

/// Which supports of a model a figure shows the laws of, with the foundations in soil, from which reading
/// makes several foundations each.
struct LawChoice {
  std::optional<std::string> id;               ///< nullopt: all
  bool is_soil = false;                        ///< `id` is that of a foundation in soil, which gives others
  std::vector<std::string> soils;              ///< ids of the foundations in soil
  std::map<std::string, double> ground_level;  ///< by member in soil
  [[nodiscard]] bool has(const std::string& support) const;
};

/// @param model with its soils, if any
[[nodiscard]] LawChoice read_law_choice(const Field& model, const std::optional<std::string>& id);

/// Returns the laws of foundations, with a place on both sides of each fraction at which their numbers bend.
/// @param model without soils @param known the same, read
[[nodiscard]] std::vector<LawGroup> foundation_law_groups(const Field& model, const Model& known,
                                                          const LawChoice& choice);

}  // namespace snapthrough::api::plot
