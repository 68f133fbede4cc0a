#pragma once
/// @file
/// Capacities of supports.

#include "solver/resolve/resolved_model.h"

namespace snapthrough {

/// @brief Largest reaction of a law (force, moment, or force per length) at a fraction of its member.
/// @pre the law is not linear
[[nodiscard]] double capacity_at(const ReactionLaw& law, double fraction);

/// @brief Whether a support carries no more than the capacity of its law.
template <class Support>
[[nodiscard]] bool has_capacity(const Support& support) {
  return support.law && support.law->type != ReactionLaw::Type::linear;
}

[[nodiscard]] bool has_supports_with_capacity(const ResolvedModel& model);

}  // namespace snapthrough
