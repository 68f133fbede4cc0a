#pragma once
/// @file
/// The figures of each kind. `size` is that of the figure, without the margin and heading of the file.

#include "api/plot/document.h"
#include "api/plot/looks.h"
#include "api/plot/model.h"
#include "api/plot/plot.h"

namespace snapthrough::api::plot {

/// What the figures of results are made of.
struct ResultInput {
  Field result;
  std::optional<Model> model;  ///< of the request that was solved, where it is known
  Units units;
};

/// Stable pieces solid, unstable ones dashed, changing at the critical point between rows; critical points
/// with load factor and type, contact events.
[[nodiscard]] Figure path_figure(const ResultInput& input, const PlotRequest& request, Size size);

/// A state: undeformed and deformed axes, contact, reactions; supports, springs, ground, loads, monitors
/// where the model is known.
[[nodiscard]] Figure shape_figure(const ResultInput& input, const PlotRequest& request, Size size);

/// N, Q and M over the undeformed arc length, one member after another; positive values upwards.
[[nodiscard]] Figure sections_figure(const ResultInput& input, const PlotRequest& request, Size size);

/// A mode on the undeformed structure; where its axes are not known, displacements along the members.
[[nodiscard]] Figure mode_figure(const ResultInput& input, const PlotRequest& request, Size size);

/// An output over one parameter; failed points are crosses on the axis.
[[nodiscard]] Figure sweep_figure(const Field& document, const PlotRequest& request, Size size);

/// An output over two parameters in bands between round values; cells that failed are hatched.
[[nodiscard]] Figure heatmap_figure(const Field& document, const PlotRequest& request, Size size);

/// Whether a sweep's table is better seen as a map; see default_plot_kind().
[[nodiscard]] bool is_for_heatmap(const Field& document);

}  // namespace snapthrough::api::plot
