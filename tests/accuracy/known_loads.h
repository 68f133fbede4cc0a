#pragma once
/// @file
/// Problems whose critical loads are known independently of this program.

#include <string>
#include <vector>

#include "solver/model/analysis.h"
#include "solver/model/model.h"
#include "solver/result.h"

namespace snapthrough::testing {

/// A problem and some of its critical loads.
struct KnownLoads {
  std::string name;
  Model model;
  Analysis analysis;     ///< its accuracy is for the caller to set
  bool contact = false;  ///< has a one-sided base
  /// Critical points of the result, limit points or bifurcations counted apart, in the order met.
  struct Load {
    bool limit = false;
    int number = 0;
    double value = 0.0;
  };
  std::vector<Load> loads;
  double digits = 1e-11;  ///< relative error that the known values may have themselves
};

/// @brief All problems; sources at the functions that make them.
[[nodiscard]] std::vector<KnownLoads> known_loads();

/// @brief The computed point for a known load; null when the result has too few.
[[nodiscard]] const CriticalPoint* point_of(const Result& result, const KnownLoads::Load& load);

}  // namespace snapthrough::testing
