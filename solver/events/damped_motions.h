#pragma once
/// @file
/// Growth of damped vibrations.

#include "solver/discrete/mass_matrix.h"
#include "solver/events/natural_motions.h"

namespace snapthrough {

/// Damped vibration x exp(s t) about an equilibrium, with complex s.
struct GrowingMotion {
  double growth = 0.0;  ///< Re(s) / |s|
  double square = 0.0;  ///< |s|^2, scaled
};

/// @brief The damped vibration with the largest growth, of those that oscillate; its growth is minus infinity
/// when none oscillates.
///
/// (s^2 M + s C + J) x = 0 with C = alpha M + beta K, K the elastic stiffness of members and their joints, on
/// the span of undamped motions: s to first order in the damping of the motions that were left out.
/// @param right, left motions of J and of its transpose; equal numbers
[[nodiscard]] GrowingMotion most_growing(const Structure& structure, const MassMatrix& masses,
                                         const NaturalMotions& right, const NaturalMotions& left);

}  // namespace snapthrough
