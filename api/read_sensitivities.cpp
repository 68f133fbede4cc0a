#include "api/read_sensitivities.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <variant>

#include "api/read_parts.h"
#include "api/sweep_data.h"
#include "solver/check/check.h"
#include "solver/model/id_index.h"
#include "solver/numeric/work_limit.h"

namespace snapthrough::api {

namespace {

using Json = nlohmann::json;

/// Returns the largest distance between the first and another node; 1 when it is zero.
double extent_of(const Model& model) {
  double extent = 0.0;
  for (const Node& node : model.nodes) {
    extent = std::max(extent, std::hypot(node.x - model.nodes[0].x, node.y - model.nodes[0].y));
  }
  return extent > 0.0 && std::isfinite(extent) ? extent : 1.0;
}

/// Largest force, moment, force per length or pressure of a load; a kind of load without it does not compile.
double size_of(const PointLoad& load) {
  return std::max({std::abs(load.force[0]), std::abs(load.force[1]), std::abs(load.moment)});
}
double size_of(const DistributedLoad& load) {
  double size = std::max(std::abs(load.force[0]), std::abs(load.force[1]));
  for (const auto& [fraction, force] : load.force_along) {
    size = std::max({size, std::abs(force[0]), std::abs(force[1])});
  }
  return size;
}
double size_of(const PressureLoad& load) {
  double size = std::abs(load.value);
  for (const auto& [fraction, value] : load.value_along) {
    size = std::max(size, std::abs(value));
  }
  return size;
}
double size_of(const InitialStrain&) { return 0.0; }
double size_of(const TemperatureLoad&) { return 0.0; }
double size_of(const SelfWeight&) { return 0.0; }  // the masses and the lengths of members determine it

double largest_load(const Model& model) {
  double largest = 0.0;
  for (const Load& load : model.loads) {
    largest = std::max(largest, std::visit([](const auto& one) { return size_of(one); }, load));
  }
  return largest > 0.0 ? largest : 1.0;
}

/// Scales of a model's numbers, each computed once for all of them.
class Sizes {
 public:
  explicit Sizes(const Model& model)
      : extent_(extent_of(model)), load_(largest_load(model)), chords_(model.nodes.size(), extent_) {
    for (const Section& section : model.sections) {
      bending_ = std::max(bending_, section.EI.largest());
    }
    const IdIndex nodes(model.nodes);
    for (const Member& member : model.members) {
      const int start = nodes.of(member.start);
      const int end = nodes.of(member.end);
      if (start >= 0 && end >= 0) {
        take_chord(model.nodes, static_cast<std::size_t>(start), static_cast<std::size_t>(end));
      }
    }
  }

  /// Size of a large change of a quantity.
  [[nodiscard]] double of(const std::vector<std::string>& tokens, double value) const {
    if (tokens[1] == "nodes") {
      const std::size_t node = *array_index(tokens[2]);
      return node < chords_.size() ? chords_[node] : extent_;
    }
    if (std::find(tokens.begin(), tokens.end(), "points") != tokens.end()) {
      return 0.1 * extent_;
    }
    return value != 0.0 ? std::abs(value) : of_nothing(tokens);
  }

 private:
  void take_chord(const std::vector<Node>& nodes, std::size_t start, std::size_t end) {
    const double chord = std::hypot(nodes[end].x - nodes[start].x, nodes[end].y - nodes[start].y);
    if (chord > 0.0) {
      chords_[start] = std::min(chords_[start], chord);
      chords_[end] = std::min(chords_[end], chord);
    }
  }

  /// Scale of a quantity that is zero, by its name. Only lengths and angles enter nonlinearly.
  [[nodiscard]] double of_nothing(const std::vector<std::string>& tokens) const {
    static constexpr std::array<std::string_view, 9> kLengths{
        "x", "y", "rise", "amplitude", "gap", "points", "ground_level", "water_table", "scour"};
    constexpr double kRadian = 57.0;
    const auto names = [&tokens](std::string_view name) {
      return std::find(tokens.begin(), tokens.end(), name) != tokens.end();
    };
    if (std::any_of(kLengths.begin(), kLengths.end(), names) || (names("offsets") && tokens.back() == "1")) {
      return extent_;
    }
    if (names("angle_degrees") || names("sweep_degrees")) {
      return kRadian;
    }
    if (names("stiffness") || names("shear_stiffness")) {
      return bending_ / (extent_ * extent_ * extent_);
    }
    if (names("release")) {
      return bending_ / extent_;
    }
    if (names("curvature")) {
      return 1.0 / extent_;
    }
    return names("force") || names("moment") || names("value") ? load_ : 1.0;
  }

  double extent_;
  double load_;                 ///< largest load
  double bending_ = 0.0;        ///< largest EI
  std::vector<double> chords_;  ///< shortest chord of the members at each node, at most the extent
};

/// Returns why critical loads have no derivative with respect to a value; "" when they may have one.
std::string refusal(const std::vector<std::string>& tokens, const Json& value) {
  if (!value.is_number()) {
    return std::string("is not a number but ") + (value.is_array() ? "an array" : value.type_name());
  }
  if (tokens.back() == "half_waves" || tokens.back() == "number") {
    return "is a count: between whole numbers there is nothing to differentiate by";
  }
  return tokens[1] == "monitors" ? "changes what is read from the structure, not the structure" : "";
}

/// Returns the model with another value at a place; nullopt when that model is invalid.
std::optional<Model> model_with(const Json& document, const Json::json_pointer& place, double value) {
  Json changed = document.at("model");
  changed[place] = value;
  Report report;
  Model model;
  read(Value(changed, PointerPath("/model"), report), model);
  return report.findings().empty() && check(model, Analysis()).empty() ? std::optional(std::move(model))
                                                                       : std::nullopt;
}

void complete(const std::shared_ptr<const Json>& document, const Sizes& sizes, const Value& at,
              Variation& variation) {
  const auto tokens = pointer_tokens(variation.pointer);
  if (!tokens || tokens->size() < 2 || tokens->front() != "model") {
    at.report("invalid_pointer", "expected a JSON Pointer to a number in /model");
    return;
  }
  const Json::json_pointer place(variation.pointer.substr(std::string_view("/model").size()));
  const Json& whole = document->at("model");
  if (!whole.contains(place)) {
    at.report("no_such_place", "this request has no " + variation.pointer +
                                   "; a value that is left out has to be written to be varied");
    return;
  }
  const Json& value = whole.at(place);
  if (const std::string why = refusal(*tokens, value); !why.empty()) {
    at.report("not_supported", variation.pointer + " " + why);
    return;
  }
  variation.value = value.get<double>();
  variation.size = sizes.of(*tokens, variation.value);
  variation.model_at = [document, place](double other) { return model_with(*document, place, other); };
}

}  // namespace

void read_sensitivities(const std::shared_ptr<const Json>& document, const Model& model, Analysis& analysis,
                        Report& report) {
  if (analysis.sensitivities.empty() || !document->contains("model")) {
    return;
  }
  const Json& list = document->at("analysis").at("sensitivities");
  const PointerPath path = PointerPath().with("analysis").with("sensitivities");
  const Sizes sizes(model);
  for (std::size_t i = 0; i < analysis.sensitivities.size(); ++i) {
    WorkLimit::poll();
    if (list[i].is_string()) {
      complete(document, sizes, Value(list[i], path.with(i), report), analysis.sensitivities[i]);
    }
  }
}

}  // namespace snapthrough::api
