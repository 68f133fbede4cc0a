#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <utility>

#include "api/json_text.h"
#include "api/sweep.h"
#include "api/sweep_data.h"
#include "api/value.h"
#include "solver/model/check_place.h"

namespace snapthrough::api {

std::optional<std::vector<std::string>> pointer_tokens(std::string_view pointer) {
  std::vector<std::string> tokens;
  for (std::size_t i = 0; i < pointer.size(); ++i) {
    if (pointer[i] == '/') {
      tokens.emplace_back();
    } else if (tokens.empty()) {
      return std::nullopt;
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

/// Whether a value can be written at a pointer: everything above it is there, and an array has the element.
bool has_place(const Json& document, const std::vector<std::string>& tokens) {
  const Json* at = &document;
  for (std::size_t i = 0; i < tokens.size(); ++i) {
    const bool last = i + 1 == tokens.size();
    const auto index = array_index(tokens[i]);
    if (at->is_array() && index && *index < at->size()) {
      at = &(*at)[*index];
    } else if (at->is_object() && at->contains(tokens[i])) {
      at = &(*at)[tokens[i]];
    } else {
      return last && at->is_object();
    }
  }
  return true;
}

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
  } else if (!has_place(base, *tokens)) {
    pointer->report("no_such_place", "the request of this sweep has no " + target.pointer);
  } else {
    target.place = Json::json_pointer(target.pointer);
  }
  return target;
}

/// @param counted the design takes the values one by one, so the range says how many
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
  if (range.log && (range.from <= 0.0 || range.to <= 0.0)) {
    value.report("out_of_range", "from and to must be positive where the spacing is log");
  }
  return range;
}

/// Why a target cannot get its number for a value; empty when it can.
std::string number_refusal(const SweepTarget& target, double value) {
  if (std::isfinite(target.number_for(value))) {
    return "";
  }
  return checks::text(value) + (target.power ? " to the power " + checks::text(*target.power) : "") +
         (target.scale ? " times " + checks::text(*target.scale) : "") + " is no finite number, at " +
         target.pointer;
}

/// Values are numbers where a target computes with them, and so is what it gets.
void check_computed(const SweepParameter& parameter, const Value& values) {
  for (const SweepTarget& target : parameter.targets) {
    for (std::size_t i = 0; target.computes() && i < parameter.values.size(); ++i) {
      if (!parameter.values[i].is_number()) {
        values.item(i).report_type("a number, because a target has a scale or a power");
      } else if (const std::string why = number_refusal(target, parameter.values[i].get<double>());
                 !why.empty()) {
        values.item(i).report("out_of_range", why);
      }
    }
  }
}

/// The same for all values from one end of a range to the other.
void check_computed_range(const SweepParameter& parameter, const Value& value) {
  const SweepRange& range = *parameter.range;
  if (!std::isfinite(range.from) || !std::isfinite(range.to)) {
    return;  // reported already
  }
  for (const SweepTarget& target : parameter.targets) {
    if (!target.computes()) {
      continue;
    }
    std::string why = number_refusal(target, range.from);
    why = why.empty() ? number_refusal(target, range.to) : why;
    if (why.empty() && target.power.value_or(1.0) < 0.0 && range.from * range.to < 0.0) {
      why = "a range through 0 has no number there for a negative power, at " + target.pointer;
    }
    if (!why.empty()) {
      value.report("out_of_range", why);
    }
  }
}

/// Texts in place of the values of a list, one for each.
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
  if (label->is_array() && parameter.labels.size() != parameter.values.size()) {
    label->report("unequal_counts",
                  "label has one text for each value: " + std::to_string(parameter.labels.size()) +
                      " here, " + std::to_string(parameter.values.size()) + " values");
  }
  std::set<std::string_view> seen;
  for (std::size_t i = 0; i < parameter.labels.size(); ++i) {
    if (const Value text = label->item(i); !text.is_string()) {
      continue;  // reported already
    } else if (parameter.labels[i].empty()) {
      text.report("invalid_name", "a label is not empty");
    } else if (!seen.insert(parameter.labels[i]).second) {
      text.report("duplicate_name", "another value has this label");
    }
  }
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
    check_computed_range(parameter, *range);
  } else if (!values->is_array()) {
    values->report_type("an array");
  } else if (values->size() == 0) {
    values->report("out_of_range", "values must not be empty");
  } else {
    parameter.values = values->json().get<std::vector<Json>>();
    check_computed(parameter, *values);
  }
}

