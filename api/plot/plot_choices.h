#pragma once
/// @file
/// The choices of a figure as a JSON document, for callers that are not C++.

#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "api/plot/plot.h"
#include "solver/model/finding.h"

namespace snapthrough::api {

/// What reading the choices gave. `request` can be used where `findings` is empty; it refers to the document.
struct PlotChoices {
  PlotRequest request;
  std::vector<Finding> findings;
};

/// @brief Reads the choices of a figure: an object whose members are those of PlotRequest by their names, all
/// optional.
///
/// `kind` is a text, `where` an object of texts, `solved_request` the request document that was solved. The
/// findings have pointers into this document.
/// @param document must outlive the result
[[nodiscard]] PlotChoices read_plot_choices(const nlohmann::json& document);

}  // namespace snapthrough::api
