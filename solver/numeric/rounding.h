#pragma once
/// @file
/// What rounding leaves in double precision.

#include <limits>

namespace snapthrough {

/// @brief Differences that count as rounding, for quantities which more than one module computes. Ratios
/// without unit. Source: unit in the last place, 2.2e-16, times the number of operations and their condition.
struct Rounding {
  static constexpr double cancelled_sum = 1e-14;   ///< a sum that is zero, over its terms' sum of magnitudes
  static constexpr double unit_component = 1e-14;  ///< a component of a vector of length one
  static constexpr double coordinate = 1e-14;      ///< a coordinate, over the structure's length
  static constexpr double displacement = 1e-13;    ///< a displacement at equilibrium, over the largest
  static constexpr double largest_residual = 2e-13;  ///< relative residual that rounding can leave
  /// A force where none acts, over the forces of the actions: it reaches 1e-14 in random statically
  /// determinate structures with EA l^2 / EI up to 1e10.
  static constexpr double force = 1e-12;
  /// Distance of a support from touching, next to a critical point, over the structure's length.
  static constexpr double touching = 1e-7;
  /// A position or a force, over the largest of the numbers that it is computed from: four units in the last
  /// place.
  static constexpr double last_places = 4.0 * std::numeric_limits<double>::epsilon();
  /// An inner product, over the product of the norms: 16 units in the last place.
  static constexpr double inner_product = 16.0 * std::numeric_limits<double>::epsilon();
  static constexpr double element_sum = 8.0;     ///< a sum over an element's terms, over one term's rounding
  static constexpr double parallel = 1e-12;      ///< sine of the angle between lines that coincide
  static constexpr double null_vector = 1e-12;   ///< a value computed from null vectors of length one
  static constexpr double imperfection = 1e-13;  ///< the largest imperfection that coordinates cause
  /// A displacement or a distance along a path, over the size of the structure or of the path.
  static constexpr double distance = 1e-12;
  /// A component of a mode or of a free motion, over the largest; work on that motion, over the sum of its
  /// terms' magnitudes.
  static constexpr double motion = 1e-9;
  /// Factor by which a later of several values must exceed the first to be taken for larger.
  static constexpr double first_of_equal = 1.0 + 1e-9;
};

}  // namespace snapthrough
