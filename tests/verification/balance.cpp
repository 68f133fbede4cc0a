#include "tests/verification/balance.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <variant>

#include "solver/geometry/axis_curve.h"
#include "solver/numeric/gauss_rule.h"
#include "tests/reaction_sum.h"

namespace snapthrough::testing {
namespace {

using Vec2 = std::array<double, 2>;

/// Force and moment about the origin.
struct Wrench {
  double x = 0.0;
  double y = 0.0;
  double moment = 0.0;
  void add(const Vec2& at, const Vec2& force, double couple = 0.0) {
    x += force[0];
    y += force[1];
    moment += at[0] * force[1] - at[1] * force[0] + couple;
  }
};

const Node& node_of(const Model& model, const std::string& id) {
  return *std::find_if(model.nodes.begin(), model.nodes.end(), [&id](const Node& n) { return n.id == id; });
}

/// One member with its displacements as piecewise polynomials.
class Body {
 public:
  Body(const Model& model, const Discretization& mesh, const State& state, std::size_t member,
       Geometry geometry);

  struct Place {
    Vec2 u, du;  ///< displacement and its derivative by s
    Vec2 X, dX;  ///< initial place and tangent
    Vec2 x, dx;  ///< place and tangent in which equilibrium is stated
    double curvature;
    double s;  ///< arc length of the initial axis
  };
  [[nodiscard]] Place at(double s) const;
  /// Adds the integral over [from, to] of a function of place, weight ds, split at element ends.
  template <class F>
  void integrate(double from, double to, F add) const {
    const Quadrature gauss = gauss_legendre(order_ + 4);
    const double h = length_ / elements_;
    for (int e = 0; e < elements_; ++e) {
      const double lo = std::max(from, e * h);
      const double hi = std::min(to, (e + 1) * h);
      for (std::size_t i = 0; lo < hi && i < gauss.points.size(); ++i)
        add(at(lo + (hi - lo) * gauss.points[i]), gauss.weights[i] * (hi - lo));
    }
  }
  /// Force through a section as (x, y), at the first or last sample.
  [[nodiscard]] Vec2 end_force(bool last) const;
  [[nodiscard]] const MemberState& state() const { return *state_; }
  [[nodiscard]] double length() const { return length_; }

