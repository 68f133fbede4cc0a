#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <utility>

#include "api/api.h"
#include "api/field_json.h"
#include "api/provenance.h"
#include "api/result_fields.h"

namespace snapthrough::api {

namespace {

using Json = nlohmann::json;

Json write(const Model& model) {
  Json units = Json::object();
  for (const auto& [quantity, unit] : model.units) {
    units[quantity] = unit;
  }
  return {{"title", model.title}, {"units", std::move(units)}};
}

/// JSON has no NaN and no infinity, and the library would write null without a word. Depth is that of the
/// contract.
void require_finite_numbers(const Json& json, const std::string& pointer) {
  if (json.is_number_float() && !std::isfinite(json.get<double>())) {
    throw std::runtime_error("the result has a number that is not finite at " + pointer);
  }
  if (json.is_array()) {
    for (std::size_t i = 0; i < json.size(); ++i) {
      if (json[i].is_structured() || json[i].is_number_float()) {
        require_finite_numbers(json[i], pointer + "/" + std::to_string(i));
      }
    }
  } else if (json.is_object()) {
    for (const auto& [key, value] : json.items()) {
      require_finite_numbers(value, pointer + "/" + key);
    }
  }
}

}  // namespace

nlohmann::json write_result(const Request& request, const Result& result, double wall_time_s,
                            std::span<const std::string_view> parts) {
  const auto wanted = [&](std::string_view part) {
    return parts.empty() || std::find(parts.begin(), parts.end(), part) != parts.end();
  };
  Json document = object_json(result, wanted);
  if (wanted("model")) {
    document.emplace("model", write(request.model));
  }
  if (wanted("kind")) {
    document.emplace("kind", "result");
  }
  if (wanted("program")) {
    document.emplace("program", program_json());
  }
  if (wanted("request_sha256") && request.document) {
    document.emplace("request_sha256", request_digest(*request.document));
  }
  if (wanted("diagnostics")) {
    document["diagnostics"]["wall_time_s"] = wall_time_s;
  }
  if (request.analysis.koiter && wanted("critical_points")) {
    for (Json& point : document["critical_points"]) {
      point.emplace("koiter", nullptr);  // where it has none; else it is there
    }
  }
  require_finite_numbers(document, "");
  return document;
}

nlohmann::json write_findings(const std::vector<Finding>& findings) {
  Json array = Json::array();
  for (const Finding& finding : findings) {
    array.push_back({{"pointer", finding.pointer}, {"code", finding.code}, {"detail", finding.detail}});
  }
  return array;
}

}  // namespace snapthrough::api
