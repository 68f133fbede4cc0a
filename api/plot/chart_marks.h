#pragma once
/// @file
/// Marks of the points of a path on charts, with their labels.

#include <string>
#include <vector>

#include "api/plot/axes.h"
#include "api/plot/labels.h"
#include "api/plot/marks.h"
#include "api/plot/result.h"

namespace snapthrough::api::plot {

/// A mark with its place in pixels and the pieces of its label.
struct PlacedMark {
  Mark mark;
  Pixel at;
  std::vector<Run> runs;
};

/// Returns the mark of a critical point; its label has the load factor and the type.
[[nodiscard]] PlacedMark placed_mark(const CriticalPoint& point, Pixel at);
/// Returns the mark of the softest point; its label has the load factor and the stiffness ratio.
[[nodiscard]] PlacedMark placed_mark(const Softest& softest, Pixel at);
/// Returns the mark of first yield; its label has the load factor.
[[nodiscard]] PlacedMark placed_mark(const FirstYield& yield, Pixel at);

/// Draws marks, then the labels that find room; the first label is drawn even over lines.
void draw_marks(const std::vector<PlacedMark>& marks, Occupancy& taken, std::vector<Shape>& shapes);

/// Keeps labels off axis numbers and legend.
void keep_margins(const Frame& frame, Size size, Occupancy& taken);

/// @brief Returns a sentence for each of the first 50 critical points, with type and load factor, and one for
/// the number of the others; each sentence begins with a space.
[[nodiscard]] std::string points_text(const std::vector<CriticalPoint>& points);

}  // namespace snapthrough::api::plot
