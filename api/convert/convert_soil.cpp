/// Writes the p-y curves of a pile in soil as laws of foundations.

#include <nlohmann/json.hpp>

#include "api/api.h"
#include "api/convert/convert.h"
#include "api/convert/soil.h"
#include "api/json_text.h"
#include "api/list_foundations.h"
#include "api/soil/write_foundations.h"

namespace snapthrough::api {

namespace {

using nlohmann::json;

/// Returns parts of a model, with units if there are any.
std::shared_ptr<json> parts_of(const json& units, json foundations) {
  auto parts = std::make_shared<json>(json::object());
  if (!units.empty()) {
    (*parts)["units"] = units;
  }
  (*parts)["foundations"] = std::move(foundations);
  return parts;
}

/// Returns the foundations that the model of a request has.
Conversion convert_request(const json& request) {
  // the request is not kept: what is read of it ends with this function
  const ReadOutcome read = read_request_document(std::shared_ptr<const json>(&request, [](const json*) {}));
  if (!read.request) {
    return {nullptr, read.findings};
  }
  const json& model = request.at("model");
  json made = with_laws_of_soil(model);
  auto parts = parts_of(model.value("units", json::object()), std::move(made["foundations"]));
  const std::size_t own = model.contains("springs") ? model["springs"].size() : 0;
  if (made.contains("springs") && made["springs"].size() > own) {
    (*parts)["springs"] = std::move(made["springs"]);
  }
  return {std::move(parts), {}};
}

}  // namespace

Conversion convert_soil(std::string_view text) {
  const ParsedText parsed = parse_json(text);
  return parsed.document == nullptr ? Conversion{nullptr, parsed.findings}
                                    : convert_soil_document(*parsed.document);
}

Conversion convert_soil_document(const json& soil) {
  if (soil.is_object() && soil.contains("model")) {
    return convert_request(soil);
  }
  Conversion conversion;
  const convert::SoilDocument document = convert::read_soil(soil, conversion.findings);
  if (!conversion.findings.empty()) {
    return conversion;
  }
  std::size_t numbers = 0;
  json foundations = soil::write_foundations(document.profile, document.pile, numbers, conversion.findings);
  if (conversion.findings.empty()) {
    conversion.document = parts_of(json(document.units), std::move(foundations));
  }
  return conversion;
}

}  // namespace snapthrough::api
