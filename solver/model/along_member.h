#pragma once
/// @file
/// Numbers that vary along a member.

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

namespace snapthrough {

/// Number of a member: constant, or piecewise linear in the fraction of the undeformed length and constant
/// before the first and beyond the last point.
struct AlongMember {
  double constant = 0.0;                      ///< used without points
  std::vector<std::array<double, 2>> points;  ///< (fraction, value); fractions ascend

  [[nodiscard]] bool varies() const { return !points.empty(); }
  [[nodiscard]] double at(double fraction) const {
    if (points.empty()) return constant;
    if (fraction <= points.front()[0]) return points.front()[1];
    for (std::size_t i = 1; i < points.size(); ++i) {
      const auto& [from, a] = points[i - 1];
      const auto& [to, b] = points[i];
      if (fraction <= to) return a + (b - a) * (fraction - from) / (to - from);
    }
    return points.back()[1];
  }
  [[nodiscard]] double largest() const {
    double out = points.empty() ? constant : points.front()[1];
    for (const auto& point : points) out = std::max(out, point[1]);
    return out;
  }
  bool operator==(const AlongMember&) const = default;
};

}  // namespace snapthrough
