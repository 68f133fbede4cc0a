#include "tests/stress/rod_model.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <numbers>
#include <variant>

#include "solver/resolve/resolved_model.h"
#include "tests/index_of.h"

namespace snapthrough::testing {
namespace {

using Eigen::Vector3d;

/// Unit vector in (x, y, rotation) in which a base on this strip reacts, at xi of the element.
Vector3d direction_of(const RodModel& rod, const RodElement& element, const RodStrip& strip, double xi) {
  if (strip.component == FoundationComponent::rotation) return {0.0, 0.0, 1.0};
  if (strip.fixed) return {(*strip.fixed)[0], (*strip.fixed)[1], 0.0};
  const AxisCurve& axis = *rod.axes[element.member];
  const double angle = axis.at(axis.length() * fraction_at(element, xi)).angle;
  if (strip.component == FoundationComponent::tangent) return {std::cos(angle), std::sin(angle), 0.0};
  return {-strip.sign * std::sin(angle), strip.sign * std::cos(angle), 0.0};
}

class Maker {
 public:
  Maker(const Model& model, RodModel& rod) : model_(model), rod_(rod) {}
  void scales();
  void members();
  void element_actions(RodElement& element);
  void nodes();
  void bars(const Model& whole);
  static void heat(RodBar& bar, const Member& member, const Section& section, double length,
                   const Model& whole);
  void hang(RodBar& bar, const Section& section, double length, const Model& whole);
  void sampling();

 private:
  void shape(RodElement& element, const StressFreeAxis& axis) const;
  void section(RodElement& element, const Section& section) const;
  void base(RodElement& element, const Foundation& base) const;
  [[nodiscard]] RodStrip sampled(const RodElement& element, RodStrip strip) const;
  void springs_of_base(RodElement& element, const RodStrip& strip, bool lumped) const;
  void shear_layer(RodElement& element, const Foundation& base, const RodStrip& strip) const;
  void distributed(RodElement& element, const DistributedLoad& load) const;
  void line_load(RodElement& element, const DistributedLoad& load, const std::array<double, 2>& range) const;
  void weight(RodElement& element, const SelfWeight& load) const;
  void pressure(RodElement& element, const PressureLoad& load) const;
  void strain(RodElement& element, const InitialStrain& load, double axial, double curvature) const;
  void temperature(RodElement& element, const TemperatureLoad& load) const;
  void element_spring(RodElement& element, const Spring& spring) const;
  void member_load(RodElement& element, const Load& load) const;
  [[nodiscard]] RodReaction reaction_of(const Spring& spring) const;
  [[nodiscard]] double without_force(const Spring& spring) const;
  void pretension(RodElement& element, const Member& member) const;
  [[nodiscard]] RodJoint joint(bool turns, double stiffness, const std::optional<ReactionLaw>& law) const;
  [[nodiscard]] const Section& section_of(const RodElement& element) const {
    return model_.sections[static_cast<std::size_t>(
        index_of(model_.sections, model_.members[static_cast<std::size_t>(element.member)].section))];
  }
  [[nodiscard]] bool holds(const RodElement& element, const Location& at) const;
  void point_load(const PointLoad& load);

