#pragma once
/// @file
/// Koiter's coefficients of bifurcations.

#include <optional>

#include "solver/discrete/structure.h"
#include "solver/model/model.h"
#include "solver/result.h"
#include "solver/sensitivity/exact_point.h"

namespace snapthrough {

/// @brief The load along the path that crosses at a bifurcation, by the amplitude of its mode as results have
/// it.
/// @param structure of the model, where the point is from
/// @param points of a member at which the mode is scaled
/// @param factorisations those that were made are added
/// @return empty at other points, where several motions lose their stiffness, where contact or follower
/// pressure on a free end makes the tangent jump or unsymmetric, and where the point is not found again
[[nodiscard]] std::optional<KoiterCoefficients> koiter_coefficients(const Model& model,
                                                                    const Structure& structure,
                                                                    const LocatedPoint& at, int points,
                                                                    int& factorisations);

}  // namespace snapthrough
