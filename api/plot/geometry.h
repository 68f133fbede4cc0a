#pragma once
/// @file
/// Plane geometry of members: axes of a request (docs/requests.md), interpolation over undeformed arc length,
/// normals. Model axes: x to the right, y up, angles counter-clockwise.

#include <utility>
#include <vector>

#include "api/plot/document.h"

namespace snapthrough::api::plot {

struct Point {
  double x = 0;
  double y = 0;
};

/// A polyline with the undeformed arc length s of each point; lists of equal length, s increasing.
struct Axis {
  std::vector<double> s, x, y;
};

/// Interpolates values linearly over the increasing list s; outside the list, returns the end value.
/// @pre both lists have the same length, which is not zero
[[nodiscard]] double interpolate(const std::vector<double>& s, const std::vector<double>& values,
                                 double where);

/// Returns the unit left normal at each point of a polyline: the tangent turned by +90 degrees.
[[nodiscard]] std::vector<Point> left_normals(const std::vector<double>& x, const std::vector<double>& y);

/// @brief Returns a member's axis from its end nodes and its `curve` in a request, without imperfections.
/// @param curve nullopt: a straight line
/// @throws PlotError when the curve is invalid or has no length
[[nodiscard]] Axis member_axis(const Field& member, const std::optional<Field>& curve, Point start,
                               Point end);

}  // namespace snapthrough::api::plot
