/// Reader of the model: each function lists the fields of one entity.

#include <algorithm>

#include "api/list_foundations.h"
#include "api/read_along.h"
#include "api/read_law.h"
#include "api/read_parts.h"
#include "solver/model/limits.h"

namespace snapthrough::api {

// The functions are static, not in an unnamed namespace, so that templates of api/value.h find them.

void read(const Value& value, Pattern& out) {
  static constexpr Named<Pattern> kNames[] = {{"proportional", Pattern::proportional},
                                              {"constant", Pattern::constant}};
  read_named(value, kNames, out);
}

static void read(const Value& value, Reaction& out) {
  static constexpr Named<Reaction> kNames[] = {{"bilateral", Reaction::bilateral},
                                               {"compression_only", Reaction::compression_only},
                                               {"tension_only", Reaction::tension_only}};
  read_named(value, kNames, out);
}

static void read(const Value& value, GroundEnd& out) {
  static constexpr Named<GroundEnd> kNames[] = {{"free", GroundEnd::free}, {"endless", GroundEnd::endless}};
  read_named(value, kNames, out);
}

void read(const Value& value, Side& out) {
  static constexpr Named<Side> kNames[] = {{"left", Side::left}, {"right", Side::right}};
  read_named(value, kNames, out);
}

static void read(const Value& value, Component& out) {
  static constexpr Named<Component> kNames[] = {{"x", Component::x},
                                                {"y", Component::y},
                                                {"rotation", Component::rotation},
                                                {"normal", Component::normal}};
  read_named(value, kNames, out);
}

void read(const Value& value, Location& out) {
  Object in(value);
  const auto node = in.find("node");
  const auto member = in.find("member");
  if (node) {
    read(*node, out.node);
  }
  if (member) {
    read(*member, out.member);
    in.required("fraction", out.fraction);
  }
  if (node && member) {
    value.report("ambiguous", "a location is either a node or a member with a fraction, not both");
  } else if (in.is_readable() && !node && !member) {
    value.report("missing_field", "a location needs a node, or a member and a fraction");
  }
  in.finish();
}

/// Reads a set of names, such as ["x", "y"]; reports a repeated name.
template <std::size_t n>
static std::array<bool, n> read_set(const Value& value, const std::array<std::string_view, n>& names) {
  std::array<bool, n> out{};
  if (!value.is_array()) {
    value.report_type("an array");
    return out;
  }
  for (std::size_t i = 0; i < value.size(); ++i) {
    const Value item = value.item(i);
    const auto choice = read_choice(item, names);
    if (choice && out[*choice]) {
      item.report("duplicate", std::string(names[*choice]) + " is there twice");
    } else if (choice) {
      out[*choice] = true;
    }
  }
  return out;
}

/// Reads a direction vector, or the name of the default direction, which gives nullopt.
static void read_direction(const Value& value, std::string_view default_name,
                           std::optional<std::array<double, 2>>& out) {
  out.reset();
  if (value.is_string()) {
    read_choice(value, std::array{default_name});
  } else if (value.is_array()) {
    read(value, out);
  } else {
    value.report_type("[dx, dy] or \"" + std::string(default_name) + "\"");
  }
}

static void read(const Value& value, Node& out) {
  Object in(value);
  in.required("id", out.id);
  in.required("x", out.x);
  in.required("y", out.y);
  in.finish();
}

static Curve read_line(Object&) { return LineCurve{}; }

static Curve read_arc(Object& in) {
  ArcCurve arc;
  in.required("sweep_degrees", arc.sweep_degrees);
  return arc;
}

static Curve read_parabola(Object& in) {
  ParabolaCurve parabola;
  in.required("rise", parabola.rise);
  in.optional("direction", parabola.direction);
  return parabola;
}

static Curve read_sine_curve(Object& in) {
  SineCurve sine;
  in.required("rise", sine.rise);
  in.optional("half_waves", sine.half_waves);
  return sine;
}

static Curve read_points_curve(Object& in) {
  PointsCurve curve;
  in.required("points", curve.points);
  return curve;
}

static void read(const Value& value, Curve& out) {
  static constexpr Named<Curve (*)(Object&)> kForms[] = {{"line", read_line},
                                                         {"arc", read_arc},
                                                         {"parabola", read_parabola},
                                                         {"sine", read_sine_curve},
                                                         {"points", read_points_curve}};
  read_tagged(value, kForms, out);
}

/// Components that other frame programs release at member ends, beside the rotation.
static constexpr std::array<std::string_view, 2> kNotReleased{"axial", "shear"};

static void report_not_released(const Value& value, std::string_view code, std::string_view name) {
  value.report(code, std::string(name) +
                         " is not released: only rotation is. An axial or shear release is two nodes at one "
                         "place with springs between them (springs[].to)");
}

/// Reads whether a list of released components has the rotation.
static bool read_hinge(const Value& list) {
  static constexpr std::array<std::string_view, 1> kNames{"rotation"};
  for (std::size_t i = 0; list.is_array() && i < list.size(); ++i) {
    const Value item = list.item(i);
    std::string written;
    if (item.is_string()) {
      read(item, written);
    }
    if (std::ranges::find(kNotReleased, written) != kNotReleased.end()) {
      report_not_released(item, "unknown_value", written);
      return false;
    }
  }
  return read_set(list, kNames)[0];
}

/// Reads the moment of a joint: its stiffness, or {"law": ...}.
static void read_moment(const Value& value, double& stiffness, std::optional<ReactionLaw>& law) {
  if (!value.is_object()) {
    read(value, stiffness);
    return;
  }
  Object in(value);
  in.required("law", law);
  in.finish();
}

/// Reads the release of a member end: a list of released components, or the moment of its joint.
static void read_release(const Value& value, bool& released, double& stiffness,
                         std::optional<ReactionLaw>& law) {
  if (!value.is_object()) {
    released = read_hinge(value);
    return;
  }
  Object in(value);
  for (const std::string_view name : kNotReleased) {
    if (const auto other = in.find(name)) {
      report_not_released(*other, "unknown_field", name);
      return;
    }
  }
  if (const auto rotation = in.find_required("rotation")) {
    read_moment(*rotation, stiffness, law);
  }
  released = true;
  in.finish();
}

static void read_release(const Value& value, Member& out) {
  Object in(value);
  if (const auto start = in.find("start")) {
    read_release(*start, out.release_start_rotation, out.release_start_stiffness, out.release_start_law);
  }
  if (const auto end = in.find("end")) {
    read_release(*end, out.release_end_rotation, out.release_end_stiffness, out.release_end_law);
  }
  in.finish();
}

static void read(const Value& value, Pretension& out) {
  Object in(value);
  in.optional("force", out.force);
  in.optional("unstressed_length", out.unstressed_length);
  in.finish();
}

static void read(const Value& value, Member& out) {
  Object in(value);
  in.required("id", out.id);
  in.required("start", out.start);
  in.required("end", out.end);
  in.required("section", out.section);
  in.optional("curve", out.curve);
  if (const auto release = in.find("release")) {
    read_release(*release, out);
  }
  in.optional("cable", out.cable);
  if (out.cable) {
    out.reaction = Reaction::tension_only;
  }
  in.optional("reaction", out.reaction);
  in.optional("pretension", out.pretension);
  in.finish();
}

static void read(const Value& value, PrescribedDisplacement& out) {
  Object in(value);
  in.optional("x", out.x);
  in.optional("y", out.y);
  in.optional("rotation", out.rotation);
  in.optional("pattern", out.pattern);
  in.finish();
}

/// Reads `displacement` with its `pattern`, which may also stand beside `displacement`, but not in both.
static void read_displacement(Object& in, Support& out) {
  const auto displacement = in.find("displacement");
  const auto pattern = in.find("pattern");
  if (displacement) {
    read(*displacement, out.displacement);
  }
  if (!pattern) {
    return;
  }
  if (!displacement) {
    pattern->report("missing_field", "pattern needs a displacement");
  } else if (displacement->is_object() && displacement->member("pattern")) {
    pattern->report("ambiguous", "pattern is given in the displacement already");
  } else {
    read(*pattern, out.displacement->pattern);
  }
}

static void read(const Value& value, Support& out) {
  static constexpr std::array<std::string_view, 3> kComponents{"x", "y", "rotation"};
  Object in(value);
  in.required("node", out.node);
  if (const auto fixed = in.find_required("fixed")) {
    const auto set = read_set(*fixed, kComponents);
    out.x = set[0];
    out.y = set[1];
    out.rotation = set[2];
  }
  in.optional("angle_degrees", out.angle_degrees);
  read_displacement(in, out);
  in.finish();
}

static void read(const Value& value, Spring& out) {
  Object in(value);
  in.required("id", out.id);
  in.required("at", out.at);
  in.optional("to", out.to);
  if (const auto direction = in.find_required("direction")) {
    read_direction(*direction, "rotation", out.direction);
  }
  read_law(in, out);
  in.optional("reaction", out.reaction);
  in.optional("gap", out.gap);
  in.optional("displacement", out.displacement);
  in.optional("pretension", out.pretension);
  in.finish();
}

static Outline read_circle_outline(Object& in) {
  static constexpr Named<bool> kMedia[] = {{"outside", false}, {"inside", true}};
  CircleOutline out;
  in.required("center", out.centre);
  in.required("radius", out.radius);
  if (const auto medium = in.find_required("medium")) {
    read_named(*medium, kMedia, out.medium_inside);
  }
  return out;
}

static Outline read_line_outline(Object& in) {
  LineOutline out;
  in.required("through", out.through);
  in.required("into", out.into);
  return out;
}

static Outline read_spline_outline(Object& in) {
  SplineOutline out;
  in.required("points", out.points);
  in.required("medium", out.medium);
  return out;
}

static Outline read_polyline_outline(Object& in) {
  PolylineOutline out;
  in.required("points", out.points);
  in.required("rounding", out.rounding);
  in.required("medium", out.medium);
  return out;
}

/// Reads the surface of the medium of a foundation.
static void read_outline(Object& in, Foundation& out) {
  static constexpr Named<Outline (*)(Object&)> kForms[] = {{"circle", read_circle_outline},
                                                           {"line", read_line_outline},
                                                           {"spline", read_spline_outline},
                                                           {"polyline", read_polyline_outline}};
  const auto outline = in.find("outline");
  if (!outline) {
    return;
  }
  read_tagged(*outline, kForms, out.outline.emplace());
  if (in.find("direction") || in.find("side") || in.find("gap") || in.find("component")) {
    outline->report("ambiguous",
                    "an outline is the place of the medium: leave side, direction, gap and component out");
  }
}

/// Reads whether a foundation acts along the normal, along the tangent, or against rotation.
static void read_component(Object& in, Foundation& out) {
  static constexpr Named<FoundationComponent> kNames[] = {{"normal", FoundationComponent::normal},
                                                          {"tangent", FoundationComponent::tangent},
                                                          {"rotation", FoundationComponent::rotation}};
  const auto component = in.find("component");
  if (!component) {
    return;
  }
  read_named(*component, kNames, out.component);
  if (out.component != FoundationComponent::normal && (out.direction || in.find("side"))) {
    component->report("ambiguous", "only a foundation along the normal has a direction or a side");
  }
}

static void read(const Value& value, GroundDisplacement& out) {
  Object in(value);
  if (const auto x = in.find("x")) {
    read_along(*x, out.x.constant, out.x.points, kLeastPoints);
  }
  if (const auto y = in.find("y")) {
    read_along(*y, out.y.constant, out.y.points, kLeastPoints);
  }
  in.optional("pattern", out.pattern);
  in.finish();
}

static void read(const Value& value, Foundation& out) {
  Object in(value);
  in.required("id", out.id);
  in.required("member", out.member);
  read_law(in, out);
  in.optional("shear_stiffness", out.shear_stiffness);
  in.optional("ground_end", out.ground_end);
  in.optional("reaction", out.reaction);
  in.optional("range", out.range);
  if (const auto gap = in.find("gap")) {
    read_along(*gap, out.gap, out.gap_along, 1);
  }
  if (const auto direction = in.find("direction")) {
    read_direction(*direction, "normal", out.direction);
  }
  if (const auto side = in.find("side")) {
    read(*side, out.side);
    if (out.direction) {
      side->report("ambiguous", "a fixed direction points into the medium already: leave side out");
    }
  }
  read_component(in, out);
  read_outline(in, out);
  in.optional("displacement", out.displacement);
  in.finish();
}

static Imperfection read_sine_imperfection(Object& in) {
  SineImperfection imperfection;
  in.required("member", imperfection.member);
  in.required("half_waves", imperfection.half_waves);
  in.required("amplitude", imperfection.amplitude);
  return imperfection;
}

static Imperfection read_mode_imperfection(Object& in) {
  ModeImperfection imperfection;
  in.required("number", imperfection.number);
  in.required("amplitude", imperfection.amplitude);
  return imperfection;
}

static Imperfection read_points_imperfection(Object& in) {
  PointsImperfection imperfection;
  in.required("member", imperfection.member);
  in.required("offsets", imperfection.offsets);
  return imperfection;
}

static void read(const Value& value, OffsetNorm& out) {
  static constexpr Named<OffsetNorm> kNames[] = {{"rms", OffsetNorm::rms}, {"max", OffsetNorm::max}};
  read_named(value, kNames, out);
}

static Imperfection read_worst_imperfection(Object& in) {
  WorstImperfection imperfection;
  in.required("norm", imperfection.norm);
  in.required("amplitude", imperfection.amplitude);
  return imperfection;
}

static void read(const Value& value, Imperfection& out) {
  static constexpr Named<Imperfection (*)(Object&)> kForms[] = {{"sine", read_sine_imperfection},
                                                                {"mode", read_mode_imperfection},
                                                                {"points", read_points_imperfection},
                                                                {"worst", read_worst_imperfection}};
  read_tagged(value, kForms, out);
}

static void read(const Value& value, PointMass& out) {
  Object in(value);
  in.required("at", out.at);
  in.optional("mass", out.mass);
  in.optional("inertia", out.inertia);
  in.finish();
}

static void read(const Value& value, Damping& out) {
  Object in(value);
  in.optional("mass", out.mass);
  in.optional("stiffness", out.stiffness);
  in.finish();
}

static void read(const Value& value, Monitor& out) {
  Object in(value);
  in.required("id", out.id);
  in.required("at", out.at);
  in.required("component", out.component);
  in.finish();
}

static void read_units(const Value& value, std::vector<std::pair<std::string, std::string>>& out) {
  if (!value.is_object()) {
    value.report_type("an object of strings");
    return;
  }
  for (const std::string& key : value.keys()) {
    read(*value.member(key), out.emplace_back(key, "").second);
  }
}

/// Reads a foundation whose soil gives no law, because of a mistake that was reported.
static void read_unknown(const ListedSupport& support, Foundation& out) {
  out.id = support.made.at("id").get<std::string>();
  out.member = support.made.at("member").get<std::string>();
  set_unread(out.stiffness);
}

/// Reads the foundations of a model; the soil of those that name one gives laws by depth, and springs.
static void read_foundations(Object& in, Model& model) {
  const auto soils = in.find("soils");
  const auto entries = in.find("foundations");
  if (entries && (!entries->is_array() || !has_soil(in.value().json()))) {
    read(*entries, model.foundations);
    return;
  }
  if (!entries && !soils) {
    return;
  }
  ListedSupports listed = list_foundations(in.value());
  for (ListedSupport& one : listed.foundations) {
    const Value entry = entries->item(one.entry);
    if (!one.made.is_null() && !one.made.contains("law")) {
      read_unknown(one, model.foundations.emplace_back());
      continue;
    }
    if (!one.made.is_null() && entry.document_report().covers(entry.pointer() + "/displacement")) {
      one.made.erase("displacement");  // its mistakes were reported with the entry's first foundation
    }
    read(one.made.is_null() ? entry : Value(one.made, PointerPath(entry.pointer()), entry.document_report()),
         model.foundations.emplace_back());
  }
  for (const ListedSupport& one : listed.springs) {
    const Value entry = entries->item(one.entry);
    read(Value(one.made, PointerPath(entry.pointer()), entry.document_report()),
         model.springs.emplace_back());
  }
}

void read(const Value& value, Model& model) {
  Object in(value);
  in.optional("title", model.title);
  if (const auto units = in.find("units")) {
    read_units(*units, model.units);
  }
  in.required("nodes", model.nodes);
  in.required("sections", model.sections);
  in.required("members", model.members);
  in.optional("supports", model.supports);
  in.optional("springs", model.springs);
  read_foundations(in, model);
  in.optional("loads", model.loads);
  if (const auto cases = in.find("load_cases")) {
    read_load_cases(*cases, model);
  }
  in.optional("imperfections", model.imperfections);
  in.optional("masses", model.masses);
  in.optional("damping", model.damping);
  in.optional("monitors", model.monitors);
  in.finish();
}

}  // namespace snapthrough::api
