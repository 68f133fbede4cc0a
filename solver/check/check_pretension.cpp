/// Checks of the pretension of members, and of springs between two nodes.

#include <cmath>
#include <string>
#include <variant>

#include "solver/check/check_parts.h"
#include "solver/model/limits.h"

namespace snapthrough::checks {

namespace {

/// Sine of the angle from which two directions are not parallel: that of given coordinates with six digits.
constexpr double kParallel = 1e-6;

void check_values(const Place& place, const Pretension& given) {
  if (given.force.has_value() == given.unstressed_length.has_value())
    place.report("ambiguous", "a pretension is given by force or by unstressed_length, and not by both");
  if (given.force) require_finite(place / "force", *given.force);
  if (given.unstressed_length) require_positive(place / "unstressed_length", *given.unstressed_length);
}

}  // namespace

void check_pretension(const Place& place, const Member& member, const Model& data, const Names& names) {
  check_values(place, *member.pretension);
  if (!std::holds_alternative<LineCurve>(member.curve))
    place.report("not_supported", "only a straight member has a pretension");
  const Section* section = section_of(member, data, names);
  if (!member.pretension->force || section == nullptr) return;
  if (section->EA.varies() && !is_rod(member))
    (place / "force")
        .report("not_supported",
                "the EA of this member varies, so that a force strains it unevenly: give unstressed_length");
  if (std::isinf(section->EA.constant))
    (place / "force").report("not_supported", "a member whose EA is rigid has no pretension by force");
}

void check_pretension(const Place& place, const Spring& spring, const Model& data, const Names& names) {
  check_values(place, *spring.pretension);
  if (!spring.to || !spring.direction) {
    place.report("not_supported", "only a spring between two nodes, along a direction, has a pretension");
    return;
  }
  if (spring.pretension->force && (spring.law || !(spring.stiffness > 0.0)))
    (place / "force")
        .report("not_supported", "a force needs a stiffness above zero: give unstressed_length with a law");
  if (std::isinf(spring.stiffness)) place.report("not_supported", "a rigid spring has no pretension");
  if (!names.nodes.contains(spring.at.node) || !names.nodes.contains(spring.to->node)) return;
  const Node& at = data.nodes[names.nodes.index(spring.at.node)];
  const Node& to = data.nodes[names.nodes.index(spring.to->node)];
  const double dx = to.x - at.x;
  const double dy = to.y - at.y;
  const auto [x, y] = *spring.direction;
  const double size = std::hypot(dx, dy) * std::hypot(x, y);
  if (!(size > 0.0) || std::abs(dx * y - dy * x) > kParallel * size)
    place.report("not_supported",
                 "a pretension acts along the line between the nodes: direction must be along it, and the "
                 "nodes must lie apart");
}

}  // namespace snapthrough::checks
