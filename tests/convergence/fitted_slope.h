#pragma once
/// @file
/// Observed order of convergence.

#include <cmath>
#include <cstddef>
#include <vector>

namespace snapthrough::testing {

/// Least-squares slope of log |error| over log(1 / n): the observed order.
inline double fitted_order(const std::vector<int>& n, const std::vector<double>& error) {
  double sx = 0.0, sy = 0.0, sxx = 0.0, sxy = 0.0;
  for (std::size_t i = 0; i < n.size(); ++i) {
    const double x = std::log(static_cast<double>(n[i]));
    const double y = std::log(std::abs(error[i]));
    sx += x;
    sy += y;
    sxx += x * x;
    sxy += x * y;
  }
  const auto m = static_cast<double>(n.size());
  return -(m * sxy - sx * sy) / (m * sxx - sx * sx);
}

}  // namespace snapthrough::testing
