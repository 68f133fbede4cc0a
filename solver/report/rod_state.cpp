#include "solver/report/rod_state.h"

#include <cmath>

#include "solver/mesh/dof_map.h"
#include "solver/report/cable_state.h"

namespace snapthrough {

using Eigen::Vector3d;
using Eigen::VectorXd;

namespace {

Vector3d displacement_of(const VectorXd& y, int node) { return DofMap::at(y, node); }

/// Sets the extremes of a rod: its force is constant, and one of its ends moves most.
void set_peaks(MemberState& rod) {
  const Peak force{rod.axial_force.front(), rod.s.front()};
  const Peak none{0.0, rod.s.front()};
  const double first = std::hypot(rod.u.front(), rod.v.front());
  const double last = std::hypot(rod.u.back(), rod.v.back());
  rod.extremes = {{force, force},
                  {none, none},
                  {none, none},
                  first >= last ? Peak{first, rod.s.front()} : Peak{last, rod.s.back()},
                  {}};
}

/// Axial force of a rod, tension positive, in the model's units.
double axial_force_of(const Structure& structure, const NodeSpring& rod, const VectorXd& y) {
  const double w = rod.motion(y, structure.geometry == Geometry::linear).w;
  return -in_users_sense(rod.sense, structure.scales.force * rod.law.reaction(w)) + 0.0;
}

}  // namespace

Utilisation rod_utilisation(const Structure& structure, std::size_t spring, const VectorXd& y) {
  const NodeSpring rod = rod_of(structure, spring);
  if (rod.is_cable()) {
    const Peak tension = largest_tension(structure, spring, y);
    return {tension.value / *structure.model->springs[spring].strength, tension.s, Fibre::left};
  }
  const double force = axial_force_of(structure, rod, y);
  return {force / *structure.model->springs[spring].strength, 0.0, Fibre::left};
}

MemberMode rod_mode(const Structure& structure, std::size_t spring, const VectorXd& mode, int points) {
  const ResolvedModel& model = *structure.model;
  const NodeSpring rod = rod_of(structure, spring);
  const double L = structure.scales.length;
  const Vector3d from = displacement_of(mode, rod.node);
  const Vector3d change = displacement_of(mode, rod.to) - from;
  const Vector3d along = rod.sense * rod.direction();
  MemberMode out;
  out.id = model.springs[spring].id;
  for (int i = 0; i < points; ++i) {
    const double fraction = static_cast<double>(i) / (points - 1);
    out.s.push_back(fraction * rod.length * L);
    out.u.push_back(L * (from[0] + fraction * change[0]));
    out.v.push_back(L * (from[1] + fraction * change[1]));
    out.rotation.push_back((along[0] * change[1] - along[1] * change[0]) / rod.length);
  }
  return out;
}

MemberState rod_state(const Structure& structure, std::size_t spring, const VectorXd& y, int points) {
  const ResolvedModel& model = *structure.model;
  const NodeSpring rod = rod_of(structure, spring);
  if (rod.is_cable()) return cable_state(structure, spring, y, points);
  const bool is_linear = structure.geometry == Geometry::linear;
  const SpringMotion motion = rod.motion(y, is_linear);
  const double force = axial_force_of(structure, rod, y);
  const Vector3d turned = rod.sense * motion.gradient;
  const Vector3d along = rod.sense * rod.direction();
  const Node& start = model.nodes[model.springs[spring].at.node];
  const Node& end = model.nodes[model.springs[spring].to->node];
  MemberMode moved = rod_mode(structure, spring, y, points);
  MemberState out;
  out.id = moved.id;
  out.s = std::move(moved.s);
  out.u = std::move(moved.u);
  out.v = std::move(moved.v);
  out.rotation = std::move(moved.rotation);
  if (!is_linear)
    out.rotation.assign(out.s.size(),
                        std::atan2(along[0] * turned[1] - along[1] * turned[0], along.dot(turned)));
  for (std::size_t i = 0; i < out.s.size(); ++i) {
    const double fraction = static_cast<double>(i) / (points - 1);
    out.x0.push_back(start.x + fraction * (end.x - start.x));
    out.y0.push_back(start.y + fraction * (end.y - start.y));
    out.x.push_back(out.x0[i] + out.u[i]);
    out.y.push_back(out.y0[i] + out.v[i]);
  }
  out.axial_force.assign(out.s.size(), force);
  out.shear_force.assign(out.s.size(), 0.0);
  out.bending_moment.assign(out.s.size(), 0.0);
  set_peaks(out);
  if (model.springs[spring].strength) {
    const Utilisation utilisation = rod_utilisation(structure, spring, y);
    out.utilisation_left.assign(out.s.size(), utilisation.value);
    out.utilisation_right = out.utilisation_left;
    out.extremes.utilisation = utilisation;
  }
  return out;
}

}  // namespace snapthrough
