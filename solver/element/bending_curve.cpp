#include "solver/element/bending_curve.h"

#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "solver/numeric/piecewise_cubic.h"

namespace snapthrough {
namespace {

/// c = m + coefficient moment (m / moment)^exponent (Ramberg and Osgood, NACA TN 902, 1943).
class RambergOsgoodCurve final : public BendingCurve {
 public:
  RambergOsgoodCurve(const BendingLaw& law, double unit)
      : moment_(law.moment / unit), coefficient_(law.coefficient), exponent_(law.exponent) {}

  [[nodiscard]] Values at(double moment) const override {
    const double x = std::abs(moment) / moment_;
    const double power = coefficient_ * std::pow(x, exponent_ - 2.0);
    return {moment + power * x * moment, 1.0 + exponent_ * power * x,
            std::copysign(exponent_ * (exponent_ - 1.0) * power / moment_, moment)};
  }

 private:
  double moment_;
  double coefficient_;
  double exponent_;
};

/// Points (M, k) of a table.
CurvePoints by_moment(const BendingLaw& law) {
  CurvePoints points = law.points;
  for (auto& [curvature, moment] : points) std::swap(curvature, moment);
  return with_origin(std::move(points));
}

/// Curve through a table, with the last slope beyond its last point.
class BendingTable final : public BendingCurve {
 public:
  BendingTable(const BendingLaw& law, double unit) {
    CurvePoints points = by_moment(law);
    const double stiffness = initial_slope(law);
    const bool is_smooth = law.interpolation == Interpolation::monotone_cubic;
    std::vector<double> slopes = is_smooth ? cubic_slopes(points) : std::vector<double>();
    for (double& slope : slopes) slope *= stiffness;
    for (auto& [moment, curvature] : points) {
      moment /= unit;
      curvature *= stiffness / unit;
    }
    curve_ = PiecewiseCubic(std::move(points), slopes);
  }

  [[nodiscard]] Values at(double moment) const override {
    const double a = std::abs(moment);
    const auto [last, value] = curve_.points().back();
    if (a >= last)
      return {std::copysign(value + curve_.last_slope() * (a - last), moment), curve_.last_slope(), 0.0};
    const PiecewiseCubic::Values c = curve_.at(a);
    return {std::copysign(c.value, moment), c.slope, std::copysign(1.0, moment) * c.second};
  }

 private:
  PiecewiseCubic curve_;
};

}  // namespace

double initial_slope(const BendingLaw& law) {
  const CurvePoints points = by_moment(law);
  if (points.size() < 2) return 0.0;
  return law.interpolation == Interpolation::linear ? points[1][0] / points[1][1]
                                                    : 1.0 / cubic_slopes(points)[0];
}

std::shared_ptr<const BendingCurve> bending_curve_of(const Section& section, const Scales& scales) {
  if (!section.bending) return nullptr;
  const double unit = scales.moment();
  if (section.bending->type == BendingLaw::Type::ramberg_osgood)
    return std::make_shared<RambergOsgoodCurve>(*section.bending, unit);
  return std::make_shared<BendingTable>(*section.bending, unit);
}

}  // namespace snapthrough
