#pragma once
/// @file
/// Content of a sweep document after read_sweep(). Internal to api/.

#include <cmath>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace snapthrough::api {

/// `count` numbers from `from` to `to` inclusive, with constant differences, or constant ratios if `log`. A
/// Latin hypercube uses the interval without `count`.
struct SweepRange {
  double from = 0.0;
  double to = 0.0;
  int count = 2;
  bool log = false;
};

/// A place in the request that a parameter writes; it receives value^power * scale, each factor only if
/// given.
struct SweepTarget {
  std::string pointer;
  std::optional<double> scale;
  std::optional<double> power;
  nlohmann::json::json_pointer place;  ///< `pointer`, parsed

  /// Returns whether a number is computed from the parameter's value, which must then be a number.
  [[nodiscard]] bool computes() const { return scale || power; }
  /// Returns value^power * scale.
  [[nodiscard]] double number_for(double value) const {
    return (power ? std::pow(value, *power) : value) * scale.value_or(1.0);
  }
};

struct SweepParameter {
  std::string name;
  std::vector<SweepTarget> targets;
  std::vector<nlohmann::json> values;  ///< listed values; empty when the parameter has a range
  std::vector<std::string> labels;     ///< texts that replace the values in tables; empty: none
  std::optional<SweepRange> range;

  [[nodiscard]] std::uint64_t count() const {
    return range ? static_cast<std::uint64_t>(range->count) : values.size();
  }
};

struct SweepOutput {
  std::string pointer;
  std::vector<std::string> tokens;
};

enum class SweepDesign { grid, zip, latin_hypercube };

/// Which critical points are followed over the last parameter.
struct SweepFollow {
  std::optional<int> point;  ///< counted from 0 along the path of the first value; empty: the first of each
  bool locus = false;        ///< all curves of critical points, with their special points
};

struct SweepData {
  nlohmann::json base;  ///< object with model and analysis
  std::vector<SweepParameter> parameters;
  SweepDesign design = SweepDesign::grid;
  int samples = 1;  ///< number of points of a Latin hypercube
  int seed = 0;     ///< seed of a Latin hypercube
  std::vector<SweepOutput> outputs;
  bool follow = false;          ///< critical points are followed over the last parameter
  SweepFollow followed;         ///< which ones, where `follow` is set
  std::uint64_t unit_size = 1;  ///< number of points computed together
  std::uint64_t points = 0;
};

/// Returns the unescaped tokens of a JSON Pointer (RFC 6901); nullopt for invalid syntax.
[[nodiscard]] std::optional<std::vector<std::string>> pointer_tokens(std::string_view pointer);

/// Returns the index that a token denotes (no sign, no leading zero); nullopt for another token.
[[nodiscard]] std::optional<std::size_t> array_index(std::string_view token);

/// @brief Returns the request document with values of the parameters.
[[nodiscard]] nlohmann::json document_with(const SweepData& data, const std::vector<nlohmann::json>& values);

/// @brief Returns the values of a point of the design, one for each parameter.
/// @pre point < data.points
[[nodiscard]] std::vector<nlohmann::json> design_values(const SweepData& data, std::uint64_t point);

/// @brief Returns the values of a point as a table shows them: labels replace values.
[[nodiscard]] std::vector<nlohmann::json> design_labels(const SweepData& data, std::uint64_t point);

}  // namespace snapthrough::api
