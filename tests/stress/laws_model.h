#pragma once
/// @file
/// Random valid requests of structures in soil; see docs/stress.md for what is drawn.

#include "tests/stress/random_model.h"

namespace snapthrough::testing {

/// @brief Chains of one to three members on foundations and springs with reaction laws, under loads and
/// strains that vary along members, self weight, temperature and load cases, with semi-rigid joints. Any seed
/// gives one, the same on every machine.
[[nodiscard]] RandomRequest laws_request(std::uint64_t seed);

}  // namespace snapthrough::testing
