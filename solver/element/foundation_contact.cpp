#include "solver/element/foundation_contact.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>
#include <utility>

#include "solver/numeric/chebyshev_series.h"
#include "solver/numeric/cubic.h"
#include "solver/numeric/max_order.h"
#include "solver/numeric/rounding.h"

namespace snapthrough {
namespace {

/// Search of zones of contact within one element. Source: docs/decisions/0022.
struct ContactSearch {
  static constexpr int least_samples = 13;  ///< samples on a curved axis at least: they resolve its rotation
  static constexpr int parts = 4;           ///< parts of a cell between two samples
  static constexpr int dip_trials = 20;     ///< points at most in the search of a minimum
  static constexpr double zero = 1e-10;     ///< |g| that is rounding, over |g| at the other end of a part
  static constexpr double vanishing = 1e-12;  ///< number of a law that counts as zero, over its largest value
};

}  // namespace

FoundationContact::FoundationContact(int order, const FoundationLaw& law, Place place,
                                     std::array<double, 2> range, int foundation)
    : rule_(&CollocationRule::of(order)),
      foundation_law_(law),
      place_(std::move(place)),
      range_(range),
      law_(law.law),
      ground_(law.ground_under(place_.from, place_.to)),
      foundation_(foundation),
      samples_(sampled()) {
  law_.scale(place_.length);
}

const Quadrature& FoundationContact::quadrature(int order) {
  static const std::vector<Quadrature> rules = [] {
    std::vector<Quadrature> all;
    for (int p = 1; p <= kMaxOrder; ++p) all.push_back(gauss_legendre(std::max(p + 2, 5)));
    return all;
  }();
  return rules[static_cast<std::size_t>(order - 1)];
}

namespace {

/// Positions of the samples on a range, and the A_r there and at the points of the quadrature.
/// @param turns whether the direction varies along the axis
template <class Samples>
Samples without_direction(int order, bool turns, std::array<double, 2> range) {
  const CollocationRule& rule = CollocationRule::of(order);
  Samples out;
  out.count = std::max(2 * order + 3, turns ? ContactSearch::least_samples : 0);
  out.blocks = (out.count + kLanes - 1) / kLanes;
  out.rows.assign(static_cast<std::size_t>(out.blocks) * (2 + order), Lanes::Zero());
  std::array<double, kMaxOrder> a{};
  for (int i = 0; i < out.count; ++i) {
    const bool last = i + 1 == out.count;
    out.z[i] = last ? 1.0 : 0.5 - 0.5 * std::cos(std::numbers::pi * i / (out.count - 1));
    rule.integrals_at(last ? range[1] : range[0] + out.z[i] * (range[1] - range[0]),
                      std::span(a).first(order));
    Lanes* block = &out.rows[static_cast<std::size_t>(i / kLanes) * (2 + order)];
    for (int r = 0; r < order; ++r) block[2 + r][i % kLanes] = a[r];
  }
  for (const double point : FoundationContact::quadrature(order).points) {
    rule.integrals_at(range[0] + (range[1] - range[0]) * point, std::span(a).first(order));
    out.points.insert(out.points.end(), {0.0, 0.0});
    out.points.insert(out.points.end(), a.begin(), a.begin() + order);
  }
  return out;
}

/// Positions and A_r on a whole element, made once for each order.
template <class Samples>
const Samples& on_whole_element(int order, bool turns) {
  static const auto all = [] {
    std::vector<std::array<Samples, 2>> out;
    for (int p = 1; p <= kMaxOrder; ++p)
      out.push_back({without_direction<Samples>(p, false, {0.0, 1.0}),
                     without_direction<Samples>(p, true, {0.0, 1.0})});
    return out;
  }();
  return all[static_cast<std::size_t>(order - 1)][turns ? 1 : 0];
}

}  // namespace

std::shared_ptr<const FoundationContact::Samples> FoundationContact::sampled() const {
  const auto width = std::size_t{2} + static_cast<std::size_t>(rule_->order());
  const bool whole = range_ == std::array{0.0, 1.0};
  auto out = std::make_shared<Samples>(
      whole ? on_whole_element<Samples>(rule_->order(), direction().turns)
            : without_direction<Samples>(rule_->order(), direction().turns, range_));
  const auto towards = [this](double z) { return direction_at(range_[0] + z * (range_[1] - range_[0])); };
  for (int i = 0; i < out->count; ++i) {
    const auto d = i + 1 == out->count ? direction_at(range_[1]) : towards(out->z[i]);
    for (int c = 0; c < 2; ++c)
      out->rows[static_cast<std::size_t>(i / kLanes) * width + c][i % kLanes] = d[c];
  }
  for (std::size_t i = 0; i * width < out->points.size(); ++i) {
    const auto d = towards(quadrature(rule_->order()).points[i]);
    std::copy(d.begin(), d.end(), out->points.begin() + static_cast<std::ptrdiff_t>(i * width));
  }
  for (int i = 0; foundation_law_.surface && i < out->count; ++i)
    out->axis.push_back(place_at(range_[0] + out->z[i] * (range_[1] - range_[0])).x);
  out->exact = !direction().turns || (!foundation_law_.surface && resolved(*out));
  return out;
}

/// Whether the samples resolve products of the direction and displacements of the element's degree.
bool FoundationContact::resolved(const Samples& samples) const {
  constexpr std::array<double, 5> between{0.02, 0.19, 0.41, 0.68, 0.93};  // fractions of the range
  const int degree = rule_->order();
  const auto power = [degree](double z) {
    double out = 1.0;
    for (int i = 0; i < degree; ++i) out *= z;
    return out;
  };
  std::array<std::array<double, ChebyshevSeries::kMostPoints>, 2> values{};
  for (int i = 0; i < samples.count; ++i)
    for (int c = 0; c < 2; ++c)
      values[c][i] = samples.rows[static_cast<std::size_t>(i / kLanes) * (2 + degree) + c][i % kLanes] *
                     power(samples.z[i]);
  const std::array<ChebyshevSeries, 2> series{
      ChebyshevSeries(std::span<const double>(values[0]).first(samples.count)),
      ChebyshevSeries(std::span<const double>(values[1]).first(samples.count))};
  return std::all_of(between.begin(), between.end(), [&](double z) {
    const auto exact = direction_at(range_[0] + z * (range_[1] - range_[0]));
    const auto error = [&](int c) { return std::abs(series[c].value(z) - exact[c] * power(z)); };
    return std::max(error(0), error(1)) <= Rounding::unit_component;
  });
}

FoundationContact FoundationContact::with_law(const FoundationLaw& law, int foundation) const {
  FoundationContact other = *this;
  other.foundation_law_ = law;
  other.law_ = law.law;
  other.law_.scale(place_.length);
  other.ground_ = law.ground_under(place_.from, place_.to);
  other.foundation_ = foundation;
  return other;
}

Law FoundationContact::law_at(double xi) const {
  Law law = law_;
  if (foundation_law_.variation || !foundation_law_.gap_along.empty()) {
    law = foundation_law_.at(place_.from + xi * (place_.to - place_.from));
    law.scale(place_.length);
  }
  if (foundation_law_.surface && !follows_surface()) law.gap = -penetration_at(xi, {0.0, 0.0}).depth;
  return law;
}

std::array<double, 2> FoundationContact::direction_at(double xi) const {
  if (foundation_law_.surface) return foundation_law_.surface->at(place_at(xi).x).into;
  if (!direction().turns) return direction().fixed;
  return direction().at(place_.axis->angle_at(place_.s0 + xi * place_.ds));
}

PlaceOnAxis FoundationContact::place_at(double xi) const {
  PlaceOnAxis out;
  out.fraction = place_.from + xi * (place_.to - place_.from);
  if (!foundation_law_.surface && !direction().turns) return out;
  const double s = place_.s0 + xi * place_.ds;
  if (!foundation_law_.surface) {
    out.angle = place_.axis->angle_at(s);
    return out;
  }
  const AxisPoint at = place_.axis->at(s);
  const double scale = place_.length / place_.ds;
  return {{scale * at.x, scale * at.y}, at.angle, out.fraction};
}

namespace {

/// a + sum_r weights_r (dx_r, dy_r).
std::array<double, 2> combined(std::array<double, 2> a, std::span<const double> weights,
                               std::span<const double> dx, std::span<const double> dy) {
  for (std::size_t r = 0; r < dx.size(); ++r) {
    a[0] += weights[r] * dx[r];
    a[1] += weights[r] * dy[r];
  }
  return a;
}

}  // namespace

std::array<double, 2> FoundationContact::displacement(double xi, std::array<double, 2> ua,
                                                      std::span<const double> dx,
                                                      std::span<const double> dy) const {
  std::array<double, kMaxOrder> a{};
  rule_->integrals_at(xi, std::span(a).first(dx.size()));
  return combined(ua, a, dx, dy);
}

double FoundationContact::penetration(double xi, std::array<double, 2> ua, std::span<const double> dx,
                                      std::span<const double> dy) const {
  return penetration_at(xi, displacement(xi, ua, dx, dy)).depth;
}

double FoundationContact::penetration_slope(double xi, std::array<double, 2> ua, std::span<const double> dx,
                                            std::span<const double> dy) const {
  std::array<double, kMaxOrder> l{};
  rule_->values_at(xi, std::span(l).first(dx.size()));
  const auto du = combined({0.0, 0.0}, l, dx, dy);
  if (foundation_law_.surface) return slope_to_surface(xi, displacement(xi, ua, dx, dy), du);
  const double gap = slope_at(foundation_law_.gap_along, place_.from + xi * (place_.to - place_.from)) *
                     (place_.to - place_.from);
  if (!direction().turns) return du[0] * direction().fixed[0] + du[1] * direction().fixed[1] - gap;
  const auto u = displacement(xi, ua, dx, dy);
  const AxisPoint axis = place_.axis->at(place_.s0 + xi * place_.ds);
  const auto d = direction().at(axis.angle);
  const double turn = place_.ds * axis.curvature;
  return du[0] * d[0] + du[1] * d[1] + turn * (u[1] * d[0] - u[0] * d[1]) - gap;
}

/// Slope of the depth below the surface. @param u, du displacement at xi and its derivative by xi
double FoundationContact::slope_to_surface(double xi, std::array<double, 2> u,
                                           std::array<double, 2> du) const {
  const PlaceOnAxis at = place_at(xi);
  const std::array<double, 2> dx{place_.length * std::cos(at.angle), place_.length * std::sin(at.angle)};
  if (foundation_law_.follows_surface()) {
    const auto d = foundation_law_.penetration(at, u).into;
    return d[0] * (dx[0] + du[0]) + d[1] * (dx[1] + du[1]);
  }
  const SurfacePoint initial = foundation_law_.surface->at(at.x);
  const auto d = initial.into;
  const double turn = initial.bend * (d[0] * dx[1] - d[1] * dx[0]);  // rotation of d per xi
  return d[0] * (dx[0] + du[0]) + d[1] * (dx[1] + du[1]) + turn * (d[0] * u[1] - d[1] * u[0]);
}

namespace {

/// Interpolant of the penetration samples, set up on first use because most searches need none.
class SampledGap {
 public:
  explicit SampledGap(std::span<const double> samples) : samples_(samples) {}

