#pragma once
/// @file
/// Koiter coefficients of bifurcations.

#include <optional>

#include "solver/discrete/structure.h"
#include "solver/resolve/resolved_model.h"
#include "solver/result.h"
#include "solver/sensitivity/exact_point.h"

namespace snapthrough {

/// @brief Load along the path that crosses at a bifurcation, as a function of the mode's reported amplitude.
/// @param structure structure on which the point was found
/// @param points points per member at which the mode is normalised
/// @param factorisations incremented by the number of factorisations
/// @return empty at other points, at multiple bifurcations, where contact makes the tangent discontinuous,
/// with follower pressure on a free end (nonsymmetric tangent), and when the point cannot be solved to
/// rounding
[[nodiscard]] std::optional<KoiterCoefficients> koiter_coefficients(const Structure& structure,
                                                                    const LocatedPoint& at, int points,
                                                                    int& factorisations);

}  // namespace snapthrough
