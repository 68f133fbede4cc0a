#pragma once
/// @file
/// Random valid requests over the whole contract of paths; see docs/stress.md for what is drawn.

#include "tests/stress/random_model.h"

namespace snapthrough::testing {

/// @brief Frames and chains of one to five members of every curve, with all supports, bases, loads,
/// imperfections, controls and stop rules; stiffness ratios over twelve decades. Any seed gives one, the same
/// on every machine.
[[nodiscard]] RandomRequest broad_request(std::uint64_t seed);

}  // namespace snapthrough::testing
