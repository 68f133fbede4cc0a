#pragma once
/// @file
/// Tangent stiffness of places of a structure.

#include <Eigen/Core>
#include <vector>

#include "solver/discrete/structure.h"
#include "solver/model/model.h"
#include "solver/result.h"

namespace snapthrough {

/// @brief Tangent stiffness of places of an equilibrium: forces (x, y) and moment by displacements (x, y) and
/// rotation of the place. Costs one factorisation and three solutions for each place.
///
/// It is the inverse of the displacements under unit forces. A component that the structure holds there is
/// rigid, and one that nothing resists has no stiffness: the matrix is then not given.
/// @param y, lambda scaled unknowns and load factor; the result is in the model's units
/// @pre the places exist, and are not on one-sided members
[[nodiscard]] std::vector<PlaceStiffness> place_stiffnesses(const Structure& structure,
                                                            const Eigen::VectorXd& y, double lambda,
                                                            const std::vector<Location>& places);

}  // namespace snapthrough
