#pragma once
/// @file
/// What the figures of sweeps share: axes of columns, failed points.

#include <string>

#include "api/plot/axes.h"
#include "api/plot/table.h"

namespace snapthrough::api::plot {

/// The axis of a column: names at equal distances, or numbers, with a logarithm where it fits them better.
/// @param tight the axis ends with the values; else there is room beyond them
[[nodiscard]] Scale axis_of(const Column& column, double start, double end, bool tight);

/// The two parameters that a figure shows by itself; `by` is null where only one varies.
struct ChosenParameters {
  const Column* x;
  const Column* by;
};
/// The parameter with most values on the horizontal axis, unless that is the one asked for as `by`.
[[nodiscard]] ChosenParameters default_parameters(const Table& table, const PlotRequest& request);

/// `d` of a cross.
[[nodiscard]] std::string cross(Pixel at, double half);
/// How many points failed, at the top of a figure.
[[nodiscard]] Shape failure_note(const std::string& text, Size size);

}  // namespace snapthrough::api::plot
