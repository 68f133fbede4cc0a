#pragma once
/// @file
/// The initial axis of a member as a function of its arc length.

#include <array>
#include <functional>
#include <vector>

#include "solver/model/model.h"

namespace snapthrough {

/// A point of an initial axis.
struct AxisPoint {
  double x = 0.0;
  double y = 0.0;
  double angle = 0.0;      ///< of the tangent, continuous along the member
  double curvature = 0.0;  ///< d angle / ds
};

/// @brief Planar curve with arc length as parameter. Immutable, thread safe.
///
/// Lines and arcs are closed forms; the other curves invert their arc length numerically to rounding.
class AxisCurve {
 public:
  /// @brief Axis of a member between two points.
  /// @pre the points differ; an arc's sweep is in (0, 360) degrees in absolute value
  AxisCurve(const Curve& curve, std::array<double, 2> start, std::array<double, 2> end);

  [[nodiscard]] double length() const { return length_; }
  /// @pre 0 <= s <= length()
  [[nodiscard]] AxisPoint at(double s) const;
  /// @brief By how much the tangent turns between two arc lengths, all turns counted positive.
  /// @pre 0 <= from <= to <= length()
  [[nodiscard]] double turning(double from, double to) const;
  /// Whether the curvature is zero everywhere.
  [[nodiscard]] bool straight() const { return straight_; }
  /// Places in (0, length()) where the curvature jumps in its derivative (spline knots); empty for the
  /// others.
  [[nodiscard]] const std::vector<double>& knots() const { return knots_; }

 private:
  /// Value and first two derivatives by a parameter t in [0, 1].
  struct Jet {
    double x, y, dx, dy, ddx, ddy;
  };
  static double speed_of(const Jet& j);
  void set_parametric(std::function<Jet(double)> jet, int intervals);
  void set_spline(const PointsCurve& curve, std::array<double, 2> start, std::array<double, 2> end);
  [[nodiscard]] double parameter_at(double s) const;
  [[nodiscard]] double length_to(double t) const;

  double length_ = 0.0;
  bool straight_ = false;
  // line and arc: constant curvature from the start point
  std::array<double, 2> start_{};
  double start_angle_ = 0.0;
  double curvature_ = 0.0;
  // others: jet of a parameter, with tables of arc length and angle at equal parameter intervals
  std::function<Jet(double)> jet_;
  std::vector<double> table_s_;
  std::vector<double> table_angle_;
  std::vector<double> table_speed_;  ///< ds/dt at the same parameters
  std::vector<double> knots_;
};

}  // namespace snapthrough
