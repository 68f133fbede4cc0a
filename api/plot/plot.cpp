#include "api/plot/plot.h"

#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "api/plot/figures.h"
#include "api/plot/result.h"

namespace snapthrough::api {
namespace {

using plot::Field;
using plot::Figure;
using plot::Size;

bool is_table(const nlohmann::json& document) {
  return document.contains("columns") && document.contains("rows");
}

/// Returns whether a member of a document is a non-empty list or object.
bool has(const nlohmann::json& document, const char* key) {
  const auto found = document.find(key);
  return found != document.end() && found->is_structured() && !found->empty();
}

void need_result_or_table(const nlohmann::json& document) {
  if (!document.is_object()) {
    throw PlotError("",
                    "the document must be a result, as snapthrough solve prints it, or a table, as "
                    "snapthrough sweep does");
  }
  if (is_table(document)) {
    return;
  }
  if (document.contains("analysis") || document.contains("parameters")) {
    const bool sweep = document.contains("parameters");
    throw PlotError(
        sweep ? "/parameters" : "/analysis",
        std::string("the document is a request, not a result: solve it first, with snapthrough ") +
            (sweep ? "sweep" : "solve"));
  }
  if (!document.contains("summary") && !document.contains("branches") && !document.contains("states")) {
    throw PlotError(
        "",
        "the document is neither a result (it has no summary) nor a table of a sweep (it has no columns)");
  }
}

Size file_size(const PlotRequest& request, PlotKind kind) {
  const auto checked = [](const std::optional<double>& asked, double otherwise, const char* name) {
    const double value = asked.value_or(otherwise);
    if (!(value >= kLeastPlotSize && value <= kLargestPlotSize)) {
      throw PlotError("", std::string(name) + " of the figure must be 200 to 8000 pixels");
    }
    return value;
  };
  return {checked(request.width, 720, "the width"),
          checked(request.height, kind == PlotKind::sections ? 600 : 480, "the height")};
}

bool is_for_table(PlotKind kind) { return kind == PlotKind::sweep || kind == PlotKind::heatmap; }

Figure figure_of(const plot::ResultInput& input, const PlotRequest& request, PlotKind kind, Size size) {
  switch (kind) {
    case PlotKind::path:
      return plot::path_figure(input, request, size);
    case PlotKind::shape:
      return plot::shape_figure(input, request, size);
    case PlotKind::sections:
      return plot::sections_figure(input, request, size);
    case PlotKind::mode:
      return plot::mode_figure(input, request, size);
    case PlotKind::sweep:
      return plot::sweep_figure(input.result, request, size);
    case PlotKind::heatmap:
      return plot::heatmap_figure(input.result, request, size);
  }
  throw PlotError("", "the kind of figure does not exist");
}

}  // namespace

PlotError::PlotError(std::string pointer, std::string rule)
    : std::runtime_error(pointer.empty() ? rule : pointer + ": " + rule),
      pointer_(std::move(pointer)),
      rule_(std::move(rule)) {}

PlotKind default_plot_kind(const nlohmann::json& document) {
  need_result_or_table(document);
  if (is_table(document)) {
    return plot::is_for_heatmap(Field(document)) ? PlotKind::heatmap : PlotKind::sweep;
  }
  if (document.contains("buckling")) {
    return PlotKind::mode;
  }
  if (document.contains("static") && has(document, "states")) {
    return PlotKind::shape;
  }
  if (has(document, "branches") || document.contains("static")) {
    return PlotKind::path;
  }
  return has(document, "states") || document.contains("failure") ? PlotKind::shape : PlotKind::mode;
}

std::string svg_of(const nlohmann::json& document, const PlotRequest& request) {
  need_result_or_table(document);
  if (request.magnify && !(*request.magnify > 0 && *request.magnify <= 1e9)) {
    throw PlotError("", "magnify must be more than 0, and at most 1e9");
  }
  const PlotKind kind = request.kind ? *request.kind : default_plot_kind(document);
  if (is_for_table(kind) != is_table(document)) {
    throw PlotError("", std::string("the document is ") +
                            (is_table(document) ? "a table of a sweep" : "a result") +
                            ", which has no figure of kind " + std::string(name_of(kPlotKinds, kind)));
  }
  const Field field(document);
  plot::ResultInput input{field, std::nullopt, plot::read_units(field)};
  if (request.solved_request != nullptr && !is_for_table(kind)) {
    input.model = plot::read_model(*request.solved_request);
  }
  const std::string heading = plot::read_title(field);
  Size size = file_size(request, kind);
  const Size content = plot::content_size(size, heading);
  Figure figure = figure_of(input, request, kind, content);
  if (figure.height > 0) {
    size.height -= content.height - figure.height;
  }
  return plot::file_of(std::move(figure), size, heading, request.dark);
}

}  // namespace snapthrough::api
