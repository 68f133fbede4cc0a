#include "solver/support/reaction_curve.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "solver/numeric/piecewise_cubic.h"

namespace snapthrough {
namespace {

/// Parts of curves between knots. On [x, 2 x] the nearest singularity of x / (1 + x) and of a power is at
/// three half widths from the middle, so that n Gauss points have the error 5.8^-2n. The difference of tanh x
/// from 1 falls as exp(-2 x), faster than the parts grow.
struct CurveParts {
  static constexpr int tanh = 5;         ///< 1, 2, .. 16, beyond which 1 - tanh x is rounding
  static constexpr int hyperbolic = 51;  ///< 0, 1, 2, .. 2^49, beyond which 1 - x / (1 + x) is rounding
  static constexpr int power = 51;       ///< the end of the line, its doubles, and the capacity
};

/// f = tanh x.
class TanhCurve final : public ReactionCurve {
 public:
  [[nodiscard]] Values at(double x, double) const override {
    const double f = std::tanh(x);
    const double c = std::cosh(std::min(std::abs(x), kSaturated));
    const double slope = 1.0 / (c * c);  // 1 - f^2 without cancellation
    return {f, slope, -2.0 * f * slope};
  }
  [[nodiscard]] double energy(double x, double) const override {
    const double a = std::abs(x);
    return a + std::log1p(std::exp(-2.0 * a)) - std::log(2.0);  // log cosh x without overflow
  }

  [[nodiscard]] int knot_count() const override { return CurveParts::tanh; }
  [[nodiscard]] Knot knot(int index, double) const override { return {std::ldexp(1.0, index), 0.0}; }

 private:
  static constexpr double kSaturated = 300.0;  ///< 1 / cosh^2 is below the least positive double beyond
};

/// f = x / (1 + |x|).
class HyperbolicCurve final : public ReactionCurve {
 public:
  [[nodiscard]] Values at(double x, double) const override {
    const double inverse = 1.0 / (1.0 + std::abs(x));
    const double slope = inverse * inverse;
    return {x * inverse, slope, std::copysign(2.0 * slope * inverse, -x)};
  }
  [[nodiscard]] double energy(double x, double) const override {
    return std::abs(x) - std::log1p(std::abs(x));
  }
  [[nodiscard]] int knot_count() const override { return CurveParts::hyperbolic; }
  [[nodiscard]] Knot knot(int index, double) const override {
    return {index == 0 ? 0.0 : std::ldexp(1.0, index - 1), 0.0};
  }
};

/// f = min(x, (x / shape)^exponent, 1) for x >= 0: the line of the initial stiffness, the power, the
/// capacity.
class PowerCurve final : public ReactionCurve {
 public:
  explicit PowerCurve(double exponent) : exponent_(exponent) {}

  [[nodiscard]] Values at(double x, double shape) const override {
    const double a = std::abs(x);
    const auto [elastic, full] = ends(shape);
    if (a <= elastic) return {x, 1.0, 0.0};
    if (a >= full) return {std::copysign(1.0, x), 0.0, 0.0};
    const double f = std::pow(a / shape, exponent_);
    const double slope = exponent_ * f / a;
    return {std::copysign(f, x), slope, (exponent_ - 1.0) * slope / x};
  }
  [[nodiscard]] double energy(double x, double shape) const override {
    const double a = std::abs(x);
    const auto [elastic, full] = ends(shape);
    const double first = std::min(a, elastic);
    double sum = 0.5 * first * first;
    const auto integral = [&](double z) { return z * std::pow(z / shape, exponent_) / (1.0 + exponent_); };
    if (a > elastic) sum += integral(std::min(a, full)) - integral(elastic);
    return a > full ? sum + a - full : sum;
  }
  [[nodiscard]] int knot_count() const override { return CurveParts::power; }
  [[nodiscard]] Knot knot(int index, double shape) const override {
    const auto [elastic, full] = ends(shape);
    if (elastic == full) return {full, index + 1 == CurveParts::power ? -1.0 : 0.0};
    if (index == 0) return {elastic, exponent_ - 1.0};
    const double x = index + 1 == CurveParts::power ? full : std::ldexp(elastic, index);
    return {std::min(x, full), index + 1 == CurveParts::power ? -exponent_ / full : 0.0};
  }

