#pragma once
/// @file
/// Plane geometry of members: axes of a request (docs/requests.md), places by undeformed arc length, normals.
/// Model axes: x to the right, y up, angles counter-clockwise.

#include <utility>
#include <vector>

#include "api/plot/document.h"

namespace snapthrough::api::plot {

struct Point {
  double x = 0;
  double y = 0;
};

/// A line through points with the undeformed arc length of each; lists of equal length, s increasing.
struct Axis {
  std::vector<double> s, x, y;
};

/// Linear interpolation of values over an increasing list; beyond its ends the end values.
/// @pre both lists have the same length, which is not zero
[[nodiscard]] double interpolate(const std::vector<double>& s, const std::vector<double>& values,
                                 double where);

/// Unit left normals of a line through points: its tangent turned by +90 degrees.
[[nodiscard]] std::vector<Point> left_normals(const std::vector<double>& x, const std::vector<double>& y);

/// @brief The axis of a member from its nodes and its `curve` in a request; imperfections are left out.
/// @param curve absent: a straight line
/// @throws PlotError when the curve is wrong or has no length
[[nodiscard]] Axis member_axis(const Field& member, const std::optional<Field>& curve, Point start,
                               Point end);

}  // namespace snapthrough::api::plot
