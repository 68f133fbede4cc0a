#pragma once
/// @file
/// Capacities of supports.

#include "solver/resolve/resolved_model.h"

namespace snapthrough {

/// @brief Whether a support carries no more than the capacity of its law.
template <class Support>
[[nodiscard]] bool has_capacity(const Support& support) {
  return support.law && support.law->type != ReactionLaw::Type::linear;
}

[[nodiscard]] bool has_supports_with_capacity(const ResolvedModel& model);

/// @brief Whether the reaction of some support falls beyond a peak. Supports then do not carry their largest
/// reactions all at once, so that limit analysis gives a bound of the limit load and not that load.
[[nodiscard]] bool has_falling_laws(const ResolvedModel& model);

/// @brief Whether the moment of some joint at a released member end follows a law. Limit analysis takes
/// joints as rigid, so that it gives a bound of the limit load and not that load.
[[nodiscard]] bool has_joint_laws(const ResolvedModel& model);

}  // namespace snapthrough
