#pragma once
/// @file
/// Random valid requests with joints, ties, guys and rigid members; see docs/stress.md for what is drawn.

#include "tests/stress/random_model.h"

namespace snapthrough::testing {

/// @brief A structure of laws_request() or broad_request(), with foundations against rotation, laws at
/// joints, pretensioned rods, members and springs between nodes, and rigid sections. Any seed gives one, the
/// same on every machine.
[[nodiscard]] RandomRequest members_request(std::uint64_t seed);

}  // namespace snapthrough::testing
