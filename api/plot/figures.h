#pragma once
/// @file
/// One function for each kind of figure. `size` is the figure's size in pixels without margin and heading.

#include "api/plot/document.h"
#include "api/plot/looks.h"
#include "api/plot/model.h"
#include "api/plot/plot_request.h"

namespace snapthrough::api::plot {

/// Input of the figures of results.
struct ResultInput {
  Field result;
  std::optional<Model> model;  ///< model of the solved request; nullopt: not given
  Units units;
};

/// Draws load factor over a monitor or the arc length: stable pieces solid, unstable ones dashed, with
/// critical points (load factor, type) and contact events.
[[nodiscard]] Figure path_figure(const ResultInput& input, const PlotRequest& request, Size size);

/// Draws a state: undeformed and deformed axes, contact, reactions; supports, springs, ground, loads and
/// monitors when the model is given.
[[nodiscard]] Figure shape_figure(const ResultInput& input, const PlotRequest& request, Size size);

/// Draws N, Q and M over the undeformed arc length, one member after another; positive values point up.
[[nodiscard]] Figure sections_figure(const ResultInput& input, const PlotRequest& request, Size size);

/// Draws a mode on the undeformed structure, or its displacements over arc length when the axes are unknown.
[[nodiscard]] Figure mode_figure(const ResultInput& input, const PlotRequest& request, Size size);

/// Draws the undeformed structure with supports, springs, ground, loads and monitors. @pre input.model
[[nodiscard]] Figure model_figure(const ResultInput& input, const PlotRequest& request, Size size);

/// Draws the reaction of a spring or foundation over its displacement, by its law.
/// @param model the model that has the spring or foundation; it need not be valid otherwise
[[nodiscard]] Figure law_figure(const Field& model, const PlotRequest& request, Size size);

/// Draws the laws of all supports, those of foundations by depth or place, in a diagram for each direction.
/// @param model as of law_figure(), with its nodes and members
[[nodiscard]] Figure laws_figure(const Field& model, const PlotRequest& request, Size size);

/// @brief Draws circular frequencies over the load factor, each motion a line. A motion that diverges is
/// below zero; the lines of a pair that flutters lie on one another, at the frequency of its growing
/// vibration.
[[nodiscard]] Figure frequencies_figure(const ResultInput& input, Size size);

/// Draws the stiffness ratio along the primary path over the load factor, up to the first loss of stability,
/// with the softest point and the critical points of that part of the path.
[[nodiscard]] Figure stiffness_figure(const ResultInput& input, Size size);

/// Draws an output over one parameter; crosses on the axis mark failed points.
[[nodiscard]] Figure sweep_figure(const Field& document, const PlotRequest& request, Size size);

/// Draws an output over two parameters as colour bands between round values; failed cells are hatched.
[[nodiscard]] Figure heatmap_figure(const Field& document, const PlotRequest& request, Size size);

/// Returns whether a table varies exactly two parameters, each with more than six values.
[[nodiscard]] bool is_for_heatmap(const Field& document);

}  // namespace snapthrough::api::plot
