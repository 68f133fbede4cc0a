#include "api/plot/plot_choices.h"

#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

namespace snapthrough::api {
namespace {

using Json = nlohmann::json;

/// Stores a value and returns "", or returns the rule that the value breaks.
using Take = std::function<std::string(const Json&)>;

Take number_between(std::optional<double>& to, double least, double largest) {
  return [&to, least, largest](const Json& value) -> std::string {
    if (!value.is_number() || value.get<double>() < least || value.get<double>() > largest) {
      return "must be a number from " + Json(least).dump() + " to " + Json(largest).dump();
    }
    to = value.get<double>();
    return "";
  };
}

Take index(std::optional<std::size_t>& to) {
  return [&to](const Json& value) -> std::string {
    if (!value.is_number_unsigned()) {
      return "must be an index, a whole number from 0";
    }
    to = value.get<std::size_t>();
    return "";
  };
}

Take text(std::optional<std::string>& to) {
  return [&to](const Json& value) -> std::string {
    if (!value.is_string()) {
      return "must be a text";
    }
    to = value.get<std::string>();
    return "";
  };
}

Take yes_or_no(bool& to) {
  return [&to](const Json& value) -> std::string {
    if (!value.is_boolean()) {
      return "must be true or false";
    }
    to = value.get<bool>();
    return "";
  };
}

std::string take_kind(const Json& value, PlotRequest& request) {
  request.kind = value.is_string() ? value_of(kPlotKinds, value.get<std::string>()) : std::nullopt;
  if (request.kind) {
    return "";
  }
  std::string names;
  for (const auto& kind : kPlotKinds) {
    names += (names.empty() ? "" : ", ") + std::string(kind.name);
  }
  return "must be one of " + names;
}

std::string take_where(const Json& value, PlotRequest& request) {
  if (!value.is_object()) {
    return "must be an object of texts";
  }
  for (const auto& [name, wanted] : value.items()) {
    if (!wanted.is_string()) {
      return "must be an object of texts; that of \"" + name + "\" is none";
    }
    request.where[name] = wanted.get<std::string>();
  }
  return "";
}

std::map<std::string_view, Take> takers(PlotRequest& request) {
  constexpr double kLargestFactor = 1e12;  // a larger factor moves every point out of the figure
  return {{"kind", [&request](const Json& value) { return take_kind(value, request); }},
          {"width", number_between(request.width, kLeastPlotSize, kLargestPlotSize)},
          {"height", number_between(request.height, kLeastPlotSize, kLargestPlotSize)},
          {"dark", yes_or_no(request.dark)},
          {"state", index(request.state)},
          {"mode", index(request.mode)},
          {"branch", index(request.branch)},
          {"monitor", text(request.monitor)},
          {"over_arc_length", yes_or_no(request.over_arc_length)},
          {"points", yes_or_no(request.points)},
          {"magnify", number_between(request.magnify, 1 / kLargestFactor, kLargestFactor)},
          {"law", text(request.law)},
          {"output", text(request.output)},
          {"x", text(request.x)},
          {"by", text(request.by)},
          {"where", [&request](const Json& value) { return take_where(value, request); }},
          {"solved_request", [&request](const Json& value) -> std::string {
             request.solved_request = &value;
             return "";
           }}};
}

}  // namespace

PlotChoices read_plot_choices(const Json& document) {
  PlotChoices choices;
  if (!document.is_object()) {
    choices.findings.push_back({"", "wrong_type", "the choices of a figure are an object"});
    return choices;
  }
  const std::map<std::string_view, Take> takes = takers(choices.request);
  for (const auto& [name, value] : document.items()) {
    const auto take = takes.find(name);
    const std::string pointer = (Json::json_pointer() / name).to_string();
    if (take == takes.end()) {
      std::string known;
      for (const auto& [other, unused] : takes) {
        known += (known.empty() ? "" : ", ") + std::string(other);
      }
      choices.findings.push_back(
          {pointer, "unknown_field", "unknown field \"" + name + "\"; known here: " + known});
    } else if (const std::string rule = take->second(value); !rule.empty()) {
      choices.findings.push_back({pointer, "out_of_range", name + " " + rule});
    }
  }
  return choices;
}

}  // namespace snapthrough::api
