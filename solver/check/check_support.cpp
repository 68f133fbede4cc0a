/// Checks of supports, springs and foundations.

#include <cmath>

#include "solver/check/check_parts.h"
#include "solver/model/limits.h"

namespace snapthrough::checks {

namespace {

void check_gap(const Place& place, double gap, Reaction reaction) {
  if (require_not_negative(place, gap) && gap > 0.0 && reaction == Reaction::bilateral) {
    place.report("needs_one_sided", "gap needs reaction compression_only or tension_only");
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

/// Checks points (w, p) of a law: both ascend from the origin, w strictly.
void check_points(const Place& place, const std::vector<std::array<double, 2>>& points) {
  require_count(place, points.size(), kMaxPointsAlong);
  const bool has_origin = !points.empty() && points.front()[0] == 0.0 && points.front()[1] == 0.0;
  const std::size_t first = has_origin ? 1 : 0;
  if (points.size() <= first) {
    place.report("empty", "a table needs a point beside the origin");
    return;
  }
  std::array<double, 2> last{0.0, 0.0};
  for (std::size_t i = first; i < points.size(); ++i) {
    const auto [w, p] = points[i];
    if (!require_finite(place / i / std::size_t{0}, w) || !require_finite(place / i / std::size_t{1}, p)) {
      return;
    }
    if (!(w > last[0])) {
      (place / i / std::size_t{0})
          .report("not_increasing", "displacements must ascend from the origin (0, 0)");
    }
    if (!(p >= last[1])) {
      (place / i / std::size_t{1}).report("not_increasing", "forces must not fall");
    }
    if (i == first && !(p > 0.0)) {
      (place / i / std::size_t{1})
          .report("out_of_range", "the first force beside the origin must be positive");
    }
    last = {w, p};
  }
}

void check_law(const Place& support, const ReactionLaw& law) {
  if (law.type == ReactionLaw::Type::linear) {
    check_number(support / "stiffness", law.stiffness);
    return;
  }
  const Place place = support / "law";
  if (law.type == ReactionLaw::Type::table) {
    check_points(place / "points", law.points);
    check_number(place / "factor", law.factor);
    return;
  }
  check_number(place / "stiffness", law.stiffness);
  check_number(place / "capacity", law.capacity);
  if (law.type == ReactionLaw::Type::power) {
    require_positive(place / "reference", law.reference);
    if (!(law.exponent > 0.0 && law.exponent < 1.0)) {
      (place / "exponent").report("out_of_range", "exponent must be above 0 and below 1");
    }
  }
}

/// Requires the numbers of a spring's law to be constant, since a spring has one place.
void check_constant(const Place& support, const ReactionLaw& law) {
  const auto require_constant = [](const Place& place, const AlongMember& value) {
    if (value.varies()) {
      place.report("not_supported", "a spring acts at one place: " + place.name() + " must be a number");
    }
  };
  const Place place = support / "law";
  require_constant(place / "stiffness", law.stiffness);
  require_constant(place / "capacity", law.capacity);
  require_constant(place / "factor", law.factor);
}

void check_tangential(const Place& place, const Foundation& foundation) {
  if (foundation.reaction != Reaction::bilateral) {
    (place / "reaction").report("not_supported", "a foundation along the tangent must be bilateral");
  }
  if (foundation.shear_stiffness > 0.0) {
    (place / "shear_stiffness").report("not_supported", "a foundation along the tangent has no shear layer");
  }
}

void check_prescribed(const Place& place, double value, bool fixed) {
  if (require_finite(place, value) && std::abs(value) > 0.0 && !fixed) {
    place.report("not_fixed", place.name() + " is prescribed but is not among the fixed components");
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

void check_location(const Place& place, const Location& location, const Names& names) {
  if (location.node.empty() == location.member.empty()) {
    place.report("ambiguous", "a location is either a node or a member with a fraction");
  } else if (!location.node.empty()) {
    names.nodes.require(place / "node", location.node);
  } else {
    names.members.require(place / "member", location.member);
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
  for (std::size_t i = 0; i < data.springs.size(); ++i) {
    const Place place = springs / i;
    const Spring& spring = data.springs[i];
    ids.add(place / "id", spring.id);
    check_location(place / "at", spring.at, names);
    if (spring.direction) {
      require_direction(place / "direction", *spring.direction);
    }
    if (spring.law) {
      check_law(place, *spring.law);
      check_constant(place, *spring.law);
    } else {
      require_not_negative(place / "stiffness", spring.stiffness);
    }
    check_gap(place / "gap", spring.gap, spring.reaction);
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
    names.members.require(place / "member", foundation.member);
    if (foundation.law) {
      check_law(place, *foundation.law);
    } else {
      require_not_negative(place / "stiffness", foundation.stiffness);
    }
    if (foundation.tangential) {
      check_tangential(place, foundation);
    }
    require_not_negative(place / "shear_stiffness", foundation.shear_stiffness);
    require_fractions(place / "range", foundation.range);
    check_gap(place / "gap", foundation.gap, foundation.reaction);
    if (foundation.direction) {
      require_direction(place / "direction", *foundation.direction);
    }
  }
}

}  // namespace snapthrough::checks
