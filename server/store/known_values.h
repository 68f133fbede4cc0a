#pragma once
/// @file
/// Series of which some values are not known, as the stores keep them.

#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <vector>

namespace snapthrough::server {

/// The values, NaN for those that are not known.
[[nodiscard]] inline std::vector<double> with_nan(std::span<const std::optional<double>> values) {
  std::vector<double> out;
  out.reserve(values.size());
  for (const std::optional<double>& value : values)
    out.push_back(value.value_or(std::numeric_limits<double>::quiet_NaN()));
  return out;
}

/// The reverse of with_nan(). @param count values of the series; a series that was not stored has none known
[[nodiscard]] inline std::vector<std::optional<double>> without_nan(std::span<const double> values,
                                                                    std::size_t count) {
  std::vector<std::optional<double>> out(count);
  for (std::size_t i = 0; i < count && i < values.size(); ++i)
    if (!std::isnan(values[i])) out[i] = values[i];
  return out;
}

}  // namespace snapthrough::server
