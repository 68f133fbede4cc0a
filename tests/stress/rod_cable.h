#pragma once
/// @file
/// The checker's own cable: forces by quadrature of the differential equation of a hanging cable.

#include <Eigen/Core>

namespace snapthrough::testing {

/// Cable of a length without force, whose weight per length without force is constant.
struct HangingBar {
  double EA = 0.0;
  double length = 0.0;
  Eigen::Vector2d weight = Eigen::Vector2d::Zero();
};

/// Pull of a bar or cable on its start, and minus that on its end, without half of the weight at each.
struct BarPull {
  Eigen::Vector2d force = Eigen::Vector2d::Zero();
  Eigen::Matrix2d tangent = Eigen::Matrix2d::Zero();  ///< by the vector from start to end
  double at_start = 0.0;                              ///< axial force at the start, a tension positive
};

/// @brief Pull of a cable whose ends are apart by `chord`.
/// @param lengthening of the whole length, without force
[[nodiscard]] BarPull pull_of(const HangingBar& cable, const Eigen::Vector2d& chord, double lengthening);

}  // namespace snapthrough::testing
