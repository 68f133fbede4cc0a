#include "api/component.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <span>

#include "api/names.h"
#include "api/result_schema.h"
#include "api/sweep_data.h"
#include "api/value.h"
#include "solver/model/pointer.h"
#include "solver/numeric/number_text.h"

namespace snapthrough::api {
namespace {

using Json = nlohmann::json;

std::string pointer_to_input(std::string_view name) { return "/" + escape_pointer_token(name); }

bool is_point(const Json& value) {
  return value.is_array() && value.size() == 2 && value[0].is_number() && value[1].is_number();
}

/// Type of an input that has a given value; plug_of() returns nullopt for a type that inputs do not support.
struct Plug {
  PlugType type = PlugType::number;
  bool list = false;

  bool operator==(const Plug&) const = default;
};

std::optional<Plug> plug_of(const Json& value) {
  if (value.is_number()) {
    return Plug{PlugType::number, false};
  }
  if (value.is_boolean()) {
    return Plug{PlugType::boolean, false};
  }
  if (value.is_string()) {
    return Plug{PlugType::text, false};
  }
  const bool list = value.is_array() && !value.empty();
  if (list && std::all_of(value.begin(), value.end(), [](const Json& one) { return one.is_number(); })) {
    return Plug{PlugType::number, true};
  }
  if (list && std::all_of(value.begin(), value.end(), is_point)) {
    return Plug{PlugType::point, true};
  }
  return std::nullopt;
}

/// Returns whether all targets of a parameter accept integers only.
bool takes_integers(const SweepParameter& parameter) {
  return std::all_of(parameter.targets.begin(), parameter.targets.end(), [](const SweepTarget& target) {
    const std::optional<std::vector<std::string>> tokens = pointer_tokens(target.pointer);
    const PlaceTypes types = types_at("Request", tokens.value());
    return !target.computes() && types.integer && !types.number;
  });
}

std::string shown(const Json& value) {
  return value.is_number() ? number(value.get<double>()) : value.dump();
}

std::string described(const SweepParameter& parameter, const ComponentInput& input) {
  std::string text = "Written to";
  for (const SweepTarget& target : parameter.targets) {
    text += (&target == &parameter.targets.front() ? " " : ", ") + target.pointer;
  }
  if (input.least) {
    text += "; " + shown(*input.least) + " to " + shown(*input.most);
  }
  for (const std::string& label : input.labels) {
    text += (&label == &input.labels.front() ? "; one of: " : ", ") + label;
  }
  return text;
}

/// Sets the bounds of an input to the extremes of its range or of several numbers; a single number sets none.
void set_bounds(const SweepParameter& parameter, ComponentInput& input) {
  std::vector<double> numbers;
  if (parameter.range) {
    numbers = {parameter.range->from, parameter.range->to};
  } else if (!input.list && parameter.values.size() > 1) {
    for (const Json& value : parameter.values) {
      numbers.push_back(value.get<double>());
    }
  }
  if (!numbers.empty()) {
    const auto [least, most] = std::minmax_element(numbers.begin(), numbers.end());
    input.least = *least;
    input.most = *most;
  }
}

/// @param findings receives the reasons why the parameter cannot be an input
ComponentInput input_of(const SweepParameter& parameter, std::size_t index, std::vector<Finding>& findings) {
  ComponentInput input;
  input.name = parameter.name;
  input.labels = parameter.labels;
  if (!parameter.labels.empty()) {
    input.type = PlugType::text;
    input.initial = parameter.labels.front();
  } else {
    input.initial = parameter.range ? Json(parameter.range->from) : parameter.values.front();
    const std::optional<Plug> plug = plug_of(input.initial);
    const bool same = std::all_of(parameter.values.begin(), parameter.values.end(),
                                  [&](const Json& value) { return plug_of(value) == plug; });
    if (!plug || !same) {
      findings.push_back(
          {"/parameters/" + std::to_string(index) + "/values", "wrong_type",
           "the values of an input are all numbers, texts, booleans, lists of numbers or lists "
           "of points [x, y]; other values need a label for each"});
      return input;
    }
    input.type = plug->type;
    input.list = plug->list;
    if (input.type == PlugType::number) {
      set_bounds(parameter, input);
      input.type = !input.list && takes_integers(parameter) ? PlugType::integer : input.type;
    }
  }
  input.description = described(parameter, input);
  return input;
}

/// Returns the type at a place of results, or of the elements of a list there.
PlugType type_of_place(std::vector<std::string> tokens) {
  PlaceTypes types = types_at("Result", tokens);
  while (types.list && !types.object && !types.text) {
    tokens.emplace_back("0");
    types = types_at("Result", tokens);
  }
  if (types.object || types.list) {
    return PlugType::text;  // JSON text
  }
  if (types.number || types.integer) {
    return types.number ? PlugType::number : PlugType::integer;
  }
  return types.boolean ? PlugType::boolean : PlugType::text;
}

/// Returns the name of an output: the last token of its JSON Pointer that is no index, with the indices after
/// it. While another output has that name, the preceding token is added.
std::string name_of_place(const std::vector<std::string>& tokens, const std::set<std::string>& taken) {
  std::size_t begin = tokens.size() - 1;
  while (begin > 0 && array_index(tokens[begin])) {
    --begin;
  }
  for (;; --begin) {
    std::string name;
    for (std::size_t i = begin; i < tokens.size(); ++i) {
      name += (name.empty() ? "" : "/") + tokens[i];
    }
    if (begin == 0 || !taken.contains(name)) {
      return name;
    }
  }
}

const Json* find_at(const Json& document, const char* pointer) {
  const Json::json_pointer place{std::string(pointer)};
  return document.contains(place) ? &document.at(place) : nullptr;
}

/// Returns the type of the analysis; "" when a parameter writes it.
std::string analysis_type(const SweepData& data) {
  for (const SweepParameter& parameter : data.parameters) {
    for (const SweepTarget& target : parameter.targets) {
      if (std::string_view("/analysis/type").starts_with(target.pointer)) {
        return "";
      }
    }
  }
  const Json* type = find_at(data.base, "/analysis/type");
  return type != nullptr && type->is_string() ? type->get<std::string>() : "";
}

void add_drawn(const SweepData& data, std::vector<ComponentOutput>& outputs) {
  const std::string type = analysis_type(data);
  const Json* monitors = find_at(data.base, "/model/monitors");
  if (monitors != nullptr && type != name_of(kAnalysisTypes, AnalysisType::critical) &&
      type != name_of(kAnalysisTypes, AnalysisType::buckling)) {
    outputs.push_back({std::string(kPathOutput),
                       "Points (displacement of a monitor, load factor, 0) of the paths; a branch {path; "
                       "monitor} for each",
                       PlugType::point});
  }
  const Json* states = find_at(data.base, "/analysis/output/states");
  const bool none = states != nullptr && *states == name_of(kStateOutputs, StateOutput::none);
  if (!none && type != name_of(kAnalysisTypes, AnalysisType::buckling)) {
    outputs.push_back(
        {std::string(kShapeOutput),
         "Points (x, y, 0) of the deformed axes in the state of the first critical point, or in "
         "the last one; a branch {member} for each",
         PlugType::point});
  }
}

std::vector<ComponentOutput> outputs_of(const SweepData& data) {
  std::set<std::string> taken{std::string(kPathOutput), std::string(kShapeOutput)};
  std::vector<ComponentOutput> outputs;
  for (const SweepOutput& output : data.outputs) {
    std::string name = name_of_place(output.tokens, taken);
    taken.insert(name);
    outputs.push_back({std::move(name), output.pointer + " of the result", type_of_place(output.tokens)});
  }
  add_drawn(data, outputs);
  return outputs;
}

/// Returns the numbers of a list (NaN for other items); empty for another type.
std::vector<double> numbers_of(const Json& list) {
  std::vector<double> numbers;
  for (const Json& one : list.is_array() ? list : Json::array()) {
    numbers.push_back(one.is_number() ? one.get<double>() : std::nan(""));
  }
  return numbers;
}

/// Returns the polyline of the points whose two coordinates are finite.
Polyline line_of(std::vector<int> place, const Json& x, const Json& y) {
  Polyline line{std::move(place), {}};
  const std::vector<double> xs = numbers_of(x);
  const std::vector<double> ys = numbers_of(y);
  for (std::size_t i = 0; i < std::min(xs.size(), ys.size()); ++i) {
    if (std::isfinite(xs[i]) && std::isfinite(ys[i])) {
      line.points.push_back({xs[i], ys[i]});
    }
  }
  return line;
}

std::vector<Polyline> drawn_paths(const Json& result) {
  std::vector<Polyline> lines;
  std::vector<const Json*> paths;
  if (const auto branches = result.find("branches"); branches != result.end()) {
    for (const Json& branch : *branches) {
      paths.push_back(&branch);
    }
  }
  const auto rows = result.find("static");
  if (paths.empty() && rows != result.end() && rows->is_object()) {
    paths.push_back(&*rows);
  }
  for (std::size_t i = 0; i < paths.size(); ++i) {
    int monitor = 0;
    for (const auto& [id, values] : paths[i]->at("monitors").items()) {
      lines.push_back(line_of({static_cast<int>(i), monitor++}, values, paths[i]->at("load_factor")));
    }
  }
  return lines;
}

std::vector<Polyline> drawn_shape(const Json& result) {
  const auto states = result.find("states");
  if (states == result.end() || states->empty()) {
    return {};
  }
  std::size_t chosen = states->size() - 1;
  for (const Json& point : result.value("critical_points", Json::array())) {
    if (point.contains("state") && point.at("state").is_number()) {
      chosen = std::min(chosen, point.at("state").get<std::size_t>());
      break;
    }
  }
  std::vector<Polyline> lines;
  int member = 0;
  for (const auto& [id, shape] : states->at(chosen).at("members").items()) {
    lines.push_back(line_of({member++}, shape.at("x"), shape.at("y")));
  }
  return lines;
}

/// The value to write for an input, or the rule that the value breaks.
struct Taken {
  Json value;
  std::string broken_rule;  ///< empty: the value is valid
};

Taken labelled(const ComponentInput& input, const SweepParameter& parameter, const Json& value) {
  const auto label = std::find(input.labels.begin(), input.labels.end(),
                               value.is_string() ? value.get<std::string>() : std::string());
  if (label == input.labels.end()) {
    std::string all;
    for (const std::string& one : input.labels) {
      all += (all.empty() ? "" : ", ") + one;
    }
    return {{}, "expected one of " + all + ", got " + value.dump()};
  }
  return {parameter.values[static_cast<std::size_t>(label - input.labels.begin())], ""};
}

Taken checked(const ComponentInput& input, const SweepParameter& parameter, const Json& value) {
  if (!input.labels.empty()) {
    return labelled(input, parameter, value);
  }
  if (input.least && value.is_number() &&
      !(value.get<double>() >= *input.least && value.get<double>() <= *input.most)) {
    return {{}, "must be " + shown(*input.least) + " to " + shown(*input.most) + ", got " + shown(value)};
  }
  for (const SweepTarget& target : parameter.targets) {
    if (target.computes() && !std::isfinite(target.number_for(value.get<double>()))) {
      return {{}, shown(value) + " gives no finite number at " + target.pointer};
    }
  }
  return {value, ""};
}

}  // namespace

ComponentCall Component::call(const std::map<std::string, Json>& values) const {
  ComponentCall call;
  const SweepData& data = sweep_.data();
  std::vector<Json> taken;
  for (std::size_t i = 0; i < inputs_.size(); ++i) {
    const auto value = values.find(inputs_[i].name);
    if (value == values.end()) {
      call.findings.push_back({pointer_to_input(inputs_[i].name), "missing_field", "has no value"});
      continue;
    }
    Taken one = checked(inputs_[i], data.parameters[i], value->second);
    if (!one.broken_rule.empty()) {
      call.findings.push_back(
          {pointer_to_input(inputs_[i].name), "out_of_range", std::move(one.broken_rule)});
    }
    taken.push_back(std::move(one.value));
  }
  if (call.findings.empty()) {
    call.document = document_with(data, taken);
  }
  return call;
}

std::string Component::input_at(std::string_view pointer) const {
  for (const SweepParameter& parameter : sweep_.data().parameters) {
    for (const SweepTarget& target : parameter.targets) {
      const std::string_view place = target.pointer;
      const std::string_view inner = place.size() > pointer.size() ? place : pointer;
      const std::string_view outer = place.size() > pointer.size() ? pointer : place;
      if (inner.starts_with(outer) && (inner.size() == outer.size() || inner[outer.size()] == '/')) {
        return parameter.name;
      }
    }
  }
  return "";
}

std::vector<std::string> Component::parts() const {
  std::vector<std::string> parts{"branches", "static", "states", "critical_points"};
  for (const std::string_view part : sweep_.parts()) {
    parts.emplace_back(part);
  }
  return parts;
}

std::vector<ComponentValue> Component::values(const Json& result) const {
  std::vector<ComponentValue> values;
  const std::vector<SweepOutput>& places = sweep_.data().outputs;
  for (std::size_t i = 0; i < outputs_.size(); ++i) {
    if (i < places.size()) {
      values.push_back({sweep_.value_at(result, i), {}});
    } else {
      values.push_back({{}, outputs_[i].name == kPathOutput ? drawn_paths(result) : drawn_shape(result)});
    }
  }
  return values;
}

ComponentOutcome read_component(std::string_view text) {
  SweepOutcome read = read_sweep(text);
  if (!read.sweep) {
    return {std::move(read.findings), std::nullopt};
  }
  ComponentOutcome outcome;
  const SweepData& data = read.sweep->data();
  if (data.follow) {
    outcome.findings.push_back(
        {"/follow", "excess_field", "a component computes one point: it has no curve to follow"});
  }
  std::vector<ComponentInput> inputs;
  for (std::size_t i = 0; i < data.parameters.size(); ++i) {
    inputs.push_back(input_of(data.parameters[i], i, outcome.findings));
  }
  if (outcome.findings.empty()) {
    outcome.component.emplace(*read.sweep, std::move(inputs), outputs_of(data));
  }
  return outcome;
}

}  // namespace snapthrough::api
