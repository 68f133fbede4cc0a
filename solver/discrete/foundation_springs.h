#pragma once
/// @file
/// Elastic foundation on one element as springs at quadrature points, for assembly and for resultants.

#include <array>
#include <vector>

#include "solver/discrete/element_reader.h"
#include "solver/discrete/structure.h"
#include "solver/support/law.h"

namespace snapthrough {

/// @brief Functional row . (x, y, rotation) of the displacement at a place of an element, without stiffness.
/// @param xi in [0, 1] of the element
[[nodiscard]] SupportSpring support_at(const Structure& structure, int element, double xi,
                                       std::array<double, 3> row);

/// Point of the perfect axis at a place of an element, in the model's units.
[[nodiscard]] AxisPoint axis_point(const Structure& structure, int element, double xi);

/// Point of the perfect axis at a place of an element, scaled, with the fraction of its member.
[[nodiscard]] PlaceOnAxis place_on_axis(const Structure& structure, int element, double xi);

/// @brief Winkler springs of a foundation on part of an element: at Gauss points, or at Lobatto points where
/// the mesh lumps foundations.
///
/// Not for one-sided foundations under the consistent rule, which act on contact intervals: see
/// contact_springs().
/// @param range part of the element, in [0, 1]
[[nodiscard]] std::vector<SupportSpring> winkler_springs(const Structure& structure,
                                                         const FoundationLaw& foundation, int element,
                                                         std::array<double, 2> range);

/// @brief Springs at the Gauss points of an interval on which a one-sided foundation acts, with its gap; for
/// a surface those of its tangents under the displaced axis.
/// @param reader displacements of the element relative to the ground
[[nodiscard]] std::vector<SupportSpring> contact_springs(const Structure& structure,
                                                         const FoundationLaw& foundation,
                                                         const ElementReader& reader, int element,
                                                         FoundationContact::Interval interval);

/// @brief Springs with the energy 1/2 G (dw/ds)^2 of the shear layer, at Gauss points of part of an element:
/// those of contact for a one-sided foundation, which acts on the parts in contact.
///
/// w' = u'.n - kappa u.t along the initial normal n. The layer ends with the range, with a free edge (no
/// force from the ground beyond).
[[nodiscard]] std::vector<SupportSpring> shear_layer_springs(const Structure& structure,
                                                             const FoundationLaw& foundation, int element,
                                                             std::array<double, 2> range);

}  // namespace snapthrough
