#include "solver/report/state.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <memory>
#include <span>

#include "solver/discrete/element_reader.h"
#include "solver/discrete/foundation_springs.h"
#include "solver/discrete/layer_state.h"
#include "solver/geometry/stress_free_axis.h"
#include "solver/model/id_index.h"
#include "solver/numeric/number_text.h"
#include "solver/report/contact.h"
#include "solver/report/rod_state.h"
#include "solver/report/section_force.h"
#include "solver/report/support_state.h"
#include "solver/support/rods.h"

namespace snapthrough {
namespace {

MemberState member_state(const Structure& structure, const Model& model, const Eigen::VectorXd& y,
                         double lambda, const std::vector<LayerState>& layers, int member, int points) {
  const double L = structure.scales.length;
  const double F = structure.scales.force;
  const StressFreeAxis& axis = *structure.stress_free[member];
  const double length = axis.perfect().length();
  MemberState out;
  out.id = model.members[member].id;
  int current = -1;
  std::unique_ptr<ElementReader> reader;
  std::unique_ptr<SectionForces> forces;
  for (int i = 0; i < points; ++i) {
    const double fraction = static_cast<double>(i) / (points - 1);
    const MeshPlace place = place_of(structure.mesh, member, fraction);
    if (place.element != current) {
      current = place.element;
      reader = std::make_unique<ElementReader>(structure, y, current);
      forces = std::make_unique<SectionForces>(structure, model, y, lambda, layers, current);
    }
    const auto u = reader->displacement(place.xi);
    const auto n = forces->at(place.xi);
    const StressFreePoint p = axis.at(fraction * length);
    // small displacements: equilibrium of the undeformed shape
    const double angle = p.angle + (structure.geometry == Geometry::linear ? 0.0 : u[2]);
    out.s.push_back(fraction * length);
    out.x0.push_back(structure.origin[0] + p.x);
    out.y0.push_back(structure.origin[1] + p.y);
    out.u.push_back(L * u[0]);
    out.v.push_back(L * u[1]);
    out.x.push_back(structure.origin[0] + p.x + L * u[0]);
    out.y.push_back(structure.origin[1] + p.y + L * u[1]);
    out.rotation.push_back(u[2]);
    out.axial_force.push_back(F * (n[0] * std::cos(angle) + n[1] * std::sin(angle)));
    out.shear_force.push_back(F * (-n[0] * std::sin(angle) + n[1] * std::cos(angle)));
    out.bending_moment.push_back(F * L * n[2]);
  }
  return out;
}

/// Mesh place of a fraction, on an element within the foundation's range.
MeshPlace place_under(const Mesh& mesh, int member, const Foundation& foundation, double fraction) {
  const MeshPlace place = place_of(mesh, member, fraction);
  const bool is_beyond = place.xi == 0.0 && place.element > mesh.first[static_cast<std::size_t>(member)] &&
                         fraction >= foundation.range[1] - kOnePlace;
  return is_beyond ? MeshPlace{place.element - 1, 1.0} : place;
}

FoundationState foundation_state(const Structure& structure, const Model& model, const Eigen::VectorXd& y,
                                 int index, int points) {
  const Foundation& foundation = model.foundations[index];
  const int member = index_of(model.members, foundation.member);
  const AxisCurve& axis = *structure.axes[member];
  const FoundationLaw& law = structure.foundation_laws[index];
  FoundationState out;
  out.id = foundation.id;
  out.contact = contact_intervals(structure, model, y, index);
  const auto touches = [&out](double s) {
    return std::any_of(out.contact.begin(), out.contact.end(),
                       [s](const auto& zone) { return zone[0] <= s && s <= zone[1]; });
  };
  for (int i = 0; i < points; ++i) {
    const double fraction =
        foundation.range[0] + (foundation.range[1] - foundation.range[0]) * i / (points - 1);
    const MeshPlace place = place_under(structure.mesh, member, foundation, fraction);
    const auto u = ElementReader(structure, y, place.element, law).displacement(place.xi);
    // results use the user's sign: a pushing medium has a positive reaction, a pulling one a negative
    const Law acting = law_on(structure, law, place.element).at(fraction);
    double beyond = law.penetration(place_on_axis(structure, place.element, place.xi), {u[0], u[1]}).depth;
    // beside contact the surface of a shear layer lies deeper than the member
    const bool is_apart = law.has_layer() && !touches(fraction * axis.length());
    const double reaction = is_apart ? 0.0 : acting.reaction_beyond(beyond);
    // displacement of the base's surface by its given stiffness, where the element has a bounded one
    if (law.law.one_sided && beyond > 0.0 && acting.stiffness > 0.0)
      beyond *= acting.stiffness / law.at(fraction).stiffness;
    const double w = law.surface ? beyond : acting.gap + beyond;
    out.s.push_back(fraction * axis.length());
    out.reaction.push_back(in_users_sense(law.sense, structure.scales.line_load() * reaction));
    out.displacement.push_back(in_users_sense(law.sense, structure.scales.length * w));
  }
  return out;
}

}  // namespace

std::vector<MemberState> member_states(const Structure& structure, const Model& model,
                                       const Eigen::VectorXd& y, double lambda, int points) {
  std::vector<MemberState> out;
  const std::vector<LayerState> layers = layer_states(structure, y);
  for (std::size_t m = 0; m < model.members.size(); ++m)
    out.push_back(member_state(structure, model, y, lambda, layers, static_cast<int>(m), points));
  const auto state_of = [&](std::size_t spring) { return rod_state(structure, model, spring, y, points); };
  insert_rods(model.springs, state_of, out);
  return out;
}

State make_state(const Structure& structure, const Model& model, const Eigen::VectorXd& y, double lambda,
                 int points) {
  State state;
  state.load_factor = lambda / structure.scales.load;
  state.members = member_states(structure, model, y, lambda, points);
  for (std::size_t i = 0; i < model.foundations.size(); ++i)
    state.foundations.push_back(foundation_state(structure, model, y, static_cast<int>(i), points));
  static_cast<void>(add_forces_on_structure(structure, model, y, lambda, state));
  return state;
}

double imbalance(const Structure& structure, const Model& model, const Eigen::VectorXd& y, double lambda) {
  State forces;
  return add_forces_on_structure(structure, model, y, lambda, forces);
}

std::string imbalance_text(double load_factor, double left) {
  return "the state that was found at load factor " + number(load_factor) +
         " is no equilibrium and is not reported: its actions and reactions leave " + rounded(left) +
         " of the largest of them";
}

std::vector<double> contact_fractions(const Structure& structure, const Model& model,
                                      const Eigen::VectorXd& y) {
  std::vector<double> out;
  for (std::size_t i = 0; i < model.foundations.size(); ++i) {
    const Foundation& foundation = model.foundations[i];
    const double length = structure.axes[index_of(model.members, foundation.member)]->length() *
                          (foundation.range[1] - foundation.range[0]);
    double contact = 0.0;
    for (const auto& interval : contact_intervals(structure, model, y, static_cast<int>(i)))
      contact += interval[1] - interval[0];
    out.push_back(std::clamp(contact / length, 0.0, 1.0));
  }
  return out;
}

}  // namespace snapthrough
