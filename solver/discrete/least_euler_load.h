#pragma once
/// @file
/// The load of the member that buckles first alone.

#include <algorithm>

#include "solver/discrete/structure.h"

namespace snapthrough {

/// Least of Structure::euler_loads; of rods alone their largest EA, which is the unit of forces.
[[nodiscard]] inline double least_euler_load(const Structure& structure) {
  return structure.euler_loads.empty() ? 1.0 : *std::ranges::min_element(structure.euler_loads);
}

}  // namespace snapthrough
