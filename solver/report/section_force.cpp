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

}  // namespace

SectionForces::SectionForces(const Structure& structure, const Eigen::VectorXd& y, double lambda,
                             const std::vector<LayerState>& layers, int element)
    : structure_(structure),
      model_(*structure.model),
      element_(element),
      cell_(structure.mesh.elements[element]),
      reader_(structure, y, element),
      gauss_(gauss_legendre(structure.mesh.order + 2)) {
  for (int c = 0; c < 3; ++c) end_[c] = y[structure.dofs[element].m + c];
  add_loads(y, lambda / structure.scales.load, 1.0);
  if (pressure_.acts()) release_end_of_pressure(y);
  add_foundations(y, layers);
  add_springs(y);
}

/// Corrects end_ for follower pressure. The pressure's area formula (element/element_work_supports.h) adds a
/// force on the node and its opposite on the element end; removing the latter leaves the section force.
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
  end_[0] -= 0.5 * pressure_.at(1.0) * z;
  end_[1] += 0.5 * pressure_.at(1.0) * x;
}

void SectionForces::add_loads(const Eigen::VectorXd& y, double proportional, double constant) {
  for (const int i : model_.actions_on_member[static_cast<std::size_t>(cell_.member)]) {
    const Action& action = model_.actions[static_cast<std::size_t>(i)];
    const double factor = action.pattern() == Pattern::proportional ? proportional : constant;
    std::visit([&](const auto& one) { add(one, y, factor); }, action.what);
  }
}

SectionForces::PointForce SectionForces::point_force(const PointAction& load, double xi,
                                                     const Eigen::VectorXd& y, double factor) const {
  const Scales& scales = structure_.scales;
  const auto displacement = [&](const std::array<double, 3>& row) {
    return structure_.geometry == Geometry::linear ? 0.0 : displacement_row(structure_, load.at, row).dot(y);
  };
  const double angle = load.follows ? displacement({0.0, 0.0, 1.0}) : 0.0;
  const Vec2 force = global_force(LoadAxes::member, load.force, angle);
  const double x = scales.scaled_force(factor * force[0]);
  const double z = scales.scaled_force(factor * force[1]);
  double moment = scales.scaled_moment(factor * load.moment);
  // the line of the force passes beside its place
  if (load.fixed_line) moment += displacement({-z, x, 0.0});
  return {xi, {x, z, moment}};
}

void SectionForces::add(const PointAction& load, const Eigen::VectorXd& y, double factor) {
  const MeshPlace place = place_of(structure_.mesh, cell_.member, load.at.fraction);
  if (place.element == element_) points_.push_back(point_force(load, place.xi, y, factor));
}

void SectionForces::add(const LineAction& load, const Eigen::VectorXd& /*y*/, double factor) {
  for (const LinePiece& piece : load.pieces) {
    const Vec2 range = part_of(cell_, piece.range);
    if (range[1] > range[0])
      dead_.push_back({piece, structure_.scales.scaled_line_load(factor), load.per, load.axes, range});
  }
}

void SectionForces::add(const PressureAction& load, const Eigen::VectorXd& /*y*/, double factor) {
  const double sense = (load.side == Side::left ? 1.0 : -1.0) * structure_.scales.scaled_line_load(factor);
  const double from = sense * value_at(load.value, load.value_along, cell_.from);
  const double to = sense * value_at(load.value, load.value_along, cell_.to);
  pressure_.middle += 0.5 * (from + to);
  pressure_.change += to - from;
}

void SectionForces::add_foundations(const Eigen::VectorXd& y, const std::vector<LayerState>& layers) {
  const auto before = [](const FoundationPart& part, int element) { return part.element < element; };
  const auto& parts = structure_.foundation_parts;
  for (auto at = std::lower_bound(parts.begin(), parts.end(), element_, before);
       at != parts.end() && at->element == element_; ++at) {
    const FoundationPart& part = *at;
    const FoundationLaw law = law_on(structure_, structure_.foundation_laws[part.foundation], element_);
    const bool lumped = structure_.mesh.foundation == FoundationRule::lumped;
    const ElementReader reader(structure_, y, element_, law);
    FoundationHere out{law, reader, lumped, part.range, {{part.range[0], part.range[1]}}};
    if (lumped) add_lumped(out);
    if (const LayerState& layer = layers[static_cast<std::size_t>(part.foundation)]; !layer.cells.empty()) {
      out.contact = layer.on_element(element_);
      add_layer_forces(layer);
    } else if (part.contact) {
      out.contact = part.contact->smooth_pieces({reader.start()[0], reader.start()[1]}, reader.gradient(0),
                                                reader.gradient(1));
    }
    foundations_.push_back(out);
  }
}

