#pragma once
/// @file
/// The elastic base on one element, as springs at quadrature points: what the elements get, and what the
/// base's resultant is summed over.

#include <array>
#include <vector>

#include "solver/discrete/structure.h"
#include "solver/support/law.h"

namespace snapthrough {

/// @brief Functional that reads row . (x, y, rotation) at a place of an element, with no spring on it.
/// @param xi in [0, 1] of the element
[[nodiscard]] Station station_at(const Structure& structure, int element, double xi,
                                 std::array<double, 3> row);

/// The perfect axis at a place of an element, in the model's units.
[[nodiscard]] AxisPoint axis_point(const Structure& structure, int element, double xi);

/// @brief The base's Winkler springs on part of an element: Gauss points, or Lobatto's where the mesh lumps
/// it.
///
/// A one-sided base under the consistent rule acts on its contact intervals: see contact_stations().
/// @param range of the element
[[nodiscard]] std::vector<Station> winkler_stations(const Structure& structure, const FoundationLaw& base,
                                                    int element, std::array<double, 2> range);

/// @brief Gauss points of an interval on which a one-sided base touches, acting there, with the base's gap.
[[nodiscard]] std::vector<Station> contact_stations(const Structure& structure, const FoundationLaw& base,
                                                    int element, ContactStrip::Interval interval);

/// @brief The shear layer's energy 1/2 G (dw/ds)^2 at Gauss points of part of an element.
///
/// w' = u'.n - kappa u.t along the initial normal n. The layer ends where the range ends, with a free edge:
/// no force from ground beyond.
[[nodiscard]] std::vector<Station> shear_layer_stations(const Structure& structure, const FoundationLaw& base,
                                                        int element, std::array<double, 2> range);

}  // namespace snapthrough
