#pragma once
/// @file
/// Contour lines on a grid by marching squares.

#include <utility>
#include <vector>

#include "api/plot/shape.h"

namespace snapthrough::api::plot {

/// value(i, j) = values[j * x.size() + i] at (x[i], y[j]) in pixels; a cell with a corner that is not finite
/// has no lines.
struct Grid {
  std::vector<double> x, y, values;
};

using Segment = std::pair<Pixel, Pixel>;

/// All pieces of the contour lines of increasing levels, one list a level.
[[nodiscard]] std::vector<std::vector<Segment>> contours(const Grid& grid, const std::vector<double>& levels);

}  // namespace snapthrough::api::plot
