#pragma once
/// @file
/// Interpolation by C2 cubic splines.

#include <array>
#include <vector>

namespace snapthrough {

/// @brief C2 cubic spline through (t_i, f_i), not-a-knot at both ends for four or more points; for two or
/// three points the interpolating polynomial. Immutable, thread safe.
class CubicSpline {
 public:
  CubicSpline() = default;
  /// @pre t strictly increasing, at least two points, sizes equal
  /// @throws std::invalid_argument when steps of t are below its rounding
  CubicSpline(std::vector<double> t, std::vector<double> f);

  /// @return value, first and second derivative at t (extrapolated outside the points)
  [[nodiscard]] std::array<double, 3> at(double t) const;

 private:
  std::vector<double> t_;
  std::vector<double> f_;
  std::vector<double> m_;  ///< second derivatives at the points
};

}  // namespace snapthrough
