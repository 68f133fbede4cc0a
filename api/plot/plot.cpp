#include "api/plot/plot.h"

#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "api/plot/figures.h"
#include "api/plot/ink.h"
#include "api/plot/plot_error.h"
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

bool is_result(const nlohmann::json& document) {
  return document.contains("summary") || document.contains("branches") || document.contains("states");
}

/// Returns the model of a request, of `{"model": ...}`, or the document if it is a model; nullopt for others.
/// A result has a member `model`, too, but without nodes.
std::optional<Field> model_of(const nlohmann::json& document) {
  if (document.contains("nodes")) {
    return Field(document);
  }
  const auto model = document.find("model");
  return model != document.end() && model->contains("nodes") ? std::optional(Field(document).at("model"))
                                                             : std::nullopt;
}

/// Returns the model whose laws are drawn: of the document, or of the request that gave a result.
/// @throws PlotError when there is none
Field law_model(const nlohmann::json& document, const PlotRequest& request) {
  if (const std::optional<Field> model = model_of(document)) {
    return *model;
  }
  if (request.solved_request != nullptr && document.is_object() && is_result(document)) {
    return Field(*request.solved_request, PointerPath("request:")).at("model");
  }
  throw PlotError("",
                  "the document has no model with nodes, whose laws are drawn: give a request or "
                  "a model, or a result with the request that was solved");
}

/// Whether a document is a model, with which nothing was computed and nothing is to be.
bool is_model(const nlohmann::json& document) {
  return !is_table(document) && !is_result(document) && model_of(document).has_value();
}

void need_drawable(const nlohmann::json& document) {
  if (!document.is_object()) {
    throw PlotError("",
                    "the document must be a result, as snapthrough solve prints it, a table, as snapthrough "
                    "sweep does, or a model");
  }
  if (is_table(document)) {
    return;
  }
  if (document.contains("analysis") || document.contains("parameters")) {
    const bool sweep = document.contains("parameters");
    throw PlotError(
        sweep ? "/parameters" : "/analysis",
        std::string("the document is a request, not a result: solve it first, with snapthrough ") +
            (sweep ? "sweep" : "solve") +
            ", or ask for the kind model, which draws its structure, or the kind law or laws");
  }
  if (!is_result(document) && !is_model(document)) {
    throw PlotError("",
                    "the document is neither a result (it has no summary), nor a table of a sweep (it has no "
                    "columns), nor a model (it has no nodes)");
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

/// Whether a figure draws laws of a model.
bool is_of_laws(std::optional<PlotKind> kind) { return kind == PlotKind::law || kind == PlotKind::laws; }

bool is_for_table(PlotKind kind) { return kind == PlotKind::sweep || kind == PlotKind::heatmap; }

/// Returns the kind of the figure that a document gets. @throws PlotError when the document has none of it
PlotKind kind_of(const nlohmann::json& document, const PlotRequest& request) {
  if (request.kind == PlotKind::model) {
    if (!model_of(document)) {
      throw PlotError("", "the document has no model with nodes, which a figure of kind model draws");
    }
    return PlotKind::model;
  }
  if (is_of_laws(request.kind)) {
    (void)law_model(document, request);  // throws without a model
    return *request.kind;
  }
  need_drawable(document);
  const PlotKind kind = request.kind ? *request.kind : default_plot_kind(document);
  const bool model = is_model(document);
  if (model != (kind == PlotKind::model) || is_for_table(kind) != is_table(document)) {
    throw PlotError("", std::string("the document is ") +
                            (is_table(document) ? "a table of a sweep"
                             : model            ? "a model"
                                                : "a result") +
                            ", which has no figure of kind " + std::string(name_of(kPlotKinds, kind)));
  }
  return kind;
}

/// Returns the program and the digest of the request that a document names, as JSON in XML; "" for a document
/// that names neither.
std::string provenance_of(const nlohmann::json& document) {
  constexpr std::size_t kLongest = 200;  // bytes of a text: they are short in documents of the program
  nlohmann::ordered_json about;
  const auto take = [&](const nlohmann::json& from, const char* name, nlohmann::ordered_json& to) {
    const auto found = from.find(name);
    if (found != from.end() && found->is_string() &&
        found->get_ref<const std::string&>().size() <= kLongest) {
      to[name] = found->get<std::string>();
    }
  };
  if (const auto program = document.find("program"); program != document.end() && program->is_object()) {
    for (const char* const name : {"name", "version", "build", "target"}) {
      take(*program, name, about["program"]);
    }
  }
  take(document, "request_sha256", about);
  if (about.empty()) {
    return "";
  }
  std::string text;
  for (const char c : about.dump(-1, ' ', true, nlohmann::ordered_json::error_handler_t::replace)) {
    text += c == '&' ? "&amp;" : c == '<' ? "&lt;" : c == '>' ? "&gt;" : std::string(1, c);
  }
  return text;
}

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
    case PlotKind::model:
      return plot::model_figure(input, request, size);
    case PlotKind::law:
      return plot::law_figure(input.result, request, size);
    case PlotKind::laws:
      return plot::laws_figure(input.result, request, size);
    case PlotKind::frequencies:
      return plot::frequencies_figure(input, size);
    case PlotKind::stiffness:
      return plot::stiffness_figure(input, size);
    case PlotKind::sweep:
      return plot::sweep_figure(input.result, request, size);
    case PlotKind::heatmap:
      return plot::heatmap_figure(input.result, request, size);
  }
  throw PlotError("", "the kind of figure does not exist");
}

}  // namespace

PlotKind default_plot_kind(const nlohmann::json& document) {
  need_drawable(document);
  if (is_table(document)) {
    return plot::is_for_heatmap(Field(document)) ? PlotKind::heatmap : PlotKind::sweep;
  }
  if (is_model(document)) {
    return PlotKind::model;
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
  const plot::Ink ink(request.most_coordinates);
  if (request.magnify && !(*request.magnify > 0 && *request.magnify <= 1e9)) {
    throw PlotError("", "magnify must be more than 0, and at most 1e9");
  }
  const PlotKind kind = kind_of(document, request);
  const Field field(document);
  plot::ResultInput input{field, std::nullopt, plot::read_units(field)};
  if (kind == PlotKind::model) {
    input.model = plot::read_model(*model_of(document));
  } else if (is_of_laws(kind)) {
    input.result = law_model(document, request);
  } else if (request.solved_request != nullptr && !is_for_table(kind)) {
    input.model = plot::read_model(Field(*request.solved_request, PointerPath("request:")).at("model"));
  }
  const std::string heading = plot::read_title(field);
  Size size = file_size(request, kind);
  const Size content = plot::content_size(size, heading);
  Figure figure = figure_of(input, request, kind, content);
  if (figure.height > 0) {
    size.height -= content.height - figure.height;
  }
  std::string text = plot::file_of(std::move(figure), size, heading, request.dark);
  if (const std::string about = provenance_of(document); !about.empty()) {
    text.insert(text.rfind("</svg>"), "<metadata>" + about + "</metadata>\n");
  }
  return text;
}

}  // namespace snapthrough::api
