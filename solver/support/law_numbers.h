#pragma once
/// @file
/// Stiffness and capacity of reaction laws.

#include "solver/model/model.h"

namespace snapthrough {

/// @brief Slope at zero and largest reaction of a law along its member, in the law's units.
struct LawNumbers {
  AlongMember stiffness;
  AlongMember capacity;  ///< not used of a linear law
};

/// @brief Numbers of a law, by which it is scaled, varies along its member and is limited. A type of law
/// without its numbers here does not compile. A table without a point beyond the origin, which check()
/// refuses, has zeros.
[[nodiscard]] LawNumbers numbers_of(const ReactionLaw& law);

}  // namespace snapthrough