 private:
  Geometry geometry_;
  AxisCurve axis_;
  const MemberState* state_;
  double length_;
  int elements_;
  int order_;
  int stride_;
};

Body::Body(const Model& model, const Discretization& mesh, const State& state, std::size_t member,
           Geometry geometry)
    : geometry_(geometry),
      axis_(model.members[member].curve,
            {node_of(model, model.members[member].start).x, node_of(model, model.members[member].start).y},
            {node_of(model, model.members[member].end).x, node_of(model, model.members[member].end).y}),
      state_(&state.members[member]),
      length_(axis_.length()),
      elements_(mesh.elements),
      order_(mesh.order) {
  const int intervals = static_cast<int>(state_->s.size()) - 1;
  stride_ = intervals / (elements_ * order_);
  if (stride_ * elements_ * order_ != intervals || stride_ == 0)
    throw std::invalid_argument("points_per_member does not fit the mesh");
}

Body::Place Body::at(double s) const {
  const double h = length_ / elements_;
  const int e = std::clamp(static_cast<int>(s / h), 0, elements_ - 1);
  const double xi = s / h - e;
  Place place{};
  for (int i = 0; i <= order_; ++i) {
    double value = 1.0;
    double slope = 0.0;
    for (int j = 0; j <= order_; ++j) {
      if (j == i) continue;
      const double d = static_cast<double>(i - j) / order_;
      slope = slope * (xi - static_cast<double>(j) / order_) / d + value / d;
      value *= (xi - static_cast<double>(j) / order_) / d;
    }
    const std::size_t k = static_cast<std::size_t>((e * order_ + i) * stride_);
    const AxisPoint p = axis_.at(std::min(length_, state_->s[k]));
    const Vec2 u{state_->x[k] - p.x, state_->y[k] - p.y};
    for (int c = 0; c < 2; ++c) {
      place.u[c] += value * u[c];
      place.du[c] += slope / h * u[c];
    }
  }
  const AxisPoint p = axis_.at(std::min(length_, s));
  place.X = {p.x, p.y};
  place.dX = {std::cos(p.angle), std::sin(p.angle)};
  place.curvature = p.curvature;
  place.s = s;
  const double moved = geometry_ == Geometry::linear ? 0.0 : 1.0;
  for (int c = 0; c < 2; ++c) {
    place.x[c] = place.X[c] + moved * place.u[c];
    place.dx[c] = place.dX[c] + moved * place.du[c];
  }
  return place;
}

Vec2 Body::end_force(bool last) const {
  const std::size_t i = last ? state_->s.size() - 1 : 0;
  const double turned = geometry_ == Geometry::linear ? 0.0 : state_->rotation[i];
  const double angle = axis_.at(last ? length_ : 0.0).angle + turned;
  const double N = state_->axial_force[i];
  const double Q = state_->shear_force[i];
  return {N * std::cos(angle) - Q * std::sin(angle), N * std::sin(angle) + Q * std::cos(angle)};
}

/// The law of a one-sided or bonded support: force against the displacement along its direction.
double reaction_of(Reaction reaction, double stiffness, double w, double gap) {
  if (reaction == Reaction::compression_only) return stiffness * std::max(w - gap, 0.0);
  if (reaction == Reaction::tension_only) return stiffness * std::min(w + gap, 0.0);
  return stiffness * w;
}

struct BaseNormal {
  Vec2 n, dn;
};

BaseNormal base_normal(const Foundation& base, const Body::Place& at) {
  if (base.direction) {
    const double size = std::hypot((*base.direction)[0], (*base.direction)[1]);
    return {{(*base.direction)[0] / size, (*base.direction)[1] / size}, {0.0, 0.0}};
  }
  const double side = base.side == Side::left ? 1.0 : -1.0;
  return {{-side * at.dX[1], side * at.dX[0]},
          {-side * at.curvature * at.dX[0], -side * at.curvature * at.dX[1]}};
}

/// A base's work on the three rigid motions: -int (K w dw + G w' dw') ds.
void add_base(const Foundation& base, const FoundationState& state, const Body& body, Wrench& sum) {
  const auto add = [&](const Body::Place& at, double ds) {
    const auto [n, dn] = base_normal(base, at);
    const double w = at.u[0] * n[0] + at.u[1] * n[1];
    const double slope = at.du[0] * n[0] + at.du[1] * n[1] + at.u[0] * dn[0] + at.u[1] * dn[1];
    const double r = ds * reaction_of(base.reaction, base.stiffness, w, base.gap);
    const double g = ds * base.shear_stiffness * slope;
    sum.add(at.x, {-r * n[0] - g * dn[0], -r * n[1] - g * dn[1]}, -g * (n[1] * at.dx[0] - n[0] * at.dx[1]));
  };
  for (const auto& interval : state.contact) body.integrate(interval[0], interval[1], add);
}

/// Force in the shear layers at an end of a member, which its node carries beside the member.
Vec2 layer_force(const Model& model, const Member& member, const Body& body, bool last) {
  Vec2 sum{0.0, 0.0};
  for (const Foundation& base : model.foundations) {
    if (base.member != member.id || base.shear_stiffness == 0.0 ||
        base.range[last ? 1 : 0] != (last ? 1.0 : 0.0))
      continue;
    const Body::Place at = body.at(last ? body.length() : 0.0);
    const auto [n, dn] = base_normal(base, at);
    const double slope = at.du[0] * n[0] + at.du[1] * n[1] + at.u[0] * dn[0] + at.u[1] * dn[1];
    for (int c = 0; c < 2; ++c) sum[c] += base.shear_stiffness * slope * n[c];
  }
  return sum;
}

/// Force of a distributed load at a place, in global axes.
Vec2 force_at(const DistributedLoad& load, const Body::Place& at, double fraction) {
  Vec2 q = load.force;
  for (std::size_t i = 0; i < load.force_along.size(); ++i) {
    const auto& [to, after] = load.force_along[i];
    const auto& [from, before] = load.force_along[i > 0 ? i - 1 : 0];
    if (i > 0 && fraction < from) break;
    q = after;
    if (i > 0 && fraction < to)
      for (std::size_t c = 0; c < 2; ++c)
        q[c] = (before[c] * (to - fraction) + after[c] * (fraction - from)) / (to - from);
  }
  if (load.axes == LoadAxes::global) return q;
  return {q[0] * at.dX[0] - q[1] * at.dX[1], q[0] * at.dX[1] + q[1] * at.dX[0]};
}

/// Mass per length at a fraction of the member.
double mass_at(const AlongMember& mass, double fraction) {
  double out = mass.varies() ? mass.points.front().second : mass.constant;
  for (std::size_t i = 1; i < mass.points.size(); ++i) {
    const auto& [from, before] = mass.points[i - 1];
    const auto& [to, after] = mass.points[i];
    const double share = std::clamp((fraction - from) / (to - from), 0.0, 1.0);
    if (fraction > from)
      out = std::pow(
          (1.0 - share) * std::pow(before, 1.0 / mass.power) + share * std::pow(after, 1.0 / mass.power),
          mass.power);
  }
  return out;
}

/// Pressure at a fraction of the member, of two places where it varies.
double pressure_at(const PressureLoad& load, double fraction) {
  if (load.value_along.empty()) return load.value;
  const auto& [from, before] = load.value_along.front();
  const auto& [to, after] = load.value_along.back();
  return before + (after - before) * std::clamp((fraction - from) / (to - from), 0.0, 1.0);
}

void add_load(const Load& load, const std::vector<Section>& sections, const Member& member, const Body& body,
              double lambda, Wrench& sum) {
  const auto factor = [lambda](Pattern pattern) { return pattern == Pattern::constant ? 1.0 : lambda; };
  if (const auto* point = std::get_if<PointLoad>(&load); point && point->at.member == member.id) {
    const double f = factor(point->pattern);
    sum.add(body.at(point->at.fraction * body.length()).x, {f * point->force[0], f * point->force[1]},
            f * point->moment);
  }
  if (const auto* spread = std::get_if<DistributedLoad>(&load); spread && spread->member == member.id) {
    const double f = factor(spread->pattern);
    const auto add = [&](const Body::Place& at, double ds) {
      double weight = f * ds;
      if (spread->per == LoadMeasure::horizontal) weight *= std::abs(at.dX[0]);
      if (spread->per == LoadMeasure::vertical) weight *= std::abs(at.dX[1]);
      const Vec2 q = force_at(*spread, at, at.s / body.length());
      sum.add(at.x, {weight * q[0], weight * q[1]});
    };
    body.integrate(spread->range[0] * body.length(), spread->range[1] * body.length(), add);
  }
  if (const auto* weight = std::get_if<SelfWeight>(&load)) {
    const Section& section = *std::find_if(sections.begin(), sections.end(),
                                           [&](const Section& s) { return s.id == member.section; });
    const auto add = [&](const Body::Place& at, double ds) {
      const double f = factor(weight->pattern) * mass_at(*section.mass, at.s / body.length());
      sum.add(at.x, {ds * f * weight->gravity[0], ds * f * weight->gravity[1]});
    };
    body.integrate(0.0, body.length(), add);
  }
  if (const auto* pressure = std::get_if<PressureLoad>(&load); pressure && pressure->member == member.id) {
    const double sense = factor(pressure->pattern) * (pressure->side == Side::left ? 1.0 : -1.0);
    const auto add = [&](const Body::Place& at, double ds) {
      const double p = sense * pressure_at(*pressure, at.s / body.length());
      sum.add(at.x, {p * ds * at.dx[1], -p * ds * at.dx[0]});
    };
    body.integrate(0.0, body.length(), add);
  }
}

/// Force (or couple) of a spring on what it holds.
void add_spring(const Spring& spring, const Vec2& x, const Vec2& u, double rotation, Wrench& sum) {
  if (!spring.direction) {
    sum.moment -= spring.stiffness * rotation;
    return;
  }
  const double size = std::hypot((*spring.direction)[0], (*spring.direction)[1]);
  const Vec2 d{(*spring.direction)[0] / size, (*spring.direction)[1] / size};
  const double r = reaction_of(spring.reaction, spring.stiffness, u[0] * d[0] + u[1] * d[1], spring.gap);
  sum.add(x, {-r * d[0], -r * d[1]});
}

/// Forces of a node's members, loads and springs on it; moments about the node.
struct NodeSum {
  Wrench sum;
  bool seen = false;
  Vec2 x{}, X{};
  double rotation = 0.0;
};

void add_member_ends(const Model& model, std::size_t m, const Body& body, std::vector<NodeSum>& nodes) {
  const Member& member = model.members[m];
  for (const bool last : {false, true}) {
    const std::string& id = last ? member.end : member.start;
    const auto index = static_cast<std::size_t>(&node_of(model, id) - model.nodes.data());
    NodeSum& node = nodes[index];
    const Body::Place at = body.at(last ? body.length() : 0.0);
    const Vec2 force = body.end_force(last);
    const Vec2 layer = layer_force(model, member, body, last);
    const double sign = last ? -1.0 : 1.0;
    const MemberState& state = body.state();
    node.sum.x += sign * (force[0] + layer[0]);
    node.sum.y += sign * (force[1] + layer[1]);
    node.sum.moment += sign * (last ? state.bending_moment.back() : state.bending_moment.front());
    node.x = {at.X[0] + at.u[0], at.X[1] + at.u[1]};
    node.X = at.X;
    if (!(last ? member.release_end_rotation : member.release_start_rotation))
      node.rotation = last ? state.rotation.back() : state.rotation.front();
    node.seen = true;
  }
}

void add_node_actions(const Model& model, double lambda, std::vector<NodeSum>& nodes) {
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    NodeSum& node = nodes[i];
    const Vec2 u{node.x[0] - node.X[0], node.x[1] - node.X[1]};
    for (const Load& load : model.loads) {
      const auto* point = std::get_if<PointLoad>(&load);
      if (!point || point->at.node != model.nodes[i].id) continue;
      const double f = point->pattern == Pattern::constant ? 1.0 : lambda;
      node.sum.add({0.0, 0.0}, {f * point->force[0], f * point->force[1]}, f * point->moment);
    }
    for (const Spring& spring : model.springs)
      if (spring.at.node == model.nodes[i].id) add_spring(spring, {0.0, 0.0}, u, node.rotation, node.sum);
  }
}

/// Takes support reactions out of the nodes' sums and adds them up; `each` gets those of every support, about
/// its node.
void take_reactions(const Model& model, Geometry geometry, std::vector<NodeSum>& nodes, Wrench& reactions,
                    std::vector<Wrench>& each) {
  for (const Support& support : model.supports) {
    Wrench& reaction = each.emplace_back();
    NodeSum& node = nodes[static_cast<std::size_t>(&node_of(model, support.node) - model.nodes.data())];
    const double angle = support.angle_degrees * std::numbers::pi / 180.0;
    const Vec2& place = geometry == Geometry::linear ? node.X : node.x;
    const Vec2 axes[] = {{std::cos(angle), std::sin(angle)}, {-std::sin(angle), std::cos(angle)}};
    const bool held[] = {support.x, support.y};
    for (int c = 0; c < 2; ++c) {
      if (!held[c]) continue;
      const double along = node.sum.x * axes[c][0] + node.sum.y * axes[c][1];
      node.sum.x -= along * axes[c][0];
      node.sum.y -= along * axes[c][1];
      reactions.add(place, {-along * axes[c][0], -along * axes[c][1]});
      reaction.add({0.0, 0.0}, {-along * axes[c][0], -along * axes[c][1]});
    }
    if (support.rotation) {
      reactions.moment -= node.sum.moment;
      reaction.moment -= node.sum.moment;
      node.sum.moment = 0.0;
    }
  }
}

struct Scales {
  double force = 0.0;
  double moment = 0.0;
};

Scales scales_of(const State& state) {
  Scales scales;
  double extent = 0.0;
  for (const MemberState& m : state.members) {
    extent = std::max({extent, m.s.back(), std::abs(m.x.front()), std::abs(m.y.front())});
    for (std::size_t i = 0; i < m.s.size(); ++i) {
      scales.force = std::max(scales.force, std::hypot(m.axial_force[i], m.shear_force[i]));
      scales.moment = std::max(scales.moment, std::abs(m.bending_moment[i]));
    }
  }
  scales.moment = std::max(scales.moment, scales.force * extent);
  return scales;
}

/// What is left of one member as a free body.
Wrench member_sum(const Model& model, const State& state, std::size_t m, const Body& body,
                  Geometry geometry) {
  const Member& member = model.members[m];
  Wrench sum;
  for (const bool last : {false, true}) {
    const double sign = last ? 1.0 : -1.0;
    const Vec2 force = body.end_force(last);
    const Vec2 layer = layer_force(model, member, body, last);
    const double moment = last ? body.state().bending_moment.back() : body.state().bending_moment.front();
    sum.add(body.at(last ? body.length() : 0.0).x,
            {sign * (force[0] + layer[0]), sign * (force[1] + layer[1])}, sign * moment);
  }
  for (const Load& load : model.loads) add_load(load, model.sections, member, body, state.load_factor, sum);
  for (std::size_t f = 0; f < model.foundations.size(); ++f)
    if (model.foundations[f].member == member.id)
      add_base(model.foundations[f], state.foundations[f], body, sum);
  for (const Spring& spring : model.springs) {
    if (spring.at.member != member.id) continue;
    const Body::Place at = body.at(spring.at.fraction * body.length());
    const auto i = static_cast<std::size_t>(
        std::lround(spring.at.fraction * static_cast<double>(body.state().s.size() - 1)));
    add_spring(spring, geometry == Geometry::linear ? at.X : at.x, at.u, body.state().rotation[i], sum);
  }
  return sum;
}

}  // namespace

