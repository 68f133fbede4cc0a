#pragma once
/// @file
/// C2 cubic interpolation in one variable.

#include <array>
#include <vector>

namespace snapthrough {

/// @brief C2 cubic spline through (t_i, f_i), not-a-knot at both ends where there are four points or more,
/// the interpolating polynomial of degree n - 1 for n = 2 or 3 points. Immutable, thread safe.
class CubicSpline {
 public:
  CubicSpline() = default;
  /// @pre t strictly increasing, at least two points, sizes equal
  /// @throws std::invalid_argument where neighbours can't be told apart: steps of t below its roundoff
  CubicSpline(std::vector<double> t, std::vector<double> f);

  /// @return value, first and second derivative at t (extrapolated beyond the ends).
  [[nodiscard]] std::array<double, 3> at(double t) const;

 private:
  std::vector<double> t_;
  std::vector<double> f_;
  std::vector<double> m_;  ///< second derivatives at the points
};

}  // namespace snapthrough
