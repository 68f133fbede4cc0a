#include "solver/report/section_force.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <string>
#include <variant>

namespace snapthrough {
namespace {

using Vec2 = std::array<double, 2>;

/// Part of an element that a range of member fractions covers, in the element's own [0, 1].
Vec2 part_of(const MeshElement& cell, Vec2 range) {
  const double width = cell.to - cell.from;
  return {std::clamp((range[0] - cell.from) / width, 0.0, 1.0),
          std::clamp((range[1] - cell.from) / width, 0.0, 1.0)};
}

}  // namespace

SectionForces::SectionForces(const Structure& structure, const Model& model, const Eigen::VectorXd& y,
                             double lambda, int element)
    : structure_(structure),
      model_(model),
      element_(element),
      cell_(structure.mesh.elements[element]),
      reader_(structure, y, element),
      gauss_(gauss_legendre(structure.mesh.order + 2)) {
  for (int c = 0; c < 3; ++c) end_[c] = y[structure.dofs[element].m + c];
  add_loads(lambda / structure.scales.load, 1.0);
  if (pressure_ != 0.0) release_end_of_pressure(y);
  add_bases();
  add_springs();
}

/// The multiplier goes with the area formula of the pressure (element/element_set_supports.h), which puts a
/// force on the node and its opposite on the element's end: take the latter back, so that end_ is what the
/// section carries.
void SectionForces::release_end_of_pressure(const Eigen::VectorXd& y) {
  const StressFreeAxis& axis = *structure_.stress_free[cell_.member];
  const double length = axis.perfect().length();
  const StressFreePoint from = axis.at(length * cell_.from);
  const StressFreePoint to = axis.at(length * cell_.to);
  double x = (to.x - from.x) / structure_.scales.length;
  double z = (to.y - from.y) / structure_.scales.length;
  if (structure_.geometry == Geometry::nonlinear) {
    x += y[structure_.dofs[element_].b[0]];
    z += y[structure_.dofs[element_].b[1]];
  }
  end_[0] -= 0.5 * pressure_ * z;
  end_[1] += 0.5 * pressure_ * x;
}

void SectionForces::add_loads(double proportional, double constant) {
  for (const Load& load : model_.loads) {
    const Pattern pattern = std::visit([](const auto& l) { return l.pattern; }, load);
    add_load(load, pattern == Pattern::proportional ? proportional : constant);
  }
}

void SectionForces::add_load(const Load& load, double factor) {
  const std::string& member = model_.members[cell_.member].id;
  const double F = structure_.scales.force;
  const double L = structure_.scales.length;
  if (const auto* point = std::get_if<PointLoad>(&load); point != nullptr && point->at.member == member) {
    const MeshPlace place = place_of(structure_.mesh, cell_.member, point->at.fraction);
    if (place.element == element_)
      points_.push_back(
          {place.xi,
           {factor * point->force[0] / F, factor * point->force[1] / F, factor * point->moment / (F * L)}});
  }
  if (const auto* d = std::get_if<DistributedLoad>(&load); d != nullptr && d->member == member) {
    const Vec2 range = part_of(cell_, d->range);
    if (range[1] > range[0])
      dead_.push_back({{factor * d->force[0] * L / F, factor * d->force[1] * L / F}, d->per, range});
  }
  if (const auto* p = std::get_if<PressureLoad>(&load); p != nullptr && p->member == member)
    pressure_ += (p->side == Side::left ? 1.0 : -1.0) * factor * p->value * L / F;
}

void SectionForces::add_bases() {
  for (const FoundationPart& part : structure_.foundation_parts) {
    if (part.element != element_) continue;
    const Foundation& base = model_.foundations[part.foundation];
    const double L = structure_.scales.length;
    const double modulus = base.stiffness * L * L / structure_.scales.force;
    const bool one_sided = base.reaction != Reaction::bilateral;
    Base out{part.foundation,
             modulus,
             base.shear_stiffness / structure_.scales.force,
             one_sided ? base.gap / L : 0.0,
             one_sided,
             part.range,
             {{part.range[0], part.range[1]}}};
    if (structure_.mesh.foundation == FoundationRule::lumped) {
      add_lumped(base, part.foundation, part.range, modulus);
      out.modulus = 0.0;
    }
    if (part.strip)
      part.strip->contact_intervals({reader_.start()[0], reader_.start()[1]}, reader_.gradient(0),
                                    reader_.gradient(1), out.contact);
    bases_.push_back(out);
  }
}

void SectionForces::add_lumped(const Foundation& base, int index, Vec2 range, double modulus) {
  const Quadrature lobatto = gauss_lobatto(structure_.mesh.order + 1);
  for (std::size_t i = 0; i < lobatto.points.size(); ++i) {
    const double xi = lobatto.points[i];
    if (xi < range[0] - 1e-9 || xi > range[1] + 1e-9) continue;
    const Vec2 n = base_normal(index, xi);
    const auto u = reader_.displacement(xi);
    double w = u[0] * n[0] + u[1] * n[1];
    if (base.reaction != Reaction::bilateral) w = std::max(w - base.gap / structure_.scales.length, 0.0);
    const double force = -modulus * reader_.length() * lobatto.weights[i] * w;
    points_.push_back({xi, {force * n[0], force * n[1], 0.0}});
  }
}

void SectionForces::add_springs() {
  const double F = structure_.scales.force;
  const double L = structure_.scales.length;
  for (const Spring& spring : model_.springs) {
    if (spring.at.member != model_.members[cell_.member].id) continue;
    const MeshPlace place = place_of(structure_.mesh, cell_.member, spring.at.fraction);
    if (place.element != element_) continue;
    const auto u = reader_.displacement(place.xi);
    const double sign = spring.reaction == Reaction::tension_only ? -1.0 : 1.0;
    std::array<double, 3> row{0.0, 0.0, sign};
    double stiffness = spring.stiffness / (F * L);
    double gap = spring.gap;
    if (spring.direction) {
      const double size = std::hypot((*spring.direction)[0], (*spring.direction)[1]);
      row = {sign * (*spring.direction)[0] / size, sign * (*spring.direction)[1] / size, 0.0};
      stiffness = spring.stiffness * L / F;
      gap = spring.gap / L;
    }
    double w = row[0] * u[0] + row[1] * u[1] + row[2] * u[2];
    if (spring.reaction != Reaction::bilateral) w = std::max(w - gap, 0.0);
    points_.push_back(
        {place.xi, {-stiffness * w * row[0], -stiffness * w * row[1], -stiffness * w * row[2]}});
  }
}

const AxisPoint& SectionForces::axis_at(double xi) const {
  const AxisCurve& axis = *structure_.axes[cell_.member];
  if (xi != last_xi_) last_ = axis.at(axis.length() * (cell_.from + xi * (cell_.to - cell_.from)));
  last_xi_ = xi;
  return last_;
}

Vec2 SectionForces::position(double xi) const {
  const StressFreeAxis& axis = *structure_.stress_free[cell_.member];
  const StressFreePoint p =
      axis.at(axis.perfect().length() * (cell_.from + xi * (cell_.to - cell_.from)), axis_at(xi));
  const double x = p.x / structure_.scales.length;
  const double y = p.y / structure_.scales.length;
  if (structure_.geometry == Geometry::linear) return {x, y};  // equilibrium is that of the undeformed shape
  const auto u = reader_.displacement(xi);
  return {x + u[0], y + u[1]};
}

Vec2 SectionForces::base_normal(int foundation, double xi) const {
  const Foundation& base = model_.foundations[foundation];
  const double pull = base.reaction == Reaction::tension_only ? -1.0 : 1.0;
  if (base.direction) {
    const double size = std::hypot((*base.direction)[0], (*base.direction)[1]);
    return {pull * (*base.direction)[0] / size, pull * (*base.direction)[1] / size};
  }
  const double sign = pull * (base.side == Side::left ? 1.0 : -1.0);
  const double angle = axis_at(xi).angle;
  return {-sign * std::sin(angle), sign * std::cos(angle)};
}

Vec2 SectionForces::density(double xi) const {
  Vec2 f{0.0, 0.0};
  for (const DeadLoad& load : dead_) {
    if (xi < load.range[0] || xi > load.range[1]) continue;
    double measure = 1.0;
    if (load.per == LoadMeasure::horizontal) measure = std::abs(std::cos(axis_at(xi).angle));
    if (load.per == LoadMeasure::vertical) measure = std::abs(std::sin(axis_at(xi).angle));
    for (int c = 0; c < 2; ++c) f[c] += measure * load.force[c];
  }
  const auto u = reader_.displacement(xi);
  for (const Base& base : bases_) {
    if (base.modulus == 0.0 || xi < base.range[0] || xi > base.range[1]) continue;
    const Vec2 n = base_normal(base.foundation, xi);
    double w = u[0] * n[0] + u[1] * n[1];
    if (base.one_sided) w = std::max(w - base.gap, 0.0);
    for (int c = 0; c < 2; ++c) f[c] -= base.modulus * w * n[c];
  }
  return f;
}

/// G w' of a shear layer.
double SectionForces::shear_layer(const Base& base, double xi) const {
  const Vec2 n = base_normal(base.foundation, xi);
  const auto u = reader_.displacement(xi);
  const auto du = reader_.derivative(xi);
  double slope = du[0] * n[0] + du[1] * n[1];
  if (!model_.foundations[base.foundation].direction) {
    const AxisPoint& at = axis_at(xi);
    const double turn = at.curvature * structure_.scales.length;
    const double sign = model_.foundations[base.foundation].side == Side::left ? 1.0 : -1.0;
    slope -= sign * turn * (u[0] * std::cos(at.angle) + u[1] * std::sin(at.angle));
  }
  return base.shear * slope;
}

/// Shear layers on [from, to] of the part beyond xi: by virtual work of its rigid motions, -int G w' dw' ds.
void SectionForces::add_shear_layers(double xi, double from, double to, std::array<double, 3>& sum) const {
  const Vec2 x0 = position(xi);
  for (const Base& base : bases_) {
    if (base.shear == 0.0) continue;
    const double lo = std::max(from, base.range[0]);
    const double hi = std::min(to, base.range[1]);
    for (std::size_t i = 0; lo < hi && i < gauss_.points.size(); ++i) {
      const double at = lo + (hi - lo) * gauss_.points[i];
      const double force = shear_layer(base, at) * gauss_.weights[i] * (hi - lo) * reader_.length();
      const Vec2 n = base_normal(base.foundation, at);
      const AxisPoint p = axis_at(at);
      const double side = model_.foundations[base.foundation].direction
                              ? 0.0
                              : (model_.foundations[base.foundation].side == Side::left ? 1.0 : -1.0);
      const double turn = -side * p.curvature * structure_.scales.length;
      const Vec2 dn{turn * std::cos(p.angle), turn * std::sin(p.angle)};
      const Vec2 x = position(at);
      const auto du =
          structure_.geometry == Geometry::linear ? std::array{0.0, 0.0, 0.0} : reader_.derivative(at);
      const Vec2 slope{std::cos(p.angle) + du[0], std::sin(p.angle) + du[1]};
      sum[0] -= force * dn[0];
      sum[1] -= force * dn[1];
      sum[2] -=
          force * (-n[0] * slope[1] + n[1] * slope[0] - dn[0] * (x[1] - x0[1]) + dn[1] * (x[0] - x0[0]));
    }
  }
}

std::vector<double> SectionForces::breaks_beyond(double xi) const {
  std::vector<double> breaks{xi, 1.0};
  const auto add = [&breaks, xi](double at) {
    if (at > xi && at < 1.0) breaks.push_back(at);
  };
  for (const DeadLoad& load : dead_)
    for (const double at : load.range) add(at);
  for (const Base& base : bases_) {
    for (const double at : base.range) add(at);
    for (const auto& interval : base.contact) {
      add(interval.from);
      add(interval.to);
    }
  }
  std::sort(breaks.begin(), breaks.end());
  return breaks;
}

std::array<double, 3> SectionForces::at(double xi) const {
  const Vec2 x0 = position(xi);
  const Vec2 xb = position(1.0);
  std::array<double, 3> sum = end_;
  sum[2] += (xb[0] - x0[0]) * end_[1] - (xb[1] - x0[1]) * end_[0];
  const auto add = [&sum, &x0](const Vec2& x, double fx, double fy) {
    sum[0] += fx;
    sum[1] += fy;
    sum[2] += (x[0] - x0[0]) * fy - (x[1] - x0[1]) * fx;
  };
  for (const PointAction& point : points_) {
    if (point.xi < xi || (point.xi == xi && xi < 1.0)) continue;
    add(position(point.xi), point.action[0], point.action[1]);
    sum[2] += point.action[2];
  }
  if (pressure_ !=
      0.0) {  // int (y', -x') ds and its moment about x0 are exact: the chord, and half its square
    const double dx = xb[0] - x0[0];
    const double dy = xb[1] - x0[1];
    sum[0] += pressure_ * dy;
    sum[1] -= pressure_ * dx;
    sum[2] -= 0.5 * pressure_ * (dx * dx + dy * dy);
  }
  const std::vector<double> breaks = breaks_beyond(xi);
  for (std::size_t b = 0; b + 1 < breaks.size() && (!dead_.empty() || !bases_.empty()); ++b) {
    const double width = breaks[b + 1] - breaks[b];
    for (std::size_t i = 0; i < gauss_.points.size(); ++i) {
      const double at = breaks[b] + width * gauss_.points[i];
      const Vec2 f = density(at);
      const double ds = width * gauss_.weights[i] * reader_.length();
      add(position(at), ds * f[0], ds * f[1]);
    }
    add_shear_layers(xi, breaks[b], breaks[b + 1], sum);
  }
  for (const Base& base : bases_) {
    if (base.shear == 0.0 || xi < base.range[0] || xi > base.range[1]) continue;
    const Vec2 n = base_normal(base.foundation, xi);
    const double cut = shear_layer(base, xi);
    sum[0] -= cut * n[0];
    sum[1] -= cut * n[1];
  }
  return sum;
}

}  // namespace snapthrough