 private:
  /// Ends of the line and of the power: x = (x / shape)^n, and x = shape; both 1 where the line reaches the
  /// capacity first.
  [[nodiscard]] std::array<double, 2> ends(double shape) const {
    if (shape <= 1.0) return {1.0, 1.0};
    return {std::pow(shape, -exponent_ / (1.0 - exponent_)), shape};
  }

  double exponent_;
};

/// Curve through a table, constant beyond its last point: a cubic between neighbouring points. x and f are
/// the table's w and p over scales that make f'(0) = 1 and the largest f one.
class TableCurve final : public ReactionCurve {
 public:
  explicit TableCurve(const ReactionLaw& law) {
    CurvePoints points = with_origin(law.points);
    const double stiffness = initial_slope(law);
    const bool is_smooth = law.interpolation == ReactionLaw::Interpolation::monotone_cubic;
    std::vector<double> slopes = is_smooth ? cubic_slopes(points) : std::vector<double>();
    for (double& slope : slopes) slope /= stiffness;
    double capacity = 0.0;
    for (const auto& point : points) capacity = std::max(capacity, point[1]);
    for (auto& [w, p] : points) {
      w *= stiffness / capacity;
      p /= capacity;
    }
    curve_ = PiecewiseCubic(std::move(points), slopes);
  }

  [[nodiscard]] Values at(double x, double) const override {
    const double a = std::abs(x);
    const auto [last, force] = curve_.points().back();
    if (a >= last) return {std::copysign(force, x), 0.0, 0.0};
    const PiecewiseCubic::Values f = curve_.at(a);
    return {std::copysign(f.value, x), f.slope, std::copysign(1.0, x) * f.second};
  }
  [[nodiscard]] double energy(double x, double) const override {
    const double a = std::abs(x);
    const auto [last, force] = curve_.points().back();
    return a >= last ? curve_.whole_integral() + (a - last) * force : curve_.integral_to(a);
  }
  [[nodiscard]] int knot_count() const override { return static_cast<int>(curve_.points().size()); }
  [[nodiscard]] Knot knot(int index, double) const override {
    const auto i = static_cast<std::size_t>(index);
    const bool is_last = index + 1 == knot_count();
    return {curve_.points()[i][0], is_last ? -curve_.last_slope() : curve_.slope_change(i)};
  }
  [[nodiscard]] double peak() const override {
    const CurvePoints& points = curve_.points();
    for (std::size_t i = 0; i + 1 < points.size(); ++i)
      if (points[i + 1][1] < points[i][1]) return points[i][0];
    return ReactionCurve::peak();
  }

 private:
  PiecewiseCubic curve_;
};

}  // namespace

double initial_slope(const ReactionLaw& law) {
  const CurvePoints points = with_origin(law.points);
  if (points.size() < 2) return 0.0;
  return law.interpolation == ReactionLaw::Interpolation::linear ? points[1][1] / points[1][0]
                                                                 : cubic_slopes(points)[0];
}

std::shared_ptr<const ReactionCurve> curve_of(const ReactionLaw& law) {
  switch (law.type) {
    case ReactionLaw::Type::linear:
      return nullptr;
    case ReactionLaw::Type::tanh:
      return std::make_shared<TanhCurve>();
    case ReactionLaw::Type::hyperbolic:
      return std::make_shared<HyperbolicCurve>();
    case ReactionLaw::Type::power:
      return std::make_shared<PowerCurve>(law.exponent);
    case ReactionLaw::Type::table:
      return std::make_shared<TableCurve>(law);
  }
  return nullptr;
}

}  // namespace snapthrough
