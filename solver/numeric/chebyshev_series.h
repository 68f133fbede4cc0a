#pragma once
/// @file
/// Interpolation of a smooth function at Chebyshev points.

#include <Eigen/Core>
#include <array>
#include <span>

#include "solver/numeric/max_order.h"

namespace snapthrough {

/// @brief Polynomial of degree n - 1 through n values at xi_i = (1 - cos(pi i / (n - 1))) / 2 of [0, 1];
/// converges geometrically for analytic functions.
class ChebyshevSeries {
 public:
  static constexpr int kMostPoints = 2 * kMaxOrder + 3;

  /// @pre 2 <= values.size() <= kMostPoints
  explicit ChebyshevSeries(std::span<const double> values);

  [[nodiscard]] double value(double xi) const { return sum(coefficients_, xi); }
  /// Values at four positions.
  [[nodiscard]] Eigen::Array4d values(const Eigen::Array4d& xi) const { return sum(coefficients_, xi); }
  [[nodiscard]] double slope(double xi) const { return sum(slopes_, xi); }

 private:
  using Coefficients = std::array<double, kMostPoints>;
  /// Clenshaw's recurrence.
  template <class Real>
  [[nodiscard]] Real sum(const Coefficients& c, const Real& xi) const {
    const Real t = 2.0 * xi - 1.0;
    Real b1 = 0.0 * xi;
    Real b2 = b1;
    for (int k = size_ - 1; k > 0; --k) {
      const Real b = c[k] - b2 + 2.0 * t * b1;
      b2 = b1;
      b1 = b;
    }
    return c[0] - b2 + t * b1;
  }

  int size_;
  Coefficients coefficients_{};
  Coefficients slopes_{};  ///< coefficients of d / d xi
};

}  // namespace snapthrough
