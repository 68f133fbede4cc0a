#pragma once
/// @file
/// What rounding leaves in double precision.

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
};

}  // namespace snapthrough
