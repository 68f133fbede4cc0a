#pragma once
/// @file
/// Shapes of reaction laws that are not linear.

#include <array>
#include <limits>
#include <memory>
#include <vector>

#include "solver/resolve/resolved_model.h"

namespace snapthrough {

/// @brief Dimensionless reaction f(x) of an elastic support with the slope 1 at x = 0. Law scales it: the
/// force is capacity * f(stiffness * penetration / capacity). All curves are odd; arguments may have both
/// signs.
///
/// `shape` is the second dimensionless number of a law, stiffness * reference / capacity. Only the power law
/// depends on it.
class ReactionCurve {
 public:
  virtual ~ReactionCurve() = default;
  /// f, f', f'' and the integral of f from 0.
  struct Values {
    double force = 0.0;
    double slope = 0.0;
    double curvature = 0.0;
  };
  [[nodiscard]] virtual Values at(double x, double shape) const = 0;
  [[nodiscard]] virtual double energy(double x, double shape) const = 0;

  /// @brief Place at which integrals of f are split: f'' or f' is not continuous there, or it ends a part of
  /// the curve that a few points of quadrature integrate.
  struct Knot {
    double x = 0.0;
    double slope_change = 0.0;  ///< change of f' from below to above x
  };
  /// @brief Number of knots at x >= 0. The curve has the same ones, with the opposite change, at -x.
  [[nodiscard]] virtual int knot_count() const = 0;
  /// @brief Place x > 0 from which f falls for the first time; infinite where it never does.
  [[nodiscard]] virtual double peak() const { return std::numeric_limits<double>::infinity(); }
  /// @param index in [0, knot_count()); knots ascend
  [[nodiscard]] virtual Knot knot(int index, double shape) const = 0;
};

/// @brief Curve of a law; null for a linear one.
/// @pre the law passed check()
[[nodiscard]] std::shared_ptr<const ReactionCurve> curve_of(const ReactionLaw& law);

/// @brief Slope at the origin of the curve through the points of a table; 0 for a table without a point
/// beyond the origin, which check() refuses.
/// @pre law.type is table
[[nodiscard]] double initial_slope(const ReactionLaw& law);

}  // namespace snapthrough