namespace {

double difference(const Wrench& rebuilt, const Resultant& given, const Scales& scales) {
  return std::max(std::hypot(rebuilt.x - given.fx, rebuilt.y - given.fy) / scales.force,
                  std::abs(rebuilt.moment - given.moment) / scales.moment);
}

/// Where a node is in equilibrium, its displacement and its rotation.
struct NodePlace {
  Vec2 x, u;
  double rotation;
};

NodePlace place_of_node(const NodeSum& node, Geometry geometry) {
  return {geometry == Geometry::linear ? node.X : node.x,
          {node.x[0] - node.X[0], node.x[1] - node.X[1]},
          node.rotation};
}

/// Loads on the nodes themselves.
void add_node_loads(const Model& model, double lambda, Geometry geometry, const std::vector<NodeSum>& nodes,
                    Wrench& sum) {
  for (const Load& load : model.loads) {
    const auto* point = std::get_if<PointLoad>(&load);
    if (!point || point->at.node.empty()) continue;
    const auto index = static_cast<std::size_t>(&node_of(model, point->at.node) - model.nodes.data());
    const double f = point->pattern == Pattern::constant ? 1.0 : lambda;
    sum.add(place_of_node(nodes[index], geometry).x, {f * point->force[0], f * point->force[1]},
            f * point->moment);
  }
}

/// Resultants of springs, bases and loads rebuilt on one member, beside those of the state.
struct Rebuilt {
  std::vector<Wrench> springs;
  std::vector<Wrench> foundations;
  Wrench loads;
};

void rebuild_on_member(const Model& model, const State& state, std::size_t m, const Body& body,
                       Rebuilt& out) {
  const Member& member = model.members[m];
  for (const Load& load : model.loads)
    add_load(load, model.sections, member, body, state.load_factor, out.loads);
  for (std::size_t f = 0; f < model.foundations.size(); ++f)
    if (model.foundations[f].member == member.id)
      add_base(model.foundations[f], state.foundations[f], body, out.foundations[f]);
  for (std::size_t k = 0; k < model.springs.size(); ++k) {
    const Spring& spring = model.springs[k];
    if (spring.at.member != member.id) continue;
    const Body::Place at = body.at(spring.at.fraction * body.length());
    const auto i = static_cast<std::size_t>(
        std::lround(spring.at.fraction * static_cast<double>(body.state().s.size() - 1)));
    add_spring(spring, at.x, at.u, body.state().rotation[i], out.springs[k]);
  }
}

void compare(const Model& model, const State& state, Geometry geometry, const std::vector<NodeSum>& nodes,
             Rebuilt& rebuilt, const Scales& scales, Imbalance& out) {
  add_node_loads(model, state.load_factor, geometry, nodes, rebuilt.loads);
  out.loads = difference(rebuilt.loads, state.loads, scales);
  for (std::size_t f = 0; f < state.foundations.size(); ++f)
    out.foundations =
        std::max(out.foundations, difference(rebuilt.foundations[f], state.foundations[f].resultant, scales));
  for (std::size_t k = 0; k < state.springs.size(); ++k) {
    const Spring& spring = model.springs[k];
    if (!spring.at.node.empty()) {
      const auto index = static_cast<std::size_t>(&node_of(model, spring.at.node) - model.nodes.data());
      const NodePlace at = place_of_node(nodes[index], geometry);
      add_spring(spring, at.x, at.u, at.rotation, rebuilt.springs[k]);
    }
    out.springs = std::max(out.springs, difference(rebuilt.springs[k], state.springs[k].resultant, scales));
  }
}

}  // namespace

