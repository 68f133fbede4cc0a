#pragma once
/// @file
/// Scales, round ticks, grid and axis labels that all charts share; thinning of lines by what can be seen.

#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "api/plot/shape.h"

namespace snapthrough::api::plot {

/// A scale from values to pixels; `log` maps the logarithm, of values above zero.
struct Scale {
  double from = 0;
  double to = 1;
  double start = 0;
  double end = 1;
  bool log = false;
};

/// The pixel of a value.
[[nodiscard]] double place(const Scale& scale, double value);
/// The step of 1, 2 or 5 times a power of ten that cuts a length into about so many parts.
[[nodiscard]] double round_step(double length, double parts);
/// Round values of a scale, about one every `spacing` pixels.
[[nodiscard]] std::vector<double> ticks(const Scale& scale, double spacing);
/// k * step without the rounding that the product has.
[[nodiscard]] double multiple(double k, double step);

/// Least and largest of values; what is not finite is left out. Empty (low > high) without values.
struct Range {
  double low;
  double high;
  Range();
  Range(double least, double largest) : low(least), high(largest) {}
  void include(double value);
  [[nodiscard]] bool empty() const { return !(low <= high); }
};

/// A range with room at both ends, that is never empty and holds zero where it is near.
[[nodiscard]] Range widened(const Range& range);

/// The frame of a chart: grid lines, numbers, axis labels.
struct Frame {
  Scale x;
  Scale y;
  std::string x_label;
  std::string y_label;
  /// Names at 0, 1, 2, ..., where an axis has names and not numbers.
  std::optional<std::vector<std::string>> x_names;
  std::optional<std::vector<std::string>> y_names;
  /// Values to write at, where there are few that mean something.
  std::optional<std::vector<double>> x_values;
  std::optional<std::vector<double>> y_values;
};

/// The pixel of a point.
[[nodiscard]] Pixel place(const Frame& frame, double x, double y);
/// Grid, zero lines and numbers; every value is finite.
[[nodiscard]] Shape frame_shape(const Frame& frame, Size size);
/// Room at the left of a plot for the numbers of its vertical axis and its label.
[[nodiscard]] double room_for_numbers(const Frame& frame);

/// @brief Indices of the points of a line to draw: the first, the last, and those without which the line
/// would be off by more than the tolerance in pixels.
///
/// The sector algorithm of Williams (Cartography 15, 1978), with a stop where the line turns back. O(n).
[[nodiscard]] std::vector<std::size_t> thinned(std::span<const Pixel> points, double tolerance = 0.25);
/// The points that thinned() keeps.
[[nodiscard]] std::vector<Pixel> thinned_points(std::span<const Pixel> points, double tolerance = 0.25);

}  // namespace snapthrough::api::plot