  const Model& model_;
  RodModel& rod_;
  std::vector<StressFreeAxis> stress_free_;
};

int slot(Pattern pattern) { return pattern == Pattern::proportional ? 0 : 1; }

void add(Functional& to, const Functional& what) {
  to.a += what.a;
  to.v += what.v;
}

/// Part of an element that a range of fractions of the member covers, in the element's own [0, 1].
std::array<double, 2> part_of(const RodElement& element, const std::array<double, 2>& range) {
  const double width = element.to - element.from;
  return {std::clamp((range[0] - element.from) / width, 0.0, 1.0),
          std::clamp((range[1] - element.from) / width, 0.0, 1.0)};
}

void Maker::scales() {
  rod_.axes = make_axes(resolve(model_));
  rod_.length = 0.0;
  for (const auto& axis : rod_.axes) rod_.length = std::max(rod_.length, axis->length());
  rod_.force = largest_bending(model_) / (rod_.length * rod_.length);
  rod_.origin = {model_.nodes.front().x, model_.nodes.front().y};
}

void Maker::shape(RodElement& element, const StressFreeAxis& axis) const {
  const double length = axis.perfect().length();
  const int p = rod_.lagrange.order();
  const Rule& rule = rod_.lagrange.rule();
  for (VectorXd* v : {&element.angle, &element.tx, &element.ty, &element.e0, &element.g0, &element.stretch})
    v->resize(p);
  const StressFreePoint a = axis.at(element.from * length);
  const StressFreePoint b = axis.at(element.to * length);
  double missing_x = (b.x - a.x) / rod_.length / element.h;
  double missing_y = (b.y - a.y) / rod_.length / element.h;
  for (int q = 0; q < p; ++q) {
    const StressFreePoint at =
        axis.at(length * (element.from + rule.points[q] * (element.to - element.from)));
    element.angle[q] = at.angle;
    element.stretch[q] = at.stretch;
    element.tx[q] = at.stretch * std::cos(at.angle);
    element.ty[q] = at.stretch * std::sin(at.angle);
    missing_x -= rule.weights[q] * element.tx[q];
    missing_y -= rule.weights[q] * element.ty[q];
  }
  // the sum of the derivatives is the chord exactly, as the discretisation is defined (docs/theory.md)
  element.tx.array() += missing_x;
  element.ty.array() += missing_y;
  const VectorXd c = element.angle.array().cos();
  const VectorXd s = element.angle.array().sin();
  element.e0 = element.tx.cwiseProduct(c) + element.ty.cwiseProduct(s);
  element.g0 = element.ty.cwiseProduct(c) - element.tx.cwiseProduct(s);
}

void Maker::section(RodElement& element, const Section& section) const {
  const auto value = [](const AlongMember& number, double fraction) {
    return along(number.points, number.constant, fraction, number.power);
  };
  const double bending = rod_.force * rod_.length * rod_.length;
  const int p = rod_.lagrange.order();
  for (VectorXd* v : {&element.axial, &element.shear, &element.bending}) *v = VectorXd::Zero(p);
  for (int q = 0; q < p; ++q) {
    const double fraction = fraction_at(element, rod_.lagrange.rule().points[static_cast<std::size_t>(q)]);
    element.axial[q] = rod_.force / value(section.EA, fraction);
    element.bending[q] = bending / value(section.EI, fraction);
    if (section.GA) element.shear[q] = rod_.force / value(*section.GA, fraction);
  }
  if (section.bending)
    element.law =
        std::make_shared<const BendingCurvature>(BendingCurvature(*section.bending, section.EI.constant)
                                                     .scaled(rod_.force * rod_.length, 1.0 / rod_.length));
  element.shears = section.GA.has_value();
  element.softest = bending / std::min(value(section.EI, element.from), value(section.EI, element.to));
}

void Maker::shear_layer(RodElement& element, const Foundation& base, const RodStrip& strip) const {
  const Rule rule = gauss(rod_.lagrange.order() + 1);
  const AxisCurve& axis = *rod_.axes[element.member];
  for (std::size_t i = 0; i < rule.points.size(); ++i) {
    const double xi = strip.lo + (strip.hi - strip.lo) * rule.points[i];
    const Vector3d n = direction_of(rod_, element, strip, xi);
    RodSpring spring;
    spring.reaction.law.stiffness = base.shear_stiffness;
    spring.reaction.share = element.h * (strip.hi - strip.lo) * rule.weights[i] / rod_.force;
    // w = u.n, so w' = u'.n + u.n' and n' = -+ kappa t along the turning normal
    Vector3d turning = Vector3d::Zero();
    if (!base.direction) {
      const AxisPoint at = axis.at(axis.length() * (element.from + xi * (element.to - element.from)));
      turning =
          -strip.sign * at.curvature * rod_.length * Vector3d(std::cos(at.angle), std::sin(at.angle), 0);
    }
    spring.row = functional_at(rod_, element, xi, turning);
    spring.row.v += n * rod_.lagrange.values(xi).transpose();
    element.springs.push_back(spring);
  }
}

void Maker::base(RodElement& element, const Foundation& base) const {
  RodStrip strip = strip_of(rod_, base);
  const auto [lo, hi] = part_of(element, base.range);
  if (hi <= lo) return;
  strip.lo = lo;
  strip.hi = hi;
  strip.law = acting_law(rod_, element, base);
  if (base.shear_stiffness > 0.0) shear_layer(element, base, strip);
  if (!base.law && base.stiffness == 0.0) return;
  const bool lumped = rod_.mesh.foundation == FoundationRule::lumped;
  if (lumped || (!strip.one_sided && strip.law.is_linear()))
    springs_of_base(element, strip, lumped);
  else
    element.strips.push_back(sampled(element, strip));
}

/// Samples of the displacement in cosine spacing: beside an end an extremum has samples on one side only.
RodStrip Maker::sampled(const RodElement& element, RodStrip strip) const {
  const int cells = 12 * rod_.lagrange.order() + 12;
  for (int i = 0; i <= cells; ++i) {
    const double z = 0.5 - 0.5 * std::cos(std::numbers::pi * i / cells);
    const double xi = i == cells ? strip.hi : strip.lo + (strip.hi - strip.lo) * z;
    strip.sites.push_back(site_of(rod_, element, strip, xi));
  }
  return strip;
}

void Maker::springs_of_base(RodElement& element, const RodStrip& strip, bool lumped) const {
  const int n = rod_.lagrange.order() + 1;
  const Rule rule = lumped ? lobatto(n) : gauss(n);
  const double width = strip.hi - strip.lo;
  for (std::size_t i = 0; i < rule.points.size(); ++i) {
    const double xi = lumped ? rule.points[i] : strip.lo + width * rule.points[i];
    if (xi < strip.lo - 1e-9 || xi > strip.hi + 1e-9) continue;
    const RodSite site = site_of(rod_, element, strip, xi);
    RodSpring spring;
    spring.row = functional_at(rod_, element, xi, site.direction);
    spring.reaction = {strip.law.at(fraction_at(element, xi)), strip.unit,
                       element.h * rule.weights[i] * (lumped ? 1.0 : width) * strip.share, site.gap,
                       strip.one_sided};
    element.springs.push_back(spring);
  }
}

/// Adds the parts of a distributed load between the places at which its force bends.
void Maker::distributed(RodElement& element, const DistributedLoad& load) const {
  std::array<double, 2> range = load.range;
  for (const auto& [fraction, force] : load.force_along) {
    if (fraction <= range[0] || fraction >= load.range[1]) continue;
    line_load(element, load, {range[0], fraction});
    range[0] = fraction;
  }
  line_load(element, load, range);
}

void Maker::line_load(RodElement& element, const DistributedLoad& load,
                      const std::array<double, 2>& range) const {
  const auto [lo, hi] = part_of(element, range);
  if (hi <= lo) return;
  std::array<std::vector<std::pair<double, double>>, 2> components;
  for (const auto& [fraction, force] : load.force_along)
    for (std::size_t c = 0; c < 2; ++c) components[c].emplace_back(fraction, force[c]);
  const Rule rule = gauss(rod_.lagrange.order() + 1);
  const AxisCurve& axis = *rod_.axes[element.member];
  for (std::size_t i = 0; i < rule.points.size(); ++i) {
    const double xi = lo + (hi - lo) * rule.points[i];
    const double fraction = fraction_at(element, xi);
    const double angle = axis.at(axis.length() * fraction).angle;
    const double c = std::cos(angle);
    const double s = std::sin(angle);
    double w = element.h * (hi - lo) * rule.weights[i] * rod_.length / rod_.force;
    if (load.per == LoadMeasure::horizontal) w *= std::abs(c);
    if (load.per == LoadMeasure::vertical) w *= std::abs(s);
    const double p = along(components[0], load.force[0], fraction);
    const double q = along(components[1], load.force[1], fraction);
    const bool turned = load.axes == LoadAxes::member;
    add(element.load[slot(load.pattern)],
        functional_at(rod_, element, xi,
                      w * Vector3d(turned ? p * c - q * s : p, turned ? p * s + q * c : q, 0.0)));
  }
}

void Maker::weight(RodElement& element, const SelfWeight& load) const {
  const AlongMember mass = section_of(element).mass.value_or(0.0);
  const auto pulled = [&load](double of) { return std::array{of * load.gravity[0], of * load.gravity[1]}; };
  DistributedLoad pull;
  pull.force = pulled(mass.constant);
  for (const auto& [fraction, value] : mass.points) pull.force_along.emplace_back(fraction, pulled(value));
  pull.pattern = load.pattern;
  distributed(element, pull);
}

void Maker::pressure(RodElement& element, const PressureLoad& load) const {
  const double unit = (load.side == Side::left ? 1.0 : -1.0) * rod_.length / rod_.force;
  RodPressure& out = element.pressure[slot(load.pattern)];
  out.from += unit * along(load.value_along, load.value, element.from);
  out.to += unit * along(load.value_along, load.value, element.to);
}

/// @param axial, curvature factors of the load's numbers
void Maker::strain(RodElement& element, const InitialStrain& load, double axial, double curvature) const {
  const Rule& rule = rod_.lagrange.rule();
  for (int q = 0; q < rod_.lagrange.order(); ++q) {
    const double fraction = fraction_at(element, rule.points[static_cast<std::size_t>(q)]);
    element.strain[slot(load.pattern)][q] += axial * along(load.axial_along, load.axial, fraction);
    element.curvature[slot(load.pattern)][q] +=
        curvature * rod_.length * along(load.curvature_along, load.curvature, fraction);
  }
}

/// The warmer left side grows, so that a member bends to the right.
void Maker::temperature(RodElement& element, const TemperatureLoad& load) const {
  const double expansion = section_of(element).expansion.value_or(0.0);
  strain(element,
         {load.member, load.change, load.gradient, load.pattern, load.change_along, load.gradient_along},
         expansion, -expansion);
}

/// A place at an element's end belongs to the element that starts there, the member's end to its last.
bool Maker::holds(const RodElement& element, const Location& at) const {
  if (at.member.empty() || at.member != model_.members[element.member].id) return false;
  const bool last = element.to >= 1.0;
  return at.fraction >= element.from - 1e-9 && (last || at.fraction < element.to - 1e-9);
}

double sense_of(const Spring& spring) { return spring.reaction == Reaction::tension_only ? -1.0 : 1.0; }

Vector3d spring_row(const Spring& spring) {
  const double sign = sense_of(spring);
  if (!spring.direction) return {0.0, 0.0, sign};
  const double size = std::hypot((*spring.direction)[0], (*spring.direction)[1]);
  return {sign * (*spring.direction)[0] / size, sign * (*spring.direction)[1] / size, 0.0};
}

RodReaction Maker::reaction_of(const Spring& spring) const {
  RodReaction out;
  out.law = law_of_support(spring).at(0.0);
  if (std::isinf(spring.stiffness)) {
    // the stiffness of its place counts for the inertia alone
    constexpr double kStop = 1e8;
    double members = 12.0 * rod_.force / rod_.length;
    for (const Section& section : model_.sections)
      if (std::isfinite(section.EA.largest()))
        members = std::max(members, (section.EA.largest() + 12.0 * rod_.force) / rod_.length);
    out.law.stiffness = kStop * members * (spring.direction ? 1.0 : rod_.length * rod_.length);
    out.stop = RodStop{static_cast<std::size_t>(index_of(model_.springs, spring.id)), sense_of(spring)};
  }
  out.unit = spring.direction ? rod_.length : 1.0;
  out.share = spring.direction ? 1.0 / rod_.force : 1.0 / (rod_.force * rod_.length);
  out.one_sided = spring.reaction != Reaction::bilateral;
  if (out.one_sided) out.gap = spring.gap / out.unit;
  if (spring.pretension) out.without_force = sense_of(spring) * without_force(spring) / out.unit;
  return out;
}

/// Displacement of `at` relative to `to`, along the direction, at which a pretensioned spring has no force. A
/// spring of the stiffness k with the tension T loses it where its nodes come closer by T / k, one of the
/// unstressed length Lu between nodes at the distance L where they come closer by L - Lu. A displacement
/// along the direction brings `at` closer to `to` where the direction points to `to`, and away from it
/// otherwise.
double Maker::without_force(const Spring& spring) const {
  const Node& at = model_.nodes[static_cast<std::size_t>(index_of(model_.nodes, spring.at.node))];
  const Node& to = model_.nodes[static_cast<std::size_t>(index_of(model_.nodes, spring.to->node))];
  const Eigen::Vector2d between(to.x - at.x, to.y - at.y);
  const Eigen::Vector2d direction((*spring.direction)[0], (*spring.direction)[1]);
  const Pretension& given = *spring.pretension;
  const double closer =
      given.force ? *given.force / spring.stiffness : between.norm() - *given.unstressed_length;
  return direction.dot(between) > 0.0 ? closer : -closer;
}

double xi_of(const RodElement& element, const Location& at) {
  return std::clamp((at.fraction - element.from) / (element.to - element.from), 0.0, 1.0);
}

void Maker::element_spring(RodElement& element, const Spring& spring) const {
  if (!holds(element, spring.at)) return;
  element.springs.push_back(
      {functional_at(rod_, element, xi_of(element, spring.at), spring_row(spring)), reaction_of(spring)});
}

void Maker::member_load(RodElement& element, const Load& load) const {
  const std::string& id = model_.members[element.member].id;
  if (const auto* point = std::get_if<PointLoad>(&load); point != nullptr && holds(element, point->at)) {
    const Vector3d action(point->force[0], point->force[1], point->moment / rod_.length);
    add(element.load[slot(point->pattern)],
        functional_at(rod_, element, xi_of(element, point->at), action / rod_.force));
  }
  if (const auto* d = std::get_if<DistributedLoad>(&load); d != nullptr && d->member == id)
    distributed(element, *d);
  if (const auto* p = std::get_if<PressureLoad>(&load); p != nullptr && p->member == id)
    pressure(element, *p);
  if (const auto* i = std::get_if<InitialStrain>(&load); i != nullptr && i->member == id)
    strain(element, *i, 1.0, 1.0);
  if (const auto* t = std::get_if<TemperatureLoad>(&load); t != nullptr && t->member == id)
    temperature(element, *t);
  if (const auto* w = std::get_if<SelfWeight>(&load)) weight(element, *w);
}

void Maker::element_actions(RodElement& element) {
  for (const Foundation& foundation : model_.foundations)
    if (foundation.member == model_.members[element.member].id) base(element, foundation);
  for (const Spring& spring : model_.springs) element_spring(element, spring);
  for (const Load& load : model_.loads) member_load(element, load);
  const Member& member = model_.members[static_cast<std::size_t>(element.member)];
  if (member.pretension) pretension(element, member);
}

/// Adds the strain that a straight member has without force: (Lu - L) / L with the length L between its nodes
/// and the unstressed length Lu, or -F / EA with the force F at the length L.
void Maker::pretension(RodElement& element, const Member& member) const {
  InitialStrain out;
  out.member = member.id;
  out.pattern = Pattern::constant;
  const double length = rod_.axes[element.member]->length();
  out.axial = member.pretension->force ? -*member.pretension->force / section_of(element).EA.constant
                                       : (*member.pretension->unstressed_length - length) / length;
  strain(element, out, 1.0, 0.0);
}

RodJoint Maker::joint(bool turns, double stiffness, const std::optional<ReactionLaw>& law) const {
  RodJoint out;
  out.turns = turns;
  out.resists = turns && (law || stiffness > 0.0);
  out.reaction.law = (law ? LawAlong(*law) : LawAlong(stiffness)).at(0.0);
  out.reaction.share = 1.0 / (rod_.force * rod_.length);
  return out;
}

void Maker::members() {
  const int p = rod_.lagrange.order();
  const ResolvedModel resolved = resolve(model_);
  for (std::size_t m = 0; m < model_.members.size(); ++m) {
    const Member& member = model_.members[m];
    rod_.members.push_back(
        {index_of(model_.nodes, member.start),
         index_of(model_.nodes, member.end),
         0,
         joint(member.release_start_rotation, member.release_start_stiffness, member.release_start_law),
         joint(member.release_end_rotation, member.release_end_stiffness, member.release_end_law),
         {}});
    stress_free_.emplace_back(resolved, static_cast<int>(m), rod_.axes[m], std::vector<CubicSpline>{});
    const Section& section = model_.sections[index_of(model_.sections, member.section)];
    for (int e = rod_.mesh.first[m]; e < rod_.mesh.first[m + 1]; ++e) {
      RodElement element;
      element.member = static_cast<int>(m);
      element.from = rod_.mesh.elements[e].from;
      element.to = rod_.mesh.elements[e].to;
      element.h = (element.to - element.from) * rod_.axes[m]->length() / rod_.length;
      this->section(element, section);
      for (Functional& load : element.load) load.v = MatrixXd::Zero(3, p);
      element.strain.fill(VectorXd::Zero(p));
      element.curvature.fill(VectorXd::Zero(p));
      shape(element, stress_free_.back());
      element_actions(element);
      rod_.elements.push_back(std::move(element));
    }
  }
}

void Maker::point_load(const PointLoad& load) {
  if (!load.at.member.empty()) return;
  rod_.nodes[index_of(model_.nodes, load.at.node)].load[slot(load.pattern)] +=
      Vector3d(load.force[0], load.force[1], load.moment / rod_.length) / rod_.force;
}

void Maker::nodes() {
  rod_.nodes.resize(model_.nodes.size());
  for (const Support& support : model_.supports) {
    RodNode& node = rod_.nodes[index_of(model_.nodes, support.node)];
    node.fixed = {support.x, support.y, support.rotation};
    node.angle = support.angle_degrees * std::numbers::pi / 180.0;
    if (!support.displacement) continue;
    const auto& d = *support.displacement;
    node.displacement[slot(d.pattern)] = {d.x / rod_.length, d.y / rod_.length, d.rotation};
  }
  for (const Load& load : model_.loads)
    if (const auto* point = std::get_if<PointLoad>(&load)) point_load(*point);
  for (std::size_t i = 0; i < model_.springs.size(); ++i) {
    const Spring& spring = model_.springs[i];
    if (spring.at.node.empty()) continue;
    rod_.node_springs.push_back({index_of(model_.nodes, spring.at.node),
                                 spring.to ? index_of(model_.nodes, spring.to->node) : -1, spring_row(spring),
                                 sense_of(spring), reaction_of(spring), i});
  }
}

/// Mean of 1 / EA along a member, by parts between the places at which EA bends.
double mean_compliance(const AlongMember& EA) {
  constexpr int kParts = 16;
  const Rule rule = gauss(8);
  std::vector<double> ends{0.0};
  for (const auto& point : EA.points) ends.push_back(point.first);
  ends.push_back(1.0);
  double out = 0.0;
  for (std::size_t e = 0; e + 1 < ends.size(); ++e) {
    const double width = (ends[e + 1] - ends[e]) / kParts;
    for (int i = 0; i < kParts; ++i)
      for (std::size_t q = 0; q < rule.points.size(); ++q)
        out += width * rule.weights[q] /
               along(EA.points, EA.constant, ends[e] + width * (i + rule.points[q]), EA.power);
  }
  return out;
}

/// Sets the lengthening of a rod by the mean of its temperature. @param length of the rod without force
void Maker::heat(RodBar& bar, const Member& member, const Section& section, double length,
                 const Model& whole) {
  for (const Load& load : whole.loads) {
    const auto* t = std::get_if<TemperatureLoad>(&load);
    if (t == nullptr || t->member != member.id) continue;
    double mean = t->change;
    if (!t->change_along.empty()) {
      mean = t->change_along.front().first * t->change_along.front().second +
             (1.0 - t->change_along.back().first) * t->change_along.back().second;
      for (std::size_t i = 1; i < t->change_along.size(); ++i) {
        const auto& [from, before] = t->change_along[i - 1];
        const auto& [to, after] = t->change_along[i];
        mean += 0.5 * (to - from) * (before + after);
      }
    }
    bar.lengthening[slot(t->pattern)] += section.expansion.value_or(0.0) * mean * length;
  }
}

/// Makes a rod a cable under its constant weight. @param length without force
void Maker::hang(RodBar& bar, const Section& section, double length, const Model& whole) {
  const double unit = rod_.force / rod_.length;  // of a force per length
  HangingBar& cable = bar.cable.emplace();
  cable.EA = section.EA.constant / rod_.force;
  cable.length = length;
  for (const Load& load : whole.loads)
    if (const auto* weight = std::get_if<SelfWeight>(&load); weight && weight->pattern == Pattern::constant)
      cable.weight += section.mass.value_or(0.0).constant / unit *
                      Eigen::Vector2d(weight->gravity[0], weight->gravity[1]);
}

/// Rods of the whole model, whose weight acts on their nodes. The lengthening of a rod is that of its mean
/// compliance; compliance and mass are those of its length without force where that is given.
void Maker::bars(const Model& whole) {
  std::size_t beams = 0;
  for (std::size_t m = 0; m < whole.members.size(); ++m) {
    const Member& member = whole.members[m];
    if (member.reaction == Reaction::bilateral) {
      rod_.members[beams++].place = m;
      continue;
    }
    const Section& section = whole.sections[index_of(whole.sections, member.section)];
    RodBar bar;
    bar.start = index_of(whole.nodes, member.start);
    bar.end = index_of(whole.nodes, member.end);
    bar.along = {(whole.nodes[bar.end].x - whole.nodes[bar.start].x) / rod_.length,
                 (whole.nodes[bar.end].y - whole.nodes[bar.start].y) / rod_.length};
    double length = bar.along.norm();  // of its stiffness and mass
    if (member.pretension && member.pretension->unstressed_length) {
      length = *member.pretension->unstressed_length / rod_.length;
      bar.stretched = bar.along.norm() - length;
    }
    bar.stiffness = 1.0 / (mean_compliance(section.EA) * rod_.force * length);
    if (member.pretension && member.pretension->force)
      bar.stretched = *member.pretension->force / (rod_.force * bar.stiffness);
    bar.sign = member.reaction == Reaction::tension_only ? 1 : -1;
    bar.member = m;
    heat(bar, member, section, length, whole);
    if (member.cable) hang(bar, section, length, whole);
    rod_.bars.push_back(bar);
    const double half = 0.5 * section.mass.value_or(0.0).constant * length * rod_.length;
    for (const Load& load : whole.loads)
      if (const auto* weight = std::get_if<SelfWeight>(&load))
        for (const int node : {bar.start, bar.end})
          rod_.nodes[node].load[slot(weight->pattern)] +=
              half / rod_.force * Vector3d(weight->gravity[0], weight->gravity[1], 0.0);
  }
}

/// Chooses samples of the state for each element and the least-squares fit of its polynomial.
void Maker::sampling() {
  const int p = rod_.lagrange.order();
  double narrowest = 1.0;
  for (const RodElement& e : rod_.elements) narrowest = std::min(narrowest, e.to - e.from);
  rod_.points = static_cast<int>(std::ceil((2 * p + 3) / narrowest)) + 1;
  constexpr int kMostPoints = 8001;
  if (rod_.points > kMostPoints) {
    rod_.points = 0;
    return;
  }
  const double step = 1.0 / (rod_.points - 1);
  for (RodElement& e : rod_.elements) {
    const int lo = static_cast<int>(std::ceil(e.from / step - 1e-9));
    const int hi = static_cast<int>(std::floor(e.to / step + 1e-9));
    const int wanted = 2 * p + 2;
    for (int i = 0; i < wanted; ++i) {  // dense towards the ends, where a polynomial is hardest to tell
      const double z = 0.5 - 0.5 * std::cos(std::numbers::pi * i / (wanted - 1));
      const int k = lo + static_cast<int>(std::lround(z * (hi - lo)));
      if (e.samples.empty() || k > e.samples.back()) e.samples.push_back(k);
    }
    e.basis.resize(static_cast<Eigen::Index>(e.samples.size()), p + 1);
    for (std::size_t i = 0; i < e.samples.size(); ++i) {
      const double xi = (e.samples[i] * step - e.from) / (e.to - e.from);
      const auto row = static_cast<Eigen::Index>(i);
      e.basis(row, 0) = 1.0;
      e.basis.row(row).tail(p) = e.h * rod_.lagrange.integrals(xi).transpose();
    }
    e.fit = e.basis.colPivHouseholderQr().solve(MatrixXd::Identity(e.basis.rows(), e.basis.rows()));
  }
  for (std::size_t m = 0; m < rod_.members.size(); ++m) {
    for (int i = 0; i < rod_.points; ++i) {
      const double s = rod_.axes[m]->length() * std::min(1.0, static_cast<double>(i) / (rod_.points - 1));
      rod_.members[m].sampled.push_back(stress_free_[m].at(s));
      const StressFreePoint& at = rod_.members[m].sampled.back();
      rod_.extent = std::max({rod_.extent, std::abs(rod_.origin[0]) + std::abs(at.x),
                              std::abs(rod_.origin[1]) + std::abs(at.y)});
    }
  }
  rod_.extent /= rod_.length;
}

}  // namespace

double largest_bending(const Model& model) {
  double out = 0.0;
  for (const Section& section : model.sections)
    if (std::isfinite(section.EI.largest())) out = std::max(out, section.EI.largest());
  return out;
}

Functional functional_at(const RodModel& rod, const RodElement& element, double xi,
                         const Eigen::Vector3d& row) {
  return {row, row * (element.h * rod.lagrange.integrals(xi)).transpose()};
}

LawAlong acting_law(const RodModel& rod, const RodElement& element, const Foundation& base) {
  if (base.law || base.reaction == Reaction::bilateral) return law_of_support(base);
  constexpr double kRigidDecays = 3.0;  // that an element resolves (docs/theory.md, Stiff foundations)
  const double decays = std::isinf(base.stiffness) ? kRigidDecays : rod.mesh.decay_lengths;
  const double modulus = rod.force / (rod.length * rod.length);
  double length = element.h;
  // the stiffness of a rigid base follows from the longest element of its member
  if (std::isinf(base.stiffness))
    for (int e = rod.mesh.first[element.member]; e < rod.mesh.first[element.member + 1]; ++e)
      length = std::max(length, element.h * (rod.mesh.elements[e].to - rod.mesh.elements[e].from) /
                                    (element.to - element.from));
  const double most = 4.0 * modulus / (element.softest * std::pow(length / decays, 4));
  return LawAlong(std::min(base.stiffness, most));
}

RodStrip strip_of(const RodModel& rod, const Foundation& base) {
  const int pull = base.reaction == Reaction::tension_only ? -1 : 1;
  RodStrip out;
  out.one_sided = base.reaction != Reaction::bilateral;
  out.gap = out.one_sided ? base.gap / rod.length : 0.0;
  for (const auto& [fraction, gap] : base.gap_along) out.gap_along.emplace_back(fraction, gap / rod.length);
  out.sign = pull * (base.side == Side::left ? 1 : -1);
  out.component = base.component;
  const bool turns = base.component == FoundationComponent::rotation;
  out.unit = turns ? 1.0 : rod.length;
  out.share = (turns ? 1.0 : rod.length) / rod.force;
  if (base.outline) out.surface = surface_of(*base.outline, rod.origin, rod.length);
  out.takes_planes = rod.mesh.foundation == FoundationRule::lumped;
  if (!base.direction) return out;
  const double size = std::hypot((*base.direction)[0], (*base.direction)[1]);
  out.fixed = {pull * (*base.direction)[0] / size, pull * (*base.direction)[1] / size};
  return out;
}

RodSite site_of(const RodModel& rod, const RodElement& element, const RodStrip& strip, double xi) {
  RodSite out;
  out.xi = xi;
  out.weights = element.h * rod.lagrange.integrals(xi);
  const double fraction = fraction_at(element, xi);
  out.gap = along(strip.gap_along, strip.gap, fraction);
  if (!strip.surface) {
    out.direction = direction_of(rod, element, strip, xi);
    return out;
  }
  const AxisCurve& axis = *rod.axes[element.member];
  const AxisPoint at = axis.at(axis.length() * std::min(fraction, 1.0));
  out.x = {(at.x - rod.origin[0]) / rod.length, (at.y - rod.origin[1]) / rod.length};
  const RodDepth initial = strip.surface->at(out.x);
  out.direction.head<2>() = initial.into;
  out.gap = -initial.value;
  return out;
}

namespace {

Vector3d displacement_at(const RodSite& site, const MatrixXd& u) {
  return u.row(0).transpose() + u.bottomRows(site.weights.size()).transpose() * site.weights;
}

}  // namespace

double depth_at(const RodStrip& strip, const RodSite& site, const MatrixXd& u) {
  const Vector3d moved = displacement_at(site, u);
  if (!strip.follows_surface()) return site.direction.dot(moved) - site.gap;
  return strip.surface->at(site.x + moved.head<2>()).value;
}

StripDepth depth_with_derivatives(const RodStrip& strip, const RodSite& site, const MatrixXd& u) {
  const auto row = [&site](const Vector3d& of) { return Functional{of, of * site.weights.transpose()}; };
  const Vector3d moved = displacement_at(site, u);
  if (!strip.follows_surface())
    return {site.direction.dot(moved) - site.gap, row(site.direction), row(Vector3d::Zero()), 0.0};
  const RodDepth depth = strip.surface->at(site.x + moved.head<2>());
  return {depth.value, row({depth.into.x(), depth.into.y(), 0.0}),
          row({-depth.into.y(), depth.into.x(), 0.0}), depth.bend};
}

namespace {

/// The elements between the ends that a result tells.
void set_elements(const std::vector<std::vector<double>>& ends, Mesh& mesh) {
  mesh.elements.clear();
  mesh.first = {0};
  for (std::size_t m = 0; m < ends.size(); ++m) {
    for (std::size_t i = 0; i + 1 < ends[m].size(); ++i)
      mesh.elements.push_back({static_cast<int>(m), ends[m][i], ends[m][i + 1]});
    mesh.first.push_back(static_cast<int>(mesh.elements.size()));
  }
}

}  // namespace

RodModel make_rod_model(const Model& model, const Analysis& analysis, const MeshReport& told) {
  RodModel rod;
  const Model beams = without_bars(model);
  Maker maker(beams, rod);
  maker.scales();
  const MeshUse use = mesh_use(analysis);
  rod.mesh = make_mesh(resolve(beams), analysis.discretization, rod.axes, use);
  if (told.paths > 1) set_elements(told.ends, rod.mesh);
  rod.lagrange = Lagrange(rod.mesh.order);
  rod.concentrated =
      rod.mesh.foundation == FoundationRule::lumped ||
      std::ranges::any_of(model.foundations, [](const Foundation& f) { return f.shear_stiffness > 0.0; });
  maker.members();
  maker.nodes();
  maker.bars(model);
  maker.sampling();
  return rod;
}

BarPull RodBar::pull(const Eigen::Vector2d& now, double load_factor) const {
  const double longer = lengthening[0] * load_factor + lengthening[1];
  if (cable) return pull_of(*cable, now, longer);
  BarPull out;
  const double force = stiffness * (now.norm() - along.norm() + stretched - longer);
  if (!(sign * force > 0.0)) return out;
  const Eigen::Vector2d e = now.normalized();
  const Eigen::Vector2d n(-e.y(), e.x());
  out.force = force * e;
  out.tangent = stiffness * e * e.transpose() + force / now.norm() * n * n.transpose();
  out.at_start = force;
  return out;
}

Model without_bars(Model model) {
  const auto heats_a_bar = [&model](const Load& load) {
    const auto* heat = std::get_if<TemperatureLoad>(&load);
    return heat != nullptr && is_rod(model.members[index_of(model.members, heat->member)]);
  };
  std::erase_if(model.loads, heats_a_bar);
  std::erase_if(model.members, [](const Member& m) { return m.reaction != Reaction::bilateral; });
  return model;
}

}  // namespace snapthrough::testing
