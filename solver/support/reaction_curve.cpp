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

/// Slopes of the cubic of Fritsch and Butland (SIAM J. Sci. Stat. Comput. 5 (1984) 300-304) at the points,
/// which is monotone between them: weighted harmonic means of the neighbouring chords, zero at peaks and
/// valleys. The cubic has no curvature at the first and the last point, so that a table on a line is that
/// line, and so that its odd continuation is smooth at the origin.
std::vector<double> cubic_slopes(const Points& points) {
  const std::size_t n = points.size();
  std::vector<double> out(n, 0.0);
  const auto width = [&](std::size_t i) { return points[i + 1][0] - points[i][0]; };
  const auto chord = [&](std::size_t i) { return (points[i + 1][1] - points[i][1]) / width(i); };
  for (std::size_t i = 1; i + 1 < n; ++i) {
    const double before = chord(i - 1);
    const double after = chord(i);
    const bool has_one_sense = (before > 0.0 && after > 0.0) || (before < 0.0 && after < 0.0);
    if (!has_one_sense) continue;
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

/// Curve through a table, constant beyond its last point: a cubic between neighbouring points. x and f are
/// the table's w and p over scales that make f'(0) = 1 and the largest f one.
class TableCurve final : public ReactionCurve {
 public:
  explicit TableCurve(const ReactionLaw& law) : points_(with_origin(law.points)) {
    const double stiffness = initial_slope(law);
    const bool is_smooth = law.interpolation == ReactionLaw::Interpolation::monotone_cubic;
    std::vector<double> slopes = is_smooth ? cubic_slopes(points_) : std::vector<double>();
    for (double& slope : slopes) slope /= stiffness;
    double capacity = 0.0;
    for (const auto& point : points_) capacity = std::max(capacity, point[1]);
    for (auto& [w, p] : points_) {
      w *= stiffness / capacity;
      p /= capacity;
    }
    set_pieces(slopes);
    double sum = 0.0;
    for (std::size_t i = 0; i < points_.size(); ++i) {
      if (i > 0) sum += integral(pieces_[i - 1], points_[i][0]);
      energies_.push_back(sum);
    }
  }

  [[nodiscard]] Values at(double x, double) const override {
    const double a = std::abs(x);
    if (a >= points_.back()[0]) return {std::copysign(points_.back()[1], x), 0.0, 0.0};
    const Piece& piece = pieces_[piece_at(a)];
    const double t = a - piece.from;
    return {std::copysign(piece.force + t * (piece.slope + t * (piece.second + t * piece.third)), x),
            piece.slope_at(t), std::copysign(1.0, x) * (2.0 * piece.second + 6.0 * t * piece.third)};
  }
  [[nodiscard]] double energy(double x, double) const override {
    const double a = std::abs(x);
    const auto [last, force] = points_.back();
    if (a >= last) return energies_.back() + (a - last) * force;
    const std::size_t i = piece_at(a);
    return energies_[i] + integral(pieces_[i], a);
  }
  [[nodiscard]] int knot_count() const override { return static_cast<int>(points_.size()); }
  [[nodiscard]] Knot knot(int index, double) const override {
    const auto i = static_cast<std::size_t>(index);
    return {points_[i][0], slope_changes_[i]};
  }
  [[nodiscard]] double peak() const override {
    for (std::size_t i = 0; i + 1 < points_.size(); ++i)
      if (points_[i + 1][1] < points_[i][1]) return points_[i][0];
    return ReactionCurve::peak();
  }

 private:
  /// Cubic force + slope t + second t^2 + third t^3 with t from a point on.
  struct Piece {
    double from, force, slope, second, third;
    [[nodiscard]] double slope_at(double t) const { return slope + t * (2.0 * second + 3.0 * t * third); }
  };
  /// @param slopes at the points; empty: lines between them
  void set_pieces(const std::vector<double>& slopes) {
    slope_changes_.assign(points_.size(), 0.0);
    double before = 0.0;
    for (std::size_t i = 0; i + 1 < points_.size(); ++i) {
      const double h = points_[i + 1][0] - points_[i][0];
      const double chord = (points_[i + 1][1] - points_[i][1]) / h;
      const double a = slopes.empty() ? chord : slopes[i];
      const double b = slopes.empty() ? chord : slopes[i + 1];
      if (i > 0) slope_changes_[i] = a - before;
      before = b;
      pieces_.push_back({points_[i][0], points_[i][1], a, (3.0 * chord - 2.0 * a - b) / h,
                         (a + b - 2.0 * chord) / (h * h)});
    }
    slope_changes_.back() = -before;
  }
  /// @pre 0 <= a < the last point
  [[nodiscard]] std::size_t piece_at(double a) const {
    const auto next = std::upper_bound(points_.begin(), points_.end(), a,
                                       [](double value, const auto& point) { return value < point[0]; });
    return static_cast<std::size_t>(next - points_.begin()) - 1;
  }
  [[nodiscard]] static double integral(const Piece& p, double to) {
    const double t = to - p.from;
    return t * (p.force + t * (p.slope / 2.0 + t * (p.second / 3.0 + t * p.third / 4.0)));
  }

  Points points_;
  std::vector<Piece> pieces_;          ///< between neighbouring points
  std::vector<double> slope_changes_;  ///< jump of f' at each point
  std::vector<double> energies_;       ///< integral of f up to each point
};

}  // namespace

double initial_slope(const ReactionLaw& law) {
  const Points points = with_origin(law.points);
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
