#include "solver/support/reaction_curve.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace snapthrough {
namespace {

using Points = std::vector<std::array<double, 2>>;

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

/// Slopes of the monotone cubic of Fritsch and Butland (SIAM J. Sci. Stat. Comput. 5 (1984) 300-304) at the
/// points: weighted harmonic means of the neighbouring chords. The cubic has no curvature at the first and
/// the last point, so that a table on a line is that line, and so that its odd continuation is smooth at the
/// origin.
std::vector<double> slopes_of(const Points& points) {
  const std::size_t n = points.size();
  std::vector<double> out(n, 0.0);
  const auto width = [&](std::size_t i) { return points[i + 1][0] - points[i][0]; };
  const auto chord = [&](std::size_t i) { return (points[i + 1][1] - points[i][1]) / width(i); };
  for (std::size_t i = 1; i + 1 < n; ++i) {
    const double before = chord(i - 1);
    const double after = chord(i);
    if (before <= 0.0 || after <= 0.0) continue;
    const double a = width(i) + 2.0 * width(i - 1);
    const double b = 2.0 * width(i) + width(i - 1);
    out[i] = (a + b) / (b / before + a / after);
  }
  if (n == 2) return {chord(0), chord(0)};
  out.front() = 0.5 * (3.0 * chord(0) - out[1]);
  out.back() = 0.5 * (3.0 * chord(n - 2) - out[n - 2]);
  return out;
}

/// Points with the origin first.
Points with_origin(Points points) {
  if (points.empty() || points.front()[0] > 0.0) points.insert(points.begin(), {0.0, 0.0});
  return points;
}

/// Monotone cubic through a table, constant beyond its last point. x and f are the table's w and p divided by
/// its first slope, so that f'(0) = 1 and the capacity is 1.
class TableCurve final : public ReactionCurve {
 public:
  explicit TableCurve(const Points& given) : points_(with_origin(given)), slopes_(slopes_of(points_)) {
    const double capacity = points_.back()[1];
    const double stiffness = slopes_[0];
    for (auto& [w, p] : points_) {
      w *= stiffness / capacity;
      p /= capacity;
    }
    for (double& slope : slopes_) slope /= stiffness;
    double sum = 0.0;
    for (std::size_t i = 0; i < points_.size(); ++i) {
      if (i > 0) sum += integral(i - 1, points_[i][0]);
      energies_.push_back(sum);
    }
  }

  [[nodiscard]] Values at(double x, double) const override {
    const double a = std::abs(x);
    if (a >= points_.back()[0]) return {std::copysign(1.0, x), 0.0, 0.0};
    const Piece piece = piece_at(a);
    const double t = a - points_[piece.index][0];
    const double force = points_[piece.index][1] + t * (piece.slope + t * (piece.second + t * piece.third));
    return {std::copysign(force, x), piece.slope + t * (2.0 * piece.second + 3.0 * t * piece.third),
            std::copysign(1.0, x) * (2.0 * piece.second + 6.0 * t * piece.third)};
  }
  [[nodiscard]] double energy(double x, double) const override {
    const double a = std::abs(x);
    const double last = points_.back()[0];
    if (a >= last) return energies_.back() + (a - last);
    const std::size_t i = piece_at(a).index;
    return energies_[i] + integral(i, a);
  }
  [[nodiscard]] int knot_count() const override { return static_cast<int>(points_.size()); }
  [[nodiscard]] Knot knot(int index, double) const override {
    const auto i = static_cast<std::size_t>(index);
    return {points_[i][0], i + 1 == points_.size() ? -slopes_[i] : 0.0};
  }

 private:
  /// Cubic p + slope t + second t^2 + third t^3 from a point on.
  struct Piece {
    std::size_t index;
    double slope, second, third;
  };
  [[nodiscard]] Piece piece(std::size_t i) const {
    const double h = points_[i + 1][0] - points_[i][0];
    const double chord = (points_[i + 1][1] - points_[i][1]) / h;
    return {i, slopes_[i], (3.0 * chord - 2.0 * slopes_[i] - slopes_[i + 1]) / h,
            (slopes_[i] + slopes_[i + 1] - 2.0 * chord) / (h * h)};
  }
  /// @pre 0 <= a < the last point
  [[nodiscard]] Piece piece_at(double a) const {
    const auto next = std::upper_bound(points_.begin(), points_.end(), a,
                                       [](double value, const auto& point) { return value < point[0]; });
    return piece(static_cast<std::size_t>(next - points_.begin()) - 1);
  }
  [[nodiscard]] double integral(std::size_t i, double to) const {
    const Piece p = piece(i);
    const double t = to - points_[i][0];
    return t * (points_[i][1] + t * (p.slope / 2.0 + t * (p.second / 3.0 + t * p.third / 4.0)));
  }

  Points points_;
  std::vector<double> slopes_;
  std::vector<double> energies_;  ///< integral of f up to each point
};

}  // namespace

double initial_slope(const std::vector<std::array<double, 2>>& points) {
  const Points all = with_origin(points);
  return all.size() < 2 ? 0.0 : slopes_of(all)[0];
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
      return std::make_shared<TableCurve>(law.points);
  }
  return nullptr;
}

}  // namespace snapthrough
