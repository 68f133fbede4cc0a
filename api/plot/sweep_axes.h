#pragma once
/// @file
/// Axes and marks of failed points for the two figures of sweeps.

#include <string>

#include "api/plot/axes.h"
#include "api/plot/plot_request.h"
#include "api/plot/table.h"

namespace snapthrough::api::plot {

/// Returns the scale of a column: texts at equal distances, numbers linear or logarithmic.
/// @param tight true: the axis ends at the extreme values; false: it has margins and is linear
[[nodiscard]] Scale axis_of(const Column& column, double start, double end, bool tight);

/// Parameters of the horizontal axis (x) and of the curves or the vertical axis (by; null if only x varies).
struct ChosenParameters {
  const Column* x;
  const Column* by;
};
/// Returns the parameters of the request; the varied parameters with most values replace those not requested.
[[nodiscard]] ChosenParameters default_parameters(const Table& table, const PlotRequest& request);

/// Returns the `d` attribute of a diagonal cross; `half` is half its width in pixels.
[[nodiscard]] std::string cross(Pixel at, double half);
/// Draws the text about failed points at the top of a figure.
[[nodiscard]] Shape failure_note(const std::string& text, Size size);

}  // namespace snapthrough::api::plot
