#include "solver/discrete/stops.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <vector>

#include "solver/model/id_index.h"
#include "solver/support/law.h"

namespace snapthrough {

bool is_stop(const Spring& spring) {
  return spring.direction && !spring.rod && !std::isfinite(initial_stiffness(spring));
}

namespace {

/// Elements that begin where a stop acts between the ends of a member, ascending.
std::vector<int> elements_at_stops(const Model& model, const Mesh& mesh) {
  std::vector<int> out;
  for (const Spring& spring : model.springs) {
    if (!is_stop(spring) || spring.at.member.empty()) continue;
    const int member = index_of(model.members, spring.at.member);
    const MeshPlace place = place_of(mesh, member, spring.at.fraction);
    if (place.xi == 0.0 && place.element > mesh.first[static_cast<std::size_t>(member)])
      out.push_back(place.element);
  }
  std::sort(out.begin(), out.end());
  out.erase(std::unique(out.begin(), out.end()), out.end());
  return out;
}

}  // namespace

int node_of_stop(const Structure& structure, const Model& model, const Spring& stop) {
  if (stop.at.member.empty()) return index_of(model.nodes, stop.at.node);
  const int m = index_of(model.members, stop.at.member);
  const Member& member = model.members[static_cast<std::size_t>(m)];
  const MeshPlace place = place_of(structure.mesh, m, stop.at.fraction);
  if (place.xi == 1.0) return index_of(model.nodes, member.end);
  if (place.xi != 0.0) return -1;
  if (place.element == structure.mesh.first[static_cast<std::size_t>(m)])
    return index_of(model.nodes, member.start);
  const auto first = structure.stop_elements.begin();
  const auto at = std::lower_bound(first, structure.stop_elements.end(), place.element);
  return structure.first_stop_node + static_cast<int>(at - first);
}

void number_nodes(const Model& model, Structure& structure) {
  structure.first_ground = static_cast<int>(model.nodes.size());
  structure.first_stop_node = structure.first_ground + static_cast<int>(ground_displacements(model).size());
  structure.stop_elements = elements_at_stops(model, structure.mesh);
  structure.nodes = structure.first_stop_node + static_cast<int>(structure.stop_elements.size());
  const std::vector<int>& first = structure.mesh.first;
  std::merge(first.begin(), first.end(), structure.stop_elements.begin(), structure.stop_elements.end(),
             std::back_inserter(structure.parts_between_nodes));
}

}  // namespace snapthrough
