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

#include "api/point_outcome.h"

namespace snapthrough::api {

/// `count` numbers from `from` to `to` inclusive, with constant differences, or constant ratios if `log`. A
/// Latin hypercube uses the interval without `count`.
struct SweepRange {
  double from = 0.0;
  double to = 0.0;
  int count = 2;  ///< in a refined range: all places that a row can have
  bool log = false;
  int first_parts = 0;  ///< equal parts that a refined range begins with; 0: the range is not refined
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

/// Columns of a refined sweep after its outputs.
inline constexpr std::string_view kPieceColumn = "piece";
inline constexpr std::string_view kChangeColumn = "change";

/// Points are added over the last one or two parameters until straight lines between rows are near enough.
struct SweepRefine {
  std::string output;  ///< pointer of the output that decides
  double within = 0.01;
  int parameters = 1;
  int most = 0;            ///< largest number of points of a curve or surface
  std::size_t number = 0;  ///< index of the output among those of the sweep
};

struct SweepData {
  nlohmann::json base;  ///< object with model and analysis
  std::vector<SweepParameter> parameters;
  SweepDesign design = SweepDesign::grid;
  int samples = 1;  ///< number of points of a Latin hypercube
  int seed = 0;     ///< seed of a Latin hypercube
  std::vector<SweepOutput> outputs;
  bool follow = false;   ///< critical points are followed over the last parameter
  SweepFollow followed;  ///< which ones, where `follow` is set
  std::optional<SweepRefine> refine;
  std::uint64_t item_size = 1;  ///< number of points computed together
  std::uint64_t points = 0;     ///< points that are computed; with `refine`, the number of curves or surfaces
};

/// @brief Returns the number of points that a request can be built for: with `refine`, all places of each
/// curve or surface. @pre the design is a grid, or there is no `refine`
[[nodiscard]] std::uint64_t places_of_item(const SweepData& data);

/// A row of a table.
struct SweepRow {
  std::uint64_t point = 0;             ///< number of the point, less than Sweep::places()
  std::vector<nlohmann::json> labels;  ///< parameters' values as a table shows them; null: of no single value
  PointOutcome outcome;                ///< with Sweep::output_count() outputs, or failed
  std::vector<nlohmann::json> own;     ///< values of Sweep::own_columns()
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
