#pragma once
/// @file
/// Curves through points: cubics, or straight lines, between neighbouring ones.

#include <array>
#include <cstddef>
#include <vector>

namespace snapthrough {

/// Points (x, f) with ascending x.
using CurvePoints = std::vector<std::array<double, 2>>;

/// @brief Slopes at the points of the cubic of Fritsch and Butland (SIAM J. Sci. Stat. Comput. 5 (1984)
/// 300-304), which is monotone between them: weighted harmonic means of the neighbouring chords, zero at
/// peaks and valleys.
///
/// The cubic has no curvature at the first and the last point, so that points on a line give that line, and
/// so that the odd continuation of a curve from the origin is smooth there.
/// @pre two points at least
[[nodiscard]] std::vector<double> cubic_slopes(const CurvePoints& points);

/// @brief Points with the origin first. @pre x of the points is not negative
[[nodiscard]] CurvePoints with_origin(CurvePoints points);

/// Curve through points, a cubic with given slopes between neighbouring ones.
class PiecewiseCubic {
 public:
  /// Value with its first and second derivative.
  struct Values {
    double value = 0.0;
    double slope = 0.0;
    double second = 0.0;
  };
  PiecewiseCubic() = default;
  /// @param slopes one per point; empty: straight lines between the points
  /// @pre two points at least
  PiecewiseCubic(CurvePoints points, const std::vector<double>& slopes);

  [[nodiscard]] const CurvePoints& points() const { return points_; }
  /// @pre x is from the first point to before the last
  [[nodiscard]] Values at(double x) const;
  /// Integral from the first point to x. @pre as at()
  [[nodiscard]] double integral_to(double x) const;
  /// Integral from the first point to the last.
  [[nodiscard]] double whole_integral() const { return integrals_.back(); }
  /// Slope before the last point.
  [[nodiscard]] double last_slope() const { return last_slope_; }
  /// Slope after a point less that before it; zero at the first and the last point.
  [[nodiscard]] double slope_change(std::size_t point) const { return slope_changes_[point]; }

 private:
  /// Cubic value + slope t + second t^2 + third t^3 with t from a point on.
  struct Piece {
    double from, value, slope, second, third;
  };
  [[nodiscard]] std::size_t piece_at(double x) const;
  [[nodiscard]] static double integral(const Piece& p, double to);

  CurvePoints points_;
  std::vector<Piece> pieces_;  ///< between neighbouring points
  std::vector<double> slope_changes_;
  std::vector<double> integrals_;  ///< integral up to each point
  double last_slope_ = 0.0;
};

}  // namespace snapthrough
