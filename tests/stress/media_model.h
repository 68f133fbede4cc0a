#pragma once
/// @file
/// Random valid requests of structures with rods, rigid obstacles and media with surfaces; see docs/stress.md
/// for what is drawn.

#include "tests/stress/random_model.h"

namespace snapthrough::testing {

/// @brief Structures of laws_request() with sections that taper, rods, gaps that vary along members, rigid
/// foundations and stops, and outlines of every type. Any seed gives one, the same on every machine.
[[nodiscard]] RandomRequest media_request(std::uint64_t seed);

}  // namespace snapthrough::testing
