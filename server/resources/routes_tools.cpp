/// Conversion of files into parts of a model, and figures: what the commands convert and plot do, for a body
/// that a client sends. Nothing is stored.

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <set>
#include <utility>

#include "api/api.h"
#include "api/convert/convert.h"
#include "api/json_text.h"
#include "api/plot/plot.h"
#include "api/plot/plot_error.h"
#include "api/plot/plot_request.h"
#include "server/jobs/memory.h"
#include "server/resources/conversion_warnings.h"
#include "server/resources/documents.h"
#include "server/resources/form_data.h"
#include "server/resources/negotiation.h"
#include "server/resources/plot_query.h"
#include "server/resources/routes.h"
#include "solver/model/limits.h"
#include "solver/model/pointer.h"

namespace snapthrough::server::http {
namespace {

using nlohmann::json;

/// Largest number of coordinates of a figure: a structure of 20 000 straight members has some 200 000. The
/// text of such a figure is some megabytes, and its drawing takes some 100 MB.
constexpr std::size_t kMostCoordinates = 500'000;

/// Keeps a figure that is opened by itself from loading anything and from running scripts.
constexpr const char* kFigurePolicy = "default-src 'none'; style-src 'unsafe-inline'";

std::string media_type(const Request& request) {
  const std::string_view type = request.header("Content-Type").value_or("");
  return std::string(trimmed(type.substr(0, type.find(';'))));
}

bool is_drawing(std::string_view type) {
  return equal_ignoring_case(type, "image/vnd.dxf") || equal_ignoring_case(type, "application/dxf");
}

Response unsupported(const Request& request, const char* detail) {
  return simple_problem(request, 415, "unsupported-media-type", "Unsupported media type", detail);
}

Response malformed_json(const Request& request, std::vector<Finding> findings) {
  return problem_response({400, "malformed-json", "Malformed JSON", "The body is no acceptable JSON text.",
                           std::move(findings), "", ""},
                          request);
}

/// Returns the problem of a file that gives no parts of a model, with the first findings.
Response invalid_file(const Request& request, std::vector<Finding> findings) {
  const std::size_t count = findings.size();
  constexpr auto kMost = static_cast<std::size_t>(api::kMaxFindings);
  if (count > kMost) {
    findings.resize(kMost);
    findings.push_back(
        {"", "too_many_findings", std::to_string(count - kMost) + " more findings are not listed"});
  }
  for (Finding& finding : findings) {
    // The command names its option, of which a request has a query parameter.
    finding.pointer.erase(0, finding.pointer.starts_with("--") ? 2 : 0);
  }
  return problem_response({422, "invalid-file", "Invalid file",
                           "The file has " + std::to_string(count) + (count == 1 ? " error" : " errors") +
                               "; it gives no parts of a model.",
                           std::move(findings), "", ""},
                          request);
}

constexpr QueryParameter<api::DxfOptions> kDrawingParameters[] = {
    {"layer",
     [](const std::string& value, api::DxfOptions& options) {
       options.layers.push_back(value);
       return true;
     },
     true},
    {"tolerance",
     [](const std::string& value, api::DxfOptions& options) {
       options.tolerance = whole_number<double>(value);
       return options.tolerance && *options.tolerance > 0.0 && *options.tolerance <= kMaxMagnitude;
     }},
    {"join_tees",
     [](const std::string& value, api::DxfOptions& options) { return read_flag(value, options.join_tees); }},
};

/// Reads the query parameters of a drawing, which no other file has. Returns a problem about the first one
/// that is unknown, repeated or invalid.
std::optional<Response> read_drawing_query(const Request& request, bool drawing, api::DxfOptions& options) {
  const auto wrong = drawing                 ? read_query(request, kDrawingParameters, options)
                     : request.query.empty() ? std::nullopt
                                             : std::optional(request.query.front());
  if (wrong) {
    return wrong_parameter(request,
                           "layer (may be repeated), tolerance (above 0, at most 1e150) and join_tees (true "
                           "or false), each of these two once, all for a drawing only",
                           wrong->first, wrong->second);
  }
  return std::nullopt;
}

/// Outcome of a conversion, or the response to a body that was not read so far.
struct Converted {
  api::Conversion conversion;
  std::optional<Response> refusal;
};

Converted convert_soil(const Request& request, std::size_t most_keys) {
  const api::ParsedText parsed = api::parse_json(request.body, {.keys = most_keys});
  if (parsed.document == nullptr) {
    return {{}, malformed_json(request, parsed.findings)};
  }
  return {api::convert_soil_document(*parsed.document), std::nullopt};
}

/// Converts the tables of a form, whose fields have the names of the command's options.
Converted convert_tables(const Request& request) {
  const FormData form = read_form_data(request.header("Content-Type").value_or(""), request.body);
  if (!form.mistake.empty()) {
    return {{}, simple_problem(request, 400, "malformed-form", "Malformed form", form.mistake)};
  }
  api::CsvFiles files{{"nodes", ""}, {"members", ""}, std::nullopt};
  std::set<std::string> seen;
  std::vector<Finding> findings;
  for (const FormPart& part : form.parts) {
    api::CsvFile* file = part.name == "nodes"      ? &files.nodes
                         : part.name == "members"  ? &files.members
                         : part.name == "sections" ? &files.sections.emplace(api::CsvFile{"sections", ""})
                                                   : nullptr;
    if (file == nullptr) {
      findings.push_back(
          {part.name, "unknown_field", "the fields of the form are nodes, members and sections"});
    } else if (!seen.insert(part.name).second) {
      findings.push_back({part.name, "duplicate", "the form has this field twice"});
    } else {
      file->text = part.content;
    }
  }
  for (const char* name : {"nodes", "members"}) {
    if (!seen.contains(name)) {
      findings.push_back(
          {name, "missing_field", std::string("the form must have a table in the field ") + name});
    }
  }
  return {findings.empty() ? api::convert_csv(files) : api::Conversion{nullptr, std::move(findings)},
          std::nullopt};
}

Converted converted(const Request& request, std::string_view type, const api::DxfOptions& drawing,
                    std::size_t most_keys) {
  if (is_json(type)) {
    return convert_soil(request, most_keys);
  }
  return is_drawing(type) ? Converted{api::convert_dxf(request.body, drawing), std::nullopt}
                          : convert_tables(request);
}

/// What a figure is drawn of: the body, or the parts of `{"result": ..., "request": ...}`.
struct FigureInput {
  const json* document = nullptr;
  const json* solved_request = nullptr;  ///< null: not given
  std::string pointer;                   ///< JSON Pointer of the document in the body
  std::vector<Finding> findings;
};

/// No result, table or model has a member `result`.
FigureInput opened(const json& body) {
  if (!body.is_object() || !body.contains("result")) {
    return {&body, nullptr, "", {}};
  }
  FigureInput input{&body.at("result"), nullptr, "/result", {}};
  for (const auto& [name, value] : body.items()) {
    if (name == "request") {
      input.solved_request = &value;
    } else if (name != "result") {
      input.findings.push_back(
          {"/" + escape_pointer_token(name), "unknown_field", "unknown field; known beside result: request"});
    }
  }
  return input;
}

/// Returns the place of a mistake in the body.
std::string place_in(const FigureInput& input, const std::string& pointer) {
  constexpr std::string_view kRequest = "request:";
  return pointer.starts_with(kRequest) ? "/request" + pointer.substr(kRequest.size())
                                       : input.pointer + pointer;
}

Response no_figure(const Request& request, std::vector<Finding> findings) {
  return problem_response({422, "no-figure", "No figure", "The document and the choices give no figure.",
                           std::move(findings), "", ""},
                          request);
}

}  // namespace

Response Routes::convert(const Request& request, const std::string& /*id*/) {
  const std::string type = media_type(request);
  if (!is_json(type) && !is_drawing(type) && !equal_ignoring_case(type, "multipart/form-data")) {
    return unsupported(request,
                       "A soil document has Content-Type: application/json, a drawing image/vnd.dxf or "
                       "application/dxf; tables (CSV) are the fields nodes, members and sections of a form, "
                       "multipart/form-data.");
  }
  api::DxfOptions drawing;
  if (std::optional<Response> refusal = read_drawing_query(request, is_drawing(type), drawing)) {
    return *std::move(refusal);
  }
  const LargeDocument room(request.body.size());
  Converted outcome = converted(request, type, drawing, jobs_.limits().json_keys);
  if (outcome.refusal) {
    return *std::move(outcome.refusal);
  }
  if (outcome.conversion.document == nullptr) {
    return invalid_file(request, std::move(outcome.conversion.findings));
  }
  std::string parts = api::write_parts(*outcome.conversion.document);
  const auto most = std::find_if(facts_.limits.begin(), facts_.limits.end(),
                                 [](const auto& limit) { return limit.first == "body_bytes"; });
  if (most != facts_.limits.end() && static_cast<double>(parts.size()) > most->second) {
    return invalid_file(request, {{"", "too_many",
                                   "the parts of the model take " + std::to_string(parts.size()) +
                                       " bytes, more than a request may have (body_bytes of /v1/limits)"}});
  }
  Response response = json_response(200, std::move(parts));
  if (!outcome.conversion.warnings.empty()) {
    // The body holds parts of a model and nothing else, which a model takes as they are.
    constexpr bool kAscii = true;  // a header has no other characters
    response.headers.emplace_back("X-Warnings",
                                  conversion_warnings(outcome.conversion.warnings).dump(-1, ' ', kAscii));
  }
  return response;
}

Response Routes::plot(const Request& request, const std::string& /*id*/) {
  if (!is_json(media_type(request))) {
    return unsupported(request, "A result, a table or a model has Content-Type: application/json.");
  }
  api::PlotRequest figure;
  if (std::optional<Response> refusal = read_plot_query(request, figure)) {
    return *std::move(refusal);
  }
  const LargeDocument room(request.body.size());
  const api::ParsedText parsed =
      api::parse_json(request.body, {.values = api::kFigureLimits.values, .keys = jobs_.limits().json_keys});
  if (parsed.document == nullptr) {
    return malformed_json(request, parsed.findings);
  }
  FigureInput input = opened(*parsed.document);
  if (!input.findings.empty()) {
    return no_figure(request, std::move(input.findings));
  }
  figure.solved_request = input.solved_request;
  figure.most_coordinates = kMostCoordinates;
  try {
    Response response;
    response.content_type = "image/svg+xml";
    response.headers.emplace_back("Content-Security-Policy", kFigurePolicy);
    response.body = api::svg_of(*input.document, figure);
    return response;
  } catch (const api::PlotError& error) {
    return no_figure(request, {{place_in(input, error.pointer()), "no_figure", error.rule()}});
  }
}

}  // namespace snapthrough::server::http
