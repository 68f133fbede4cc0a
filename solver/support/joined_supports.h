#pragma once
/// @file
/// Opposite one-sided supports as one law of support.

#include <optional>

#include "solver/model/model.h"

namespace snapthrough {

/// Largest gap, over the structure's longest chord, that is rounding of the geometry: such a support touches.
inline constexpr double kNoGap = 1e-14;

/// @brief Two one-sided supports that push from opposite sides at one place, both without gap, react with
///
///   k_1 max(w, 0) - k_2 max(-w, 0)  =  k w + (k_1 - k_2) max(w, 0),    k = k_2 <= k_1:
///
/// a bilateral support of the smaller stiffness, and a one-sided one of what the stiffer has more. Springs
/// are added up by place and line of action; foundations of a member by line of action on each part of their
/// ranges, which may overlap in any way.
/// @return the model with its supports in that form, for equations only (ids and numbers of supports are
/// others); empty: no supports are opposite
/// @pre the model passed check()
[[nodiscard]] std::optional<Model> with_joined_supports(const Model& model);

}  // namespace snapthrough
