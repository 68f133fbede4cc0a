#pragma once
/// @file
/// The looks of figures as a style sheet, and the file around a figure.

#include <string>
#include <vector>

#include "api/plot/shape.h"

namespace snapthrough::api::plot {

/// What a figure shows: its shapes within a size, and the words for those who do not see it.
struct Figure {
  std::vector<Shape> shapes;
  std::string title;        ///< one sentence: what is plotted
  std::string description;  ///< its numbers: critical points, extremes, ranges
  double height = 0;        ///< that it takes, where it needs less than it has; 0: all
};

/// The size that is left for a figure in a file of a size with a heading.
[[nodiscard]] Size content_size(Size file, const std::string& heading);

/// A file of its own on paper: the heading above the figure, which is made for content_size().
[[nodiscard]] std::string file_of(Figure figure, Size file, const std::string& heading, bool dark);

}  // namespace snapthrough::api::plot
