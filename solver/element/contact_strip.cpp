#include "solver/element/contact_strip.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>

namespace snapthrough {

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
    const double z = 0.5 - 0.5 * std::cos(std::numbers::pi * i / (count - 1));
    samples_.push_back(sample_at(i + 1 == count ? range_[1] : range_[0] + z * (range_[1] - range_[0])));
  }
}

ContactStrip::Sample ContactStrip::sample_at(double xi) const {
  Sample out;
  out.xi = xi;
  out.direction = direction_at(xi);
  rule_->integrals_at(xi, std::span(out.a).first(rule_->order()));
  rule_->values_at(xi, std::span(out.rate).first(rule_->order()));
  if (direction_.axis) {
    const double turning = direction_.ds * direction_.axis->at(direction_.s0 + xi * direction_.ds).curvature;
    out.turning = {-turning * out.direction[1], turning * out.direction[0]};
  }
  return out;
}

/// d g / d xi.
double ContactStrip::slope_at(const Sample& sample, const Shape& shape) {
  double ux = shape.ua[0];
  double uy = shape.ua[1];
  double along_x = 0.0;
  double along_y = 0.0;
  for (std::size_t r = 0; r < shape.dx.size(); ++r) {
    ux += sample.a[r] * shape.dx[r];
    uy += sample.a[r] * shape.dy[r];
    along_x += sample.rate[r] * shape.dx[r];
    along_y += sample.rate[r] * shape.dy[r];
  }
  return along_x * sample.direction[0] + along_y * sample.direction[1] + ux * sample.turning[0] +
         uy * sample.turning[1];
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

double ContactStrip::root_between(double lo, double g_lo, double hi, double g_hi, const Shape& shape) const {
  // Illinois' variant of false position: keeps the bracket, converges faster than linearly
  int last = 0;
  for (int it = 0; it < 60; ++it) {
    const double x = hi - g_hi * (hi - lo) / (g_hi - g_lo);
    if (hi - lo < 1e-15 || x <= lo || x >= hi) break;
    const double g = penetration(x, shape.ua, shape.dx, shape.dy);
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

ContactStrip::Place ContactStrip::place_at(double xi, const Shape& shape) const {
  return {sample_at(xi), penetration(xi, shape.ua, shape.dx, shape.dy)};
}

/// A place between two where g has one sign, with the other sign, if g turns back there; the value has the
/// first sign when there is none.
std::array<double, 2> ContactStrip::dip_between(Place left, Place right, const Shape& shape) const {
  constexpr int kMostTrials = 20;
  const double sign = left.g > 0.0 ? 1.0 : -1.0;
  const std::array<double, 2> none{left.sample.xi, left.g};
  double fall = sign * slope_at(left.sample, shape);
  double rise = sign * slope_at(right.sample, shape);
  for (int n = 0; n < kMostTrials && fall < 0.0 && rise > 0.0; ++n) {
    // what is convex stays above both tangents
    const double width = right.sample.xi - left.sample.xi;
    const double meet = (sign * (right.g - left.g) - rise * width) / (fall - rise);
    if (sign * left.g + fall * meet > 0.0) break;
    const double share = std::clamp(-fall / (rise - fall), 0.1, 0.9);
    const Place middle = place_at(left.sample.xi + share * width, shape);
    if (sign * middle.g <= 0.0) return {middle.sample.xi, middle.g};
    const double slope = sign * slope_at(middle.sample, shape);
    (slope < 0.0 ? left : right) = middle;
    (slope < 0.0 ? fall : rise) = slope;
  }
  return none;
}

/// Tells `cross(place, whether contact begins there)` of the changes of sign between two places.
template <class Cross>
void ContactStrip::search_cell(const Place& left, const Place& right, const Shape& shape,
                               const Cross& cross) const {
  const double x0 = left.sample.xi;
  const double x1 = right.sample.xi;
  const bool inside = left.g > 0.0;
  if (inside != (right.g > 0.0)) {
    cross(root_between(x0, left.g, x1, right.g, shape), !inside);
    return;
  }
  const auto [xv, gv] = dip_between(left, right, shape);
  if ((gv > 0.0) == inside) return;
  cross(root_between(x0, left.g, xv, gv, shape), !inside);
  cross(root_between(xv, gv, x1, right.g, shape), inside);
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
  const Shape shape{ua, dx, dy};
  const auto rate = [&](std::size_t k) {
    return std::abs(g[k + 1] - g[k]) / (samples_[k + 1].xi - samples_[k].xi);
  };
  for (std::size_t i = 0; i + 1 < n; ++i) {
    const double width = samples_[i + 1].xi - samples_[i].xi;
    const double steepest = std::max({i > 0 ? rate(i - 1) : 0.0, rate(i), i + 2 < n ? rate(i + 1) : 0.0});
    if ((g[i] > 0.0) == (g[i + 1] > 0.0) && std::min(std::abs(g[i]), std::abs(g[i + 1])) > steepest * width)
      continue;
    // zones smaller than the sampling may begin and end here
    constexpr int kParts = 4;
    Place left{samples_[i], g[i]};
    for (int part = 1; part <= kParts; ++part) {
      const Place right = part == kParts ? Place{samples_[i + 1], g[i + 1]}
                                         : place_at(samples_[i].xi + width * part / kParts, shape);
      search_cell(left, right, shape, cross);
      left = right;
    }
  }
  if (g[n - 1] > 0.0) out.push_back({from, range_[1]});
}

}  // namespace snapthrough
