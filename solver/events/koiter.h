#pragma once
/// @file
/// Koiter's expansion of the load along the path that crosses at a bifurcation.

#include <optional>

#include "solver/events/bordered_point.h"

namespace snapthrough {

/// @brief lambda = lambda_c + slope s + curvature s^2 along the path that crosses at a simple bifurcation
/// (Koiter, 1945); s is the amplitude along n (norm one) relative to the primary path at the same load.
///
/// With the primary path u(lambda), u' = q + a_u n, write y = u(lambda) + s n + s^2 v + ..., n.W v = 0. Work
/// on n gives slope = -A / (2 B') with B' = B + A a_u, the rate of n's stiffness along u'. If A = 0, v from J
/// v = -F''[n, n] / 2 off n gives curvature = -c / B' with c = n.F''[n, v] + n.F'''[n, n, n] / 6.
struct KoiterExpansion {
  double slope = 0.0;
  /// Empty when the slope is not zero, or the third derivative does not converge (contact change at s = 0).
  std::optional<double> curvature;
  double stiffening = 0.0;  ///< coefficient c; positive where the state at the bifurcation is stable
};

/// @param along_path approximation of a_u, which identifies the primary path's tangent
/// @return empty when no other path crosses
/// @pre one null motion; `point` provides solves
[[nodiscard]] std::optional<KoiterExpansion> koiter_expansion(const BorderedPoint& point, double along_path);

}  // namespace snapthrough
