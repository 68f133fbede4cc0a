/// Checks of supports, springs and foundations.

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <variant>

#include "solver/check/check_parts.h"
#include "solver/model/limits.h"

namespace snapthrough::checks {

namespace {

/// Requires a one-sided reaction. @param what the subject of the sentence
void require_one_sided(const Place& place, Reaction reaction, const std::string& what) {
  if (reaction == Reaction::bilateral) {
    place.report("needs_one_sided", what + " needs reaction compression_only or tension_only");
  }
}

void check_gap(const Place& place, double gap, Reaction reaction) {
  if (require_not_negative(place, gap) && gap > 0.0) {
    require_one_sided(place, reaction, "gap");
  }
}

/// Checks a gap along a member.
void check_gaps(const Place& place, const Along<double>& gaps, Reaction reaction) {
  check_along(place, gaps, kMaxPointsAlong, require_not_negative);
  require_one_sided(place, reaction, "gap");
}

/// Checks a stiffness that may be infinite: rigid.
void check_stiffness(const Place& place, double stiffness, Reaction reaction) {
  if (stiffness == std::numeric_limits<double>::infinity()) {
    require_one_sided(place, reaction, "\"rigid\"");
  } else {
    require_not_negative(place, stiffness);
  }
}

/// Checks the points of an outline: at least `least`, and neighbours that differ beside the largest
/// coordinate.
void check_outline_points(const Place& place, const std::vector<std::array<double, 2>>& points,
                          std::size_t least) {
  require_count(place, points.size(), kMaxPointsAlong);
  if (points.size() < least) {
    place.report("empty", "an outline needs at least " + std::to_string(least) + " points");
  }
  double largest = 0.0;
  for (const auto& [x, y] : points) largest = std::max({largest, std::abs(x), std::abs(y)});
  for (std::size_t i = 0; i < points.size(); ++i) {
    const bool finite = require_finite(place / i / std::size_t{0}, points[i][0]) &&
                        require_finite(place / i / std::size_t{1}, points[i][1]);
    if (finite && i > 0 &&
        std::hypot(points[i][0] - points[i - 1][0], points[i][1] - points[i - 1][1]) <=
            kMinRelativeChord * largest) {
      (place / i).report("coincident_points", "neighbouring points of an outline must differ");
    }
  }
}

/// Whether the arcs at the corners of a polyline leave its sides a length.
bool has_room(const PolylineOutline& line) {
  const auto& points = line.points;
  double before = 0.0;  // length that the corner before takes from the side
  for (std::size_t i = 1; i < points.size(); ++i) {
    const double dx = points[i][0] - points[i - 1][0];
    const double dy = points[i][1] - points[i - 1][1];
    double after = 0.0;
    if (i + 1 < points.size()) {
      const double ex = points[i + 1][0] - points[i][0];
      const double ey = points[i + 1][1] - points[i][1];
      after = line.rounding * std::tan(0.5 * std::abs(std::atan2(dx * ey - dy * ex, dx * ex + dy * ey)));
    }
    if (!(before + after < std::hypot(dx, dy))) return false;
    before = after;
  }
  return true;
}

void check_outline(const Place& place, const CircleOutline& circle) {
  require_finite(place / "center" / std::size_t{0}, circle.centre[0]);
  require_finite(place / "center" / std::size_t{1}, circle.centre[1]);
  require_positive(place / "radius", circle.radius);
}
void check_outline(const Place& place, const LineOutline& line) {
  require_finite(place / "through" / std::size_t{0}, line.through[0]);
  require_finite(place / "through" / std::size_t{1}, line.through[1]);
  require_direction(place / "into", line.into);
}
void check_outline(const Place& place, const SplineOutline& spline) {
  check_outline_points(place / "points", spline.points, 2);
}
void check_outline(const Place& place, const PolylineOutline& line) {
  check_outline_points(place / "points", line.points, 2);
  if (require_positive(place / "rounding", line.rounding) && !has_room(line)) {
    (place / "rounding").report("out_of_range", "rounding must leave every side between two arcs a length");
  }
}

/// Checks the surface of a foundation, and the fields that it excludes.
void check_outline(const Place& foundation, const Foundation& data) {
  const Place place = foundation / "outline";
  std::visit([&place](const auto& outline) { check_outline(place, outline); }, *data.outline);
  if (data.reaction != Reaction::compression_only) {
    place.report("not_supported", "a medium with an outline pushes: its reaction must be compression_only");
  }
}

/// Checks a number of a law: not negative, with at least one positive value.
void check_number(const Place& place, const AlongMember& value) {
  if (!value.varies()) {
    require_positive(place, value.constant);
    return;
  }
  check_along(place, value.points, kMaxPointsAlong, require_not_negative);
  if (!(value.largest() > 0.0)) {
    (place / "along").report("out_of_range", place.name() + " must be positive somewhere");
  }
}

/// Checks points (w, p) of a law: w ascends from the origin, and the first p is positive.
void check_points(const Place& place, const std::vector<std::array<double, 2>>& points) {
  require_count(place, points.size(), kMaxPointsAlong);
  const bool has_origin = !points.empty() && points.front()[0] == 0.0 && points.front()[1] == 0.0;
  const std::size_t first = has_origin ? 1 : 0;
  if (points.size() <= first) {
    place.report("empty", "a table needs a point beside the origin");
    return;
  }
  double last = 0.0;
  for (std::size_t i = first; i < points.size(); ++i) {
    const auto [w, p] = points[i];
    if (!require_finite(place / i / std::size_t{0}, w) || !require_finite(place / i / std::size_t{1}, p)) {
      return;
    }
    if (!(w > last)) {
      (place / i / std::size_t{0})
          .report("not_increasing", "displacements must ascend from the origin (0, 0)");
    }
    if (!(p >= 0.0)) {
      (place / i / std::size_t{1}).report("out_of_range", "forces must not be negative");
    }
    if (i == first && p == 0.0) {
      (place / i / std::size_t{1})
          .report("out_of_range", "the first force beside the origin must be positive");
    }
    last = w;
  }
}

void check_limited(const Place& law, const ReactionLaw& numbers) {
  check_number(law / "stiffness", numbers.stiffness);
  check_number(law / "capacity", numbers.capacity);
}

void check_law(const Place& support, const ReactionLaw& law) {
  const Place place = support / "law";
  switch (law.type) {
    case ReactionLaw::Type::linear:
      check_number(support / "stiffness", law.stiffness);
      return;
    case ReactionLaw::Type::tanh:
    case ReactionLaw::Type::hyperbolic:
      check_limited(place, law);
      return;
    case ReactionLaw::Type::power:
      check_limited(place, law);
      require_positive(place / "reference", law.reference);
      if (!(law.exponent > 0.0 && law.exponent < 1.0))
        (place / "exponent").report("out_of_range", "exponent must be above 0 and below 1");
      return;
    case ReactionLaw::Type::table:
      check_points(place / "points", law.points);
      check_number(place / "factor", law.factor);
      return;
  }
}

bool lies_on_rigid_member(const Foundation& foundation, const Model& data, const Names& names) {
  if (!names.members.contains(foundation.member)) {
    return false;
  }
  const Section* section = section_of(data.members[names.members.index(foundation.member)], data, names);
  return section != nullptr && std::isinf(section->EI.constant);
}

/// Checks a foundation along the tangent or against rotation.
void check_component(const Place& place, const Foundation& foundation) {
  const bool turns = foundation.component == FoundationComponent::rotation;
  const std::string kind = turns ? "a foundation against rotation" : "a foundation along the tangent";
  if (foundation.reaction != Reaction::bilateral) {
    (place / "reaction").report("not_supported", kind + " must be bilateral");
  }
  if (foundation.shear_stiffness > 0.0) {
    (place / "shear_stiffness").report("not_supported", kind + " has no shear layer");
  }
  if (turns && foundation.displacement) {
    (place / "displacement").report("not_supported", kind + " does not follow a displacement of the ground");
  }
}

/// Requires what the surface of the ground beside contact is computed for.
void check_one_sided_layer(const Place& place, const Foundation& foundation) {
  const bool is_plane = foundation.gap_along.empty() && !foundation.outline;
  if (!is_plane || foundation.law || !(foundation.stiffness > 0.0) || !std::isfinite(foundation.stiffness)) {
    place.report(
        "not_supported",
        "the shear layer of a one-sided foundation needs a constant stiffness above zero, no outline "
        "and no gap that varies");
  }
}

void check_prescribed(const Place& place, double value, bool fixed) {
  if (require_finite(place, value) && std::abs(value) > 0.0 && !fixed) {
    place.report("not_fixed", place.name() + " is prescribed but is not among the fixed components");
  }
}

/// Checks the displacement of the ground under a spring.
void check_ground(const Place& place, const Spring& spring) {
  require_finite(place / "x", spring.displacement->x);
  require_finite(place / "y", spring.displacement->y);
  require_finite(place / "rotation", spring.displacement->rotation);
  if (spring.to) {
    place.report("ambiguous", "a spring between two nodes does not reach the ground: leave displacement out");
  } else if (spring.direction && spring.displacement->rotation != 0.0) {
    (place / "rotation").report("not_supported", "the ground's rotation moves rotational springs only");
  } else if (!spring.direction && (spring.displacement->x != 0.0 || spring.displacement->y != 0.0)) {
    place.report("not_supported", "only the ground's rotation moves a rotational spring");
  }
}

/// Checks one component of the displacement of the ground under a foundation.
void check_ground(const Place& place, const AlongMember& value) {
  if (value.varies()) {
    check_along(place, value.points, kMaxPointsAlong, require_finite);
  } else {
    require_finite(place, value.constant);
  }
}

void check_ground(const Place& place, const Foundation& foundation) {
  check_ground(place / "x", foundation.displacement->x);
  check_ground(place / "y", foundation.displacement->y);
  if (foundation.shear_stiffness != 0.0) {
    place.report("not_supported", "ground that moves has no shear layer");
  }
}

void check_support(const Place& place, const Support& support) {
  if (!support.x && !support.y && !support.rotation) {
    (place / "fixed").report("empty", "a support must fix at least one of x, y, rotation");
  }
  require_finite(place / "angle_degrees", support.angle_degrees);
  if (support.displacement) {
    const Place displacement = place / "displacement";
    check_prescribed(displacement / "x", support.displacement->x, support.x);
    check_prescribed(displacement / "y", support.displacement->y, support.y);
    check_prescribed(displacement / "rotation", support.displacement->rotation, support.rotation);
  }
}

}  // namespace

void check_law_at_one_place(const Place& owner, const ReactionLaw& law) {
  check_law(owner, law);
  const auto require_constant = [](const Place& place, const AlongMember& value) {
    if (value.varies()) {
      place.report("not_supported",
                   "a spring or joint acts at one place: " + place.name() + " must be a number");
    }
  };
  const Place place = owner / "law";
  require_constant(place / "stiffness", law.stiffness);
  require_constant(place / "capacity", law.capacity);
  require_constant(place / "factor", law.factor);
}

void check_location(const Place& place, const Location& location, const Names& names) {
  if (location.node.empty() == location.member.empty()) {
    place.report("ambiguous", "a location is either a node or a member with a fraction");
  } else if (!location.node.empty()) {
    names.nodes.require(place / "node", location.node);
  } else {
    require_beam(place / "member", location.member, names);
    require_between(place / "fraction", location.fraction, 0.0, 1.0);
  }
}

void check_supports(const Place& model, const Model& data, const Names& names) {
  const Place supports = model / "supports";
  require_count(supports, data.supports.size(), kMaxSupports);
  Ids supported("support of node");
  for (std::size_t i = 0; i < data.supports.size(); ++i) {
    const Place place = supports / i;
    const Support& support = data.supports[i];
    if (names.nodes.require(place / "node", support.node)) {
      supported.add(place / "node", support.node);
    }
    check_support(place, support);
  }
}

void check_springs(const Place& model, const Model& data, const Names& names) {
  const Place springs = model / "springs";
  require_count(springs, data.springs.size(), kMaxSprings);
  Ids ids("spring");
  const bool turns_node = std::any_of(data.springs.begin(), data.springs.end(),
                                      [](const Spring& spring) { return spring.to && !spring.direction; });
  const auto free_to_turn = turns_node ? nodes_free_to_turn(data) : std::unordered_set<std::string>{};
  for (std::size_t i = 0; i < data.springs.size(); ++i) {
    const Place place = springs / i;
    const Spring& spring = data.springs[i];
    ids.add(place / "id", spring.id);
    check_location(place / "at", spring.at, names);
    if (spring.to) {
      check_other_end(place, spring, free_to_turn, names);
    }
    if (spring.direction) {
      require_direction(place / "direction", *spring.direction);
    }
    if (spring.law) {
      check_law_at_one_place(place, *spring.law);
    } else {
      check_stiffness(place / "stiffness", spring.stiffness, spring.reaction);
    }
    check_gap(place / "gap", spring.gap, spring.reaction);
    if (spring.pretension) {
      check_pretension(place / "pretension", spring, data, names);
    }
    if (spring.displacement) {
      check_ground(place / "displacement", spring);
    }
  }
}

void check_foundations(const Place& model, const Model& data, const Names& names) {
  const Place foundations = model / "foundations";
  require_count(foundations, data.foundations.size(), kMaxFoundations);
  Ids ids("foundation");
  for (std::size_t i = 0; i < data.foundations.size(); ++i) {
    const Place place = foundations / i;
    const Foundation& foundation = data.foundations[i];
    ids.add(place / "id", foundation.id);
    require_beam(place / "member", foundation.member, names);
    if (foundation.law) {
      check_law(place, *foundation.law);
    } else {
      check_stiffness(place / "stiffness", foundation.stiffness, foundation.reaction);
    }
    if (std::isinf(foundation.stiffness) && lies_on_rigid_member(foundation, data, names)) {
      (place / "stiffness")
          .report("not_supported", "a rigid foundation needs a member that bends: its EI is rigid too");
    }
    if (foundation.component != FoundationComponent::normal) {
      check_component(place, foundation);
    }
    if (require_not_negative(place / "shear_stiffness", foundation.shear_stiffness) &&
        has_one_sided_layer(foundation)) {
      check_one_sided_layer(place / "shear_stiffness", foundation);
    } else if (foundation.ground_end != GroundEnd::free) {
      (place / "ground_end")
          .report("not_supported",
                  "only a one-sided foundation with shear_stiffness has ground beyond its range");
    }
    require_fractions(place / "range", foundation.range);
    if (foundation.gap_along.empty()) {
      check_gap(place / "gap", foundation.gap, foundation.reaction);
    } else {
      check_gaps(place / "gap", foundation.gap_along, foundation.reaction);
    }
    if (foundation.outline) {
      check_outline(place, foundation);
    }
    if (foundation.displacement) {
      check_ground(place / "displacement", foundation);
    }
    if (foundation.direction) {
      require_direction(place / "direction", *foundation.direction);
    }
  }
}

}  // namespace snapthrough::checks
