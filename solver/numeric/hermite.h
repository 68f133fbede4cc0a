#pragma once
/// @file
/// Cubics by their values and slopes at two places.

namespace snapthrough {

/// @brief Cubic Hermite interpolation on [0, d] at tau: a and b go with the values at the ends, da and db
/// with the slopes.
struct Hermite {
  double a, da, b, db;
  Hermite(double tau, double d) {
    const double t = tau / d;
    a = (1.0 + 2.0 * t) * (1.0 - t) * (1.0 - t);
    b = t * t * (3.0 - 2.0 * t);
    da = d * t * (1.0 - t) * (1.0 - t);
    db = d * t * t * (t - 1.0);
  }
};

}  // namespace snapthrough
