#pragma once
/// @file
/// Displacement of the ground under an element.

#include <array>

namespace snapthrough {

/// @brief Displacement of the ground under an element of the member: in each of x and y the share of an
/// unknown of the structure, which is linear along the element.
///
/// The unknowns are the prescribed displacement of a node that stands for the ground.
struct GroundMotion {
  int unknown = -1;                ///< that of x; y follows; -1: the ground is at rest
  std::array<double, 2> start{};   ///< shares at the element's start
  std::array<double, 2> change{};  ///< from the element's start to its end

  [[nodiscard]] bool moves() const { return unknown >= 0; }
  /// Shares of x and y at xi in [0, 1] of the element.
  [[nodiscard]] std::array<double, 2> share_at(double xi) const {
    return {start[0] + xi * change[0], start[1] + xi * change[1]};
  }
};

}  // namespace snapthrough
