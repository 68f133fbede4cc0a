#pragma once
/// @file
/// Displacement of the ground under springs and elements.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>

#include "solver/numeric/rounding.h"

namespace snapthrough {

/// @brief Displacement (x, y, rotation) of the ground at a place: shares of the unknowns x and y of a node
/// that stands for the ground, and its rotation.
struct GroundPlace {
  int unknown = -1;  ///< that of x; y and the rotation follow; -1: the ground is at rest
  std::array<double, 2> share{1.0, 1.0};

  [[nodiscard]] bool moves() const { return unknown >= 0; }
  /// Displacement of the ground along a row of weights of (x, y, rotation).
  [[nodiscard]] double along(const std::array<double, 3>& row, const double* y) const {
    if (!moves()) return 0.0;
    return row[0] * share[0] * y[unknown] + row[1] * share[1] * y[unknown + 1] + row[2] * y[unknown + 2];
  }
  /// Adds the opposite of a force along a row to the ground's rows of a residual.
  void push(double force, const std::array<double, 3>& row, double* residual) const {
    if (!moves()) return;
    for (std::size_t c = 0; c < 2; ++c) residual[unknown + static_cast<int>(c)] -= force * row[c] * share[c];
    residual[unknown + 2] -= force * row[2];
  }
};

/// @brief Displacement of the ground under an element: in each of x and y the share of an unknown, which is
/// linear along the element.
struct GroundMotion {
  int unknown = -1;                ///< see GroundPlace
  std::array<double, 2> start{};   ///< shares at the element's start
  std::array<double, 2> change{};  ///< from the element's start to its end

  /// @param xi in [0, 1] of the element
  [[nodiscard]] GroundPlace at(double xi) const {
    return {unknown, {start[0] + xi * change[0], start[1] + xi * change[1]}};
  }
  /// @brief Subtracts the ground's motion from a displacement of the element. What is left within the
  /// rounding of displacements is zero: an element that moves with the ground touches it without pressure.
  /// @param u displacement (x, y) at its start; dx, dy: derivatives of the displacement by xi
  void subtract_from(const double* y, std::span<double> u, std::span<double> dx, std::span<double> dy) const {
    if (unknown < 0) return;
    const double largest =
        std::max({std::abs(u[0]), std::abs(u[1]), std::abs(y[unknown]), std::abs(y[unknown + 1])});
    const auto clear = [rounding = Rounding::displacement * largest](double& part) {
      if (std::abs(part) <= rounding) part = 0.0;
    };
    for (std::size_t c = 0; c < 2; ++c) {
      const double moved = y[unknown + static_cast<int>(c)];
      u[c] -= start[c] * moved;
      clear(u[c]);
      for (double& derivative : c == 0 ? dx : dy) {
        derivative -= change[c] * moved;
        clear(derivative);
      }
    }
  }
};

}  // namespace snapthrough
