#pragma once
/// @file
/// Derivatives of critical loads by numbers of the model.

#include <functional>
#include <vector>

#include "solver/discrete/structure.h"
#include "solver/model/analysis.h"
#include "solver/model/model.h"
#include "solver/result.h"
#include "solver/sensitivity/exact_point.h"

namespace snapthrough {

/// @brief d load factor / d value, both in the user's units, for each variation, in order; or why there is
/// none.
///
/// The point is found again to rounding, then nothing is solved but CriticalSensitivity's linear equations:
/// the change of the equations is a difference between structures with more and less of the value, which have
/// the unknowns, elements and scales of this one, at the point's state. Their step is a thousandth of the
/// variation's size, and ever shorter until halving it changes nothing; of two steps the error is
/// extrapolated away. Where the value may change one way only, so do the differences.
/// @param structure of `model`, where the point is from
/// @param offsets of a changed model's mode imperfections; may throw std::runtime_error where it has none
/// @param factorisations those that were made are added
[[nodiscard]] std::vector<Sensitivity> load_sensitivities(
    const Model& model, const std::vector<Variation>& variations, const Structure& structure,
    const LocatedPoint& at, const std::function<ModeOffsets(const Model&)>& offsets, int& factorisations);

}  // namespace snapthrough
