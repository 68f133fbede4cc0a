#pragma once
/// @file
/// The style sheet of figures, and the SVG file around a figure.

#include <string>
#include <vector>

#include "api/plot/shape.h"

namespace snapthrough::api::plot {

/// Shapes of a figure, and its description in words for screen readers.
struct Figure {
  std::vector<Shape> shapes;
  std::string title;        ///< one sentence: what the figure plots
  std::string description;  ///< main numbers: critical points, extremes, ranges
  double height = 0;        ///< height in pixels that the figure uses; 0: all of its size
  bool has_laws = false;    ///< whether laws by depth are drawn, whose looks others do not need
};

/// Returns the size in pixels that margins and heading leave for the figure in a file of the size `file`.
[[nodiscard]] Size content_size(Size file, const std::string& heading);

/// Returns the SVG file with heading and figure. @pre the figure was drawn for content_size()
[[nodiscard]] std::string file_of(Figure figure, Size file, const std::string& heading, bool dark);

}  // namespace snapthrough::api::plot
