#include "tests/stress/request_text.h"

#include <cmath>
#include <concepts>
#include <nlohmann/json.hpp>

namespace snapthrough::testing {
namespace {

using Json = nlohmann::ordered_json;

template <typename Choice>
const char* named(Choice choice, std::initializer_list<const char*> names) {
  return names.begin()[static_cast<std::size_t>(choice)];
}

const char* name_of(Pattern p) { return named(p, {"proportional", "constant"}); }
const char* name_of(Reaction r) { return named(r, {"bilateral", "compression_only", "tension_only"}); }
const char* name_of(Side s) { return named(s, {"left", "right"}); }
const char* name_of(LoadMeasure m) { return named(m, {"length", "horizontal", "vertical"}); }
const char* name_of(LoadAxes a) { return named(a, {"global", "member"}); }
const char* name_of(ReactionLaw::Type t) {
  switch (t) {
    case ReactionLaw::Type::linear:
      return "linear";
    case ReactionLaw::Type::tanh:
      return "tanh";
    case ReactionLaw::Type::hyperbolic:
      return "hyperbolic";
    case ReactionLaw::Type::power:
      return "power";
    case ReactionLaw::Type::table:
      return "table";
  }
  return "";
}
const char* name_of(Component c) { return named(c, {"x", "y", "rotation", "normal"}); }

Json written(const Location& at) {
  if (!at.node.empty()) return {{"node", at.node}};
  return {{"member", at.member}, {"fraction", at.fraction}};
}

Json written(const LineCurve&) { return {{"type", "line"}}; }
Json written(const ArcCurve& c) { return {{"type", "arc"}, {"sweep_degrees", c.sweep_degrees}}; }
Json written(const ParabolaCurve& c) {
  Json out{{"type", "parabola"}, {"rise", c.rise}};
  if (c.direction) out["direction"] = *c.direction;
  return out;
}
Json written(const SineCurve& c) {
  return {{"type", "sine"}, {"rise", c.rise}, {"half_waves", c.half_waves}};
}
Json written(const PointsCurve& c) { return {{"type", "points"}, {"points", c.points}}; }

/// A value, or points along the member in its place.
template <typename Value>
Json written(const Value& constant, const Along<Value>& points) {
  if (points.empty()) return constant;
  return {{"along", points}};
}
Json written(const AlongMember& number) { return written(number.constant, number.points); }

/// A number of a section, with its power.
Json written_taper(const AlongMember& number) {
  Json out = written(number);
  if (number.varies()) out["power"] = number.power;
  return out;
}

/// A stiffness of a section, which may be infinite.
Json written_stiffness(const AlongMember& number) {
  if (!number.varies() && std::isinf(number.constant)) return "rigid";
  return written_taper(number);
}

const char* name_of(Interpolation i) { return i == Interpolation::linear ? "linear" : "monotone_cubic"; }

Json written(const BendingLaw& law) {
  if (law.type == BendingLaw::Type::table)
    return {{"type", "table"}, {"points", law.points}, {"interpolation", name_of(law.interpolation)}};
  return {{"type", "ramberg_osgood"},
          {"moment", law.moment},
          {"exponent", law.exponent},
          {"coefficient", law.coefficient}};
}

/// EI is not written where a bending law's table gives it.
Json written(const Section& s) {
  Json out{{"id", s.id}, {"EA", written_stiffness(s.EA)}};
  if (!s.bending || s.bending->type != BendingLaw::Type::table) out["EI"] = written_stiffness(s.EI);
  if (s.GA) out["GA"] = written_taper(*s.GA);
  if (s.mass) out["mass"] = written_taper(*s.mass);
  if (s.expansion) out["expansion"] = *s.expansion;
  if (s.bending) out["bending"]["law"] = written(*s.bending);
  if (s.strength)
    out["strength"] = {{"axial_force", written_taper(s.strength->axial_force)},
                       {"bending_moment", written_taper(s.strength->bending_moment)}};
  return out;
}

Json written(const ReactionLaw& law) {
  Json out{{"type", name_of(law.type)}};
  if (law.type == ReactionLaw::Type::table) {
    out["points"] = law.points;
    out["factor"] = written(law.factor);
    out["interpolation"] = name_of(law.interpolation);
    return out;
  }
  out["stiffness"] = written(law.stiffness);
  out["capacity"] = written(law.capacity);
  if (law.type != ReactionLaw::Type::power) return out;
  out["reference"] = law.reference;
  out["exponent"] = law.exponent;
  return out;
}

/// Release of a member's end: a hinge, or a joint of a stiffness or a law.
Json released(double stiffness, const std::optional<ReactionLaw>& law) {
  if (law) return {{"rotation", {{"law", written(*law)}}}};
  if (stiffness == 0.0) return {"rotation"};
  return {{"rotation", stiffness}};
}

Json written(const Pretension& p) {
  if (p.force) return {{"force", *p.force}};
  return {{"unstressed_length", p.unstressed_length.value()}};
}

Json written(const Member& m) {
  Json out{{"id", m.id}, {"start", m.start}, {"end", m.end}, {"section", m.section}};
  out["curve"] = std::visit([](const auto& curve) { return written(curve); }, m.curve);
  if (m.release_start_rotation)
    out["release"]["start"] = released(m.release_start_stiffness, m.release_start_law);
  if (m.release_end_rotation) out["release"]["end"] = released(m.release_end_stiffness, m.release_end_law);
  if (is_rod(m)) out["reaction"] = name_of(m.reaction);
  if (m.cable) out["cable"] = true;
  if (m.pretension) out["pretension"] = written(*m.pretension);
  return out;
}

Json written(const Support& s) {
  Json out{{"node", s.node}, {"fixed", Json::array()}, {"angle_degrees", s.angle_degrees}};
  if (s.x) out["fixed"].push_back("x");
  if (s.y) out["fixed"].push_back("y");
  if (s.rotation) out["fixed"].push_back("rotation");
  if (const auto& d = s.displacement)
    out["displacement"] = {
        {"x", d->x}, {"y", d->y}, {"rotation", d->rotation}, {"pattern", name_of(d->pattern)}};
  return out;
}

/// Writes the field `stiffness` of a support, or its field `law`. Requests have a linear law that varies
/// along a member as `stiffness`.
template <typename Support>
void add_stiffness(Json& out, const Support& support) {
  if (std::isinf(support.stiffness))
    out["stiffness"] = "rigid";
  else if (support.law && support.law->type != ReactionLaw::Type::linear)
    out["law"] = written(*support.law);
  else
    out["stiffness"] = support.law ? written(support.law->stiffness) : Json(support.stiffness);
}

Json written(const Spring& s) {
  Json out{{"id", s.id}, {"at", written(s.at)}, {"direction", "rotation"}};
  add_stiffness(out, s);
  if (s.direction) out["direction"] = *s.direction;
  if (s.to) out["to"] = written(*s.to);
  out["reaction"] = name_of(s.reaction);
  out["gap"] = s.gap;
  if (s.pretension) out["pretension"] = written(*s.pretension);
  return out;
}

Json written(const CircleOutline& o) {
  return {{"type", "circle"},
          {"center", o.centre},
          {"radius", o.radius},
          {"medium", o.medium_inside ? "inside" : "outside"}};
}
Json written(const LineOutline& o) { return {{"type", "line"}, {"through", o.through}, {"into", o.into}}; }
Json written(const SplineOutline& o) {
  return {{"type", "spline"}, {"points", o.points}, {"medium", name_of(o.medium)}};
}
Json written(const PolylineOutline& o) {
  return {
      {"type", "polyline"}, {"points", o.points}, {"rounding", o.rounding}, {"medium", name_of(o.medium)}};
}

Json written(const Foundation& f) {
  Json out{{"id", f.id},
           {"member", f.member},
           {"shear_stiffness", f.shear_stiffness},
           {"reaction", name_of(f.reaction)},
           {"range", f.range}};
  add_stiffness(out, f);
  if (f.outline) {
    out["outline"] = std::visit([](const auto& outline) { return written(outline); }, *f.outline);
    return out;
  }
  out["gap"] = written(f.gap, f.gap_along);
  if (f.direction)
    out["direction"] = *f.direction;
  else if (f.component != FoundationComponent::normal)
    out["component"] = named(f.component, {"normal", "tangent", "rotation"});
  else
    out["side"] = name_of(f.side);
  return out;
}

Json written(const PointLoad& l) {
  return {{"type", "point"}, {"at", written(l.at)}, {"force", l.force}, {"moment", l.moment}};
}
Json written(const DistributedLoad& l) {
  return {{"type", "distributed"},   {"member", l.member}, {"force", written(l.force, l.force_along)},
          {"axes", name_of(l.axes)}, {"range", l.range},   {"per", name_of(l.per)}};
}
Json written(const PressureLoad& l) {
  return {{"type", "pressure"},
          {"member", l.member},
          {"value", written(l.value, l.value_along)},
          {"side", name_of(l.side)}};
}
Json written(const InitialStrain& l) {
  return {{"type", "initial_strain"},
          {"member", l.member},
          {"axial", written(l.axial, l.axial_along)},
          {"curvature", written(l.curvature, l.curvature_along)}};
}
Json written(const SelfWeight& l) { return {{"type", "self_weight"}, {"gravity", l.gravity}}; }
Json written(const TemperatureLoad& l) {
  return {{"type", "temperature"},
          {"member", l.member},
          {"change", written(l.change, l.change_along)},
          {"gradient", written(l.gradient, l.gradient_along)}};
}
/// A load of any kind; a kind that is not written does not become a load of any kind again.
template <std::same_as<Load> Any>
Json written(const Any& load) {
  return std::visit(
      [](const auto& l) {
        Json out = written(l);
        out["pattern"] = name_of(l.pattern);
        return out;
      },
      load);
}

Json written(const SineImperfection& i) {
  return {{"type", "sine"}, {"member", i.member}, {"half_waves", i.half_waves}, {"amplitude", i.amplitude}};
}
Json written(const ModeImperfection& i) {
  return {{"type", "mode"}, {"number", i.number}, {"amplitude", i.amplitude}};
}
Json written(const PointsImperfection& i) {
  return {{"type", "points"}, {"member", i.member}, {"offsets", i.offsets}};
}
Json written(const WorstImperfection& i) {
  return {{"type", "worst"}, {"norm", i.norm == OffsetNorm::rms ? "rms" : "max"}, {"amplitude", i.amplitude}};
}
Json written(const Imperfection& imperfection) {
  return std::visit([](const auto& i) { return written(i); }, imperfection);
}

Json written(const Monitor& m) {
  return {{"id", m.id}, {"at", written(m.at)}, {"component", name_of(m.component)}};
}

template <typename Item>
Json all_of(const std::vector<Item>& items) {
  Json out = Json::array();
  for (const Item& item : items) out.push_back(written(item));
  return out;
}

/// Adds the loads and the load cases, whose loads stand last and have no patterns.
void add_loads(Json& out, const Model& m) {
  std::size_t in_cases = 0;
  for (const LoadCase& group : m.load_cases) in_cases += group.loads;
  auto next = m.loads.begin() + static_cast<std::ptrdiff_t>(m.loads.size() - in_cases);
  out["loads"] = all_of(std::vector<Load>(m.loads.begin(), next));
  for (const LoadCase& group : m.load_cases) {
    Json of_case{{"id", group.id}, {"loads", Json::array()}};
    for (const auto end = next + static_cast<std::ptrdiff_t>(group.loads); next != end; ++next) {
      Json load = written(*next);
      of_case["grows"] = load["pattern"] == "proportional";
      load.erase("pattern");
      of_case["loads"].push_back(load);
    }
    out["load_cases"].push_back(of_case);
  }
}

Json written(const Model& m) {
  Json out;
  out["title"] = m.title;
  for (const auto& [quantity, unit] : m.units) out["units"][quantity] = unit;
  for (const Node& n : m.nodes) out["nodes"].push_back({{"id", n.id}, {"x", n.x}, {"y", n.y}});
  out["sections"] = all_of(m.sections);
  out["members"] = all_of(m.members);
  out["supports"] = all_of(m.supports);
  out["springs"] = all_of(m.springs);
  out["foundations"] = all_of(m.foundations);
  add_loads(out, m);
  out["imperfections"] = all_of(m.imperfections);
  out["monitors"] = all_of(m.monitors);
  return out;
}

Json written(const Discretization& d) {
  if (!d.fixed_mesh) return {{"accuracy", d.accuracy}};
  Json out{{"elements", d.elements},
           {"order", d.order},
           {"foundation", named(d.foundation, {"consistent", "lumped"})}};
  if (!d.member_elements.empty()) out["elements"] = Json::object();
  for (const auto& [member, elements] : d.member_elements) out["elements"][member] = elements;
  return out;
}

Json written(const StopRules& s) {
  Json out = Json::object();
  if (s.limit_points) out["limit_points"] = *s.limit_points;
  if (s.load_factor) out["load_factor"] = *s.load_factor;
  if (s.monitor) out["monitor"] = {{"id", s.monitor->id}, {"range", s.monitor->range}};
  if (s.steps) out["steps"] = *s.steps;
  return out;
}

Json written(const StepOptions& s) {
  Json out = Json::object();
  if (s.initial) out["initial"] = *s.initial;
  if (s.min) out["min"] = *s.min;
  if (s.max) out["max"] = *s.max;
  return out;
}

Json written(const OutputOptions& o) {
  Json out;
  if (o.states == StateOutput::every)
    out["states"]["every"] = o.every;
  else if (o.states == StateOutput::at_load_factors)
    out["states"]["at_load_factors"] = o.at_load_factors;
  else
    out["states"] = named(o.states, {"none", "critical", "all"});
  if (o.states != StateOutput::none) out["points_per_member"] = o.points_per_member;
  if (o.path_points) out["path_points"] = *o.path_points;
  if (o.extremes) out["extremes"] = true;
  return out;
}

Json written(const Analysis& a) {
  Json out;
  out["type"] = named(a.type, {"buckling", "critical", "path", "static"});
  out["discretization"] = written(a.discretization);
  out["output"] = written(a.output);
  if (a.type != AnalysisType::path) return out;
  if (a.control.type == ControlType::displacement)
    out["control"]["displacement"] = a.control.monitor;
  else
    out["control"] = named(a.control.type, {"arc_length", "load"});
  out["step"] = written(a.step);
  out["stop"] = written(a.stop);
  out["branches"]["follow"] = named(a.branches.follow, {"primary", "first", "all"});
  if (a.branches.limit) out["branches"]["limit"] = *a.branches.limit;
  return out;
}

}  // namespace

std::string request_text(const RandomRequest& request) {
  const Json out{{"model", written(request.model)}, {"analysis", written(request.analysis)}};
  return out.dump(1);
}

}  // namespace snapthrough::testing
