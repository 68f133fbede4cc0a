#pragma once
/// @file
/// A pile in layered soil, as a soil document describes it.

#include <map>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "api/soil/layers.h"
#include "solver/model/finding.h"

namespace snapthrough::api::convert {

/// A valid soil document. Layers reach the pile's tip.
struct SoilDocument {
  std::map<std::string, std::string> units;  ///< carried over, never interpreted
  soil::Pile pile;
  soil::Profile profile;
};

/// Returns the document; its value has no meaning when `findings` gets entries.
[[nodiscard]] SoilDocument read_soil(const nlohmann::json& json, std::vector<Finding>& findings);

}  // namespace snapthrough::api::convert
