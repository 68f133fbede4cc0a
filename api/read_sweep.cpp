/// Reader of the sweep document: each function reads one part. check_sweep.cpp checks rules that relate
/// several fields.

#include <algorithm>
#include <charconv>
#include <nlohmann/json.hpp>
#include <set>
#include <utility>

#include "api/check_sweep.h"
#include "api/json_text.h"
#include "api/read_refine.h"
#include "api/sweep.h"
#include "api/sweep_data.h"
#include "api/value.h"

namespace snapthrough::api {

std::optional<std::vector<std::string>> pointer_tokens(std::string_view pointer) {
  if (!pointer.empty() && pointer.front() != '/') {
    return std::nullopt;
  }
  std::vector<std::string> tokens;
  for (std::size_t i = 0; i < pointer.size(); ++i) {
    if (pointer[i] == '/') {
      tokens.emplace_back();
    } else if (pointer[i] != '~') {
      tokens.back() += pointer[i];
    } else if (++i < pointer.size() && (pointer[i] == '0' || pointer[i] == '1')) {
      tokens.back() += pointer[i] == '0' ? '~' : '/';
    } else {
      return std::nullopt;
    }
  }
  return tokens;
}

std::optional<std::size_t> array_index(std::string_view token) {
  std::size_t index = 0;
  const char* end = token.data() + token.size();
  const auto [stop, error] = std::from_chars(token.data(), end, index);
  const bool leading_zero = token.size() > 1 && token[0] == '0';
  return error == std::errc() && stop == end && !leading_zero ? std::optional(index) : std::nullopt;
}

namespace {

using Json = nlohmann::json;

void read_pointer(const Value& value, SweepOutput& out) {
  read(value, out.pointer);
  if (!value.is_string()) {
    return;
  }
  const auto tokens = pointer_tokens(out.pointer);
  if (!tokens || tokens->empty()) {
    value.report("invalid_pointer", "expected a JSON Pointer into the result, such as /summary/message");
    return;
  }
  out.tokens = *tokens;
}

SweepTarget read_target(const Value& value, const Json& base) {
  SweepTarget target;
  Object in(value);
  in.required("pointer", target.pointer);
  in.optional("scale", target.scale);
  in.optional("power", target.power);
  in.finish();
  const auto pointer = in.find("pointer");
  if (!pointer || !pointer->is_string()) {
    return target;
  }
  const auto tokens = pointer_tokens(target.pointer);
  if (!tokens || tokens->size() < 2 || (tokens->front() != "model" && tokens->front() != "analysis")) {
    pointer->report("invalid_pointer", "expected a JSON Pointer to something in /model or /analysis");
  } else if (check_target(*tokens, base, *pointer)) {
    target.place = Json::json_pointer(target.pointer);
  }
  return target;
}

/// @param counted true: the design uses listed values, so the range needs a count
SweepRange read_range(const Value& value, bool counted) {
  static constexpr Named<bool> kSpacings[] = {{"linear", false}, {"log", true}};
  SweepRange range;
  Object in(value);
  in.required("from", range.from);
  in.required("to", range.to);
  if (counted) {
    in.required("count", range.count);
  } else if (const auto count = in.find("count")) {
    count->report("excess_field", "a Latin hypercube draws from the whole range; its samples are the count");
  }
  if (const auto spacing = in.find("spacing")) {
    read_named(*spacing, kSpacings, range.log);
  }
  in.finish();
  if (const auto count = in.find("count"); counted && count && count->is_number() && range.count < 2) {
    count->report("out_of_range", "a range has at least its two ends: count must be 2 or more");
    range.count = 2;
  }
  return range;
}

/// Reads `label`, the texts that replace listed values in tables.
void read_labels(Object& in, SweepParameter& parameter) {
  const auto label = in.find("label");
  if (!label) {
    return;
  }
  if (parameter.range) {
    label->report("excess_field", "only values have labels; those of a range are numbers");
    return;
  }
  read(*label, parameter.labels);
  check_labels(parameter, *label);
}

void read_values(Object& in, SweepParameter& parameter, bool counted) {
  const auto values = in.find("values");
  const auto range = in.find("range");
  if (values.has_value() == range.has_value()) {
    in.value().report(values ? "excess_field" : "missing_field", "a parameter has either values or a range");
    return;
  }
  if (range) {
    parameter.range = read_range(*range, counted);
    check_range(parameter, *range);
  } else if (!values->is_array()) {
    values->report_type("an array");
  } else if (values->size() == 0) {
    values->report("out_of_range", "values must not be empty");
  } else {
    parameter.values = values->json().get<std::vector<Json>>();
    check_values(parameter, *values);
  }
}

SweepParameter read_parameter(const Value& value, const SweepData& data) {
  SweepParameter parameter;
  Object in(value);
  in.required("name", parameter.name);
  if (const auto name = in.find("name"); name && name->is_string()) {
    check_name(parameter, *name);
  }
  const auto targets = in.find_required("targets");
  if (targets && !targets->is_array()) {
    targets->report_type("an array");
  } else if (targets && targets->size() == 0) {
    targets->report("out_of_range", "a parameter needs a target");
  } else if (targets && targets->size() > kMaxSweepTargets) {
    targets->report("out_of_range",
                    "a parameter has at most " + std::to_string(kMaxSweepTargets) + " targets");
  } else if (targets) {
    for (std::size_t i = 0; i < targets->size(); ++i) {
      parameter.targets.push_back(read_target(targets->item(i), data.base));
    }
  }
  read_values(in, parameter, data.design != SweepDesign::latin_hypercube);
  read_labels(in, parameter);
  in.finish();
  return parameter;
}

void read_parameters(Object& root, SweepData& data) {
  const auto parameters = root.find_required("parameters");
  if (!parameters) {
    return;
  }
  if (!parameters->is_array() || parameters->size() == 0) {
    parameters->report_type("an array with at least one parameter");
    return;
  }
  if (parameters->size() > kMaxSweepParameters) {
    parameters->report("out_of_range",
                       "a sweep has at most " + std::to_string(kMaxSweepParameters) + " parameters");
    return;
  }
  for (std::size_t i = 0; i < parameters->size(); ++i) {
    data.parameters.push_back(read_parameter(parameters->item(i), data));
  }
}

void read_whole(Object& in, std::string_view key, int least, int& out) {
  in.required(key, out);
  if (const auto value = in.find(key); value && value->is_number() && out < least) {
    value->report("out_of_range", std::string(key) + " must be " + std::to_string(least) + " or more");
    out = least;
  }
}

/// @return false when the design is unreadable; the rules of parameters are then unknown
bool read_design(Object& root, SweepData& data) {
  static constexpr Named<SweepDesign> kDesigns[] = {{"grid", SweepDesign::grid}, {"zip", SweepDesign::zip}};
  const auto design = root.find_required("design");
  if (!design) {
    return false;
  }
  if (!design->is_object()) {
    const std::size_t before = design->document_report().findings().size();
    read_named(*design, kDesigns, data.design);
    return design->document_report().findings().size() == before;
  }
  Object in(*design);
  if (const auto hypercube = in.find_required("latin_hypercube")) {
    Object fields(*hypercube);
    read_whole(fields, "samples", 1, data.samples);
    read_whole(fields, "seed", 0, data.seed);
    fields.finish();
    data.design = SweepDesign::latin_hypercube;
  }
  in.finish();
  return data.design == SweepDesign::latin_hypercube;
}

void read_outputs(Object& root, SweepData& data) {
  const auto outputs = root.find_required("outputs");
  if (!outputs) {
    return;
  }
  if (!outputs->is_array() || outputs->size() == 0) {
    outputs->report_type("an array with at least one JSON Pointer");
    return;
  }
  if (outputs->size() > kMaxSweepOutputs) {
    outputs->report("out_of_range", "a sweep has at most " + std::to_string(kMaxSweepOutputs) + " outputs");
    return;
  }
  data.outputs.resize(outputs->size());
  std::set<std::string> seen;
  for (std::size_t i = 0; i < outputs->size(); ++i) {
    const Value output = outputs->item(i);
    read_pointer(output, data.outputs[i]);
    if (output.is_string() && !seen.insert(data.outputs[i].pointer).second) {
      output.report("duplicate_name", "another column has this name");
    }
  }
}

/// Reads the name of the parameter, or an object with the name and which critical points are followed.
void read_followed(const Value& follow, std::string& name, SweepFollow& followed) {
  if (!follow.is_object()) {
    read(follow, name);
    return;
  }
  Object in(follow);
  in.required("parameter", name);
  if (const auto point = in.find("point")) {
    followed.point = 0;
    read(*point, *followed.point);
    if (*followed.point < 0) {
      point->report("out_of_range", "critical points are counted from 0");
    }
  }
  in.optional("locus", followed.locus);
  if (followed.point && followed.locus) {
    follow.report("excess_field", "follow has a point or a locus, not both");
  }
  in.finish();
}

void read_follow(Object& root, SweepData& data) {
  const auto follow = root.find("follow");
  if (!follow) {
    return;
  }
  std::string name;
  read_followed(*follow, name, data.followed);
  if (!follow->document_report().findings().empty()) {
    return;  // the check needs fields that have findings
  }
  if (name != data.parameters.back().name) {
    follow->report("unknown_reference", "follow names the last parameter, " + data.parameters.back().name);
    return;
  }
  check_follow(data, *follow);
  data.item_size = data.parameters.back().count();
}

}  // namespace

SweepOutcome read_sweep_document(const std::shared_ptr<const Json>& document, std::uint64_t most_points) {
  SweepOutcome outcome;
  auto data = std::make_shared<SweepData>();
  Report report;
  Object root(Value(*document, PointerPath(), report));
  data->base = Json::object();
  for (const char* part : {"model", "analysis"}) {
    if (const auto value = root.find_required(part)) {
      data->base[part] = value->json();
    }
  }
  if (read_design(root, *data)) {
    read_parameters(root, *data);
  } else {
    static_cast<void>(root.find("parameters"));  // marks it as known; its rules need the design
  }
  data->follow = document->is_object() && document->contains("follow");
  const bool targets_known = report.findings().empty();
  read_outputs(root, *data);
  if (targets_known) {
    check_outputs(*data, report);
  }
  read_follow(root, *data);
  read_refine(root, *data);
  root.finish();
  if (report.findings().empty()) {
    check_distinct(*data, report);
    count_points(*data, std::min(most_points, kMaxSweepPoints), report);
  }
  outcome.findings = report.listed();
  if (outcome.findings.empty()) {
    const Sweep sweep(data);
    check_points(sweep, *data, outcome.findings);
    if (outcome.findings.empty()) {
      outcome.sweep = sweep;
    }
  }
  return outcome;
}

bool is_sweep(const Json& document) { return document.is_object() && document.contains("parameters"); }

SweepOutcome read_sweep(std::string_view text, std::uint64_t most_points) {
  ParsedText parsed = parse_json(text);
  if (parsed.document == nullptr) {
    return {.malformed = true, .findings = std::move(parsed.findings), .sweep = std::nullopt};
  }
  return read_sweep_document(parsed.document, most_points);
}

}  // namespace snapthrough::api
