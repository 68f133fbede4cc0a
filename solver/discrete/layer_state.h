#pragma once
/// @file
/// Contact of one-sided foundations with a shear layer in a state, for results.

#include <Eigen/Core>
#include <array>
#include <vector>

#include "solver/discrete/structure.h"
#include "solver/element/shear_layer.h"

namespace snapthrough {

/// Contact of one foundation; cells, parts and elements are in the order of its parts in the structure.
struct LayerState {
  std::vector<LayerCell> cells;
  LayerParts parts;
  std::vector<LayerEdge> edges;
  std::vector<int> elements;

  /// Parts of an element in contact; empty where the foundation is not.
  [[nodiscard]] std::vector<ElementPart> on_element(int element) const;
};

/// @param depth penetration that does not count yet, scaled
/// @pre the foundation is one-sided and has a shear layer
[[nodiscard]] LayerState layer_state(const Structure& structure, const Eigen::VectorXd& y, int foundation,
                                     double depth = 0.0);

/// States of all foundations, in the order of the model; without cells where a foundation has no such layer.
[[nodiscard]] std::vector<LayerState> layer_states(const Structure& structure, const Eigen::VectorXd& y);

}  // namespace snapthrough
