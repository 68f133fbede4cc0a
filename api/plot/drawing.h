#pragma once
/// @file
/// Parts of the drawing of a structure. Each function adds its area to `taken`, where no label may stand.

#include <vector>

#include "api/plot/labels.h"
#include "api/plot/scene.h"

namespace snapthrough::api::plot {

/// Shapes of one part of the drawing, and labels that are placed after all shapes are drawn.
struct Part {
  std::vector<Shape> shapes;
  std::vector<LabelRequest> labels;  ///< most important label first
};

/// Draws hatched ground below each foundation of the model, at the distance of the foundation's gap.
[[nodiscard]] Shape ground_shape(const Scene& scene, const View& view, Size size);

/// Draws foundation reactions as areas from the deformed axis; the largest is 0.85 of the ground's depth.
[[nodiscard]] Part reaction_part(const Scene& scene, const View& view, Occupancy& taken);
/// Draws the deformed axis again where a member touches a one-sided foundation.
[[nodiscard]] std::vector<Shape> contact_shapes(const Scene& scene, const View& view);

/// Draws support symbols. Triangle: x and y fixed; with rollers: one direction fixed. Bar: x, y and rotation
/// fixed; two bars with rollers: one direction and rotation fixed. Square: only rotation fixed.
[[nodiscard]] std::vector<Shape> support_shapes(const Scene& scene, const View& view, Occupancy& taken);
/// Draws springs from the structure into the medium with their gaps, and rotational springs as spirals.
[[nodiscard]] std::vector<Shape> spring_shapes(const Scene& scene, const View& view, Occupancy& taken);
/// Draws hinges at member ends with a release.
[[nodiscard]] std::vector<Shape> hinge_shapes(const Scene& scene, const View& view);

/// Draws loads as arrows with their heads on the structure; labels give the loads at the scene's load factor.
[[nodiscard]] Part load_part(const Scene& scene, const View& view, Occupancy& taken);
/// Draws support forces as arrows, for a result without its model (whose supports are unknown).
[[nodiscard]] Part support_force_part(const Scene& scene, const View& view, Occupancy& taken);

/// Draws monitors, labelled with their displacements in the state.
[[nodiscard]] Part monitor_part(const Scene& scene, const View& view, Occupancy& taken);
/// Draws dimension lines of the undeformed structure: width below it, height to the left of it.
[[nodiscard]] Shape dimension_shape(const Scene& scene, const View& view, Size size, Occupancy& taken);

/// Returns the labels that find room; the others are left out.
[[nodiscard]] std::vector<Shape> placed(const std::vector<LabelRequest>& labels, Occupancy& taken);

/// @brief Draws the whole structure: ground, undeformed and deformed axes, reactions, contact, symbols,
/// labels; the mirror image when the model is one half of a symmetric structure.
/// @param over shapes drawn over the members, such as a mode; the mirror image repeats them
[[nodiscard]] std::vector<Shape> draw_structure(const Scene& scene, const View& view, Size size,
                                                const std::string& caption, std::vector<Shape> over,
                                                Occupancy& taken);

}  // namespace snapthrough::api::plot