Imbalance imbalance_of(const Model& model, const Discretization& mesh, const State& state,
                       Geometry geometry) {
  Imbalance out;
  Rebuilt rebuilt{
      std::vector<Wrench>(model.springs.size()), std::vector<Wrench>(model.foundations.size()), {}};
  const Scales scales = scales_of(state);
  std::vector<NodeSum> nodes(model.nodes.size());
  for (std::size_t m = 0; m < model.members.size(); ++m) {
    const Body body(model, mesh, state, m, geometry);
    const Wrench sum = member_sum(model, state, m, body, geometry);
    out.member_force = std::max(out.member_force, std::hypot(sum.x, sum.y) / scales.force);
    out.member_moment = std::max(out.member_moment, std::abs(sum.moment) / scales.moment);
    add_member_ends(model, m, body, nodes);
    rebuild_on_member(model, state, m, body, rebuilt);
  }
  add_node_actions(model, state.load_factor, nodes);
  compare(model, state, geometry, nodes, rebuilt, scales, out);
  Wrench reactions;
  std::vector<Wrench> each;
  take_reactions(model, geometry, nodes, reactions, each);
  for (std::size_t i = 0; i < each.size(); ++i) {
    const SupportState& given = state.supports[i];
    out.supports = std::max(out.supports, difference(each[i], {given.fx, given.fy, given.moment}, scales));
  }
  out.sum = reaction_sum(model, state, geometry).imbalance();
  for (const NodeSum& node : nodes) {
    if (!node.seen) continue;
    out.node_force = std::max(out.node_force, std::hypot(node.sum.x, node.sum.y) / scales.force);
    out.node_moment = std::max(out.node_moment, std::abs(node.sum.moment) / scales.moment);
  }
  out.reactions[0] = reactions.x;
  out.reactions[1] = reactions.y;
  out.reactions[2] = reactions.moment;
  return out;
}

