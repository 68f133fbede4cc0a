#pragma once
/// @file
/// Initial axis of a member as a function of arc length.

#include <array>
#include <cstddef>
#include <functional>
#include <vector>

#include "solver/resolve/resolved_model.h"

namespace snapthrough {

/// Point of an initial axis.
struct AxisPoint {
  double x = 0.0;
  double y = 0.0;
  double angle = 0.0;      ///< angle of the tangent, rad, continuous along the member
  double curvature = 0.0;  ///< d angle / ds
};

/// @brief Planar curve parametrised by arc length. Immutable, thread safe.
///
/// Lines and arcs have closed forms; for other curves arc length is inverted numerically to rounding.
class AxisCurve {
 public:
  /// @brief Axis of a member between two points.
  /// @pre the points differ; |sweep| of an arc is in (0, 360) degrees
  AxisCurve(const Curve& curve, std::array<double, 2> start, std::array<double, 2> end);

  [[nodiscard]] double length() const { return length_; }
  /// @pre 0 <= s <= length()
  [[nodiscard]] AxisPoint at(double s) const;
  /// Angle of the tangent alone, rad; see AxisPoint.
  [[nodiscard]] double angle_at(double s) const;
  /// @brief Total rotation of the tangent between two arc lengths, without sign, rad.
  /// @pre 0 <= from <= to <= length()
  [[nodiscard]] double turning(double from, double to) const;
  /// Whether the curvature is zero everywhere.
  [[nodiscard]] bool straight() const { return straight_; }
  /// Positions in (0, length()) with a jump of the curvature's derivative (spline knots).
  [[nodiscard]] const std::vector<double>& knots() const { return knots_; }

 private:
  /// Position with its first two derivatives with respect to a parameter t in [0, 1].
  struct Jet {
    double x, y, dx, dy, ddx, ddy;
  };
  /// Arc length from the start of the wave that a point lies in.
  struct InWave {
    int wave;
    double s;
  };
  /// Row of the tables at or before a point of the first wave, and the point's parameter.
  struct Location {
    std::size_t row;
    double t;
  };
  static double speed_of(const Jet& j);
  /// @param pieces ends of the parts of one wave on which the curve is smooth, ascending from 0
  /// @param rows rows of the table for each piece
  void set_parametric(std::function<Jet(double)> jet, std::vector<double> pieces, int rows);
  void set_sine(const SineCurve& sine, std::array<double, 2> start, std::array<double, 2> end);
  void set_spline(const PointsCurve& curve, std::array<double, 2> start, std::array<double, 2> end);
  [[nodiscard]] double parameter_of(std::size_t row) const;
  [[nodiscard]] InWave in_wave(double s) const;
  [[nodiscard]] Location locate(double s) const;
  [[nodiscard]] double turning_in_wave(double from, double to) const;

  double length_ = 0.0;
  bool straight_ = false;
  // line and arc: constant curvature from the start point
  std::array<double, 2> start_{};
  double start_angle_ = 0.0;
  double curvature_ = 0.0;
  // other curves: parametric jet, with tables over one wave, which repeats with a period of the parameter. Of
  // odd waves the angles to the chord have the other sign.
  std::function<Jet(double)> jet_;
  int waves_ = 1;
  std::vector<double> pieces_;
  std::size_t rows_ = 1;  ///< for each piece
  std::vector<double> table_s_;
  std::vector<double> table_angle_;
  std::vector<double> table_speed_;  ///< ds/dt at the parameters of the table
  std::vector<double> knots_;
};

}  // namespace snapthrough
