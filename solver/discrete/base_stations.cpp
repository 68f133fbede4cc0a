#include "solver/discrete/base_stations.h"
#include "solver/numeric/max_order.h"

#include <cmath>
#include <cstddef>
#include <span>

namespace snapthrough {
namespace {

/// A spring that reads the penetration at a place of an element.
Station penetration_station(const Structure& structure, const FoundationLaw& base, int element, double xi) {
  const auto d = base.direction.at(axis_point(structure, element, xi).angle);
  return station_at(structure, element, xi, {d[0], d[1], 0.0});
}

/// Those at the points of a rule on part of an element, glued.
std::vector<Station> penetration_stations(const Structure& structure, const FoundationLaw& base, int element,
                                          std::array<double, 2> range, const Quadrature& rule) {
  std::vector<Station> out;
  out.reserve(rule.points.size());
  const double width = range[1] - range[0];
  for (std::size_t i = 0; i < rule.points.size(); ++i) {
    out.push_back(penetration_station(structure, base, element, range[0] + width * rule.points[i]));
    out.back().law.stiffness =
        base.law.stiffness * length_of_element(structure, element) * width * rule.weights[i];
  }
  return out;
}

/// Lobatto's points of the whole element, those in the range.
std::vector<Station> lumped_stations(const Structure& structure, const FoundationLaw& base, int element,
                                     std::array<double, 2> range) {
  constexpr double kAtEnd = 1e-9;
  const Quadrature lobatto = gauss_lobatto(structure.mesh.order + 1);
  std::vector<Station> out;
  for (std::size_t i = 0; i < lobatto.points.size(); ++i) {
    const double xi = lobatto.points[i];
    if (xi < range[0] - kAtEnd || xi > range[1] + kAtEnd) continue;
    Station station = penetration_station(structure, base, element, xi);
    station.law = base.law;
    station.law.stiffness = base.law.stiffness * length_of_element(structure, element) * lobatto.weights[i];
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

AxisPoint axis_point(const Structure& structure, int element, double xi) {
  const MeshElement& e = structure.mesh.elements[element];
  const AxisCurve& axis = *structure.axes[e.member];
  return axis.at(axis.length() * (e.from + xi * (e.to - e.from)));
}

std::vector<Station> winkler_stations(const Structure& structure, const FoundationLaw& base, int element,
                                      std::array<double, 2> range) {
  if (structure.mesh.foundation == FoundationRule::lumped)
    return lumped_stations(structure, base, element, range);
  return penetration_stations(structure, base, element, range, gauss_legendre(structure.mesh.order + 1));
}

std::vector<Station> contact_stations(const Structure& structure, const FoundationLaw& base, int element,
                                      ContactStrip::Interval interval) {
  std::vector<Station> out = penetration_stations(structure, base, element, {interval.from, interval.to},
                                                  ContactStrip::quadrature(structure.mesh.order));
  for (Station& station : out) station.law.gap = base.law.gap;
  return out;
}

std::vector<Station> shear_layer_stations(const Structure& structure, const FoundationLaw& base, int element,
                                          std::array<double, 2> range) {
  const int p = structure.mesh.order;
  const Quadrature gauss = gauss_legendre(p + 1);
  const double width = range[1] - range[0];
  std::vector<Station> out;
  out.reserve(gauss.points.size());
  for (std::size_t i = 0; i < gauss.points.size(); ++i) {
    const double xi = range[0] + width * gauss.points[i];
    const AxisPoint at = axis_point(structure, element, xi);
    const auto n = base.direction.at(at.angle);
    const auto dn = base.direction.rate(at.angle, structure.scales.scaled_curvature(at.curvature));
    Station station = station_at(structure, element, xi, {dn[0], dn[1], 0.0});
    std::array<double, kMaxOrder> l{};
    CollocationRule::of(p).values_at(xi, std::span(l).first(p));
    for (int q = 0; q < p; ++q)
      for (int c = 0; c < 2; ++c) station.v[q][c] += l[q] * n[c];
    station.law.stiffness = base.shear * length_of_element(structure, element) * width * gauss.weights[i];
    out.push_back(station);
  }
  return out;
}

}  // namespace snapthrough
