#pragma once
/// @file
/// A smooth function on an interval from its values at Chebyshev's points.

#include <array>
#include <span>

#include "solver/model/analysis.h"

namespace snapthrough {

/// @brief Interpolates n values at xi_i = (1 - cos(pi i / (n - 1))) / 2 of [0, 1] by a polynomial of degree
/// n - 1: exact for those, and converging geometrically for what is smooth.
class ChebyshevSeries {
 public:
  static constexpr int kMostPoints = 2 * kMaxOrder + 3;

  /// @pre 2 <= values.size() <= kMostPoints
  explicit ChebyshevSeries(std::span<const double> values);

  [[nodiscard]] double value(double xi) const { return sum(coefficients_, xi); }
  [[nodiscard]] double slope(double xi) const { return sum(slopes_, xi); }

 private:
  using Coefficients = std::array<double, kMostPoints>;
  /// Clenshaw's recurrence.
  [[nodiscard]] double sum(const Coefficients& c, double xi) const {
    const double t = 2.0 * xi - 1.0;
    double b1 = 0.0;
    double b2 = 0.0;
    for (int k = size_ - 1; k > 0; --k) {
      const double b = c[k] - b2 + 2.0 * t * b1;
      b2 = b1;
      b1 = b;
    }
    return c[0] - b2 + t * b1;
  }

  int size_;
  Coefficients coefficients_{};
  Coefficients slopes_{};  ///< of d / d xi
};

}  // namespace snapthrough
