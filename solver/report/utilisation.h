#pragma once
/// @file
/// Stress over strength in the outer fibres of a section.

#include <array>

#include "solver/model/model.h"
#include "solver/result.h"

namespace snapthrough {

/// @brief Stress over strength in the left and right outer fibre, positive in tension:
/// N / N_y - M / M_y on the left, N / N_y + M / M_y on the right. Compression is divided by the ratio of the
/// strengths in compression and tension.
/// @param fraction of the member's length
/// @param axial_force, bending_moment in the model's units
[[nodiscard]] std::array<double, 2> fibre_utilisations(const Strength& strength, double fraction,
                                                       double axial_force, double bending_moment);
/// Whether a stress over strength is larger in size than another one, by more than rounding.
[[nodiscard]] bool exceeds(const Utilisation& value, const Utilisation& other);

}  // namespace snapthrough
