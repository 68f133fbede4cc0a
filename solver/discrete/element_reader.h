#pragma once
/// @file
/// Displacements and their derivatives inside one element.

#include <Eigen/Core>
#include <array>
#include <span>

#include "solver/discrete/structure.h"
#include "solver/numeric/max_order.h"

namespace snapthrough {

/// @brief Evaluates the displacements of one element from the scaled unknowns of its structure.
class ElementReader {
 public:
  ElementReader(const Structure& structure, const Eigen::VectorXd& y, int element);
  /// Reads displacements relative to the ground under a foundation. Under one that resists rotation, the
  /// rotation is read as the displacement along x, and that along y is zero.
  ElementReader(const Structure& structure, const Eigen::VectorXd& y, int element,
                const FoundationLaw& foundation);

  /// Displacement (x, y, rotation) at xi in [0, 1].
  [[nodiscard]] std::array<double, 3> displacement(double xi) const;
  /// Derivatives of (x, y, rotation) with respect to scaled arc length.
  [[nodiscard]] std::array<double, 3> derivative(double xi) const;
  /// Element length times the derivatives of component c at the Gauss points.
  [[nodiscard]] std::span<const double> gradient(int c) const { return std::span(dv_[c]).first(p_); }
  [[nodiscard]] const std::array<double, 3>& start() const { return ua_; }
  [[nodiscard]] double length() const { return h_; }

 private:
  int p_;
  double h_;
  const CollocationRule* rule_;
  std::array<double, 3> ua_{};
  std::array<std::array<double, kMaxOrder>, 3> dv_{};
};

}  // namespace snapthrough
