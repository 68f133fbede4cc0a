#pragma once
/// @file
/// The elastic foundation on one element, as springs at quadrature points: what the elements get, and what
/// the foundation's resultant is summed over.

#include <array>
#include <vector>

#include "solver/discrete/structure.h"
#include "solver/support/law.h"

namespace snapthrough {

/// @brief Functional that reads row . (x, y, rotation) at a place of an element, with no spring on it.
/// @param xi in [0, 1] of the element
[[nodiscard]] SupportSpring support_at(const Structure& structure, int element, double xi,
                                       std::array<double, 3> row);

/// The perfect axis at a place of an element, in the model's units.
[[nodiscard]] AxisPoint axis_point(const Structure& structure, int element, double xi);

/// @brief The foundation's Winkler springs on part of an element: Gauss points, or Lobatto's where the mesh
/// lumps it.
///
/// A one-sided foundation under the consistent rule acts on its contact intervals: see contact_springs().
/// @param range of the element
[[nodiscard]] std::vector<SupportSpring> winkler_springs(const Structure& structure,
                                                         const FoundationLaw& foundation, int element,
                                                         std::array<double, 2> range);

/// @brief Gauss points of an interval on which a one-sided foundation touches, acting there, with the
/// foundation's gap.
[[nodiscard]] std::vector<SupportSpring> contact_springs(const Structure& structure,
                                                         const FoundationLaw& foundation, int element,
                                                         FoundationContact::Interval interval);

/// @brief The shear layer's energy 1/2 G (dw/ds)^2 at Gauss points of part of an element.
///
/// w' = u'.n - kappa u.t along the initial normal n. The layer ends where the range ends, with a free edge:
/// no force from ground beyond.
[[nodiscard]] std::vector<SupportSpring> shear_layer_springs(const Structure& structure,
                                                             const FoundationLaw& foundation, int element,
                                                             std::array<double, 2> range);

}  // namespace snapthrough
