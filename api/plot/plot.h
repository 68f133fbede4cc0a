#pragma once
/// @file
/// Figures of results, models and sweep tables as SVG texts, styled as the figures of the web page.
///
/// All functions are pure: no files, threads or global state. Equal arguments give equal bytes. Loops whose
/// length a document sets poll WorkLimit (solver/numeric/work_limit.h).

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "api/plot/plot_request.h"

namespace snapthrough::api {

/// @brief Returns the default kind of a document. Table with two parameters of more than six values each:
/// heatmap; other table: sweep. Result with buckling modes: mode; with static rows and states: shape; with
/// branches or static rows: path; else with states: shape; else mode. A model without an analysis: model.
/// @throws PlotError when the document is neither a result, nor a table, nor a model
[[nodiscard]] PlotKind default_plot_kind(const nlohmann::json& document);

/// @brief Returns the SVG text of a result document (output of `snapthrough solve`), of a sweep table (output
/// of `snapthrough sweep`), or of a model: a request, `{"model": ...}`, or the model itself, such as
/// `snapthrough convert` prints it.
///
/// The text is one XML document in UTF-8 with styles, <title> and <desc>; labels are text elements, numbers
/// are finite. Reentrant.
/// @throws PlotError when the document or the request is invalid; std::bad_alloc
[[nodiscard]] std::string svg_of(const nlohmann::json& document, const PlotRequest& request = {});

}  // namespace snapthrough::api
