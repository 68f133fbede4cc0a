#pragma once
/// @file
/// A curve of critical points over one number of the model, as it is reported.

#include <cstddef>
#include <vector>

#include "solver/result.h"

namespace snapthrough {

/// Special points of a curve of critical points.
enum class LocusEventType {
  cusp,              ///< a maximum and a minimum of the load meet and vanish
  fold_bifurcation,  ///< a limit point and a bifurcation meet
  turn,              ///< two bifurcations meet and vanish
  not_followed       ///< no point of the curve was found beyond this one, or at this value
};

struct LocusEvent {
  LocusEventType type = LocusEventType::cusp;
  double value = 0.0;  ///< value of the parameter
  double load_factor = 0.0;
};

/// A critical point at one of the values.
struct LocusLoad {
  std::size_t value = 0;  ///< index of the value
  double load_factor = 0.0;
  CriticalType type = CriticalType::limit_max;
};

/// Where a curve ends.
enum class LocusEnd {
  first_value,
  last_value,
  not_followed,  ///< its next point is not found, or is no longer of its kind
  steps,         ///< most steps
  cancelled
};

/// One curve of limit points or of bifurcations.
struct LocusCurve {
  bool bifurcation = false;
  std::vector<LocusLoad> loads;    ///< in the order of the curve; a value has as many as the curve passes it
  std::vector<LocusEvent> events;  ///< in the order of the curve
  LocusEnd end = LocusEnd::not_followed;
};

}  // namespace snapthrough
