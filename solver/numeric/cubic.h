#pragma once
/// @file
/// Cubic Hermite interpolation.

#include <algorithm>
#include <cmath>
#include <optional>

#include "solver/numeric/bracket.h"

namespace snapthrough {

/// @brief Weights at tau of the cubic Hermite interpolant of values (a, b) and slopes (da, db) at 0 and d.
struct CubicWeights {
  double a, da, b, db;
  CubicWeights(double tau, double d) {
    const double t = tau / d;
    a = (1.0 + 2.0 * t) * (1.0 - t) * (1.0 - t);
    b = t * t * (3.0 - 2.0 * t);
    da = d * t * (1.0 - t) * (1.0 - t);
    db = d * t * t * (t - 1.0);
  }
};

/// @brief Weights of the first derivative of that interpolant, at a fraction t of d: of the rise b - a, and
/// of the slopes.
struct CubicRates {
  double rise, da, db;
  CubicRates(double t, double d)
      : rise(6.0 * t * (1.0 - t) / d), da((1.0 - t) * (1.0 - 3.0 * t)), db(t * (3.0 * t - 2.0)) {}
};

/// @brief Second and third derivative, at the end of an interval of length d, of the cubic with the given
/// slopes at its ends and the given rise. T is a number or a vector; the rise may be an expression.
template <class Rise, class T>
[[nodiscard]] T second_derivative_at_end(const Rise& rise, const T& slope_before, const T& slope, double d) {
  return ((2.0 * slope_before + 4.0 * slope) - (6.0 / d) * rise) / d;
}
template <class Rise, class T>
[[nodiscard]] T third_derivative(const Rise& rise, const T& slope_before, const T& slope, double d) {
  return (6.0 * (slope_before + slope) - (12.0 / d) * rise) / (d * d);
}

/// Cubic on [0, 1] with given values and slopes at both ends.
struct Cubic {
  double f0, m0, f1, m1;

  [[nodiscard]] double value(double t) const {
    const CubicWeights w(t, 1.0);
    return w.a * f0 + w.da * m0 + w.b * f1 + w.db * m1;
  }
  [[nodiscard]] double slope(double t) const {
    // m0 + 2 (3 (f1 - f0) - 2 m0 - m1) t + 3 (m0 + m1 - 2 (f1 - f0)) t^2
    return m0 + t * (2.0 * (3.0 * (f1 - f0) - 2.0 * m0 - m1) + t * 3.0 * (m0 + m1 - 2.0 * (f1 - f0)));
  }
  /// Position of the extreme slope in (0, 1); empty: none.
  [[nodiscard]] std::optional<double> inflection() const {
    const double linear = 2.0 * (3.0 * (f1 - f0) - 2.0 * m0 - m1);
    const double square = 3.0 * (m0 + m1 - 2.0 * (f1 - f0));
    const double t = -0.5 * linear / square;
    return t > 0.0 && t < 1.0 ? std::optional(t) : std::nullopt;
  }
  /// Position of the minimum in (0, 1); empty: none.
  [[nodiscard]] std::optional<double> minimum() const {
    const double a = 3.0 * (2.0 * (f0 - f1) + m0 + m1);
    const double b = 3.0 * (f1 - f0) - 2.0 * m0 - m1;  // slope: a t^2 + 2 b t + m0
    const double root = std::sqrt(std::max(b * b - a * m0, 0.0));
    const double t = b > 0.0 ? -m0 / (b + root) : (root - b) / a;
    return t > 0.0 && t < 1.0 ? std::optional(t) : std::nullopt;
  }
  /// A zero in (0, 1). @pre f0 and f1 differ in sign
  [[nodiscard]] double zero() const {
    return bisect(0.0, 1.0, 1e-12, [this](double t) { return (value(t) > 0.0) != (f0 > 0.0); });
  }
};

}  // namespace snapthrough
