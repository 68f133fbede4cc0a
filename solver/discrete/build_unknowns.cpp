#include "solver/discrete/build_unknowns.h"

#include <array>
#include <cstddef>

#include "solver/mesh/dof_map.h"

namespace snapthrough {
namespace {

/// Numbers the forces of stops from a first unknown on. @return their number
int number_stops(int first, std::vector<SpringLaw>& laws) {
  int stops = 0;
  for (SpringLaw& law : laws)
    if (law.give > 0.0) law.force_unknown = first + stops++;
  return stops;
}

/// Unknowns at a node of a member's end. @param released unknown of its own rotation; -1: it turns with the
/// node
std::array<int, 3> end_of(int node, int released) {
  std::array<int, 3> out = DofMap::of(node);
  if (released >= 0) out[2] = released;
  return out;
}

}  // namespace

void number_unknowns(std::vector<SpringLaw>& equations, Structure& out) {
  const ResolvedModel& model = *out.model;
  const Mesh& mesh = out.mesh;
  const int p = mesh.order;
  out.dofs.reserve(mesh.elements.size());
  int next = DofMap::count(out.nodes);
  std::vector<std::array<int, 2>> released(model.members.size(), {-1, -1});
  const auto release = [&](bool is_released, int node, double stiffness, int& end) {
    if (!is_released) return;
    end = next++;
    if (stiffness > 0.0)
      out.joints.push_back({DofMap::rotation(node), end, out.scales.scaled_rotational(stiffness)});
  };
  for (std::size_t m = 0; m < model.members.size(); ++m) {
    const ResolvedMember& member = model.members[m];
    release(member.release_start_rotation, member.start, member.release_start_stiffness, released[m][0]);
    release(member.release_end_rotation, member.end, member.release_end_stiffness, released[m][1]);
  }
  out.releases = next - DofMap::count(out.nodes);
  out.stops = number_stops(next, equations);
  number_stops(next, out.spring_laws);
  next += out.stops;
  const auto first_stop = out.stop_elements.begin();
  auto next_stop = first_stop;
  for (std::size_t m = 0; m < model.members.size(); ++m) {
    const int start = model.members[m].start;
    const int end = model.members[m].end;
    std::array<int, 3> a = end_of(start, released[m][0]);
    for (int e = mesh.first[m]; e < mesh.first[m + 1]; ++e) {
      ElementDofs dofs;
      dofs.a = a;
      dofs.v = next;
      dofs.s = dofs.v + DofMap::count(p);
      dofs.m = dofs.s + DofMap::count(p);
      next = dofs.m + DofMap::components;
      dofs.b = {next, next + 1, next + 2};
      if (e + 1 == mesh.first[m + 1])
        dofs.b = end_of(end, released[m][1]);
      else if (next_stop != out.stop_elements.end() && *next_stop == e + 1)
        dofs.b = DofMap::of(out.first_stop_node + static_cast<int>(next_stop++ - first_stop));
      else
        next += DofMap::components;
      a = dofs.b;
      out.dofs.push_back(dofs);
    }
  }
  out.size = next;
  out.proportional_load = Eigen::VectorXd::Zero(out.size);
  out.constant_load = Eigen::VectorXd::Zero(out.size);
}

}  // namespace snapthrough
