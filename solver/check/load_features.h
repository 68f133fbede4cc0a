#pragma once
/// @file
/// What rules ask of every kind of load.

#include "solver/model/model.h"

namespace snapthrough {

/// Properties of a load by which check() judges whether a request can be analysed.
struct LoadFeatures {
  const Location* place = nullptr;  ///< one place at which the load acts; null: it acts along members
  double moment = 0.0;              ///< moment at that place
  bool is_dead = true;              ///< no force turns or moves with the structure, apart from pressures
};

/// @brief Features of a load, with a pointer into it. A kind of load without features does not compile.
[[nodiscard]] LoadFeatures features_of(const Load& load);

}  // namespace snapthrough
