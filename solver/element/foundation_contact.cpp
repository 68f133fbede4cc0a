#include "solver/element/foundation_contact.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>
#include <utility>

#include "solver/element/zone_search.h"
#include "solver/numeric/chebyshev_series.h"
#include "solver/numeric/cubic.h"
#include "solver/numeric/max_order.h"
#include "solver/numeric/rounding.h"

namespace snapthrough {
namespace {

/// Samples on a curved axis at least: they resolve its rotation. Source: docs/decisions/0022.
constexpr int kLeastSamples = 13;

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
  out.count = std::max(2 * order + 3, turns ? kLeastSamples : 0);
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

std::array<double, 2> FoundationContact::combined(std::array<double, 2> a, std::span<const double> weights,
                                                  std::span<const double> dx, std::span<const double> dy) {
  for (std::size_t r = 0; r < dx.size(); ++r) {
    a[0] += weights[r] * dx[r];
    a[1] += weights[r] * dy[r];
  }
  return a;
}

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
  search_zones(SampledGap(std::span<const double>(pressure).first(count)), samples_->z, pressure,
               samples_->count, range_, out);
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
    search_zones(SampledGap(std::span<const double>(g).first(samples_->count)), samples_->z, g,
                 samples_->count, range_, out);
  else
    search_zones(ExactGap(*this, ua, dx, dy, depth), samples_->z, g, samples_->count, range_, out);
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
  search_zones(SampledGap(std::span<const double>(w).first(samples_->count)), samples_->z, w, samples_->count,
               range_, out);
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
