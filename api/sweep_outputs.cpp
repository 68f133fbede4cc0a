/// Checks before solving whether results of a sweep can have its outputs.

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>

#include "api/check_sweep.h"
#include "api/names.h"
#include "api/result_schema.h"

namespace snapthrough::api {

namespace {

using Json = nlohmann::json;

/// A part of results that only some types of analysis have.
struct PartOfAnalysis {
  std::string_view part;
  std::array<std::string_view, 3> types;
};
constexpr std::string_view kCritical = name_of(kAnalysisTypes, AnalysisType::critical);
constexpr std::string_view kPath = name_of(kAnalysisTypes, AnalysisType::path);
constexpr std::string_view kStatic = name_of(kAnalysisTypes, AnalysisType::static_);
constexpr std::string_view kBuckling = name_of(kAnalysisTypes, AnalysisType::buckling);
constexpr std::array<PartOfAnalysis, 11> kParts{{{"critical_points", {kCritical, kPath}},
                                                 {"contact_events", {kCritical, kPath}},
                                                 {"neutral_motion", {kCritical, kPath, kStatic}},
                                                 {"capacity", {kCritical, kPath, kStatic}},
                                                 {"first_yield", {kCritical, kPath}},
                                                 {"branches", {kPath}},
                                                 {"states", {kCritical, kPath, kStatic}},
                                                 {"extremes", {kCritical, kPath, kStatic}},
                                                 {"not_reached", {kCritical, kPath, kStatic}},
                                                 {"static", {kStatic}},
                                                 {"buckling", {kBuckling}}}};

bool is_within(std::string_view inner, std::string_view outer) {
  return inner.starts_with(outer) && (inner.size() == outer.size() || inner[outer.size()] == '/');
}

/// Returns whether a parameter writes a place or a container of it.
bool is_written(const SweepData& data, std::string_view place) {
  return std::any_of(data.parameters.begin(), data.parameters.end(), [&](const SweepParameter& parameter) {
    return std::any_of(parameter.targets.begin(), parameter.targets.end(),
                       [&](const SweepTarget& target) { return is_within(place, target.pointer); });
  });
}

const Json* find_at(const Json& document, const std::string& pointer) {
  const Json::json_pointer place(pointer);
  return document.contains(place) ? &document.at(place) : nullptr;
}

/// Returns the ids of a list of the model; nullopt when parameters write them or they are unreadable.
std::optional<std::vector<std::string>> ids_of(const SweepData& data, std::string_view name) {
  const std::string place = "/model/" + std::string(name);
  const std::string key = name == "supports" ? "/node" : "/id";
  const Json* list = find_at(data.base, place);
  if (is_written(data, place)) {
    return std::nullopt;
  }
  std::vector<std::string> ids;
  for (std::size_t i = 0; list != nullptr && i < list->size(); ++i) {
    const std::string entry = place + "/" + std::to_string(i);
    const Json* id = list->is_array() ? find_at(data.base, entry + key) : nullptr;
    if (id == nullptr || !id->is_string() || is_written(data, entry + key)) {
      return std::nullopt;
    }
    ids.push_back(id->get<std::string>());
  }
  return ids;
}

/// Returns why results of the analysis lack a part; "" when they have it or when parameters decide.
std::string part_refusal(const SweepData& data, const std::string& part) {
  if (part == "failure") {
    return "a point that fails has its code in the column error, and no outputs";
  }
  const Json* type = find_at(data.base, "/analysis/type");
  const auto found =
      std::find_if(kParts.begin(), kParts.end(), [&](const PartOfAnalysis& one) { return one.part == part; });
  if (found != kParts.end() && type != nullptr && type->is_string() && !is_written(data, "/analysis/type") &&
      std::find(found->types.begin(), found->types.end(), type->get<std::string>()) == found->types.end()) {
    std::string types;
    for (const std::string_view one : found->types) {
      types += (types.empty() || one.empty() ? "" : " or ") + std::string(one);
    }
    return "only an analysis of type " + types + " has /" + part + ", and this one is " +
           type->get<std::string>();
  }
  const Json* states = find_at(data.base, "/analysis/output/states");
  if (part == "states" && states != nullptr && *states == name_of(kStateOutputs, StateOutput::none) &&
      !is_written(data, "/analysis/output/states")) {
    return "no states are kept: /analysis/output/states is none";
  }
  const Json* extremes = find_at(data.base, "/analysis/output/extremes");
  if (part == "extremes" && (extremes == nullptr || *extremes != true) &&
      !is_written(data, "/analysis/output/extremes")) {
    return "extremes are given where /analysis/output/extremes is true";
  }
  return "";
}

}  // namespace

void check_outputs(const SweepData& data, Report& report) {
  const IdsIn ids_in = [&](std::string_view list) { return ids_of(data, list); };
  for (std::size_t i = 0; i < data.outputs.size(); ++i) {
    const std::vector<std::string>& tokens = data.outputs[i].tokens;
    const std::string at = "/outputs/" + std::to_string(i);
    if (tokens.empty() || (data.follow && tokens.front() == "curve")) {
      continue;  // an invalid pointer was reported before; check_follow() checks parts of curves
    }
    if (const auto nowhere = find_no_such_place(tokens, ids_in)) {
      report.add(at, nowhere->unknown_id ? "unknown_reference" : "unknown_field", nowhere->detail);
    } else if (std::string why = part_refusal(data, tokens.front()); !why.empty()) {
      report.add(at, "wrong_analysis", std::move(why));
    }
  }
}

}  // namespace snapthrough::api