  [[nodiscard]] double value(double z) const { return series().value(z); }
  [[nodiscard]] double slope(double z) const { return series().slope(z); }
  [[nodiscard]] Eigen::Array4d values(const Eigen::Array4d& z) const { return series().values(z); }

 private:
  [[nodiscard]] const ChebyshevSeries& series() const {
    if (!series_) series_.emplace(samples_);
    return *series_;
  }

  std::span<const double> samples_;
  mutable std::optional<ChebyshevSeries> series_;
};

/// Penetration minus a depth, evaluated exactly, on the range scaled to [0, 1].
class ExactGap {
 public:
  ExactGap(const FoundationContact& contact, std::array<double, 2> ua, std::span<const double> dx,
           std::span<const double> dy, double depth)
      : contact_(contact), ua_(ua), dx_(dx), dy_(dy), depth_(depth) {}

  [[nodiscard]] double value(double z) const { return contact_.penetration(at(z), ua_, dx_, dy_) - depth_; }
  [[nodiscard]] double slope(double z) const {
    return (contact_.range()[1] - contact_.range()[0]) * contact_.penetration_slope(at(z), ua_, dx_, dy_);
  }
  [[nodiscard]] Eigen::Array4d values(const Eigen::Array4d& z) const {
    return {value(z[0]), value(z[1]), value(z[2]), value(z[3])};
  }

