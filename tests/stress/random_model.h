#pragma once
/// @file
/// Random valid requests: any seed gives one, the same on every machine.

#include <cstdint>

#include "solver/model/analysis.h"
#include "solver/model/model.h"

namespace snapthrough::testing {

/// A request and what it is made of, in words for a failure's message.
struct RandomRequest {
  Model model;
  Analysis analysis;
};

/// @brief Members (one to four, straight, arcs, parabolas, sines), sections over twelve decades of EA L^2 /
/// EI, bases and springs bilateral or one-sided with gaps over ten decades of stiffness, dead loads,
/// imperfections, any units.
[[nodiscard]] RandomRequest random_request(std::uint64_t seed);

}  // namespace snapthrough::testing
