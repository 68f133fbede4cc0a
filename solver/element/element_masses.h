#pragma once
/// @file
/// Masses on the elements of a mesh.

#include <array>
#include <vector>

#include "solver/numeric/max_order.h"

namespace snapthrough {

/// Mass at a place of an element, scaled. The place is displaced by u_a + h sum_r integrals_r u'_r.
struct MassPlace {
  std::array<double, kMaxOrder> integrals{};
  double mass = 0.0;
  double rotary = 0.0;  ///< moment of inertia, about the place
};

/// @brief Places with mass, element by element: quadrature points of masses along members, and point masses.
///
/// The kinetic energy of the rates (u, v, b) of all displacements is the sum of 1/2 mass (u^2 + v^2) + 1/2
/// rotary b^2. It does not depend on the state, because the displacements are components in fixed axes.
struct ElementMasses {
  std::vector<MassPlace> places;
  std::vector<int> first;  ///< index of the first place of each element; one entry more than elements
};

}  // namespace snapthrough
