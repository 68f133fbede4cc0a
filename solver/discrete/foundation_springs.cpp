#include "solver/discrete/foundation_springs.h"
#include "solver/numeric/max_order.h"

#include <cmath>
#include <cstddef>
#include <span>

namespace snapthrough {
namespace {

/// Spring of a foundation at a place of an element, per unit length, with its gap; for a surface that of the
/// tangent under the axis.
/// @param reader displacements of the axis relative to the ground; null: the initial axis
SupportSpring spring_at(const Structure& structure, const FoundationLaw& foundation, int element, double xi,
                        const ElementReader* reader) {
  const PlaceOnAxis at = place_on_axis(structure, element, xi);
  std::array<double, 2> u{0.0, 0.0};
  if (reader != nullptr && foundation.surface) u = {reader->displacement(xi)[0], reader->displacement(xi)[1]};
  const auto [depth, d, bend, bend_rate, size] = foundation.penetration(at, u);
  SupportSpring out = support_at(structure, element, xi, foundation.row(d));
  const MeshElement& cell = structure.mesh.elements[static_cast<std::size_t>(element)];
  out.ground = foundation.ground_under(cell.from, cell.to).at(xi);
  out.law = foundation.at(at.fraction);
  out.law.gap = d[0] * u[0] + d[1] * u[1] - depth;
  return out;
}

/// Two-sided springs at the points of a quadrature rule on a part of an element; see spring_at().
std::vector<SupportSpring> springs_on(const Structure& structure, const FoundationLaw& foundation,
                                      int element, std::array<double, 2> range, const Quadrature& rule,
                                      const ElementReader* reader) {
  std::vector<SupportSpring> out;
  out.reserve(rule.points.size());
  const double width = range[1] - range[0];
  for (std::size_t i = 0; i < rule.points.size(); ++i) {
    out.push_back(spring_at(structure, foundation, element, range[0] + width * rule.points[i], reader));
    Law& law = out.back().law;
    law.one_sided = false;
    law.scale(length_of_element(structure, element));
    law.scale(width);
    law.scale(rule.weights[i]);
  }
  return out;
}

/// Springs at the Lobatto points of the whole element that lie in the range.
std::vector<SupportSpring> lumped_springs(const Structure& structure, const FoundationLaw& foundation,
                                          int element, std::array<double, 2> range) {
  const Quadrature lobatto = gauss_lobatto(structure.mesh.order + 1);
  std::vector<SupportSpring> out;
  for (std::size_t i = 0; i < lobatto.points.size(); ++i) {
    const double xi = lobatto.points[i];
    if (xi < range[0] - kOnePlace || xi > range[1] + kOnePlace) continue;
    out.push_back(spring_at(structure, foundation, element, xi, nullptr));
    out.back().law.scale(length_of_element(structure, element));
    out.back().law.scale(lobatto.weights[i]);
  }
  return out;
}

}  // namespace

SupportSpring support_at(const Structure& structure, int element, double xi, std::array<double, 3> row) {
  const int p = structure.mesh.order;
  std::array<double, kMaxOrder> a{};
  CollocationRule::of(p).integrals_at(xi, std::span(a).first(p));
  SupportSpring support;
  support.element = element;
  support.a = row;
  support.v.reserve(static_cast<std::size_t>(p));
  const double h = length_of_element(structure, element);
  for (int q = 0; q < p; ++q) support.v.push_back({h * a[q] * row[0], h * a[q] * row[1], h * a[q] * row[2]});
  return support;
}

AxisPoint axis_point(const Structure& structure, int element, double xi) {
  const MeshElement& e = structure.mesh.elements[element];
  const AxisCurve& axis = *structure.axes[e.member];
  return axis.at(axis.length() * (e.from + xi * (e.to - e.from)));
}

PlaceOnAxis place_on_axis(const Structure& structure, int element, double xi) {
  const MeshElement& e = structure.mesh.elements[element];
  const AxisPoint at = axis_point(structure, element, xi);
  return {{structure.scales.scaled_length(at.x), structure.scales.scaled_length(at.y)},
          at.angle,
          e.from + xi * (e.to - e.from)};
}

std::vector<SupportSpring> winkler_springs(const Structure& structure, const FoundationLaw& foundation,
                                           int element, std::array<double, 2> range) {
  if (structure.mesh.foundation == FoundationRule::lumped)
    return lumped_springs(structure, foundation, element, range);
  return springs_on(structure, foundation, element, range, gauss_legendre(structure.mesh.order + 1), nullptr);
}

std::vector<SupportSpring> contact_springs(const Structure& structure, const FoundationLaw& foundation,
                                           const ElementReader& reader, int element,
                                           FoundationContact::Interval interval) {
  return springs_on(structure, foundation, element, {interval.from, interval.to},
                    FoundationContact::quadrature(structure.mesh.order), &reader);
}

std::vector<SupportSpring> shear_layer_springs(const Structure& structure, const FoundationLaw& foundation,
                                               int element, std::array<double, 2> range) {
  const int p = structure.mesh.order;
  const Quadrature gauss =
      foundation.law.one_sided ? FoundationContact::quadrature(p) : gauss_legendre(p + 1);
  const double width = range[1] - range[0];
  std::vector<SupportSpring> out;
  out.reserve(gauss.points.size());
  for (std::size_t i = 0; i < gauss.points.size(); ++i) {
    const double xi = range[0] + width * gauss.points[i];
    const AxisPoint at = axis_point(structure, element, xi);
    const auto n = foundation.direction.at(at.angle);
    const auto dn = foundation.direction.rate(at.angle, structure.scales.scaled_curvature(at.curvature));
    SupportSpring support = support_at(structure, element, xi, {dn[0], dn[1], 0.0});
    std::array<double, kMaxOrder> l{};
    CollocationRule::of(p).values_at(xi, std::span(l).first(p));
    for (int q = 0; q < p; ++q)
      for (int c = 0; c < 2; ++c) support.v[q][c] += l[q] * n[c];
    support.law.stiffness =
        foundation.shear * length_of_element(structure, element) * width * gauss.weights[i];
    out.push_back(support);
  }
  return out;
}

}  // namespace snapthrough
