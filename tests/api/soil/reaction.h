#pragma once
/// @file
/// Values of a soil reaction curve, for its tests.

#include <algorithm>
#include <cstddef>

#include "api/soil/curves.h"

namespace snapthrough::testing {

/// Accuracy of curves that are compared with formulas.
inline constexpr double kFine = api::soil::kLeastAccuracy;

/// Returns the force of a curve at a displacement.
inline double reaction_at(const api::soil::Curve& curve, double y) {
  for (std::size_t i = 1; i < curve.points.size(); ++i) {
    const auto& [y0, p0] = curve.points[i - 1];
    const auto& [y1, p1] = curve.points[i];
    if (y <= y1) {
      return p0 + (p1 - p0) * (y - y0) / (y1 - y0);
    }
  }
  return curve.points.back()[1];
}

/// Returns the largest force of a curve.
inline double peak_of(const api::soil::Curve& curve) {
  double found = 0.0;
  for (const auto& point : curve.points) {
    found = std::max(found, point[1]);
  }
  return found;
}

}  // namespace snapthrough::testing
