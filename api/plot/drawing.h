#pragma once
/// @file
/// The parts of a drawing of a structure, in its view. Each takes the room that labels keep away from.

#include <vector>

#include "api/plot/labels.h"
#include "api/plot/scene.h"

namespace snapthrough::api::plot {

/// Shapes of the structure, and the labels that take their places after everything is drawn.
struct Part {
  std::vector<Shape> shapes;
  std::vector<LabelRequest> labels;  ///< the first is the most important
};

/// Ground of all foundations of the model, hatched, as far away as its gap.
[[nodiscard]] Shape ground_shape(const Scene& scene, const View& view, Size size);

/// Reactions from the deformed axis into the medium where it presses, the largest 0.85 of the ground's depth.
[[nodiscard]] Part reaction_part(const Scene& scene, const View& view, Occupancy& taken);
/// Pieces of members that touch a one-sided foundation.
[[nodiscard]] std::vector<Shape> contact_shapes(const Scene& scene, const View& view);

/// Symbols of supports: triangle: held along both axes; on rollers: held across them; bar: held against
/// rotation too; two bars with rollers: held across them and against rotation; square: against rotation only.
[[nodiscard]] std::vector<Shape> support_shapes(const Scene& scene, const View& view, Occupancy& taken);
/// Springs from the structure into the medium, with their gaps; spirals for rotations.
[[nodiscard]] std::vector<Shape> spring_shapes(const Scene& scene, const View& view, Occupancy& taken);
/// Hinges at released ends.
[[nodiscard]] std::vector<Shape> hinge_shapes(const Scene& scene, const View& view);

/// Loads as arrows with their heads on the structure: what acts at the scene's load factor.
[[nodiscard]] Part load_part(const Scene& scene, const View& view, Occupancy& taken);
/// Arrows of the forces of supports, where no model tells their symbols.
[[nodiscard]] Part support_force_part(const Scene& scene, const View& view, Occupancy& taken);

/// Monitors with their values in the state.
[[nodiscard]] Part monitor_part(const Scene& scene, const View& view, Occupancy& taken);
/// Overall width below and height on the left, of the undeformed structure.
[[nodiscard]] Shape dimension_shape(const Scene& scene, const View& view, Size size, Occupancy& taken);

/// Labels that find a place.
[[nodiscard]] std::vector<Shape> placed(const std::vector<LabelRequest>& labels, Occupancy& taken);

/// @brief The whole drawing: ground, undeformed and deformed axes, reactions, contact, symbols, labels; the
/// mirror image of a half structure.
/// @param over drawn over the members, such as a mode; mirrored with them
[[nodiscard]] std::vector<Shape> draw_structure(const Scene& scene, const View& view, Size size,
                                                const std::string& caption, std::vector<Shape> over,
                                                Occupancy& taken);

}  // namespace snapthrough::api::plot