 private:
  [[nodiscard]] double at(double z) const {
    return contact_.range()[0] + z * (contact_.range()[1] - contact_.range()[0]);
  }

  const FoundationContact& contact_;
  std::array<double, 2> ua_;
  std::span<const double> dx_, dy_;
  double depth_;
};

/// Position on the range, scaled to [0, 1], with the penetration there.
struct Sample {
  double z = 0.0;
  double g = 0.0;
};

template <class Gap>
double root_between(const Gap& gap, Sample lo, Sample hi) {
  // Illinois variant of regula falsi: keeps the bracket, converges superlinearly
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

/// Position at which g has the opposite of `sign` between two positions with `sign`; empty if none exists.
template <class Gap>
std::optional<Sample> dip_between(const Gap& gap, Sample left, Sample right, double sign) {
  double fall = sign * gap.slope(left.z);
  double rise = sign * gap.slope(right.z);
  const double whole = right.z - left.z;
  // beside a clamped end, where g and its slope are zero, g is not convex
  if (const auto t = Cubic{sign * left.g, fall * whole, sign * right.g, rise * whole}.minimum()) {
    const double z = left.z + *t * whole;
    if (const Sample least{z, gap.value(z)}; sign * least.g < 0.0) return least;
  }
  for (int n = 0; n < ContactSearch::dip_trials && fall < 0.0 && rise > 0.0; ++n) {
    // a convex function stays above both end tangents
    const double width = right.z - left.z;
    const double meet = (sign * (right.g - left.g) - rise * width) / (fall - rise);
    if (sign * left.g + fall * meet > 0.0) break;
    const double share = std::clamp(-fall / (rise - fall), 0.1, 0.9);
    const double z = left.z + share * width;
    const Sample middle{z, gap.value(z)};
    if (sign * middle.g <= 0.0) return middle;
    const double slope = sign * gap.slope(z);
    (slope < 0.0 ? left : right) = middle;
    (slope < 0.0 ? fall : rise) = slope;
  }
  return std::nullopt;
}

/// Position of the sign change between two samples. Beside a fixed node g is zero up to rounding, whose sign
/// is ignored: a sign change before the node is searched for.
template <class Gap>
double change_between(const Gap& gap, const Sample& left, const Sample& right) {
  const bool to_zero = std::abs(right.g) < ContactSearch::zero * std::abs(left.g);
  const bool from_zero = std::abs(left.g) < ContactSearch::zero * std::abs(right.g);
  if (!to_zero && !from_zero) return root_between(gap, left, right);
  const Sample& far = to_zero ? left : right;
  const auto dip = dip_between(gap, left, right, far.g > 0.0 ? 1.0 : -1.0);
  if (!dip) return to_zero ? right.z : left.z;
  return to_zero ? root_between(gap, left, *dip) : root_between(gap, *dip, right);
}

/// Calls cross(position, true if contact begins there) for each sign change between two samples.
template <class Gap, class Cross>
void search_part(const Gap& gap, const Sample& left, const Sample& right, const Cross& cross) {
  const bool inside = left.g > 0.0;
  if (inside != (right.g > 0.0)) {
    cross(change_between(gap, left, right), !inside);
    return;
  }
  const auto dip = dip_between(gap, left, right, inside ? 1.0 : -1.0);
  if (!dip || (dip->g > 0.0) == inside) return;
  cross(root_between(gap, left, *dip), !inside);
  cross(root_between(gap, *dip, right), inside);
}

/// Whether g may change sign between two values: the signs differ, or the smaller |g| is at most `change`.
bool may_cross(double left, double right, double change) {
  return (left > 0.0) != (right > 0.0) || std::min(std::abs(left), std::abs(right)) <= change;
}

/// Searches a cell between two samples in four parts, to find zones smaller than the sampling.
/// @param before, after changes of g on the parts next to the cell
template <class Gap, class Cross>
void search_cell(const Gap& gap, const Sample& left, const Sample& right, double before, double after,
                 const Cross& cross) {
  constexpr int parts = ContactSearch::parts;
  const double width = right.z - left.z;
  const Eigen::Array4d z =
      left.z + width * Eigen::Array4d(1.0 / parts, 2.0 / parts, 3.0 / parts, 4.0 / parts);
  const Eigen::Array4d inner = gap.values(z);
  std::array<Sample, parts + 1> places{left, Sample{z[0], inner[0]}, Sample{z[1], inner[1]},
                                       Sample{z[2], inner[2]}, right};
  std::array<double, parts + 2> moves{before};
  for (int i = 0; i < parts; ++i) moves[i + 1] = std::abs(places[i + 1].g - places[i].g);
  moves[parts + 1] = after;
  for (int i = 0; i < parts; ++i)
    if (may_cross(places[i].g, places[i + 1].g, std::max({moves[i], moves[i + 1], moves[i + 2]})))
      search_part(gap, places[i], places[i + 1], cross);
}

}  // namespace

/// Motions along direction_at(), minus a distance, at all samples.
void FoundationContact::motions_into(std::array<double, 2> ua, std::span<const double> dx,
                                     std::span<const double> dy, double less, Values& w) const {
  const std::size_t p = dx.size();
  for (int b = 0; b < samples_->blocks; ++b) {
    const Lanes* block = &samples_->rows[static_cast<std::size_t>(b) * (2 + p)];
    Lanes ux = Lanes::Constant(ua[0]);
    Lanes uy = Lanes::Constant(ua[1]);
    for (std::size_t r = 0; r < p; ++r) {
      ux += dx[r] * block[2 + r];
      uy += dy[r] * block[2 + r];
    }
    const Lanes values = ux * block[0] + uy * block[1] - less;
    for (int i = 0; i < kLanes; ++i) w[kLanes * b + i] = values[i];
  }
}

/// Depths below the surface at all samples.
void FoundationContact::depths(std::array<double, 2> ua, std::span<const double> dx,
                               std::span<const double> dy, Values& g) const {
  const std::size_t p = dx.size();
  for (int i = 0; i < samples_->count; ++i) {
    const Lanes* block = &samples_->rows[static_cast<std::size_t>(i / kLanes) * (2 + p)];
    const int lane = i % kLanes;
    std::array<double, 2> u = ua;
    for (std::size_t r = 0; r < p; ++r) {
      u[0] += dx[r] * block[2 + r][lane];
      u[1] += dy[r] * block[2 + r][lane];
    }
    g[i] = foundation_law_.surface->at(samples_->axis[i], u).depth;
  }
}

/// Penetrations minus a depth at all samples.
void FoundationContact::penetrations(std::array<double, 2> ua, std::span<const double> dx,
                                     std::span<const double> dy, double depth, Values& g) const {
  if (follows_surface()) {
    depths(ua, dx, dy, g);
    for (int i = 0; i < samples_->count; ++i) g[i] -= depth;
    return;
  }
  const bool is_uniform = !foundation_law_.surface && foundation_law_.gap_along.empty();
  motions_into(ua, dx, dy, is_uniform ? law_.gap + depth : depth, g);
  if (is_uniform) return;
  for (int i = 0; i < samples_->count; ++i)
    g[i] -= law_at(range_[0] + samples_->z[i] * (range_[1] - range_[0])).gap;
}

void FoundationContact::append_samples(std::array<double, 2> ua, std::span<const double> dx,
                                       std::span<const double> dy, std::vector<DepthAt>& out) const {
  Values g;
  penetrations(ua, dx, dy, 0.0, g);
  for (int i = 0; i < samples_->count; ++i) {
    const bool last = i + 1 == samples_->count;
    out.push_back({last ? range_[1] : range_[0] + samples_->z[i] * (range_[1] - range_[0]), g[i]});
  }
}

void FoundationContact::pressed_intervals(std::array<double, 2> ua, std::span<const double> dx,
                                          std::span<const double> dy, double above,
                                          std::vector<Interval>& out) const {
  const auto count = static_cast<std::size_t>(samples_->count);
  const double length = (range_[1] - range_[0]) * place_.length;
  Values w;
  Values slope;
  penetrations(ua, dx, dy, -above, w);
  const ChebyshevSeries depth(std::span<const double>(w).first(count));
  for (std::size_t i = 0; i < count; ++i) slope[i] = depth.slope(samples_->z[i]) / length;
  const ChebyshevSeries slopes(std::span<const double>(slope).first(count));
  Values pressure;
  for (std::size_t i = 0; i < count; ++i)
    pressure[i] = modulus() * w[i] - shear() * slopes.slope(samples_->z[i]) / length;
  out.clear();
  search(SampledGap(std::span<const double>(pressure).first(count)), pressure, out);
}

std::array<double, 2> FoundationContact::direction_rate(double xi) const {
  if (!direction().turns) return {0.0, 0.0};
  const AxisPoint axis = place_.axis->at(place_.s0 + xi * place_.ds);
  return direction().rate(axis.angle, place_.ds * axis.curvature);
}

bool FoundationContact::is_near(std::array<double, 2> ua, std::span<const double> dx,
                                std::span<const double> dy, double distance) const {
  if (!law_.one_sided) return false;
  Values g;
  penetrations(ua, dx, dy, 0.0, g);
  return std::all_of(g.begin(), g.begin() + samples_->count,
                     [distance](double w) { return std::abs(w) <= distance; });
}

/// Finds the contact intervals from the penetration minus a depth, given its values g at the samples.
template <class Gap>
void FoundationContact::search(const Gap& gap, const Values& g, std::vector<Interval>& out) const {
  const int n = samples_->count;
  const Values& z = samples_->z;
  const double length = range_[1] - range_[0];
  double from = range_[0];
  const auto cross = [&](double place, bool entering) {
    const double at = range_[0] + length * place;
    if (entering) from = at;
    if (!entering && at > from) out.push_back({from, at});
  };
  Values rate;  // slope of g in the cell before sample i
  rate[0] = 0.0;
  for (int i = 1; i < n; ++i) rate[i] = std::abs(g[i] - g[i - 1]) / (z[i] - z[i - 1]);
  rate[n] = 0.0;
  for (int i = 0; i + 1 < n; ++i) {
    const double width = z[i + 1] - z[i];
    if (!may_cross(g[i], g[i + 1], width * std::max({rate[i], rate[i + 1], rate[i + 2]}))) continue;
    search_cell(gap, Sample{z[i], g[i]}, Sample{z[i + 1], g[i + 1]}, rate[i] * width / ContactSearch::parts,
                rate[i + 2] * width / ContactSearch::parts, cross);
  }
  if (g[n - 1] > 0.0) out.push_back({from, range_[1]});
}

void FoundationContact::contact_intervals(std::array<double, 2> ua, std::span<const double> dx,
                                          std::span<const double> dy, std::vector<Interval>& out,
                                          double depth) const {
  out.clear();
  if (!law_.one_sided) {
    out.push_back({range_[0], range_[1]});
    return;
  }
  Values g;
  penetrations(ua, dx, dy, depth, g);
  if (samples_->exact && foundation_law_.gap_along.empty())
    search(SampledGap(std::span<const double>(g).first(samples_->count)), g, out);
  else
    search(ExactGap(*this, ua, dx, dy, depth), g, out);
}

void FoundationContact::intervals_into(std::array<double, 2> ua, std::span<const double> dx,
                                       std::span<const double> dy, std::vector<Interval>& out) const {
  if (!foundation_law_.surface && foundation_law_.gap_along.empty()) {
    contact_intervals(ua, dx, dy, out, -law_.gap);
    return;
  }
  out.clear();
  Values w;
  motions_into(ua, dx, dy, 0.0, w);
  search(SampledGap(std::span<const double>(w).first(samples_->count)), w, out);
}

/// Stiffness, capacity and shape of a law at the samples. Where a number along the member vanishes, a very
/// small one stands for it, so that quotients exist.
void FoundationContact::laws_at_samples(std::array<Values, 3>& out) const {
  const double width = range_[1] - range_[0];
  for (int i = 0; i < samples_->count; ++i) {
    double stiffness = 1.0;
    double capacity = 1.0;
    if (foundation_law_.variation) {
      const double xi = range_[0] + samples_->z[i] * width;
      const double fraction = place_.from + xi * (place_.to - place_.from);
      stiffness = std::max(foundation_law_.variation->stiffness.at(fraction), ContactSearch::vanishing);
      capacity = std::max(foundation_law_.variation->capacity.at(fraction), ContactSearch::vanishing);
    }
    out[0][i] = law_.stiffness * stiffness;
    out[1][i] = law_.capacity * capacity;
    out[2][i] = law_.shape * stiffness / capacity;
  }
}

/// Appends the places at which the argument k w / P of the curve is sign times that of a knot, x: the roots
/// of k w - sign x P, which is smooth where P vanishes.
/// @param w penetrations, @param laws see laws_at_samples()
void FoundationContact::add_knot(int knot, double sign, const Values& w, const std::array<Values, 3>& laws,
                                 std::vector<KnotPlace>& out) const {
  const auto count = static_cast<std::ptrdiff_t>(samples_->count);
  const double width = range_[1] - range_[0];
  Values beyond;
  for (std::ptrdiff_t i = 0; i < count; ++i)
    beyond[i] = laws[0][i] * w[i] - sign * law_.curve->knot(knot, laws[2][i]).x * laws[1][i];
  const SampledGap gap(std::span<const double>(beyond).first(count));
  std::vector<Interval> above;
  search(gap, beyond, above);
  const auto add = [&](double xi) {
    if (xi == range_[0] || xi == range_[1]) return;
    const Law law = law_at(xi);
    if (!(law.stiffness > 0.0)) return;
    out.push_back({xi, sign * law.stiffness * law_.curve->knot(knot, law.shape).slope_change,
                   gap.slope((xi - range_[0]) / width) / (width * law.stiffness)});
  };
  for (const Interval& part : above) {
    add(part.from);
    add(part.to);
  }
}

/// Appends the places at which numbers of the law bend, for fixed meshes whose elements do not end there.
void FoundationContact::add_bends(std::vector<KnotPlace>& out) const {
  if (!foundation_law_.variation) return;
  for (const AlongMember* value :
       {&foundation_law_.variation->stiffness, &foundation_law_.variation->capacity}) {
    for (const auto& [fraction, unused] : value->points) {
      const double xi = (fraction - place_.from) / (place_.to - place_.from);
      if (xi > range_[0] && xi < range_[1]) out.push_back({xi, 0.0, 1.0});
    }
  }
}

/// Distance of the moved axis ahead of a seam, along the surface; on the range scaled to [0, 1].
class AheadOfSeam {
 public:
  AheadOfSeam(const FoundationContact& contact, std::array<double, 2> ua, std::span<const double> dx,
              std::span<const double> dy, const SurfaceSeam& seam)
      : contact_(contact), ua_(ua), dx_(dx), dy_(dy), seam_(seam) {}

