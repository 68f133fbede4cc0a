#pragma once
/// @file
/// Tolerance of a chart, relative to its values.

#include <algorithm>
#include <cmath>

namespace snapthrough {

/// Says whether two values of a chart are near. Values below a hundredth of the largest one that is known
/// count as that hundredth, so that a chart may pass through zero.
class ChartTolerance {
 public:
  explicit ChartTolerance(double within) : within_(within) {}

  void include(double value) { largest_ = std::max(largest_, std::abs(value)); }
  /// @param part of the tolerance that is allowed
  [[nodiscard]] bool is_near(double a, double b, double part) const {
    constexpr double kSmall = 0.01;
    const double scale = std::max({std::abs(a), std::abs(b), kSmall * largest_});
    return std::abs(a - b) <= part * within_ * scale;
  }

 private:
  double within_;
  double largest_ = 0.0;
};

}  // namespace snapthrough
