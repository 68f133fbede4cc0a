#pragma once
/// @file
/// What a sweep document says, as read_sweep() understood it. Internal to api/.

#include <cmath>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace snapthrough::api {

/// `count` numbers from `from` to `to`, both among them, equally spaced or in equal ratios. A Latin hypercube
/// has no count: it draws from the interval.
struct SweepRange {
  double from = 0.0;
  double to = 0.0;
  int count = 2;
  bool log = false;
};

/// A place in the request that a parameter is written to, to the `power` and times `scale` where there are
/// such.
struct SweepTarget {
  std::string pointer;
  std::optional<double> scale;
  std::optional<double> power;
  nlohmann::json::json_pointer place;  ///< `pointer`, taken apart once

  /// Whether what is written is computed from the value, which is a number then.
  [[nodiscard]] bool computes() const { return scale || power; }
  /// value^power scale
  [[nodiscard]] double number_for(double value) const {
    return (power ? std::pow(value, *power) : value) * scale.value_or(1.0);
  }
};

struct SweepParameter {
  std::string name;
  std::vector<SweepTarget> targets;
  std::vector<nlohmann::json> values;  ///< when there is no range
  std::vector<std::string> labels;     ///< of the values, in tables; empty: the values stand there themselves
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

struct SweepData {
  nlohmann::json base;  ///< model and analysis
  std::vector<SweepParameter> parameters;
  SweepDesign design = SweepDesign::grid;
  int samples = 1;  ///< of a Latin hypercube
  int seed = 0;     ///< of a Latin hypercube
  std::vector<SweepOutput> outputs;
  bool follow = false;          ///< the critical point is followed along the last parameter
  std::uint64_t unit_size = 1;  ///< points that are computed together
  std::uint64_t points = 0;
};

/// The unescaped tokens of a JSON Pointer (RFC 6901), or nothing when it is not one.
[[nodiscard]] std::optional<std::vector<std::string>> pointer_tokens(std::string_view pointer);

/// The number that an array index is written as (no sign, no leading zero), or nothing.
[[nodiscard]] std::optional<std::size_t> array_index(std::string_view token);

/// @brief The request document with these values of the parameters.
[[nodiscard]] nlohmann::json document_with(const SweepData& data, const std::vector<nlohmann::json>& values);

/// @brief The values of a point of the design, one for each parameter.
/// @pre point < data.points
[[nodiscard]] std::vector<nlohmann::json> design_values(const SweepData& data, std::uint64_t point);

/// @brief The same as a table shows them: labels in place of values that have one.
[[nodiscard]] std::vector<nlohmann::json> design_labels(const SweepData& data, std::uint64_t point);

}  // namespace snapthrough::api
