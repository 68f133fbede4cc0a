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
    require_not_negative(place / "stiffness", spring.stiffness);
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
    require_not_negative(place / "stiffness", foundation.stiffness);
    require_not_negative(place / "shear_stiffness", foundation.shear_stiffness);
    require_fractions(place / "range", foundation.range);
    check_gap(place / "gap", foundation.gap, foundation.reaction);
    if (foundation.direction) {
      require_direction(place / "direction", *foundation.direction);
    }
  }
}

}  // namespace snapthrough::checks
