#pragma once
/// @file
/// The cubic by values and slopes at two places.

#include <algorithm>
#include <cmath>
#include <optional>

#include "solver/numeric/bracket.h"

namespace snapthrough {

/// @brief Weights of the values (a, b) and slopes (da, db) at 0 and d in Hermite's cubic at tau.
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

/// @brief Second and third derivative at its end of the cubic on a way of length d with these slopes and this
/// rise; of numbers or vectors, the rise may be an expression.
template <class Rise, class T>
[[nodiscard]] T second_derivative_at_end(const Rise& rise, const T& slope_before, const T& slope, double d) {
  return ((2.0 * slope_before + 4.0 * slope) - (6.0 / d) * rise) / d;
}
template <class Rise, class T>
[[nodiscard]] T third_derivative(const Rise& rise, const T& slope_before, const T& slope, double d) {
  return (6.0 * (slope_before + slope) - (12.0 / d) * rise) / (d * d);
}

/// A number along a step from 0 to 1, by its values and slopes at both ends.
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
  /// Where between the ends its slope is greatest or least; empty: at an end.
  [[nodiscard]] std::optional<double> inflection() const {
    const double linear = 2.0 * (3.0 * (f1 - f0) - 2.0 * m0 - m1);
    const double square = 3.0 * (m0 + m1 - 2.0 * (f1 - f0));
    const double t = -0.5 * linear / square;
    return t > 0.0 && t < 1.0 ? std::optional(t) : std::nullopt;
  }
  /// Where between the ends it is least; empty: at an end.
  [[nodiscard]] std::optional<double> minimum() const {
    const double a = 3.0 * (2.0 * (f0 - f1) + m0 + m1);
    const double b =
        3.0 * (f1 - f0) - 2.0 * m0 - m1;  // a t^2 + 2 b t + m0: its slope, rising where it is least
    const double root = std::sqrt(std::max(b * b - a * m0, 0.0));
    const double t = b > 0.0 ? -m0 / (b + root) : (root - b) / a;
    return t > 0.0 && t < 1.0 ? std::optional(t) : std::nullopt;
  }
  /// A zero between the ends. @pre their values differ in sign
  [[nodiscard]] double zero() const {
    return bisect(0.0, 1.0, 1e-12, [this](double t) { return (value(t) > 0.0) != (f0 > 0.0); });
  }
};

}  // namespace snapthrough
