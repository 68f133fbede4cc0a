#include "server/resources/plot_query.h"

#include <string>

#include "api/names.h"
#include "server/resources/documents.h"
#include "server/resources/negotiation.h"

namespace snapthrough::server::http {
namespace {

using api::PlotRequest;

bool read_size(const std::string& value, std::optional<double>& size) {
  size = whole_number<double>(value);
  return size && *size >= api::kLeastPlotSize && *size <= api::kLargestPlotSize;
}

bool read_index(const std::string& value, std::optional<std::size_t>& index) {
  index = whole_number<std::size_t>(value);
  return index.has_value();
}

bool read_text(const std::string& value, std::optional<std::string>& text) {
  text = value;
  return !value.empty();
}

constexpr QueryParameter<PlotRequest> kPlotParameters[] = {
    {"kind",
     [](const std::string& value, PlotRequest& figure) {
       return (figure.kind = api::value_of(api::kPlotKinds, value)).has_value();
     }},
    {"state", [](const std::string& value, PlotRequest& figure) { return read_index(value, figure.state); }},
    {"mode", [](const std::string& value, PlotRequest& figure) { return read_index(value, figure.mode); }},
    {"branch",
     [](const std::string& value, PlotRequest& figure) { return read_index(value, figure.branch); }},
    {"monitor",
     [](const std::string& value, PlotRequest& figure) { return read_text(value, figure.monitor); }},
    {"arc-length",
     [](const std::string& value, PlotRequest& figure) { return read_flag(value, figure.over_arc_length); }},
    {"points", [](const std::string& value, PlotRequest& figure) { return read_flag(value, figure.points); }},
    {"magnify",
     [](const std::string& value, PlotRequest& figure) {
       figure.magnify = whole_number<double>(value);
       return figure.magnify && *figure.magnify > 0.0;
     }},
    {"law", [](const std::string& value, PlotRequest& figure) { return read_text(value, figure.law); }},
    {"output", [](const std::string& value, PlotRequest& figure) { return read_text(value, figure.output); }},
    {"x", [](const std::string& value, PlotRequest& figure) { return read_text(value, figure.x); }},
    {"by", [](const std::string& value, PlotRequest& figure) { return read_text(value, figure.by); }},
    {"where", [](const std::string& value, PlotRequest& figure) { return api::add_condition(value, figure); },
     true},
    {"width", [](const std::string& value, PlotRequest& figure) { return read_size(value, figure.width); }},
    {"height", [](const std::string& value, PlotRequest& figure) { return read_size(value, figure.height); }},
    {"dark", [](const std::string& value, PlotRequest& figure) { return read_flag(value, figure.dark); }},
};

}  // namespace

std::optional<Response> read_plot_query(const Request& request, PlotRequest& figure) {
  if (const auto wrong = read_query(request, kPlotParameters, figure)) {
    return wrong_parameter(request,
                           "kind (" + api::names_in(api::kPlotKinds) +
                               "), state, mode and branch (numbers from 0), monitor, law, output, x, by, "
                               "arc-length, points and dark (true or "
                               "false), magnify (above 0), width and height (200 to 8000), each once, and "
                               "where (NAME=VALUE, each NAME once)",
                           wrong->first, wrong->second);
  }
  if (figure.monitor && figure.over_arc_length) {
    return simple_problem(request, 400, "invalid-parameter", "Invalid parameter",
                          "The query parameters monitor and arc-length exclude each other.");
  }
  return std::nullopt;
}

}  // namespace snapthrough::server::http
