#include "solver/geometry/axis_curve.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <numbers>
#include <utility>

#include "solver/geometry/cubic_spline.h"
#include "solver/numeric/gauss_rule.h"
#include "solver/numeric/work_limit.h"

namespace snapthrough {
namespace {

/// Numbers of the table of arc lengths. Chosen for twelve Gauss points per interval.
struct LengthTable {
  static constexpr int rows = 64;  ///< for a parabola, and for a half-wave
  /// Rows for a piece of a spline. Lengths are then exact to 1e-12 for points with turns of up to 150 degrees
  /// and distances of 0.3 to 1.7, compared with 256 rows.
  static constexpr int spline_rows = 8;
  /// Newton step, a parameter, at which the remaining error, about its square, is below rounding.
  static constexpr double last_step = 1e-9;
};

/// Chord frame: point(xi, eta) = start + xi * chord + eta * left normal of the chord.
struct Chord {
  std::array<double, 2> start;
  std::array<double, 2> vector;
  std::array<double, 2> normal;
};

Chord chord_of(std::array<double, 2> a, std::array<double, 2> b) {
  const double dx = b[0] - a[0];
  const double dy = b[1] - a[1];
  const double length = std::hypot(dx, dy);
  return {a, {dx, dy}, {-dy / length, dx / length}};
}

std::array<double, 2> unit(const std::array<double, 2>& v) {
  const double size = std::hypot(v[0], v[1]);
  return {v[0] / size, v[1] / size};
}

/// Splines of x and y over cumulative chord length, through start, interior points and end.
struct PlaneSpline {
  CubicSpline x;
  CubicSpline y;
  std::vector<double> t;  ///< parameters of all points, from 0 to 1
};

PlaneSpline spline_through(const PointsCurve& curve, std::array<double, 2> start, std::array<double, 2> end) {
  std::vector<std::array<double, 2>> all{start};
  all.insert(all.end(), curve.points.begin(), curve.points.end());
  all.push_back(end);
  std::vector<double> t{0.0};
  std::vector<double> x{start[0]};
  std::vector<double> y{start[1]};
  for (std::size_t i = 1; i < all.size(); ++i) {
    t.push_back(t.back() + std::hypot(all[i][0] - all[i - 1][0], all[i][1] - all[i - 1][1]));
    x.push_back(all[i][0]);
    y.push_back(all[i][1]);
  }
  for (double& value : t) value /= t.back();
  return {CubicSpline(t, x), CubicSpline(t, y), t};
}

/// Cubic Hermite interpolant on [0, 1] from 0 to `rise` with given end slopes.
double cubic(double u, double rise, double slope0, double slope1) {
  return u * (slope0 + u * (3.0 * rise - 2.0 * slope0 - slope1 + u * (slope0 + slope1 - 2.0 * rise)));
}

}  // namespace

/// |d(x, y) / dt|; model dimensions are far from overflow, so that hypot() is not needed.
double AxisCurve::speed_of(const Jet& j) { return std::sqrt(j.dx * j.dx + j.dy * j.dy); }

AxisCurve::AxisCurve(const Curve& curve, std::array<double, 2> start, std::array<double, 2> end) {
  const Chord chord = chord_of(start, end);
  const double chord_length = std::hypot(chord.vector[0], chord.vector[1]);
  start_ = start;
  start_angle_ = std::atan2(chord.vector[1], chord.vector[0]);
  length_ = chord_length;
  straight_ = std::holds_alternative<LineCurve>(curve);
  if (const auto* arc = std::get_if<ArcCurve>(&curve)) {
    const double sweep = arc->sweep_degrees * std::numbers::pi / 180.0;
    const double radius = chord_length / (2.0 * std::sin(0.5 * std::abs(sweep)));
    length_ = radius * std::abs(sweep);
    curvature_ = sweep / length_;
    start_angle_ -= 0.5 * sweep;
  } else if (const auto* parabola = std::get_if<ParabolaCurve>(&curve)) {
    const double rise = parabola->rise;
    const std::array<double, 2> n = parabola->direction ? unit(*parabola->direction) : chord.normal;
    set_parametric(
        [chord, rise, n](double t) {
          const double eta = 4.0 * rise * t * (1.0 - t);
          const double d = 4.0 * rise * (1.0 - 2.0 * t);
          return Jet{chord.start[0] + t * chord.vector[0] + eta * n[0],
                     chord.start[1] + t * chord.vector[1] + eta * n[1],
                     chord.vector[0] + d * n[0],
                     chord.vector[1] + d * n[1],
                     -8.0 * rise * n[0],
                     -8.0 * rise * n[1]};
        },
        {0.0, 1.0}, LengthTable::rows);
  } else if (const auto* sine = std::get_if<SineCurve>(&curve)) {
    set_sine(*sine, start, end);
  } else if (const auto* points = std::get_if<PointsCurve>(&curve)) {
    set_spline(*points, start, end);
  }
}

/// The table has the first half-wave alone: the others have its lengths.
void AxisCurve::set_sine(const SineCurve& sine, std::array<double, 2> start, std::array<double, 2> end) {
  const Chord chord = chord_of(start, end);
  const double rise = sine.rise;
  const double w = sine.half_waves * std::numbers::pi;
  waves_ = sine.half_waves;
  set_parametric(
      [chord, rise, w](double t) {
        const double eta = rise * std::sin(w * t);
        const double d = rise * w * std::cos(w * t);
        const double dd = -w * w * eta;
        const auto& n = chord.normal;
        return Jet{chord.start[0] + t * chord.vector[0] + eta * n[0],
                   chord.start[1] + t * chord.vector[1] + eta * n[1],
                   chord.vector[0] + d * n[0],
                   chord.vector[1] + d * n[1],
                   dd * n[0],
                   dd * n[1]};
      },
      {0.0, 1.0 / sine.half_waves}, LengthTable::rows);
}

void AxisCurve::set_spline(const PointsCurve& curve, std::array<double, 2> start, std::array<double, 2> end) {
  auto spline = std::make_shared<const PlaneSpline>(spline_through(curve, start, end));
  set_parametric(
      [spline](double t) {
        const auto x = spline->x.at(t);
        const auto y = spline->y.at(t);
        return Jet{x[0], y[0], x[1], y[1], x[2], y[2]};
      },
      spline->t, LengthTable::spline_rows);
  // not-a-knot: the first and the last interior point are no knots
  for (std::size_t i = 2; i + 2 < pieces_.size(); ++i) knots_.push_back(table_s_[i * rows_]);
}

void AxisCurve::set_parametric(std::function<Jet(double)> jet, std::vector<double> pieces, int rows) {
  jet_ = std::move(jet);
  pieces_ = std::move(pieces);
  rows_ = static_cast<std::size_t>(rows);
  const Quadrature gauss = gauss_legendre(12);
  table_s_.assign(1, 0.0);
  Jet j = jet_(0.0);
  table_angle_.assign(1, std::atan2(j.dy, j.dx));
  table_speed_.assign(1, speed_of(j));
  const std::size_t intervals = (pieces_.size() - 1) * rows_;
  for (std::size_t i = 0; i < intervals; ++i) {
    WorkLimit::poll();
    const double t0 = parameter_of(i);
    const double t1 = parameter_of(i + 1);
    double ds = 0.0;
    for (std::size_t q = 0; q < gauss.points.size(); ++q) {
      j = jet_(t0 + (t1 - t0) * gauss.points[q]);
      ds += gauss.weights[q] * (t1 - t0) * speed_of(j);
    }
    table_s_.push_back(table_s_.back() + ds);
    j = jet_(t1);
    const double turn = std::remainder(std::atan2(j.dy, j.dx) - table_angle_.back(), 2.0 * std::numbers::pi);
    table_angle_.push_back(table_angle_.back() + turn);
    table_speed_.push_back(speed_of(j));
  }
  length_ = waves_ * table_s_.back();
}

/// Parameter of a row of the table.
double AxisCurve::parameter_of(std::size_t row) const {
  const std::size_t piece = std::min(row / rows_, pieces_.size() - 2);
  const double part = static_cast<double>(row - piece * rows_) / static_cast<double>(rows_);
  return pieces_[piece] + part * (pieces_[piece + 1] - pieces_[piece]);
}

AxisCurve::InWave AxisCurve::in_wave(double s) const {
  if (waves_ == 1) return {0, s};
  const int wave = std::clamp(static_cast<int>(s / table_s_.back()), 0, waves_ - 1);
  return {wave, s - wave * table_s_.back()};
}

AxisCurve::Location AxisCurve::locate(double s) const {
  static const Quadrature gauss = gauss_legendre(12);
  const auto upper = std::upper_bound(table_s_.begin() + 1, table_s_.end() - 1, s);
  const auto i = static_cast<std::size_t>(upper - table_s_.begin()) - 1;
  const double t0 = parameter_of(i);
  const double dt = parameter_of(i + 1) - t0;
  const double rest = s - table_s_[i];
  const double whole = table_s_[i + 1] - table_s_[i];
  double t = t0 + cubic(rest / whole, dt, whole / table_speed_[i], whole / table_speed_[i + 1]);
  for (int it = 0; it < 20; ++it) {
    double length = 0.0;
    for (std::size_t q = 0; q < gauss.points.size(); ++q) {
      const Jet j = jet_(t0 + (t - t0) * gauss.points[q]);
      length += (t - t0) * gauss.weights[q] * speed_of(j);
    }
    const Jet j = jet_(t);
    const double step = (length - rest) / speed_of(j);
    t -= step;
    if (std::abs(step) < LengthTable::last_step) break;
  }
  return {i, t};
}

double AxisCurve::turning(double from, double to) const {
  if (!jet_) return std::abs(curvature_) * (to - from);
  const InWave first = in_wave(from);
  const InWave last = in_wave(to);
  if (first.wave == last.wave) return turning_in_wave(first.s, last.s);
  const double wave = table_s_.back();
  return turning_in_wave(first.s, wave) + (last.wave - first.wave - 1) * turning_in_wave(0.0, wave) +
         turning_in_wave(0.0, last.s);
}

/// Total rotation between two arc lengths in the first wave.
double AxisCurve::turning_in_wave(double from, double to) const {
  double angle = at(from).angle;
  double sum = 0.0;
  const auto turn_to = [&](double next) {
    sum += std::abs(next - angle);
    angle = next;
  };
  const auto after = std::upper_bound(table_s_.begin(), table_s_.end(), from);
  for (auto i = static_cast<std::size_t>(after - table_s_.begin()); i < table_s_.size() && table_s_[i] < to;
       ++i)
    turn_to(table_angle_[i]);
  turn_to(at(to).angle);
  return sum;
}

double AxisCurve::angle_at(double s) const { return jet_ ? at(s).angle : start_angle_ + curvature_ * s; }

AxisPoint AxisCurve::at(double s) const {
  if (jet_) {
    const InWave place = in_wave(s);
    const Location found = locate(place.s);
    const Jet j = jet_(place.wave * pieces_.back() + found.t);
    // an odd wave has the slopes of the first one with the other sign
    const double table = table_angle_[found.row];
    const double near = place.wave % 2 == 0 ? table : 2.0 * start_angle_ - table;
    const double angle = near + std::remainder(std::atan2(j.dy, j.dx) - near, 2.0 * std::numbers::pi);
    const double speed = speed_of(j);
    return {j.x, j.y, angle, (j.dx * j.ddy - j.dy * j.ddx) / (speed * speed * speed)};
  }
  const double angle = start_angle_ + curvature_ * s;
  // chord of the part [0, s]: length s sinc(turn / 2) in the direction of the mean angle
  const double half_turn = 0.5 * curvature_ * s;
  const double sinc =
      std::abs(half_turn) < 1e-4 ? 1.0 - half_turn * half_turn / 6.0 : std::sin(half_turn) / half_turn;
  const double mean = start_angle_ + half_turn;
  return {start_[0] + s * sinc * std::cos(mean), start_[1] + s * sinc * std::sin(mean), angle, curvature_};
}

}  // namespace snapthrough
