#pragma once
/// @file
/// Random straight columns: any seed gives one, the same on every machine.

#include <cstdint>

#include "solver/model/model.h"

namespace snapthrough::testing {

/// @brief One to four members in a line in any direction, some of them against it, with whatever the exact
/// solution of columns admits: hinges, supports and springs along and across the line, bases over twelve
/// decades of stiffness with and without shear layers, axial forces of both signs and patterns. Some are
/// mechanisms.
[[nodiscard]] Model random_column(std::uint64_t seed);

}  // namespace snapthrough::testing
