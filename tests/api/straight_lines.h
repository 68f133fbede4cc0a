#pragma once
/// @file
/// Straight lines through pairs of numbers in JSON, for tests of laws by depth.

#include <algorithm>
#include <cstddef>
#include <nlohmann/json.hpp>

namespace snapthrough::testing {

/// Value of pairs [abscissa, value] by straight lines, constant beyond the first and the last pair.
inline double interpolated(const nlohmann::json& pairs, double at) {
  for (std::size_t i = 1; i < pairs.size(); ++i) {
    const double a = pairs[i - 1][0], b = pairs[i][0];
    if (at <= b) {
      const double t = std::clamp((at - a) / (b - a), 0.0, 1.0);
      return (1.0 - t) * pairs[i - 1][1].get<double>() + t * pairs[i][1].get<double>();
    }
  }
  return pairs.back()[1];
}

}  // namespace snapthrough::testing
