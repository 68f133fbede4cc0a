/// Checks of nodes, sections and members: ids, references, values and geometry.

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "solver/check/check_parts.h"
#include "solver/element/bending_curve.h"
#include "solver/model/limits.h"

namespace snapthrough::checks {

namespace {

using Point = std::array<double, 2>;

Point position(const Node& node) { return {node.x, node.y}; }

double distance(const Point& a, const Point& b) { return std::hypot(b[0] - a[0], b[1] - a[1]); }

/// Whether coordinates are usable for geometry; others are reported elsewhere.
bool is_bounded(const Point& p) { return std::abs(p[0]) <= kMaxMagnitude && std::abs(p[1]) <= kMaxMagnitude; }
bool is_bounded(const Node& node) { return is_bounded(position(node)); }

/// Distance that counts as zero: fraction of the extent of nodes and spline points, at least their rounding.
double zero_distance(const Model& model) {
  Point lo{kMaxMagnitude, kMaxMagnitude};
  Point hi{-kMaxMagnitude, -kMaxMagnitude};
  double largest = 0.0;
  const auto include = [&](const Point& p) {
    for (std::size_t i = 0; is_bounded(p) && i < 2; ++i) {
      lo[i] = std::min(lo[i], p[i]);
      hi[i] = std::max(hi[i], p[i]);
      largest = std::max(largest, std::abs(p[i]));
    }
  };
  for (const Node& node : model.nodes) include(position(node));
  for (const Member& member : model.members) {
    if (const auto* spline = std::get_if<PointsCurve>(&member.curve)) {
      std::for_each(spline->points.begin(), spline->points.end(), include);
    }
  }
  return std::max(kMinRelativeChord * distance(lo, hi),
                  16.0 * std::numeric_limits<double>::epsilon() * largest);
}

void check_curve(const Place&, const LineCurve&) {}

void check_curve(const Place& place, const ArcCurve& arc) {
  const double turn = std::abs(arc.sweep_degrees);
  if (!(turn > 0.0 && turn < 360.0)) {
    (place / "sweep_degrees")
        .report("out_of_range",
                "sweep_degrees must be between -360 and 360 and not 0, got " + text(arc.sweep_degrees));
  }
}

void check_curve(const Place& place, const ParabolaCurve& parabola) {
  require_finite(place / "rise", parabola.rise);
  if (parabola.direction) {
    require_direction(place / "direction", *parabola.direction);
  }
}

void check_curve(const Place& place, const SineCurve& sine) {
  require_finite(place / "rise", sine.rise);
  require_between(place / "half_waves", sine.half_waves, 1, kMaxHalfWaves);
}

void check_curve(const Place& place, const PointsCurve& curve) {
  const Place points = place / "points";
  if (curve.points.empty()) {
    points.report("empty", "points must hold at least one interior point; a straight member is a line");
  }
  require_count(points, curve.points.size(), kMaxCurvePoints);
  for (std::size_t i = 0; i < curve.points.size(); ++i) {
    require_finite(points / i / 0, curve.points[i][0]);
    require_finite(points / i / 1, curve.points[i][1]);
  }
}

/// Requires consecutive points of a spline, with its ends, to differ.
void check_spline_points(const Place& place, const PointsCurve& curve, const Point& start, const Point& end,
                         double zero) {
  Point previous = start;
  for (std::size_t i = 0; i < curve.points.size(); ++i) {
    const bool meets_end = i + 1 == curve.points.size() && distance(curve.points[i], end) <= zero;
    if (distance(previous, curve.points[i]) <= zero || meets_end) {
      (place / i).report("coincident_points", "point " + std::to_string(i) + " coincides with a neighbour");
    }
    previous = curve.points[i];
  }
}

/// @return false for directions that are zero or not finite
bool is_parallel(const Point& a, const Point& b) {
  const double size = std::hypot(a[0], a[1]) * std::hypot(b[0], b[1]);
  return size > 0.0 && std::abs(a[0] * b[1] - a[1] * b[0]) <= kMinRelativeChord * size;
}

void check_member_geometry(const Place& place, const Member& member, const Node& start, const Node& end,
                           double zero) {
  if (!is_bounded(start) || !is_bounded(end)) {
    return;
  }
  if (distance(position(start), position(end)) <= zero) {
    place.report("zero_length", "member " + in_quotes(member.id) + " has no length: nodes " +
                                    in_quotes(start.id) + " and " + in_quotes(end.id) +
                                    " are at the same place");
    return;
  }
  const Point chord{end.x - start.x, end.y - start.y};
  const auto* parabola = std::get_if<ParabolaCurve>(&member.curve);
  if (parabola != nullptr && parabola->direction && is_parallel(*parabola->direction, chord)) {
    (place / "curve" / "direction")
        .report("out_of_range", "direction must not be that of the line from start to end");
  }
  if (const auto* spline = std::get_if<PointsCurve>(&member.curve)) {
    check_spline_points(place / "curve" / "points", *spline, position(start), position(end), zero);
  }
}

void check_nodes_are_reached(const Place& nodes, const Model& data, const Names& names) {
  std::vector<bool> reached(data.nodes.size(), false);
  for (const Member& member : data.members) {
    reached[names.nodes.index(member.start)] = true;
    reached[names.nodes.index(member.end)] = true;
  }
  for (std::size_t i = 0; i < data.nodes.size(); ++i) {
    if (!reached[i] && names.nodes.index(data.nodes[i].id) == i) {
      (nodes / i).report("unreached_node", "no member reaches node " + in_quotes(data.nodes[i].id));
    }
  }
}

/// Checks the joint between a member's end and its node.
void check_joint(const Place& rotation, double stiffness, const std::optional<ReactionLaw>& law) {
  if (law) {
    check_law_at_one_place(rotation, *law);
  } else {
    require_not_negative(rotation, stiffness);
  }
}

}  // namespace

/// Checks texts that results and lists repeat.
void check_texts(const Place& model, const Model& data) {
  const auto require_short = [](const Place& place, const std::string& text, std::size_t most) {
    if (characters(text) > most) {
      place.report("out_of_range", "expected at most " + std::to_string(most) + " characters, got " +
                                       std::to_string(characters(text)));
    }
  };
  require_short(model / "title", data.title, kMaxTitleLength);
  const Place units = model / "units";
  require_count(units, data.units.size(), kMaxUnits);
  for (std::size_t i = 0; i < std::min(data.units.size(), kMaxUnits); ++i) {
    const auto& [quantity, unit] = data.units[i];
    require_short(units / quantity, quantity, kMaxUnitLength);
    require_short(units / quantity, unit, kMaxUnitLength);
  }
}

void check_nodes(const Place& model, const Model& data, Names& names) {
  const Place nodes = model / "nodes";
  require_count(nodes, data.nodes.size(), kMaxNodes);
  if (data.nodes.empty()) {
    nodes.report("empty", "a model needs nodes");
  }
  for (std::size_t i = 0; i < data.nodes.size(); ++i) {
    const Place place = nodes / i;
    names.nodes.add(place / "id", data.nodes[i].id);
    require_finite(place / "x", data.nodes[i].x);
    require_finite(place / "y", data.nodes[i].y);
  }
}

/// Checks a number of a section: a constant by a rule, else positive everywhere.
template <class Rule>
void check_number(const Place& place, const AlongMember& value, Rule rule) {
  if (!value.varies()) {
    rule(place, value.constant);
    return;
  }
  check_along(place, value.points, kMaxPointsAlong, require_positive);
  require_positive(place / "power", value.power);
}

/// Checks a stiffness, which may be infinite: "rigid".
void check_stiffness(const Place& place, const AlongMember& value) {
  if (value.varies() || !(value.constant == std::numeric_limits<double>::infinity()))
    check_number(place, value, require_positive);
}

/// Checks points (k, M) of a bending law: both ascend from the origin, and no slope is below
/// kLeastBendingSlope of that at the origin. Returns whether they do.
bool check_bending_points(const Place& place, const BendingLaw& law) {
  require_count(place, law.points.size(), kMaxPointsAlong);
  std::array<double, 2> before{0.0, 0.0};
  double first_slope = 0.0;
  for (std::size_t i = 0; i < law.points.size(); ++i) {
    const auto& [curvature, moment] = law.points[i];
    if (i == 0 && curvature == 0.0 && moment == 0.0) continue;
    if (!require_not_negative(place / i / std::size_t{0}, curvature) ||
        !require_positive(place / i / std::size_t{1}, moment))
      return false;
    if (curvature <= before[0]) {
      (place / i / std::size_t{0}).report("not_increasing", "curvatures must ascend from 0");
      return false;
    }
    const double slope = (moment - before[1]) / (curvature - before[0]);
    if (first_slope == 0.0) first_slope = slope;
    if (!(slope >= kLeastBendingSlope * first_slope)) {
      (place / i / std::size_t{1})
          .report(
              "out_of_range",
              "moments must ascend, by 1e-8 of the first slope at least: give a plateau a slope, for example "
              "1e-6 of the first");
      return false;
    }
    before = law.points[i];
  }
  if (first_slope == 0.0) place.report("empty", "a bending law needs a point beside the origin");
  return first_slope > 0.0;
}

/// Checks a bending law, whose slope without moment is the section's EI.
void check_bending(const Place& section, const Section& data) {
  const BendingLaw& law = *data.bending;
  const Place place = section / "bending" / "law";
  if (law.type == BendingLaw::Type::table) {
    if (!check_bending_points(place / "points", law)) return;
    constexpr double kRounding = 1e-9;
    const double slope = initial_slope(law);
    if (std::abs(data.EI.constant - slope) > kRounding * slope)
      (section / "EI").report("out_of_range", "EI must be the slope of the bending law at the origin");
    return;
  }
  if (data.EI.varies() || std::isinf(data.EI.constant))
    (section / "bending").report("not_supported", "a section with a bending law needs a constant EI");
  require_positive(place / "moment", law.moment);
  require_not_negative(place / "coefficient", law.coefficient);
  require_between(place / "exponent", law.exponent, 2.0, kMaxBendingExponent);
}

/// Checks the strength of a section, which needs stresses that are linear in the section forces.
void check_strength(const Place& section, const Section& data) {
  const Place place = section / "strength";
  if (data.bending) {
    place.report("not_supported", "a section with a bending law has no strength: its law says how it yields");
    return;
  }
  // a section by material has products of numbers that were checked
  check_number(place / "axial_force", data.strength->axial_force, require_positive);
  check_number(place / "bending_moment", data.strength->bending_moment, require_positive);
  require_positive(place / "compression", data.strength->compression);
}

void check_sections(const Place& model, const Model& data, Names& names) {
  const Place sections = model / "sections";
  require_count(sections, data.sections.size(), kMaxSections);
  if (data.sections.empty()) {
    sections.report("empty", "a model needs sections");
  }
  for (std::size_t i = 0; i < data.sections.size(); ++i) {
    const Place place = sections / i;
    const Section& section = data.sections[i];
    names.sections.add(place / "id", section.id);
    check_stiffness(place / "EA", section.EA);
    const bool has_table = section.bending && section.bending->type == BendingLaw::Type::table;
    if (!has_table) check_stiffness(place / "EI", section.EI);
    if (section.bending) check_bending(place, section);
    if (section.strength) check_strength(place, section);
    if (section.GA) {
      check_number(place / "GA", *section.GA, require_positive);
    }
    if (section.mass) {
      check_number(place / "mass", *section.mass, require_not_negative);
    }
    if (section.rotary_inertia) {
      check_number(place / "rotary_inertia", *section.rotary_inertia, require_not_negative);
    }
    if (section.expansion) {
      require_finite(place / "expansion", *section.expansion);
    }
  }
}

const Section* section_of(const Member& member, const Model& data, const Names& names) {
  return names.sections.contains(member.section) ? &data.sections[names.sections.index(member.section)]
                                                 : nullptr;
}

namespace {

/// Whether a member has a stiffness that is not rigid, or names a section that does not exist. @pre those
/// that are one-sided have a finite EA
bool has_flexible_member(const Model& data, const Names& names) {
  return std::any_of(data.members.begin(), data.members.end(), [&](const Member& member) {
    const Section* section = section_of(member, data, names);
    return is_rod(member) || section == nullptr || section->bending || !std::isinf(section->EI.constant);
  });
}

/// Checks that the section of a one-sided member has a finite EA.
void check_rod_section(const Place& place, const Member& rod, const Model& data, const Names& names) {
  const Section* section = section_of(rod, data, names);
  if (section != nullptr && std::isinf(section->EA.constant)) {
    (place / "section").report("not_supported", "a one-sided member needs a section whose EA is not rigid");
  }
}

}  // namespace

void check_members(const Place& model, const Model& data, Names& names) {
  const Place members = model / "members";
  require_count(members, data.members.size(), kMaxMembers);
  if (data.members.empty()) {
    members.report("empty", "a model needs members");
  }
  if (!data.members.empty() && !has_flexible_member(data, names)) {
    members.report("empty", "a model needs a member whose EI is not rigid");
  }
  const double zero = zero_distance(data);
  bool all_known = true;
  for (std::size_t i = 0; i < data.members.size(); ++i) {
    const Place place = members / i;
    const Member& member = data.members[i];
    names.members.add(place / "id", member.id);
    const bool start_known = names.nodes.require(place / "start", member.start);
    const bool end_known = names.nodes.require(place / "end", member.end);
    names.sections.require(place / "section", member.section);
    check_joint(place / "release" / "start" / "rotation", member.release_start_stiffness,
                member.release_start_law);
    check_joint(place / "release" / "end" / "rotation", member.release_end_stiffness, member.release_end_law);
    std::visit([&place](const auto& curve) { check_curve(place / "curve", curve); }, member.curve);
    if (is_rod(member)) {
      names.rods.insert(member.id);
      check_rod(place, member);
      check_rod_section(place, member, data, names);
    }
    if (member.pretension) {
      check_pretension(place / "pretension", member, data, names);
    }
    if (start_known && end_known) {
      check_member_geometry(place, member, data.nodes[names.nodes.index(member.start)],
                            data.nodes[names.nodes.index(member.end)], zero);
    }
    all_known = all_known && start_known && end_known;
  }
  if (all_known && !data.members.empty()) {  // avoids reporting a misspelt id twice
    check_nodes_are_reached(model / "nodes", data, names);
  }
}

}  // namespace snapthrough::checks
