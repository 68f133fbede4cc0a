#pragma once
/// @file
/// Derivatives of critical loads with respect to numbers of the model.

#include <functional>
#include <vector>

#include "solver/discrete/structure.h"
#include "solver/model/analysis.h"
#include "solver/resolve/resolved_model.h"
#include "solver/result.h"
#include "solver/sensitivity/exact_point.h"

namespace snapthrough {

/// @brief d load factor / d value in the user's units for each variation, in order, or why it does not exist.
///
/// The point is solved to rounding once; then only the linear equations of CriticalSensitivity are solved.
/// The derivative of the equations is a difference between structures with larger and smaller value, which
/// share unknowns, elements, scales and state. The step starts at 2.5e-4 of the variation's size and is
/// shortened until halving it has no effect; two steps are extrapolated. Differences are one-sided if the
/// value may change in one sense only.
/// @param structure structure on which the point was found
/// @param offsets mode imperfections of a changed model; may throw std::runtime_error when it lacks the modes
/// @param factorisations incremented by the number of factorisations
[[nodiscard]] std::vector<Sensitivity> load_sensitivities(
    const std::vector<Variation>& variations, const Structure& structure, const LocatedPoint& at,
    const std::function<ModeOffsets(const ResolvedModel&)>& offsets, int& factorisations);

}  // namespace snapthrough
