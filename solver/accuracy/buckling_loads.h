#pragma once
/// @file
/// Linearised buckling loads with estimated errors.

#include <memory>
#include <optional>
#include <vector>

#include "solver/discrete/structure.h"
#include "solver/events/buckling.h"
#include "solver/model/analysis.h"

namespace snapthrough {

/// Buckling loads on the coarsest mesh that is fine enough for all of them.
struct BucklingLoads {
  std::shared_ptr<const Structure> structure;
  LinearBuckling buckling;
  std::vector<std::optional<double>>
      errors;              ///< relative, one a load; empty: the next mesh has another count
  int level = 0;           ///< how often the mesh was refined
  int factorizations = 0;  ///< on all meshes
};

/// @brief The lowest buckling loads, compared by their place in the order with those of the next finer mesh,
/// until all estimates are within the accuracy. On a fixed mesh the estimate is made, but nothing refined.
/// @param structure on the first mesh
/// @param sense `reversed`: of the opposite actions, see linear_buckling()
[[nodiscard]] BucklingLoads buckling_loads(const Model& model, const Analysis& analysis,
                                           const Structure& structure, LoadSense sense = LoadSense::as_given);

}  // namespace snapthrough
