/// Checks of what joins two nodes: springs between nodes and one-sided members.

#include <string>
#include <variant>

#include "solver/check/check_parts.h"
#include "solver/support/law.h"

namespace snapthrough::checks {

std::unordered_set<std::string> nodes_free_to_turn(const Model& model) {
  std::unordered_set<std::string> nodes;
  for (const Member& member : model.members) nodes.insert({member.start, member.end});
  for (const Member& member : model.members) {
    if (!is_hinged_at_start(member)) nodes.erase(member.start);
    if (!is_hinged_at_end(member)) nodes.erase(member.end);
  }
  for (const Support& support : model.supports)
    if (support.rotation) nodes.erase(support.node);
  for (const Spring& spring : model.springs)
    if (!spring.direction && !spring.to && initial_stiffness(spring) > 0.0) nodes.erase(spring.at.node);
  return nodes;
}

bool require_beam(const Place& place, const std::string& member, const Names& names) {
  if (!names.members.require(place, member)) return false;
  if (!names.rods.contains(member)) return true;
  place.report("not_supported",
               "member " + in_quotes(member) +
                   " is one-sided: it has an axial force and no other action between its nodes");
  return false;
}

void check_rod(const Place& place, const Member& rod) {
  if (!std::holds_alternative<LineCurve>(rod.curve))
    (place / "curve").report("not_supported", "a one-sided member is straight: leave curve out");
  const auto require_hinge = [&place](const char* end, bool resists) {
    if (resists)
      (place / "release" / end / "rotation")
          .report("not_supported", "a one-sided member is hinged at both ends: leave release out");
  };
  require_hinge("start", rod.release_start_stiffness > 0.0 || rod.release_start_law);
  require_hinge("end", rod.release_end_stiffness > 0.0 || rod.release_end_law);
}

void check_other_end(const Place& place, const Spring& spring,
                     const std::unordered_set<std::string>& free_to_turn, const Names& names) {
  check_location(place / "to", *spring.to, names);
  const auto check_end = [&](const Place& end, const Location& at) {
    if (!at.member.empty())
      end.report("not_supported", "a spring with two ends joins nodes: put a node there");
    else if (!spring.direction && free_to_turn.contains(at.node))
      end.report("needs_member", "node " + in_quotes(at.node) +
                                     " has no rotation: all members are hinged there, and no support or "
                                     "rotational spring to ground turns with it");
  };
  check_end(place / "at", spring.at);
  check_end(place / "to", *spring.to);
  if (!spring.at.node.empty() && spring.at.node == spring.to->node)
    (place / "to").report("ambiguous", "at and to are the same node: a spring with two ends needs two");
}

}  // namespace snapthrough::checks