SweepParameter read_parameter(const Value& value, const SweepData& data) {
  static constexpr std::array<std::string_view, 3> kOwnColumns{"error", "point", "request"};
  SweepParameter parameter;
  Object in(value);
  in.required("name", parameter.name);
  if (const auto name = in.find("name");
      name && name->is_string() &&
      (parameter.name.empty() || parameter.name[0] == '/' ||
       std::find(kOwnColumns.begin(), kOwnColumns.end(), parameter.name) != kOwnColumns.end())) {
    name->report("invalid_name",
                 "a name is not empty, does not begin with /, and is not that of another "
                 "column: error, point, request");
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

bool overlap(std::string_view a, std::string_view b) {
  if (a.size() > b.size()) {
    std::swap(a, b);
  }
  return b.starts_with(a) && (a.size() == b.size() || b[a.size()] == '/');
}

/// No name twice, and no place written by two targets: which one won would depend on their order.
void check_distinct(const SweepData& data, Report& report) {
  std::vector<std::pair<std::string, std::string>> seen;  // target and where it stands
  for (std::size_t i = 0; i < data.parameters.size(); ++i) {
    const std::string at = "/parameters/" + std::to_string(i);
    for (std::size_t j = 0; j < i; ++j) {
      if (data.parameters[i].name == data.parameters[j].name) {
        report.add(at + "/name", "duplicate_name", "another parameter has this name");
      }
    }
    for (std::size_t t = 0; t < data.parameters[i].targets.size(); ++t) {
      const std::string& pointer = data.parameters[i].targets[t].pointer;
      const std::string here = at + "/targets/" + std::to_string(t) + "/pointer";
      for (const auto& [other, where] : seen) {
        if (overlap(pointer, other)) {
          report.add(here, "overlapping_targets", "this place is also written by " + where);
        }
      }
      seen.emplace_back(pointer, here);
    }
  }
}

/// Counts without building anything; what is too many is not counted to its end.
void count_points(SweepData& data, std::uint64_t most, Report& report) {
  data.points = data.design == SweepDesign::grid ? 1 : data.parameters[0].count();
  if (data.design == SweepDesign::latin_hypercube) {
    data.points = static_cast<std::uint64_t>(data.samples);
  }
  for (std::size_t i = 0; i < data.parameters.size(); ++i) {
    const std::uint64_t count = data.parameters[i].count();
    if (data.design == SweepDesign::zip && count != data.points) {
      report.add("/parameters/" + std::to_string(i), "unequal_counts",
                 "zip needs as many values for each parameter: " + std::to_string(count) + " here, " +
                     std::to_string(data.points) + " for the first");
      return;
    }
    if (data.design == SweepDesign::grid && data.points <= most) {
      data.points *= count;  // both factors fit 32 bits
    }
  }
  if (data.points > most) {
    const bool sampled = data.design == SweepDesign::latin_hypercube;
    report.add(sampled ? "/design/latin_hypercube/samples" : "/parameters", "too_many_points",
               "the design has more than " + std::to_string(most) + " points");
  }
}

/// Mistakes of the request that no point can be without: fields that nobody knows, lack, or are of a wrong
/// type, at places that no parameter writes. Other findings may depend on the values and stay the point's.
void check_request(const Sweep& sweep, const SweepData& data, std::vector<Finding>& findings) {
  const ReadOutcome first = read_request_document(sweep.document_at(0));
  for (const Finding& finding : first.findings) {
    bool swept = false;
    for (std::size_t i = 0; i < data.parameters.size(); ++i) {
      for (std::size_t t = 0; t < data.parameters[i].targets.size(); ++t) {
        const std::string& pointer = data.parameters[i].targets[t].pointer;
        swept = swept || (finding.pointer.size() >= pointer.size() && overlap(finding.pointer, pointer));
        if (finding.pointer == pointer && finding.code == "unknown_field") {
          findings.push_back(
              {"/parameters/" + std::to_string(i) + "/targets/" + std::to_string(t) + "/pointer",
               finding.code, finding.detail});
        }
      }
    }
    if (!swept && (finding.code == "unknown_field" || finding.code == "missing_field" ||
                   finding.code == "wrong_type")) {
      findings.push_back(finding);
    }
  }
}

/// Why a target of the parameter does not take values of this one's type; empty when they all do.
std::string type_refusal(const Json& first, const SweepParameter& parameter, const Json& value) {
  const Json probe = value.is_number() ? Json(1) : value;  // 1 is of every type of number
  const auto document = std::make_shared<Json>(first);
  for (const SweepTarget& target : parameter.targets) {
    (*document)[target.place] = probe;
  }
  for (const Finding& finding : read_request_document(document).findings) {
    for (const SweepTarget& target : parameter.targets) {
      if (finding.pointer == target.pointer && finding.code == "wrong_type") {
        return finding.detail + ", at " + target.pointer;
      }
    }
  }
  return "";
}

/// Values that no point of theirs can do with, because they are of a type that the target does not take: each
/// type of JSON that occurs is tried once.
void check_value_types(const Sweep& sweep, const SweepData& data, std::vector<Finding>& findings) {
  const auto first = sweep.document_at(0);
  for (std::size_t i = 0; i < data.parameters.size(); ++i) {
    const SweepParameter& parameter = data.parameters[i];
    const std::string at = "/parameters/" + std::to_string(i);
    if (const std::string why = parameter.range ? type_refusal(*first, parameter, 1) : ""; !why.empty()) {
      findings.push_back({at + "/range", "wrong_type", why});
    }
    std::map<std::string_view, std::string> refused;  // why, by type; empty: it is taken
    for (std::size_t v = 0; v < parameter.values.size() && findings.size() < kMaxFindings; ++v) {
      const auto [known, is_new] = refused.try_emplace(parameter.values[v].type_name());
      if (is_new) {
        known->second = type_refusal(*first, parameter, parameter.values[v]);
      }
      if (!known->second.empty()) {
        findings.push_back({at + "/values/" + std::to_string(v), "wrong_type", known->second});
      }
    }
  }
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

/// @return whether the design could be read: without it nothing is known of what parameters need
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

/// Whether values are numbers that rise, or fall, from one to the next.
bool is_monotonic(const SweepParameter& parameter) {
  if (parameter.range) {
    return parameter.range->from != parameter.range->to;
  }
  bool up = true;
  bool down = true;
  for (std::size_t i = 0; i < parameter.values.size(); ++i) {
    if (!parameter.values[i].is_number()) {
      return false;
    }
    if (i > 0) {
      const double step = parameter.values[i].get<double>() - parameter.values[i - 1].get<double>();
      up = up && step > 0.0;
      down = down && step < 0.0;
    }
  }
  return up || down;
}

/// What following needs: the last parameter of a grid, numbers in order, a critical analysis on a fixed mesh,
/// and outputs that a curve has.
void check_follow(const SweepData& data, const Value& follow) {
  if (data.design != SweepDesign::grid) {
    follow.report("not_supported", "a critical point is followed in a grid only");
  } else if (!is_monotonic(data.parameters.back())) {
    follow.report("not_supported",
                  "the values of a parameter that is followed are numbers, rising or falling");
  }
  const Json none = Json::object();
  const Json analysis = data.base.value("analysis", none);
  const Json mesh = analysis.is_object() ? analysis.value("discretization", none) : none;
  if (!analysis.is_object() || analysis.value("type", Json()) != "critical" || !mesh.is_object() ||
      !mesh.contains("elements")) {
    follow.report("not_supported",
                  "a sweep that follows has an analysis of type critical on a mesh that is given (elements)");
  }
  for (const SweepOutput& output : data.outputs) {
    if (output.pointer != "/summary/critical_load_factor" && output.pointer != "/summary/critical_type") {
      follow.report(
          "not_supported",
          "a curve has /summary/critical_load_factor and /summary/critical_type, not " + output.pointer);
    }
  }
}

void read_follow(Object& root, SweepData& data) {
  const auto follow = root.find("follow");
  if (!follow) {
    return;
  }
  std::string name;
  read(*follow, name);
  if (!follow->document_report().findings().empty()) {
    return;  // it can't be judged
  }
  if (name != data.parameters.back().name) {
    follow->report("unknown_reference", "follow names the last parameter, " + data.parameters.back().name);
    return;
  }
  check_follow(data, *follow);
  data.follow = true;
  data.unit_size = data.parameters.back().count();
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
    static_cast<void>(root.find("parameters"));  // known, although nothing can be said about it
  }
  const bool targets_known = report.findings().empty();
  read_outputs(root, *data);
  if (targets_known) {
    check_outputs(*data, report);
  }
  read_follow(root, *data);
  root.finish();
  if (report.findings().empty()) {
    check_distinct(*data, report);
    count_points(*data, std::min(most_points, kMaxSweepPoints), report);
  }
  outcome.findings = report.findings();
  if (outcome.findings.empty()) {
    const Sweep sweep(data);
    check_request(sweep, *data, outcome.findings);
    check_value_types(sweep, *data, outcome.findings);
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