  [[nodiscard]] double value(double z) const {
    const double xi = at(z);
    const auto x = contact_.place_at(xi).x;
    const auto u = contact_.displacement(xi, ua_, dx_, dy_);
    return (x[0] + u[0] - seam_.x[0]) * seam_.tangent[0] + (x[1] + u[1] - seam_.x[1]) * seam_.tangent[1];
  }
  [[nodiscard]] double slope(double z) const {
    const double xi = at(z);
    std::array<double, kMaxOrder> l{};
    contact_.rule_->values_at(xi, std::span(l).first(dx_.size()));
    const auto du = combined({0.0, 0.0}, l, dx_, dy_);
    const double angle = contact_.place_at(xi).angle;
    const double length = contact_.place_.length;
    return (contact_.range_[1] - contact_.range_[0]) *
           ((length * std::cos(angle) + du[0]) * seam_.tangent[0] +
            (length * std::sin(angle) + du[1]) * seam_.tangent[1]);
  }
  [[nodiscard]] Eigen::Array4d values(const Eigen::Array4d& z) const {
    return {value(z[0]), value(z[1]), value(z[2]), value(z[3])};
  }

 private:
  [[nodiscard]] double at(double z) const {
    return contact_.range_[0] + z * (contact_.range_[1] - contact_.range_[0]);
  }

