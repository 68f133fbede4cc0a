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

/// Adds the joint at a released end of a member, unless the end is a hinge.
/// @param end unknown of the end's own rotation
void add_joint(int index, bool at_end, int end, Structure& out) {
  const ResolvedMember& member = out.model->members[static_cast<std::size_t>(index)];
  if (at_end ? is_hinged_at_end(member) : is_hinged_at_start(member)) return;
  Spring spring;  // without a direction: rotational
  spring.stiffness = at_end ? member.release_end_stiffness : member.release_start_stiffness;
  spring.law = at_end ? member.release_end_law : member.release_start_law;
  const SpringLaw law = law_of(spring, out.scales);
  if (law.curve) out.curves.push_back(law.curve);
  out.joints.push_back({DofMap::rotation(at_end ? member.end : member.start), end, law.law, index, at_end});
}

}  // namespace

void number_unknowns(std::vector<SpringLaw>& equations, Structure& out) {
  const ResolvedModel& model = *out.model;
  const Mesh& mesh = out.mesh;
  const int p = mesh.order;
  out.dofs.reserve(mesh.elements.size());
  int next = DofMap::count(out.nodes);
  std::vector<std::array<int, 2>> released(model.members.size(), {-1, -1});
  for (std::size_t m = 0; m < model.members.size(); ++m) {
    const ResolvedMember& member = model.members[m];
    if (member.release_start_rotation) {
      released[m][0] = next++;
      add_joint(static_cast<int>(m), false, released[m][0], out);
    }
    if (member.release_end_rotation) {
      released[m][1] = next++;
      add_joint(static_cast<int>(m), true, released[m][1], out);
    }
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
