/// Tools that read, draw and convert what is there.

#include <openssl/evp.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "api/convert/convert.h"
#include "api/names.h"
#include "api/plot/plot.h"
#include "api/plot/plot_error.h"
#include "api/plot/plot_request.h"
#include "server/mcp/tools.h"
#include "server/resources/conversion_warnings.h"
#include "solver/model/limits.h"

namespace snapthrough::server::mcp {
namespace {

using nlohmann::json;

Finding wrong(const std::string& pointer, const std::string& rule) {
  return {pointer, "wrong_argument", rule};
}

/// Finding for an id that no kept document has.
Finding unknown_id(const Shelf& shelf) {
  std::string known;
  for (const std::string& id : shelf.ids()) {
    known += (known.empty() ? "" : ", ") + id;
  }
  return wrong("/id", "must be the id of an earlier answer of this session; there are: " +
                          (known.empty() ? "none" : known));
}

/// Findings for arguments that a tool does not have.
std::vector<Finding> unknown_members(const json& arguments, std::initializer_list<std::string_view> known) {
  std::vector<Finding> findings;
  for (const auto& [name, value] : arguments.items()) {
    if (std::find(known.begin(), known.end(), name) == known.end()) {
      findings.push_back({"/" + name, "unknown_field", "no argument of this tool"});
    }
  }
  return findings;
}

/// Reads arguments of one object, and notes those of the wrong type.
class Reader {
 public:
  explicit Reader(const json& arguments) : arguments_(arguments) {}

  std::optional<std::string> text(const char* name) {
    const json* value = find(name);
    if (value == nullptr || value->is_string()) {
      return value == nullptr ? std::nullopt : std::optional(value->get<std::string>());
    }
    findings.push_back(wrong(place(name), "must be a text"));
    return std::nullopt;
  }
  std::optional<double> number(const char* name, double least, double most) {
    const json* value = find(name);
    if (value == nullptr) {
      return std::nullopt;
    }
    if (value->is_number() && value->get<double>() >= least && value->get<double>() <= most) {
      return value->get<double>();
    }
    findings.push_back(
        wrong(place(name), "must be a number from " + json(least).dump() + " to " + json(most).dump()));
    return std::nullopt;
  }
  std::optional<std::size_t> index(const char* name, std::size_t most = 1'000'000'000) {
    const json* value = find(name);
    if (value == nullptr) {
      return std::nullopt;
    }
    if (value->is_number_unsigned() && value->get<std::uint64_t>() <= most) {
      return value->get<std::size_t>();
    }
    findings.push_back(wrong(place(name), "must be a whole number from 0 to " + std::to_string(most)));
    return std::nullopt;
  }
  bool flag(const char* name) {
    const json* value = find(name);
    if (value != nullptr && !value->is_boolean()) {
      findings.push_back(wrong(place(name), "must be true or false"));
    }
    return value != nullptr && value->is_boolean() && value->get<bool>();
  }

  std::vector<Finding> findings = {};

 private:
  static std::string place(const char* name) { return std::string("/") + name; }
  [[nodiscard]] const json* find(const char* name) const {
    const auto found = arguments_.find(name);
    return found == arguments_.end() ? nullptr : &*found;
  }

