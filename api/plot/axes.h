#pragma once
/// @file
/// Scales, ticks, grid lines and axis labels of all charts; removal of points that a line does not need.

#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "api/plot/shape.h"

namespace snapthrough::api::plot {

/// Linear or logarithmic map of the values [from, to] to the pixels [start, end]; `log` requires values > 0.
struct Scale {
  double from = 0;
  double to = 1;
  double start = 0;
  double end = 1;
  bool log = false;
};

/// Returns the pixel coordinate of a value.
[[nodiscard]] double place(const Scale& scale, double value);
/// Returns the step (1, 2 or 5 times a power of ten) that divides `length` into about `parts` intervals.
[[nodiscard]] double round_step(double length, double parts);
/// Returns round values within a scale, in increasing order, one about every `spacing` pixels.
[[nodiscard]] std::vector<double> ticks(const Scale& scale, double spacing);
/// Returns k * step, rounded to 12 significant digits so that 3 * 0.1 is written 0.3.
[[nodiscard]] double multiple(double k, double step);

/// Smallest and largest finite value of a set; without values low > high.
struct Range {
  double low;
  double high;
  Range();
  Range(double least, double largest) : low(least), high(largest) {}
  void include(double value);
  [[nodiscard]] bool empty() const { return !(low <= high); }
};

/// Adds 6 % at both ends of a range; an end near zero moves to zero, and an empty range becomes [0, 1].
[[nodiscard]] Range widened(const Range& range);

/// Axes of a chart: scales, labels and ticks.
struct Frame {
  Scale x;
  Scale y;
  std::string x_label;
  std::string y_label;
  /// Names of the positions 0, 1, 2, ... of an axis of texts; nullopt: the axis has numbers.
  std::optional<std::vector<std::string>> x_names;
  std::optional<std::vector<std::string>> y_names;
  /// Values at which ticks stand; nullopt: ticks() chooses round values.
  std::optional<std::vector<double>> x_values;
  std::optional<std::vector<double>> y_values;
  double y_name_room = 40;  ///< pixels; longer names of the y axis are cut
};

/// Returns the pixel of the point (x, y) in chart values.
[[nodiscard]] Pixel place(const Frame& frame, double x, double y);
/// Draws grid lines, zero lines, tick texts and axis labels. @pre the ends of both scales are finite
[[nodiscard]] Shape frame_shape(const Frame& frame, Size size);
/// Returns the width in pixels left of the plot area that the tick texts and label of the y axis need.
[[nodiscard]] double room_for_numbers(const Frame& frame);

/// @brief Returns the indices of the points that a polyline needs: first, last, and each one without which
/// the line moves by more than `tolerance` pixels.
///
/// Sector algorithm of Williams (Cartography 15, 1978); a point where the line turns back is kept. O(n).
[[nodiscard]] std::vector<std::size_t> thinned(std::span<const Pixel> points, double tolerance = 0.25);
/// Returns the points whose indices thinned() returns.
[[nodiscard]] std::vector<Pixel> thinned_points(std::span<const Pixel> points, double tolerance = 0.25);

}  // namespace snapthrough::api::plot
