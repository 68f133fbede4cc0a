#include "solver/element/contact_strip.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>

namespace snapthrough {
namespace {

/// Abscissa of the vertex of the parabola through three points.
double parabola_vertex(double x0, double f0, double x1, double f1, double x2, double f2) {
  const double d1 = (f1 - f0) / (x1 - x0);
  const double d2 = (f2 - f1) / (x2 - x1);
  const double curvature = (d2 - d1) / (x2 - x0);
  if (curvature == 0.0) return x1;
  return std::clamp(0.5 * (x0 + x1) - 0.5 * d1 / curvature, x0, x2);
}

}  // namespace

ContactStrip::ContactStrip(int order, Direction direction, std::array<double, 2> range, double modulus,
                           double gap, int foundation)
    : rule_(&CollocationRule::of(order)),
      direction_(std::move(direction)),
      range_(range),
      modulus_(modulus),
      gap_(gap),
      foundation_(foundation) {
  const int count = 2 * order + 3;
  for (int i = 0; i < count; ++i) {
    Sample sample;
    const double z = 0.5 - 0.5 * std::cos(std::numbers::pi * i / (count - 1));
    sample.xi = i + 1 == count ? range_[1] : range_[0] + z * (range_[1] - range_[0]);
    sample.direction = direction_at(sample.xi);
    rule_->integrals_at(sample.xi, std::span(sample.a).first(order));
    samples_.push_back(sample);
  }
}

ContactStrip ContactStrip::with_gap(double gap) const {
  ContactStrip other = *this;
  other.gap_ = gap;
  return other;
}

std::array<double, 2> ContactStrip::direction_at(double xi) const {
  if (!direction_.axis) return direction_.fixed;
  const double angle = direction_.axis->at(direction_.s0 + xi * direction_.ds).angle;
  return {-direction_.sign * std::sin(angle), direction_.sign * std::cos(angle)};
}

double ContactStrip::penetration(double xi, std::array<double, 2> ua, std::span<const double> dx,
                                 std::span<const double> dy) const {
  std::array<double, kMaxOrder> a{};
  rule_->integrals_at(xi, std::span(a).first(dx.size()));
  double ux = ua[0];
  double uy = ua[1];
  for (std::size_t r = 0; r < dx.size(); ++r) {
    ux += a[r] * dx[r];
    uy += a[r] * dy[r];
  }
  const auto d = direction_at(xi);
  return ux * d[0] + uy * d[1] - gap_;
}

double ContactStrip::root_between(double lo, double g_lo, double hi, double g_hi, std::array<double, 2> ua,
                                  std::span<const double> dx, std::span<const double> dy) const {
  // Illinois' variant of false position: keeps the bracket, converges faster than linearly
  int last = 0;
  for (int it = 0; it < 60; ++it) {
    const double x = hi - g_hi * (hi - lo) / (g_hi - g_lo);
    if (hi - lo < 1e-15 || x <= lo || x >= hi) break;
    const double g = penetration(x, ua, dx, dy);
    if (g == 0.0) return x;
    if ((g > 0.0) == (g_hi > 0.0)) {
      hi = x;
      g_hi = g;
      if (last == 1) g_lo *= 0.5;
      last = 1;
    } else {
      lo = x;
      g_lo = g;
      if (last == -1) g_hi *= 0.5;
      last = -1;
    }
  }
  return std::clamp(hi - g_hi * (hi - lo) / (g_hi - g_lo), lo, hi);
}

/// The least value of toward * g near sample i, or a place where it is negative: successive parabolas, as
/// long as they may still change the sign.
std::array<double, 2> ContactStrip::extremum_near(std::size_t i, double toward, std::span<const double> g,
                                                  std::array<double, 2> ua, std::span<const double> dx,
                                                  std::span<const double> dy) const {
  constexpr int kMostRefinements = 6;
  std::array<double, 3> x{samples_[i - 1].xi, samples_[i].xi, samples_[i + 1].xi};
  std::array<double, 3> f{toward * g[i - 1], toward * g[i], toward * g[i + 1]};
  for (int it = 0; it < kMostRefinements; ++it) {
    const double xv = parabola_vertex(x[0], f[0], x[1], f[1], x[2], f[2]);
    if (xv == x[1] || xv <= x[0] || xv >= x[2]) break;
    const double fv = toward * penetration(xv, ua, dx, dy);
    const double gain = f[1] - fv;
    if (fv < f[1]) {
      (xv < x[1] ? x[2] : x[0]) = x[1];
      (xv < x[1] ? f[2] : f[0]) = f[1];
      x[1] = xv;
      f[1] = fv;
    } else {
      (xv < x[1] ? x[0] : x[2]) = xv;
      (xv < x[1] ? f[0] : f[2]) = fv;
    }
    if (f[1] < 0.0 || std::abs(gain) < 0.25 * f[1]) break;
  }
  return {x[1], toward * f[1]};
}

void ContactStrip::contact_intervals(std::array<double, 2> ua, std::span<const double> dx,
                                     std::span<const double> dy, std::vector<Interval>& out) const {
  out.clear();
  std::array<double, 2 * kMaxOrder + 3> g{};
  const std::size_t n = samples_.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Sample& sample = samples_[i];
    double ux = ua[0];
    double uy = ua[1];
    for (std::size_t r = 0; r < dx.size(); ++r) {
      ux += sample.a[r] * dx[r];
      uy += sample.a[r] * dy[r];
    }
    g[i] = ux * sample.direction[0] + uy * sample.direction[1] - gap_;
  }
  double from = range_[0];
  const auto cross = [&](double at, bool entering) {
    if (entering) from = at;
    if (!entering && at > from) out.push_back({from, at});
  };
  for (std::size_t i = 0; i + 1 < n; ++i) {
    const double x0 = samples_[i].xi;
    const double x1 = samples_[i + 1].xi;
    if ((g[i] > 0.0) != (g[i + 1] > 0.0)) {
      cross(root_between(x0, g[i], x1, g[i + 1], ua, dx, dy), g[i + 1] > 0.0);
      continue;
    }
    // no change of sign: a zone smaller than the sampling may still begin or end here, at an extremum of g
    const bool inside = g[i] > 0.0;
    const double toward = inside ? 1.0 : -1.0;
    if (i == 0 || toward * g[i] > toward * g[i - 1] || toward * g[i] > toward * g[i + 1]) continue;
    const auto [xv, gv] = extremum_near(i, toward, g, ua, dx, dy);
    if ((gv > 0.0) == inside) continue;
    const double xl = xv < x0 ? samples_[i - 1].xi : x0;
    const double gl = xv < x0 ? g[i - 1] : g[i];
    const double xr = xv < x0 ? x0 : x1;
    const double gr = xv < x0 ? g[i] : g[i + 1];
    if ((gl > 0.0) != inside || (gr > 0.0) != inside) continue;
    cross(root_between(xl, gl, xv, gv, ua, dx, dy), !inside);
    cross(root_between(xv, gv, xr, gr, ua, dx, dy), inside);
  }
  if (g[n - 1] > 0.0) out.push_back({from, range_[1]});
}

}  // namespace snapthrough
