#pragma once
/// @file
/// A sweep document as a function: its parameters are inputs, its outputs are outputs, and one call is one
/// analysis. Programs that draw (Grasshopper) show such a function as a component.

#include <array>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "api/api.h"
#include "api/sweep.h"

namespace snapthrough::api {

/// What an input takes, or an output gives.
enum class PlugType { number, integer, text, boolean, point };

/// A parameter of the sweep.
struct ComponentInput {
  std::string name;
  std::string description;  ///< the places that it is written to, and its bounds
  PlugType type = PlugType::number;
  bool list = false;            ///< takes a list of such values, in place of one
  nlohmann::json initial;       ///< the first of the sweep's values; a label where values have labels
  std::optional<double> least;  ///< of the values that the sweep has for it, when it has several
  std::optional<double> most;
  std::vector<std::string> labels;  ///< the texts that it takes; empty: any value of the type
};

/// A place of the result, or what is drawn of it.
struct ComponentOutput {
  std::string name;
  std::string description;
  PlugType type = PlugType::number;
};

/// A line through points (x, y), at its place in a tree of lines.
struct Polyline {
  std::vector<int> place;
  std::vector<std::array<double, 2>> points;
};

/// What a result gives for an output.
struct ComponentValue {
  nlohmann::json value;         ///< of an output that is a place; null: the result has none there
  std::vector<Polyline> lines;  ///< of an output that is drawn
};

/// Names of the outputs that are drawn of results.
inline constexpr std::string_view kPathOutput = "path";
inline constexpr std::string_view kShapeOutput = "shape";

/// What calling a component gave. Exactly one of `findings` (not empty) and `document` (not null) holds.
struct ComponentCall {
  std::vector<Finding> findings;  ///< pointers are "/" and the name of an input
  nlohmann::json document;        ///< the request
};

/// @brief A sweep document that can be called. Immutable and cheap to copy; thread-safe.
class Component {
 public:
  /// @pre as_component() found no mistake
  Component(Sweep sweep, std::vector<ComponentInput> inputs, std::vector<ComponentOutput> outputs)
      : sweep_(std::move(sweep)), inputs_(std::move(inputs)), outputs_(std::move(outputs)) {}

  /// Title of the model; may be empty.
  [[nodiscard]] std::string title() const { return sweep_.title(); }
  [[nodiscard]] const std::vector<ComponentInput>& inputs() const { return inputs_; }
  /// The sweep's outputs in their order, then what is drawn: `path` where the analysis gives load factors and
  /// displacements of monitors, `shape` where it gives states.
  [[nodiscard]] const std::vector<ComponentOutput>& outputs() const { return outputs_; }

  /// @brief The request document with these values, one for each input.
  /// @param values by name of the input; points are lists of two numbers
  [[nodiscard]] ComponentCall call(const std::map<std::string, nlohmann::json>& values) const;

  /// @brief The name of the input that is written to a place of the request, or around it; empty: none.
  /// @param pointer JSON Pointer into the request
  [[nodiscard]] std::string input_at(std::string_view pointer) const;

  /// Members of the result document that values() looks into.
  [[nodiscard]] std::vector<std::string> parts() const;

  /// @brief What a result gives for the outputs, in their order.
  ///
  /// path: for each path of a result and each monitor a line at {path; monitor}, of points (displacement,
  /// load factor). shape: for each member a line at {member} along its deformed axis, in the state of the
  /// first critical point that has one, else in the last state.
  /// @param result with at least parts()
  [[nodiscard]] std::vector<ComponentValue> values(const nlohmann::json& result) const;

 private:
  Sweep sweep_;
  std::vector<ComponentInput> inputs_;
  std::vector<ComponentOutput> outputs_;
};

/// What reading a component gave. Exactly one of `findings` (not empty) and `component` (a value) holds.
struct ComponentOutcome {
  std::vector<Finding> findings;
  std::optional<Component> component;
};

/// @brief Reads a sweep document as a component. Besides a sweep's own rules: values of one parameter are of
/// one type (numbers, texts, booleans, lists of numbers, lists of points), or each has a label; and the sweep
/// does not follow a curve.
[[nodiscard]] ComponentOutcome read_component(std::string_view text);

}  // namespace snapthrough::api