/// Adds the forces at ends of contact with a shear layer.
void SectionForces::add_layer_forces(const LayerState& layer) {
  for (std::size_t i = 0; i < layer.edges.size(); ++i) {
    const LayerEdge& edge = layer.edges[i];
    if (layer.elements[edge.cell] != element_) continue;
    const Vec2 d = layer.cells[edge.cell].contact->direction_at(edge.xi);
    const double force = -edge_force(layer.cells, layer.edges, i);
    points_.push_back({edge.xi, {force * d[0], force * d[1], 0.0}});
  }
}

void SectionForces::add_lumped(const FoundationHere& foundation) {
  const Vec2& range = foundation.range;
  const Quadrature lobatto = gauss_lobatto(structure_.mesh.order + 1);
  for (std::size_t i = 0; i < lobatto.points.size(); ++i) {
    const double xi = lobatto.points[i];
    if (xi < range[0] - kOnePlace || xi > range[1] + kOnePlace) continue;
    const auto [x, z, moment] = reaction(foundation, xi);
    const double length = reader_.length() * lobatto.weights[i];
    points_.push_back({xi, {length * x, length * z, length * moment}});
  }
}

void SectionForces::add_springs(const Eigen::VectorXd& y) {
  for (std::size_t i = 0; i < model_.springs.size(); ++i) {
    const ResolvedLocation& at = model_.springs[i].at;
    if (at.member != cell_.member) continue;
    const MeshPlace place = place_of(structure_.mesh, cell_.member, at.fraction);
    if (place.element != element_) continue;
    // a stop at the end of a member acts on the node
    if (structure_.spring_laws[i].force_unknown >= 0 && place.xi == 1.0) continue;
    const auto& row = structure_.spring_laws[i].row;
    const double force = -reading_of(structure_, i, y).force;
    points_.push_back({place.xi, {force * row[0], force * row[1], force * row[2]}});
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
  // linear geometry: equilibrium of the undeformed shape
  if (structure_.geometry == Geometry::linear) return {x, y};
  const auto u = reader_.displacement(xi);
  return {x + u[0], y + u[1]};
}

Vec2 SectionForces::slope(double xi) const {
  const StressFreeAxis& axis = *structure_.stress_free[cell_.member];
  const StressFreePoint p =
      axis.at(axis.perfect().length() * (cell_.from + xi * (cell_.to - cell_.from)), axis_at(xi));
  const Vec2 t{p.stretch * std::cos(p.angle), p.stretch * std::sin(p.angle)};
  if (structure_.geometry == Geometry::linear) return t;
  const auto du = reader_.derivative(xi);
  return {t[0] + du[0], t[1] + du[1]};
}

std::array<double, 3> SectionForces::reaction(const FoundationHere& foundation, double xi) const {
  const AxisPoint& at = axis_at(xi);
  const double fraction = cell_.from + xi * (cell_.to - cell_.from);
  const Scales& scales = structure_.scales;
  const auto u = foundation.reader.displacement(xi);
  const SurfacePoint p = foundation.law.penetration(
      {{scales.scaled_length(at.x), scales.scaled_length(at.y)}, at.angle, fraction}, {u[0], u[1]});
  const double force = -foundation.law.at(fraction).reaction_beyond(p.depth);
  const auto row = foundation.law.row(p.into);
  return {force * row[0], force * row[1], force * row[2]};
}

std::array<double, 3> SectionForces::density(double xi) const {
  std::array<double, 3> f{};
  for (const DeadLoad& load : dead_) {
    if (xi < load.range[0] || xi > load.range[1]) continue;
    const bool is_plain = load.per == LoadMeasure::length && load.axes == LoadAxes::global;
    const double angle = is_plain ? 0.0 : axis_at(xi).angle;
    const double measure = load.factor * measure_of(load.per, angle);
    const Vec2 force =
        global_force(load.axes, load.piece.at(cell_.from + xi * (cell_.to - cell_.from)), angle);
    for (int c = 0; c < 2; ++c) f[c] += measure * force[c];
  }
  if (pressure_.change != 0.0) {  // the difference to the pressure in the middle
    const double difference = (xi - 0.5) * pressure_.change;
    const Vec2 tangent = slope(xi);
    f[0] += difference * tangent[1];
    f[1] -= difference * tangent[0];
  }
  for (const FoundationHere& foundation : foundations_) {
    if (foundation.lumped || !foundation.touches(xi)) continue;
    const auto r = reaction(foundation, xi);
    for (int c = 0; c < 3; ++c) f[c] += r[c];
  }
  return f;
}

/// Force G w' of a shear layer.
double SectionForces::shear_layer(const FoundationLaw& foundation, double xi) const {
  const Vec2 n = normal_into(foundation, xi);
  const Vec2 dn = normal_rate(foundation, xi);
  const auto u = reader_.displacement(xi);
  const auto du = reader_.derivative(xi);
  return foundation.shear * (du[0] * n[0] + du[1] * n[1] + u[0] * dn[0] + u[1] * dn[1]);
}

/// Adds the resultant of shear layers on [from, to] on the part beyond xi: -int G w' dw' ds for the part's
/// rigid motions.
void SectionForces::add_shear_layers(double xi, double from, double to, std::array<double, 3>& sum) const {
  const Vec2 x0 = position(xi);
  for (const FoundationHere& foundation : foundations_) {
    if (foundation.law.shear == 0.0) continue;
    if (!foundation.touches(0.5 * (from + to))) continue;
    const double lo = std::max(from, foundation.range[0]);
    const double hi = std::min(to, foundation.range[1]);
    for (std::size_t i = 0; lo < hi && i < gauss_.points.size(); ++i) {
      const double at = lo + (hi - lo) * gauss_.points[i];
      const double force = shear_layer(foundation.law, at) * gauss_.weights[i] * (hi - lo) * reader_.length();
      const Vec2 n = normal_into(foundation.law, at);
      const Vec2 dn = normal_rate(foundation.law, at);
      const double angle = axis_at(at).angle;
      const Vec2 x = position(at);
      const auto du =
          structure_.geometry == Geometry::linear ? std::array{0.0, 0.0, 0.0} : reader_.derivative(at);
      const Vec2 slope{std::cos(angle) + du[0], std::sin(angle) + du[1]};
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
  for (const FoundationHere& foundation : foundations_) {
    for (const double at : foundation.range) add(at);
    for (const auto& interval : foundation.contact) {
      add(interval.from);
      add(interval.to);
    }
  }
  std::sort(breaks.begin(), breaks.end());
  return breaks;
}

std::vector<double> SectionForces::breaks() const {
  std::vector<double> places = breaks_beyond(0.0);
  for (const PointForce& point : points_) places.push_back(point.xi);
  std::sort(places.begin(), places.end());
  places.erase(std::unique(places.begin(), places.end()), places.end());
  std::erase_if(places, [](double xi) { return xi <= kOnePlace || xi >= 1.0 - kOnePlace; });
  return places;
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
  for (const PointForce& point : points_) {
    if (point.xi < xi || (point.xi == xi && xi < 1.0)) continue;
    add(position(point.xi), point.action[0], point.action[1]);
    sum[2] += point.action[2];
  }
  if (pressure_.acts()) {  // int (y', -x') ds and its moment about x0 are exact: chord and half its square
    const double dx = xb[0] - x0[0];
    const double dy = xb[1] - x0[1];
    sum[0] += pressure_.middle * dy;
    sum[1] -= pressure_.middle * dx;
    sum[2] -= 0.5 * pressure_.middle * (dx * dx + dy * dy);
  }
  const std::vector<double> breaks = breaks_beyond(xi);
  const bool has_density = !dead_.empty() || !foundations_.empty() || pressure_.change != 0.0;
  for (std::size_t b = 0; b + 1 < breaks.size() && has_density; ++b) {
    const double width = breaks[b + 1] - breaks[b];
    for (std::size_t i = 0; i < gauss_.points.size(); ++i) {
      const double at = breaks[b] + width * gauss_.points[i];
      const auto f = density(at);
      const double ds = width * gauss_.weights[i] * reader_.length();
      add(position(at), ds * f[0], ds * f[1]);
      sum[2] += ds * f[2];
    }
    add_shear_layers(xi, breaks[b], breaks[b + 1], sum);
  }
  for (const FoundationHere& foundation : foundations_) {
    if (foundation.law.shear == 0.0 || !foundation.is_cut(xi)) continue;
    const Vec2 n = normal_into(foundation.law, xi);
    const double cut = shear_layer(foundation.law, xi);
    sum[0] -= cut * n[0];
    sum[1] -= cut * n[1];
  }
  return sum;
}

}  // namespace snapthrough
