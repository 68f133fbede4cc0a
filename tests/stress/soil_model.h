#pragma once
/// @file
/// Random valid requests of structures in soil that loses strength; see docs/stress.md for what is drawn.

#include "tests/stress/random_model.h"

namespace snapthrough::testing {

/// @brief A structure of laws_request() whose supports have tables that fall beyond a peak. Any seed gives
/// one, the same on every machine.
[[nodiscard]] RandomRequest soil_request(std::uint64_t seed);

}  // namespace snapthrough::testing
