#include "solver/discrete/base_stations.h"
#include "solver/numeric/max_order.h"

#include <cmath>
#include <cstddef>
#include <span>

namespace snapthrough {
namespace {

/// The base's modulus in scaled units.
double modulus_of(const Structure& structure, const Foundation& base) {
  return base.stiffness * structure.scales.length * structure.scales.length / structure.scales.force;
}

/// Springs that read the penetration at the points of a rule on part of an element; stiffness `modulus` times
/// length.
std::vector<Station> penetration_stations(const Structure& structure, const Foundation& base, int element,
                                          std::array<double, 2> range, const Quadrature& rule,
                                          double modulus) {
  std::vector<Station> out;
  out.reserve(rule.points.size());
  const double width = range[1] - range[0];
  for (std::size_t i = 0; i < rule.points.size(); ++i) {
    const double xi = range[0] + width * rule.points[i];
    const auto d = base_direction(structure, base, element, xi);
    out.push_back(station_at(structure, element, xi, {d[0], d[1], 0.0}));
    out.back().stiffness = modulus * length_of_element(structure, element) * width * rule.weights[i];
  }
  return out;
}

/// Lobatto's points of the whole element, those in the range.
std::vector<Station> lumped_stations(const Structure& structure, const Foundation& base, int element,
                                     std::array<double, 2> range) {
  constexpr double kAtEnd = 1e-9;
  const Quadrature lobatto = gauss_lobatto(structure.mesh.order + 1);
  std::vector<Station> out;
  for (std::size_t i = 0; i < lobatto.points.size(); ++i) {
    const double xi = lobatto.points[i];
    if (xi < range[0] - kAtEnd || xi > range[1] + kAtEnd) continue;
    const auto d = base_direction(structure, base, element, xi);
    Station station = station_at(structure, element, xi, {d[0], d[1], 0.0});
    station.stiffness =
        modulus_of(structure, base) * length_of_element(structure, element) * lobatto.weights[i];
    station.gap = base.reaction == Reaction::bilateral ? 0.0 : base.gap / structure.scales.length;
    station.one_sided = base.reaction != Reaction::bilateral;
    out.push_back(station);
  }
  return out;
}

}  // namespace

Station station_at(const Structure& structure, int element, double xi, std::array<double, 3> row) {
  const int p = structure.mesh.order;
  std::array<double, kMaxOrder> a{};
  CollocationRule::of(p).integrals_at(xi, std::span(a).first(p));
  Station station;
  station.element = element;
  station.a = row;
  station.v.reserve(static_cast<std::size_t>(p));
  const double h = length_of_element(structure, element);
  for (int q = 0; q < p; ++q) station.v.push_back({h * a[q] * row[0], h * a[q] * row[1], h * a[q] * row[2]});
  return station;
}

std::array<double, 2> base_direction(const Structure& structure, const Foundation& base, int element,
                                     double xi) {
  if (base.direction) {
    const double size = std::hypot((*base.direction)[0], (*base.direction)[1]);
    const double sign = base.reaction == Reaction::tension_only ? -1.0 : 1.0;
    return {sign * (*base.direction)[0] / size, sign * (*base.direction)[1] / size};
  }
  const MeshElement& e = structure.mesh.elements[element];
  const AxisCurve& axis = *structure.axes[e.member];
  const double angle = axis.at(axis.length() * (e.from + xi * (e.to - e.from))).angle;
  const bool left = (base.side == Side::left) != (base.reaction == Reaction::tension_only);
  return left ? std::array{-std::sin(angle), std::cos(angle)} : std::array{std::sin(angle), -std::cos(angle)};
}

std::vector<Station> winkler_stations(const Structure& structure, const Foundation& base, int element,
                                      std::array<double, 2> range) {
  if (structure.mesh.foundation == FoundationRule::lumped)
    return lumped_stations(structure, base, element, range);
  return penetration_stations(structure, base, element, range, gauss_legendre(structure.mesh.order + 1),
                              modulus_of(structure, base));
}

std::vector<Station> contact_stations(const Structure& structure, const Foundation& base, int element,
                                      ContactStrip::Interval interval) {
  std::vector<Station> out =
      penetration_stations(structure, base, element, {interval.from, interval.to},
                           ContactStrip::quadrature(structure.mesh.order), modulus_of(structure, base));
  for (Station& station : out) station.gap = base.gap / structure.scales.length;
  return out;
}

std::vector<Station> shear_layer_stations(const Structure& structure, const Foundation& base, int element,
                                          std::array<double, 2> range) {
  const int p = structure.mesh.order;
  const MeshElement& e = structure.mesh.elements[element];
  const AxisCurve& axis = *structure.axes[e.member];
  const Quadrature gauss = gauss_legendre(p + 1);
  const double width = range[1] - range[0];
  std::vector<Station> out;
  out.reserve(gauss.points.size());
  for (std::size_t i = 0; i < gauss.points.size(); ++i) {
    const double xi = range[0] + width * gauss.points[i];
    const auto n = base_direction(structure, base, element, xi);
    const AxisPoint at = axis.at(axis.length() * (e.from + xi * (e.to - e.from)));
    // dn/ds of the left normal is -kappa t; n may be its negative, a fixed direction does not turn
    const double side = base.direction ? 0.0 : (base.side == Side::left ? 1.0 : -1.0);
    const double turn = -side * at.curvature * structure.scales.length;
    Station station =
        station_at(structure, element, xi, {turn * std::cos(at.angle), turn * std::sin(at.angle), 0.0});
    std::array<double, kMaxOrder> l{};
    CollocationRule::of(p).values_at(xi, std::span(l).first(p));
    for (int q = 0; q < p; ++q)
      for (int c = 0; c < 2; ++c) station.v[q][c] += l[q] * n[c];
    station.stiffness = base.shear_stiffness / structure.scales.force *
                        length_of_element(structure, element) * width * gauss.weights[i];
    out.push_back(station);
  }
  return out;
}

}  // namespace snapthrough
