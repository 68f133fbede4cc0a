#include "solver/element/contact_strip.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>
#include <utility>

#include "solver/element/chebyshev_series.h"

namespace snapthrough {
namespace {

/// With fewer the turning of a curved axis on one element would be seen.
constexpr int kLeastSamples = 13;

}  // namespace

ContactStrip::ContactStrip(int order, Direction direction, std::array<double, 2> range, double modulus,
                           double gap, int foundation)
    : rule_(&CollocationRule::of(order)),
      direction_(std::move(direction)),
      range_(range),
      modulus_(modulus),
      gap_(gap),
      foundation_(foundation) {
  const int count = std::max(2 * order + 3, direction_.axis ? kLeastSamples : 0);
  for (int i = 0; i < count; ++i) {
    const double z = 0.5 - 0.5 * std::cos(std::numbers::pi * i / (count - 1));
    samples_.push_back(sample_at(i + 1 == count ? range_[1] : range_[0] + z * (range_[1] - range_[0])));
    samples_.back().z = i + 1 == count ? 1.0 : z;
  }
}

ContactStrip::Sample ContactStrip::sample_at(double xi) const {
  Sample out;
  out.xi = xi;
  out.direction = direction_at(xi);
  rule_->integrals_at(xi, std::span(out.a).first(rule_->order()));
  return out;
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

namespace {

/// A place of the range, from 0 to 1, with the penetration there.
struct Place {
  double z = 0.0;
  double g = 0.0;
};

double root_between(const ChebyshevSeries& gap, Place lo, Place hi) {
  // Illinois' variant of false position: keeps the bracket, converges faster than linearly
  int last = 0;
  for (int it = 0; it < 60; ++it) {
    const double z = hi.z - hi.g * (hi.z - lo.z) / (hi.g - lo.g);
    if (hi.z - lo.z < 1e-15 || z <= lo.z || z >= hi.z) break;
    const double g = gap.value(z);
    if (g == 0.0) return z;
    if ((g > 0.0) == (hi.g > 0.0)) {
      hi = {z, g};
      if (last == 1) lo.g *= 0.5;
      last = 1;
    } else {
      lo = {z, g};
      if (last == -1) hi.g *= 0.5;
      last = -1;
    }
  }
  return std::clamp(hi.z - hi.g * (hi.z - lo.z) / (hi.g - lo.g), lo.z, hi.z);
}

/// A place between two where g has one sign, with the other sign, if g turns back there; the value has the
/// first sign when there is none.
Place dip_between(const ChebyshevSeries& gap, Place left, Place right) {
  constexpr int kMostTrials = 20;
  const double sign = left.g > 0.0 ? 1.0 : -1.0;
  const Place none = left;
  double fall = sign * gap.slope(left.z);
  double rise = sign * gap.slope(right.z);
  for (int n = 0; n < kMostTrials && fall < 0.0 && rise > 0.0; ++n) {
    // what is convex stays above both tangents
    const double width = right.z - left.z;
    const double meet = (sign * (right.g - left.g) - rise * width) / (fall - rise);
    if (sign * left.g + fall * meet > 0.0) break;
    const double share = std::clamp(-fall / (rise - fall), 0.1, 0.9);
    const double z = left.z + share * width;
    const Place middle{z, gap.value(z)};
    if (sign * middle.g <= 0.0) return middle;
    const double slope = sign * gap.slope(z);
    (slope < 0.0 ? left : right) = middle;
    (slope < 0.0 ? fall : rise) = slope;
  }
  return none;
}

/// Tells `cross(place, whether contact begins there)` of the changes of sign between two places.
template <class Cross>
void search_cell(const ChebyshevSeries& gap, const Place& left, const Place& right, const Cross& cross) {
  const bool inside = left.g > 0.0;
  if (inside != (right.g > 0.0)) {
    cross(root_between(gap, left, right), !inside);
    return;
  }
  const Place dip = dip_between(gap, left, right);
  if ((dip.g > 0.0) == inside) return;
  cross(root_between(gap, left, dip), !inside);
  cross(root_between(gap, dip, right), inside);
}

}  // namespace

void ContactStrip::contact_intervals(std::array<double, 2> ua, std::span<const double> dx,
                                     std::span<const double> dy, std::vector<Interval>& out,
                                     double depth) const {
  out.clear();
  std::array<double, ChebyshevSeries::kMostPoints> g{};
  const std::size_t n = samples_.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Sample& sample = samples_[i];
    double ux = ua[0];
    double uy = ua[1];
    for (std::size_t r = 0; r < dx.size(); ++r) {
      ux += sample.a[r] * dx[r];
      uy += sample.a[r] * dy[r];
    }
    g[i] = ux * sample.direction[0] + uy * sample.direction[1] - gap_ - depth;
  }
  const double length = range_[1] - range_[0];
  double from = range_[0];
  const auto cross = [&](double z, bool entering) {
    const double at = range_[0] + length * z;
    if (entering) from = at;
    if (!entering && at > from) out.push_back({from, at});
  };
  std::array<double, ChebyshevSeries::kMostPoints> rate{};
  for (std::size_t i = 0; i + 1 < n; ++i)
    rate[i] = std::abs(g[i + 1] - g[i]) / (samples_[i + 1].z - samples_[i].z);
  std::optional<ChebyshevSeries> gap;  // the samples are Chebyshev's points: so no other places are needed
  for (std::size_t i = 0; i + 1 < n; ++i) {
    const double width = samples_[i + 1].z - samples_[i].z;
    const double steepest = std::max({i > 0 ? rate[i - 1] : 0.0, rate[i], rate[i + 1]});
    if ((g[i] > 0.0) == (g[i + 1] > 0.0) && std::min(std::abs(g[i]), std::abs(g[i + 1])) > steepest * width)
      continue;
    if (!gap) gap.emplace(std::span<const double>(g).first(n));
    // zones smaller than the sampling may begin and end here
    constexpr int kParts = 4;
    Place left{samples_[i].z, g[i]};
    for (int part = 1; part <= kParts; ++part) {
      Place right{samples_[i + 1].z, g[i + 1]};
      if (part < kParts) {
        right.z = samples_[i].z + width * part / kParts;
        right.g = gap->value(right.z);
      }
      search_cell(*gap, left, right, cross);
      left = right;
    }
  }
  if (g[n - 1] > 0.0) out.push_back({from, range_[1]});
}

}  // namespace snapthrough
