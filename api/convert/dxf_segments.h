#pragma once
/// @file
/// Lines and arcs of a drawing.

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "api/convert/dxf_groups.h"

namespace snapthrough::api::convert {

/// A line, or an arc from its start to its end.
struct Segment {
  std::size_t line = 0;  ///< line of the file at which its entity, or its vertex, begins
  std::string_view layer;
  std::array<double, 2> start{}, end{};
  double sweep_degrees = 0.0;  ///< angle by which an arc turns to the left; 0: a line
  double elevation = 0.0;      ///< largest |z|
  double extent = 0.0;         ///< largest number that the coordinates of its ends were computed from
};

/// @brief Returns the segments of the entities in model space on the given layers, in the order of the file.
///
/// LINE, ARC, LWPOLYLINE and POLYLINE with its vertices give segments; a finding at its line reports any
/// other entity, a closed curve, and an entity that is not parallel to the plane z = 0.
/// @param layers names of layers; empty: all
[[nodiscard]] std::vector<Segment> read_segments(std::span<const Entity> entities,
                                                 std::span<const std::string> layers,
                                                 std::vector<Finding>& findings);

}  // namespace snapthrough::api::convert