int output_points(const Discretization& mesh) {
  const int intervals = mesh.elements * mesh.order;
  return std::max(1, 400 / intervals) * intervals + 1;
}

void expect_balance(const Model& model, const Discretization& mesh, const State& state, double tolerance,
                    Geometry geometry) {
  const Imbalance left = imbalance_of(model, mesh, state, geometry);
  EXPECT_LT(left.member_force, tolerance) << "forces on a member, load factor " << state.load_factor;
  EXPECT_LT(left.member_moment, tolerance) << "moments on a member, load factor " << state.load_factor;
  EXPECT_LT(left.node_force, tolerance) << "forces on a node, load factor " << state.load_factor;
  EXPECT_LT(left.node_moment, tolerance) << "moments on a node, load factor " << state.load_factor;
  EXPECT_LT(left.supports, tolerance) << "reactions, load factor " << state.load_factor;
  EXPECT_LT(left.springs, tolerance) << "springs, load factor " << state.load_factor;
  EXPECT_LT(left.foundations, tolerance) << "resultants of bases, load factor " << state.load_factor;
  EXPECT_LT(left.loads, tolerance) << "resultant of loads, load factor " << state.load_factor;
  EXPECT_LT(left.sum, 1e-9) << "sum of all, load factor " << state.load_factor;
}

}  // namespace snapthrough::testing
