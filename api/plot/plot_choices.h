#pragma once
/// @file
/// The choices of a figure (PlotRequest) as a JSON document, for callers in other languages.

#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "api/plot/plot_request.h"
#include "solver/model/finding.h"

namespace snapthrough::api {

/// Outcome of reading the choices. `request` is valid when `findings` is empty, and refers to the document.
struct PlotChoices {
  PlotRequest request;
  std::vector<Finding> findings;
};

/// @brief Reads the choices of a figure from an object with the members of PlotRequest, all optional.
///
/// `kind` is a text, `where` an object of texts, `solved_request` the request document of the result.
/// Pointers of findings refer to `document`.
/// @param document must outlive the result
[[nodiscard]] PlotChoices read_plot_choices(const nlohmann::json& document);

}  // namespace snapthrough::api
