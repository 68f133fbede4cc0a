#pragma once
/// @file
/// A sweep document as a function: parameters are inputs, outputs are outputs, and one call is one analysis.
/// Visual programming tools (Grasshopper) show the function as a component.

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

/// Type of the values of an input or output.
enum class PlugType { number, integer, text, boolean, point };

/// An input: a parameter of the sweep.
struct ComponentInput {
  std::string name;
  std::string description;  ///< targets of the parameter, and bounds
  PlugType type = PlugType::number;
  bool list = false;            ///< true: the input takes a list of values
  nlohmann::json initial;       ///< first value of the sweep, or its label
  std::optional<double> least;  ///< bounds, if the sweep has several numbers
  std::optional<double> most;
  std::vector<std::string> labels;  ///< accepted texts; empty: any value of the type
};

/// An output: a place of the result, or polylines (kPathOutput, kShapeOutput).
struct ComponentOutput {
  std::string name;
  std::string description;
  PlugType type = PlugType::number;
};

/// A polyline of points (x, y) with its path in a tree of polylines.
struct Polyline {
  std::vector<int> place;
  std::vector<std::array<double, 2>> points;
};

/// Value of an output in a result.
struct ComponentValue {
  nlohmann::json value;         ///< value at the output's place; null: none there
  std::vector<Polyline> lines;  ///< polylines of kPathOutput and kShapeOutput
};

/// Names of the outputs that are polylines.
inline constexpr std::string_view kPathOutput = "path";
inline constexpr std::string_view kShapeOutput = "shape";

/// Outcome of a call. Either `findings` is not empty or `document` is not null.
struct ComponentCall {
  std::vector<Finding> findings;  ///< pointers are "/" and an input's name
  nlohmann::json document;        ///< the request document
};

/// @brief A callable sweep document. Immutable, cheap to copy, thread-safe.
class Component {
 public:
  /// @pre read_component() has no findings
  Component(Sweep sweep, std::vector<ComponentInput> inputs, std::vector<ComponentOutput> outputs)
      : sweep_(std::move(sweep)), inputs_(std::move(inputs)), outputs_(std::move(outputs)) {}

  /// Returns the title of the model; may be empty.
  [[nodiscard]] std::string title() const { return sweep_.title(); }
  [[nodiscard]] const std::vector<ComponentInput>& inputs() const { return inputs_; }
  /// Outputs of the sweep in their order, then `path` if the analysis gives load factors and displacements of
  /// monitors, and `shape` if it gives states.
  [[nodiscard]] const std::vector<ComponentOutput>& outputs() const { return outputs_; }

  /// @brief Returns the request document for one value of each input.
  /// @param values by name of the input; a point is a list of two numbers
  [[nodiscard]] ComponentCall call(const std::map<std::string, nlohmann::json>& values) const;

  /// @brief Returns the input that writes a place of the request, a part or a container of it; "": none.
  /// @param pointer JSON Pointer into the request
  [[nodiscard]] std::string input_at(std::string_view pointer) const;

  /// Returns the members of the result document that values() needs.
  [[nodiscard]] std::vector<std::string> parts() const;

  /// @brief Returns the values of the outputs in a result, in the order of outputs().
  ///
  /// path: for each path of a result and each monitor a polyline at {path; monitor} of points (displacement,
  /// load factor). shape: for each member a polyline at {member} along its deformed axis, in the state of the
  /// first critical point with a state, else in the last state.
  /// @param result has at least the members parts()
  [[nodiscard]] std::vector<ComponentValue> values(const nlohmann::json& result) const;

 private:
  Sweep sweep_;
  std::vector<ComponentInput> inputs_;
  std::vector<ComponentOutput> outputs_;
};

/// Outcome of reading a component. Either `findings` is not empty or `component` has a value.
struct ComponentOutcome {
  std::vector<Finding> findings;
  std::optional<Component> component;
};

/// @brief Reads a sweep document as a component. Rules beyond those of sweeps: the values of a parameter have
/// one type (number, text, boolean, list of numbers, list of points) or labels, and the sweep does not follow
/// a critical point.
[[nodiscard]] ComponentOutcome read_component(std::string_view text);

}  // namespace snapthrough::api
