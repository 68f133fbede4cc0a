#include "api/check_sweep.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <utility>

#include "solver/check/check_place.h"

namespace snapthrough::api {

namespace {

using Json = nlohmann::json;

/// Returns whether a value can be written at a pointer: its parent exists, and an array has the element.
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

/// Returns why a value gives no finite number at a target; "" when it does.
std::string number_refusal(const SweepTarget& target, double value) {
  if (std::isfinite(target.number_for(value))) {
    return "";
  }
  return checks::text(value) + (target.power ? " to the power " + checks::text(*target.power) : "") +
         (target.scale ? " times " + checks::text(*target.scale) : "") + " is no finite number, at " +
         target.pointer;
}

bool overlap(std::string_view a, std::string_view b) {
  if (a.size() > b.size()) {
    std::swap(a, b);
  }
  return b.starts_with(a) && (a.size() == b.size() || b[a.size()] == '/');
}

/// Returns whether the values are strictly increasing or strictly decreasing numbers.
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

/// Adds findings about the request that hold for every point: unknown and missing fields and wrong types at
/// places that no parameter writes. Other findings may depend on values and are left to the points.
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

/// Returns why a target of the parameter rejects the type of `value`; "" when all targets accept it.
std::string type_refusal(const Json& first, const SweepParameter& parameter, const Json& value) {
  const Json probe = value.is_number() ? Json(1) : value;  // 1 is valid for integers, too
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

/// Adds findings about values whose JSON type their target rejects. Each type that occurs is tried once, at
/// the first point.
void check_value_types(const Sweep& sweep, const SweepData& data, std::vector<Finding>& findings) {
  const auto first = sweep.document_at(0);
  for (std::size_t i = 0; i < data.parameters.size(); ++i) {
    const SweepParameter& parameter = data.parameters[i];
    const std::string at = "/parameters/" + std::to_string(i);
    if (const std::string why = parameter.range ? type_refusal(*first, parameter, 1) : ""; !why.empty()) {
      findings.push_back({at + "/range", "wrong_type", why});
    }
    std::map<std::string_view, std::string> refused;  // reason by type; empty: accepted
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

bool is_one_of(std::string_view name, std::initializer_list<std::string_view> names) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// Returns whether a row of a followed curve has an output. Rows of a locus have no single critical load.
bool is_output_of_curve(const SweepOutput& output, bool locus) {
  const std::vector<std::string>& tokens = output.tokens;
  if (tokens.size() == 2 && tokens[0] == "summary") {
    return !locus && is_one_of(tokens[1], {"critical_load_factor", "critical_type"});
  }
  if (tokens.empty() || tokens[0] != "curve" || tokens.size() > 4) {
    return false;
  }
  if (tokens.size() <= 2) {
    return tokens.size() == 1 || is_one_of(tokens[1], {"critical_points", "events", "none_up_to"});
  }
  const bool is_list = is_one_of(tokens[1], {"critical_points", "events"}) && array_index(tokens[2]);
  return is_list && (tokens.size() == 3 || is_one_of(tokens[3], {"load_factor", "type"}) ||
                     (tokens[1] == "events" && tokens[3] == "value"));
}

}  // namespace

void check_name(const SweepParameter& parameter, const Value& name) {
  static constexpr std::array<std::string_view, 3> kOwnColumns{"error", "point", "request"};
  if (parameter.name.empty() || parameter.name[0] == '/' ||
      std::find(kOwnColumns.begin(), kOwnColumns.end(), parameter.name) != kOwnColumns.end()) {
    name.report("invalid_name",
                "a name is not empty, does not begin with /, and is not that of another "
                "column: error, point, request");
  }
}

bool check_target(const std::vector<std::string>& tokens, const Json& base, const Value& pointer) {
  if (has_place(base, tokens)) {
    return true;
  }
  pointer.report("no_such_place",
                 "the request of this sweep has no " + pointer.json().get_ref<const std::string&>());
  return false;
}

void check_values(const SweepParameter& parameter, const Value& values) {
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

void check_range(const SweepParameter& parameter, const Value& value) {
  const SweepRange& range = *parameter.range;
  if (range.log && (range.from <= 0.0 || range.to <= 0.0)) {
    value.report("out_of_range", "from and to must be positive where the spacing is log");
  }
  if (!std::isfinite(range.from) || !std::isfinite(range.to)) {
    return;  // not finite: reported before
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

void check_labels(const SweepParameter& parameter, const Value& label) {
  if (label.is_array() && parameter.labels.size() != parameter.values.size()) {
    label.report("unequal_counts",
                 "label has one text for each value: " + std::to_string(parameter.labels.size()) + " here, " +
                     std::to_string(parameter.values.size()) + " values");
  }
  std::set<std::string_view> seen;
  for (std::size_t i = 0; i < parameter.labels.size(); ++i) {
    if (const Value text = label.item(i); !text.is_string()) {
      continue;  // wrong type: reported before
    } else if (parameter.labels[i].empty()) {
      text.report("invalid_name", "a label is not empty");
    } else if (!seen.insert(parameter.labels[i]).second) {
      text.report("duplicate_name", "another value has this label");
    }
  }
}

/// Whether a force of the model or of its load cases turns with its place or stays on a line.
bool has_following_force(const Json& owner) {
  const Json none = Json::object();
  const auto follows = [](const Json& one) {
    return one.is_object() && (one.value("follows", Json()) == true ||
                               one.value("fixed_line", Json()) == true || has_following_force(one));
  };
  const auto any_in = [&](const char* list) {
    const Json items = owner.value(list, none);
    return std::any_of(items.begin(), items.end(), follows);
  };
  return any_in("loads") || any_in("load_cases");
}

void check_follow(const SweepData& data, const Value& follow) {
  if (data.design != SweepDesign::grid) {
    follow.report("not_supported", "a critical point is followed in a grid only");
  } else if (!is_monotonic(data.parameters.back())) {
    follow.report("not_supported",
                  "the values of a parameter that is followed are numbers, rising or falling");
  }
  if ((data.followed.locus || data.followed.point) && data.parameters.back().count() < 2) {
    follow.report("not_supported", "a point or a locus is followed over at least two values");
  }
  const Json none = Json::object();
  const Json analysis = data.base.value("analysis", none);
  const Json mesh = analysis.is_object() ? analysis.value("discretization", none) : none;
  if (!analysis.is_object() ||
      analysis.value("type", Json()) != name_of(kAnalysisTypes, AnalysisType::critical) ||
      !mesh.is_object() || !mesh.contains("elements")) {
    follow.report("not_supported",
                  "a sweep that follows has an analysis of type critical on a mesh that is given (elements)");
  }
  const Json model = data.base.value("model", none);
  const Json imperfections = model.is_object() ? model.value("imperfections", none) : none;
  const auto is_worst = [](const Json& one) {
    return one.is_object() && one.value("type", Json()) == "worst";
  };
  if (std::any_of(imperfections.begin(), imperfections.end(), is_worst)) {
    follow.report("not_supported", "a worst imperfection is sought at each point anew: nothing is followed");
  }
  if (model.is_object() && has_following_force(model)) {
    follow.report("not_supported",
                  "forces that follow the structure or stay on a line may make it flutter, and a followed "
                  "curve knows no flutter: leave follow out");
  }
  for (const SweepOutput& output : data.outputs) {
    if (!is_output_of_curve(output, data.followed.locus)) {
      follow.report(
          "not_supported",
          std::string(data.followed.locus
                          ? "a locus has parts of /curve"
                          : "a curve has /summary/critical_load_factor, /summary/critical_type and parts "
                            "of /curve") +
              " (critical_points, events, none_up_to), not " + output.pointer);
    }
  }
}

void check_distinct(const SweepData& data, Report& report) {
  std::vector<std::pair<std::string, std::string>> seen;  // pointer of each target, and where it stands
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

void count_points(SweepData& data, std::uint64_t most, Report& report) {
  const std::size_t refined = data.refine ? static_cast<std::size_t>(data.refine->parameters) : 0;
  data.points = data.design == SweepDesign::grid ? 1 : data.parameters[0].count();
  if (data.design == SweepDesign::latin_hypercube) {
    data.points = static_cast<std::uint64_t>(data.samples);
  }
  for (std::size_t i = 0; i + refined < data.parameters.size(); ++i) {
    const std::uint64_t count = data.parameters[i].count();
    if (data.design == SweepDesign::zip && count != data.points) {
      report.add("/parameters/" + std::to_string(i), "unequal_counts",
                 "zip needs as many values for each parameter: " + std::to_string(count) + " here, " +
                     std::to_string(data.points) + " for the first");
      return;
    }
    if (data.design == SweepDesign::grid && data.points <= most) {
      data.points *= count;  // both factors are below 2^32
    }
  }
  const std::uint64_t rows_each = data.refine ? static_cast<std::uint64_t>(data.refine->most) : 1;
  if (data.refine && data.points <= most && data.points * rows_each > most) {
    report.add("/refine", "too_many_points",
               std::to_string(data.points) + " curves or surfaces with up to " + std::to_string(rows_each) +
                   " points each have more than " + std::to_string(most) + " points: lower most");
  }
  if (data.points > most) {
    const bool sampled = data.design == SweepDesign::latin_hypercube;
    report.add(sampled ? "/design/latin_hypercube/samples" : "/parameters", "too_many_points",
               "the design has more than " + std::to_string(most) + " points");
  }
}

void check_points(const Sweep& sweep, const SweepData& data, std::vector<Finding>& findings) {
  check_request(sweep, data, findings);
  check_value_types(sweep, data, findings);
}

}  // namespace snapthrough::api