  const json& arguments_;
};

api::PlotRequest figure_of(Reader& in) {
  api::PlotRequest figure;
  constexpr double kLargest = 1e12;
  if (const auto kind = in.text("kind")) {
    figure.kind = api::value_of(api::kPlotKinds, *kind);
    if (!figure.kind) {
      in.findings.push_back(wrong("/kind", "must be one of " + api::names_in(api::kPlotKinds)));
    }
  }
  figure.state = in.index("state");
  figure.mode = in.index("mode");
  figure.branch = in.index("branch");
  figure.monitor = in.text("monitor");
  figure.magnify = in.number("magnify", 1.0 / kLargest, kLargest);
  figure.law = in.text("law");
  figure.output = in.text("output");
  figure.x = in.text("x");
  figure.by = in.text("by");
  figure.width = in.number("width", api::kLeastPlotSize, api::kLargestPlotSize);
  figure.height = in.number("height", api::kLeastPlotSize, api::kLargestPlotSize);
  return figure;
}

std::string base64_of(const std::string& bytes) {
  std::string text(4 * ((bytes.size() + 2) / 3) + 1, '\0');  // the function writes a zero byte at the end
  const int size =
      ::EVP_EncodeBlock(reinterpret_cast<unsigned char*>(text.data()),
                        reinterpret_cast<const unsigned char*>(bytes.data()), static_cast<int>(bytes.size()));
  text.resize(static_cast<std::size_t>(size));
  return text;
}

/// Returns the parts, which a model takes as they are, and the warnings in a text of their own.
json parts_or_refusal(api::Conversion conversion) {
  if (conversion.document == nullptr) {
    for (Finding& finding : conversion.findings) {
      if (finding.pointer == "--layer") {  // the command's option
        finding.pointer = "/layers";
      }
    }
    return refused(conversion.findings);
  }
  json result = told(*conversion.document);
  if (!conversion.warnings.empty()) {
    const json warnings = {{"warnings", http::conversion_warnings(conversion.warnings)}};
    result["content"].push_back({{"type", "text"}, {"text", warnings.dump()}});
  }
  return result;
}

api::Conversion convert_tables(Reader& in) {
  api::CsvFiles files{
      {"nodes", in.text("nodes").value_or("")}, {"members", in.text("members").value_or("")}, {}};
  if (const auto sections = in.text("sections")) {
    files.sections = api::CsvFile{"sections", *sections};
  }
  return api::convert_csv(files);
}

api::Conversion convert_drawing(const json& arguments, Reader& in) {
  api::DxfOptions options;
  options.tolerance = in.number("tolerance", 1e-300, kMaxMagnitude);
  options.join_tees = in.flag("join_tees");
  const json layers = arguments.value("layers", json::array());
  const bool texts = layers.is_array() && std::all_of(layers.begin(), layers.end(),
                                                      [](const json& one) { return one.is_string(); });
  if (texts) {
    options.layers = layers.get<std::vector<std::string>>();
  } else {
    in.findings.push_back(wrong("/layers", "must be a list of texts"));
  }
  return api::convert_dxf(in.text("drawing").value_or(""), options);
}

}  // namespace

json Tools::read(const json& arguments, Dialogue& /*dialogue*/) {
  Reader in(arguments);
  in.findings = unknown_members(arguments, {"id", "pointer", "first", "count"});
  const std::string id = in.text("id").value_or("");
  const std::string pointer = in.text("pointer").value_or("");
  const std::size_t first = in.index("first").value_or(0);
  const std::size_t count = in.index("count", kMostRows).value_or(kMostRows);
  const Kept* kept = shelf_.find(id);
  if (kept == nullptr) {
    in.findings.push_back(unknown_id(shelf_));
  }
  if (!in.findings.empty()) {
    return refused(in.findings);
  }
  const json* value = nullptr;
  try {
    value = &kept->document->at(json::json_pointer(pointer));
  } catch (const json::exception&) {
    return refused({wrong("/pointer", "must be a JSON Pointer to a part of " + id + ", such as /summary")});
  }
  json answer = {{"id", id}, {"pointer", pointer}};
  if (value->is_array()) {
    const std::size_t begin = std::min(first, value->size());
    const std::size_t end = std::min(begin + count, value->size());
    answer["items"] = value->size();
    answer["first"] = begin;
    answer["value"] = json(value->begin() + static_cast<std::ptrdiff_t>(begin),
                           value->begin() + static_cast<std::ptrdiff_t>(end));
  } else {
    answer["value"] = *value;
  }
  return told(answer);
}

json Tools::plot(const json& arguments, Dialogue& /*dialogue*/) {
  Reader in(arguments);
  in.findings = unknown_members(
      arguments, {"id", "model", "kind", "state", "mode", "branch", "monitor", "arc_length", "points",
                  "magnify", "law", "output", "x", "by", "width", "height", "dark", "svg"});
  const std::optional<std::string> id = in.text("id");
  const Kept* kept = id ? shelf_.find(*id) : nullptr;
  if (id.has_value() == arguments.contains("model")) {
    in.findings.push_back(wrong("", "needs either id, of a result or table, or model"));
  } else if (id && kept == nullptr) {
    in.findings.push_back(unknown_id(shelf_));
  }
  api::PlotRequest figure = figure_of(in);
  figure.over_arc_length = in.flag("arc_length");
  figure.points = in.flag("points");
  figure.dark = in.flag("dark");
  const bool as_svg = in.flag("svg");
  if (!in.findings.empty()) {
    return refused(in.findings);
  }
  figure.solved_request = kept != nullptr ? kept->request.get() : nullptr;
  std::string svg;
  try {
    svg = api::svg_of(kept != nullptr ? *kept->document : arguments.at("model"), figure);
  } catch (const api::PlotError& error) {
    return refused({{error.pointer(), "no_figure", error.rule()}});
  }
  std::string png;
  const std::string why = as_svg ? "asked for" : around_.to_png(svg, png);
  if (why.empty()) {
    return {{"content", {{{"type", "image"}, {"data", base64_of(png)}, {"mimeType", "image/png"}}}}};
  }
  const json resource = {{"uri", "snapthrough://figure.svg"}, {"mimeType", "image/svg+xml"}, {"text", svg}};
  return {{"content",
           {{{"type", "resource"}, {"resource", resource}}, {{"type", "text"}, {"text", "SVG: " + why}}}}};
}

json Tools::convert(const json& arguments, Dialogue& /*dialogue*/) {
  Reader in(arguments);
  in.findings = unknown_members(
      arguments, {"soil", "nodes", "members", "sections", "drawing", "layers", "tolerance", "join_tees"});
  const bool tables = arguments.contains("nodes") || arguments.contains("members");
  if ((arguments.contains("soil") ? 1 : 0) + (tables ? 1 : 0) + (arguments.contains("drawing") ? 1 : 0) !=
      1) {
    in.findings.push_back(wrong("", "needs exactly one of soil, drawing, and nodes with members"));
  }
  if (!in.findings.empty()) {
    return refused(in.findings);
  }
  api::Conversion conversion = arguments.contains("soil") ? api::convert_soil_document(arguments.at("soil"))
                               : tables                   ? convert_tables(in)
                                                          : convert_drawing(arguments, in);
  return in.findings.empty() ? parts_or_refusal(std::move(conversion)) : refused(in.findings);
}

}  // namespace snapthrough::server::mcp
