#pragma once
/// @file
/// Linearised buckling loads with error estimates.

#include <memory>
#include <optional>
#include <vector>

#include "solver/discrete/structure.h"
#include "solver/events/buckling.h"
#include "solver/model/analysis.h"

namespace snapthrough {

/// Buckling loads on the coarsest mesh that meets the accuracy for all of them.
struct BucklingLoads {
  std::shared_ptr<const Structure> structure;
  LinearBuckling buckling;
  std::vector<std::optional<double>>
      errors;              ///< relative, one per load; empty: another number of loads on the next mesh
  int level = 0;           ///< number of mesh refinements
  int factorizations = 0;  ///< on all meshes
};

/// @brief Lowest buckling loads, each compared with that of the same rank on the next finer mesh, until all
/// estimates are within the accuracy. A fixed mesh is estimated but not refined.
/// @param structure structure on the first mesh
/// @param sense `reversed`: loads of the opposite actions, see linear_buckling()
[[nodiscard]] BucklingLoads buckling_loads(const Analysis& analysis, const Structure& structure,
                                           LoadSense sense = LoadSense::as_given);

}  // namespace snapthrough
