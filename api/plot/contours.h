#pragma once
/// @file
/// Contour lines of values on a rectangular grid, by marching squares.

#include <utility>
#include <vector>

#include "api/plot/shape.h"

namespace snapthrough::api::plot {

/// Grid points (x[i], y[j]) in pixels with values[j * x.size() + i]; cells with a corner value that is not
/// finite have no contour.
struct Grid {
  std::vector<double> x, y, values;
};

using Segment = std::pair<Pixel, Pixel>;

/// Returns the segments of the contour lines, one list for each level. @pre `levels` increase
[[nodiscard]] std::vector<std::vector<Segment>> contours(const Grid& grid, const std::vector<double>& levels);

}  // namespace snapthrough::api::plot
