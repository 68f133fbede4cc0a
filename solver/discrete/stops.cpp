#include "solver/discrete/stops.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <vector>

#include "solver/support/law.h"

namespace snapthrough {

bool is_stop(const ResolvedSpring& spring) {
  return spring.direction && !spring.rod && !std::isfinite(initial_stiffness(spring));
}

namespace {

/// Elements that begin where a stop acts between the ends of a member, ascending.
std::vector<int> elements_at_stops(const ResolvedModel& model, const Mesh& mesh) {
  std::vector<int> out;
  for (const ResolvedSpring& spring : model.springs) {
    if (!is_stop(spring) || !spring.at.is_on_member()) continue;
    const int member = spring.at.member;
    const MeshPlace place = place_of(mesh, member, spring.at.fraction);
    if (place.xi == 0.0 && place.element > mesh.first[static_cast<std::size_t>(member)])
      out.push_back(place.element);
  }
  std::sort(out.begin(), out.end());
  out.erase(std::unique(out.begin(), out.end()), out.end());
  return out;
}

}  // namespace

int node_of_stop(const Structure& structure, const ResolvedSpring& stop) {
  const ResolvedModel& model = *structure.model;
  if (!stop.at.is_on_member()) return stop.at.node;
  const int m = stop.at.member;
  const ResolvedMember& member = model.members[static_cast<std::size_t>(m)];
  const MeshPlace place = place_of(structure.mesh, m, stop.at.fraction);
  if (place.xi == 1.0) return member.end;
  if (place.xi != 0.0) return -1;
  if (place.element == structure.mesh.first[static_cast<std::size_t>(m)]) return member.start;
  const auto first = structure.stop_elements.begin();
  const auto at = std::lower_bound(first, structure.stop_elements.end(), place.element);
  return structure.first_stop_node + static_cast<int>(at - first);
}

void number_nodes(Structure& structure) {
  const ResolvedModel& model = *structure.model;
  structure.first_ground = static_cast<int>(model.nodes.size());
  structure.first_stop_node = structure.first_ground + static_cast<int>(ground_displacements(model).size());
  structure.stop_elements = elements_at_stops(model, structure.mesh);
  structure.nodes = structure.first_stop_node + static_cast<int>(structure.stop_elements.size());
  const std::vector<int>& first = structure.mesh.first;
  std::merge(first.begin(), first.end(), structure.stop_elements.begin(), structure.stop_elements.end(),
             std::back_inserter(structure.parts_between_nodes));
}

}  // namespace snapthrough