  const FoundationContact& contact_;
  std::array<double, 2> ua_;
  std::span<const double> dx_, dy_;
  const SurfaceSeam& seam_;
};

/// Appends the places at which the axis passes a seam of the surface. The stiffness normal to the surface
/// does not change there.
void FoundationContact::add_seams(std::array<double, 2> ua, std::span<const double> dx,
                                  std::span<const double> dy, std::vector<KnotPlace>& out) const {
  std::vector<Interval> ahead;
  for (const SurfaceSeam& seam : foundation_law_.surface->seams()) {
    const AheadOfSeam gap(*this, ua, dx, dy, seam);
    Values g;
    for (int i = 0; i < samples_->count; ++i) g[i] = gap.value(samples_->z[i]);
    ahead.clear();
    search(gap, g, ahead);
    const double width = range_[1] - range_[0];
    for (const Interval& part : ahead) {
      for (const double xi : {part.from, part.to}) {
        if (xi == range_[0] || xi == range_[1]) continue;
        const SurfacePoint at = penetration_at(xi, displacement(xi, ua, dx, dy));
        const double turn = at.into[0] * seam.tangent[1] - at.into[1] * seam.tangent[0];
        out.push_back({xi, 0.0, gap.slope((xi - range_[0]) / width) / width,
                       std::copysign(1.0, turn) * seam.bend_change(at.depth)});
      }
    }
  }
}

void FoundationContact::knot_places(std::array<double, 2> ua, std::span<const double> dx,
                                    std::span<const double> dy, std::vector<KnotPlace>& out) const {
  out.clear();
  if (follows_surface()) add_seams(ua, dx, dy, out);
  if (law_.curve != nullptr) add_law_knots(ua, dx, dy, out);
  std::sort(out.begin(), out.end(), [](const KnotPlace& a, const KnotPlace& b) { return a.xi < b.xi; });
}

void FoundationContact::add_law_knots(std::array<double, 2> ua, std::span<const double> dx,
                                      std::span<const double> dy, std::vector<KnotPlace>& out) const {
  add_bends(out);
  Values w;
  Values x;
  std::array<Values, 3> laws;
  penetrations(ua, dx, dy, 0.0, w);
  laws_at_samples(laws);
  for (int i = 0; i < samples_->count; ++i) x[i] = laws[0][i] * w[i] / laws[1][i];
  const auto [least, most] = std::minmax_element(x.begin(), x.begin() + samples_->count);
  const auto ends = std::minmax_element(laws[2].begin(), laws[2].begin() + samples_->count);
  const std::array<double, 2> shapes{*ends.first, *ends.second};
  const auto places = [&](int k) {
    return std::array{law_.curve->knot(k, shapes[0]).x, law_.curve->knot(k, shapes[1]).x};
  };
  const int knots = law_.curve->knot_count();
  for (int k = 0; k < knots; ++k) {
    const auto at = places(k);
    if (k + 1 < knots && places(k + 1) == at) continue;  // one place, of which the last knot has the change
    const double low = std::min(at[0], at[1]);
    const double high = std::max(at[0], at[1]);
    if (high >= *least && low <= *most) add_knot(k, 1.0, w, laws, out);
    if (!law_.one_sided && high > 0.0 && -low >= *least && -high <= *most) add_knot(k, -1.0, w, laws, out);
  }
}

std::vector<FoundationContact::Interval> FoundationContact::smooth_pieces(std::array<double, 2> ua,
                                                                          std::span<const double> dx,
                                                                          std::span<const double> dy) const {
  std::vector<Interval> parts;
  contact_intervals(ua, dx, dy, parts);
  std::vector<KnotPlace> knots;
  knot_places(ua, dx, dy, knots);
  std::vector<Interval> out;
  const auto add = [&out](const Interval& piece) { out.push_back(piece); };
  for (const Interval& part : parts) {
    if (!is_curved())
      add(part);
    else
      for_each_half(knots, part, add);
  }
  return out;
}

}  // namespace snapthrough
