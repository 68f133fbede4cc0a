#pragma once
/// @file
/// Combination of opposite one-sided supports.

#include <optional>

#include "solver/resolve/resolved_model.h"

namespace snapthrough {

/// @brief Two one-sided supports without gap that push from opposite sides at one place react with
///
///   k_1 max(w, 0) - k_2 max(-w, 0)  =  k w + (k_1 - k_2) max(w, 0),    k = k_2 <= k_1:
///
/// that is, a bilateral support of the smaller stiffness plus a one-sided support of the difference. Springs
/// to ground are combined by place and line of action; foundations of a member by line of action on each part
/// of their ranges, which may overlap arbitrarily. Foundations with a shear layer are not combined: each side
/// has its own surface.
/// @return model with combined supports, for the equations only (ids and indices of supports differ); empty:
/// no supports are opposite
/// @pre the model passed check()
[[nodiscard]] std::optional<ResolvedModel> with_joined_supports(const ResolvedModel& model);

}  // namespace snapthrough
