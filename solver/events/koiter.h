#pragma once
/// @file
/// The load along the path that crosses at a bifurcation.

#include <optional>

#include "solver/events/bordered_point.h"

namespace snapthrough {

/// @brief lambda = lambda_c + slope s + curvature s^2 along the path that crosses at a simple bifurcation
/// (Koiter, 1945), s the part along n, of norm one, of its distance from the primary path at the same load.
///
/// On the path y = u(lambda) + s n + s^2 v + ..., n.W v = 0, with the primary path u, the work of the
/// equations on n gives slope = -A / (2 B'), B' = B + A a_u the rate of n's stiffness along u' = q + a_u n;
/// and where A = 0, with J v = -F''[n, n] / 2 off n, curvature = -c / B', c = n.F''[n, v] + n.F'''[n, n, n]
/// / 6.
struct KoiterExpansion {
  double slope = 0.0;
  /// Empty where the slope is not zero, or no third derivative settles: contact that changes with s at once.
  std::optional<double> curvature;
  double stiffening = 0.0;  ///< c: positive where the state at the bifurcation itself is stable
};

/// @param along_path a_u of the primary path as it is known, to tell its tangent from the other
/// @return empty where no other path crosses
/// @pre one null motion; the point solves
[[nodiscard]] std::optional<KoiterExpansion> koiter_expansion(const BorderedPoint& point, double along_path);

}  // namespace snapthrough
