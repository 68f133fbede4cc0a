#include "solver/report/state.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>

#include "solver/discrete/element_reader.h"
#include "solver/discrete/foundation_springs.h"
#include "solver/discrete/layer_state.h"
#include "solver/numeric/number_text.h"
#include "solver/report/contact.h"
#include "solver/report/member_reader.h"
#include "solver/report/peaks.h"
#include "solver/report/place_stiffness.h"
#include "solver/report/rod_state.h"
#include "solver/report/support_state.h"
#include "solver/resolve/rods.h"
#include "solver/support/capacity.h"

namespace snapthrough {
namespace {

/// Adds stresses over strength to a member's places and extremes, where its section has a strength.
void add_utilisations(const MemberReader& reader, MemberState& member) {
  if (reader.strength() == nullptr) return;
  for (const double s : member.s) {
    const auto [left, right] = reader.utilisations(reader.place(s));
    member.utilisation_left.push_back(left);
    member.utilisation_right.push_back(right);
  }
  member.extremes.utilisation = reader.largest_utilisation(member);
}

MemberState member_state(const MemberReader& reader, const Structure& structure, const std::string& id,
                         int points) {
  MemberState out;
  out.id = id;
  for (int i = 0; i < points; ++i) {
    const double s = reader.length() * i / (points - 1);
    const MemberReader::Values values = reader.at(reader.place(s));
    const StressFreePoint p = reader.undeformed(s);
    const auto& u = values.displacement;
    out.s.push_back(s);
    out.x0.push_back(structure.origin[0] + p.x);
    out.y0.push_back(structure.origin[1] + p.y);
    out.u.push_back(u[0]);
    out.v.push_back(u[1]);
    out.x.push_back(structure.origin[0] + p.x + u[0]);
    out.y.push_back(structure.origin[1] + p.y + u[1]);
    out.rotation.push_back(u[2]);
    out.axial_force.push_back(values.axial_force);
    out.shear_force.push_back(values.shear_force);
    out.bending_moment.push_back(values.bending_moment);
  }
  out.extremes = reader.peaks(out);
  add_utilisations(reader, out);
  return out;
}

/// Mesh place of a fraction, on an element within the foundation's range.
MeshPlace place_under(const Mesh& mesh, int member, const ResolvedFoundation& foundation, double fraction) {
  const MeshPlace place = place_of(mesh, member, fraction);
  const bool is_beyond = place.xi == 0.0 && place.element > mesh.first[static_cast<std::size_t>(member)] &&
                         fraction >= foundation.range[1] - kOnePlace;
  return is_beyond ? MeshPlace{place.element - 1, 1.0} : place;
}

/// Reads the reaction of one foundation along its range in a state.
class FoundationReader {
 public:
  FoundationReader(const Structure& structure, const Eigen::VectorXd& y, int index,
                   const std::vector<std::array<double, 2>>& contact)
      : structure_(structure),
        y_(y),
        foundation_(structure.model->foundations[static_cast<std::size_t>(index)]),
        member_(foundation_.member),
        law_(structure.foundation_laws[static_cast<std::size_t>(index)]),
        contact_(contact) {}

  struct Values {
    double reaction, displacement;
    double mobilised;  ///< size of the reaction over the capacity of the law; 0 where the law has none
  };
  /// Values at a fraction of the member, in the model's units and the user's sign: a pushing medium has a
  /// positive reaction, a pulling one a negative.
  [[nodiscard]] Values at(double fraction) const;
  [[nodiscard]] double length() const { return structure_.axes[static_cast<std::size_t>(member_)]->length(); }
  /// @brief Extremes of the reaction along the range.
  /// @param known its values at places, ascending
  [[nodiscard]] PeakRange peaks(const FoundationState& known) const;

 private:
  [[nodiscard]] bool touches(double s) const {
    return std::any_of(contact_.begin(), contact_.end(),
                       [s](const auto& zone) { return zone[0] <= s && s <= zone[1]; });
  }

  const Structure& structure_;
  const Eigen::VectorXd& y_;
  const ResolvedFoundation& foundation_;
  int member_;
  const FoundationLaw& law_;
  const std::vector<std::array<double, 2>>& contact_;
};

FoundationReader::Values FoundationReader::at(double fraction) const {
  const MeshPlace place = place_under(structure_.mesh, member_, foundation_, fraction);
  const auto u = ElementReader(structure_, y_, place.element, law_).displacement(place.xi);
  const Law acting = law_on(structure_, law_, place.element).at(fraction);
  double beyond = law_.penetration(place_on_axis(structure_, place.element, place.xi), {u[0], u[1]}).depth;
  // beside contact the surface of a shear layer lies deeper than the member
  const bool is_apart = law_.has_layer() && !touches(fraction * length());
  const double reaction = is_apart ? 0.0 : acting.reaction_beyond(beyond);
  // displacement of the base's surface by its given stiffness, where the element has a bounded one
  if (law_.law.one_sided && beyond > 0.0 && acting.stiffness > 0.0)
    beyond *= acting.stiffness / law_.at(fraction).stiffness;
  const double w = law_.surface ? beyond : acting.gap + beyond;
  // against rotation: moment per length, and rotation
  const Scales& scales = structure_.scales;
  return {in_users_sense(law_.sense, (law_.rotational ? scales.force : scales.line_load()) * reaction),
          in_users_sense(law_.sense, (law_.rotational ? 1.0 : scales.length) * w),
          acting.capacity > 0.0 ? std::abs(reaction) / acting.capacity : 0.0};
}

PeakRange FoundationReader::peaks(const FoundationState& known) const {
  PeakSearch<1> search;
  const auto known_values = [&known](std::size_t i) { return std::array{known.reaction[i]}; };
  const auto values_at = [this](double s) { return std::array{at(s / length()).reaction}; };
  const Mesh& mesh = structure_.mesh;
  const auto& range = foundation_.range;
  const double L = length();
  std::vector<double> ends{L * range[0], L * range[1]};
  for (int e = mesh.first[static_cast<std::size_t>(member_)];
       e < mesh.first[static_cast<std::size_t>(member_) + 1]; ++e)
    ends.push_back(L * mesh.elements[static_cast<std::size_t>(e)].to);
  for (const auto& zone : contact_) ends.insert(ends.end(), zone.begin(), zone.end());
  std::erase_if(ends, [&](double s) { return s < L * range[0] || s > L * range[1]; });
  std::sort(ends.begin(), ends.end());
  for (std::size_t k = 0; k + 1 < ends.size(); ++k)
    if (ends[k + 1] - ends[k] > kOnePlace * L)
      search.add_piece(known.s, known_values, {ends[k], values_at(ends[k])},
                       {ends[k + 1], values_at(ends[k + 1])}, values_at);
  search.refine(values_at);
  return search.range(0, values_at);
}

FoundationState foundation_state(const Structure& structure, const Eigen::VectorXd& y, int index,
                                 int points) {
  const ResolvedModel& model = *structure.model;
  const ResolvedFoundation& foundation = model.foundations[static_cast<std::size_t>(index)];
  FoundationState out;
  out.id = foundation.id;
  out.contact = contact_intervals(structure, y, index);
  const FoundationReader reader(structure, y, index, out.contact);
  for (int i = 0; i < points; ++i) {
    const double fraction =
        foundation.range[0] + (foundation.range[1] - foundation.range[0]) * i / (points - 1);
    const FoundationReader::Values values = reader.at(fraction);
    out.s.push_back(fraction * reader.length());
    out.reaction.push_back(values.reaction);
    out.displacement.push_back(values.displacement);
    if (has_capacity(foundation)) out.mobilised.push_back(values.mobilised);
  }
  out.extremes = reader.peaks(out);
  return out;
}

}  // namespace

std::vector<MemberState> member_states(const Structure& structure, const Eigen::VectorXd& y, double lambda,
                                       int points) {
  const ResolvedModel& model = *structure.model;
  std::vector<MemberState> out;
  const std::vector<LayerState> layers = layer_states(structure, y);
  for (std::size_t m = 0; m < model.members.size(); ++m)
    out.push_back(member_state(MemberReader(structure, y, lambda, layers, static_cast<int>(m)), structure,
                               model.members[m].id, points));
  const auto state_of = [&](std::size_t spring) { return rod_state(structure, spring, y, points); };
  insert_rods(model.springs, state_of, out);
  return out;
}

State make_state(const Structure& structure, const Eigen::VectorXd& y, double lambda,
                 const OutputOptions& output) {
  const ResolvedModel& model = *structure.model;
  const int points = output.points_per_member;
  State state;
  state.load_factor = lambda / structure.scales.load;
  state.members = member_states(structure, y, lambda, points);
  for (std::size_t i = 0; i < model.foundations.size(); ++i)
    state.foundations.push_back(foundation_state(structure, y, static_cast<int>(i), points));
  static_cast<void>(add_forces_on_structure(structure, y, lambda, state));
  state.stiffness_at = place_stiffnesses(structure, y, lambda, output.stiffness_at);
  return state;
}

double imbalance(const Structure& structure, const Eigen::VectorXd& y, double lambda) {
  State forces;
  return add_forces_on_structure(structure, y, lambda, forces);
}

std::string imbalance_text(double load_factor, double left) {
  return "the state that was found at load factor " + number(load_factor) +
         " is no equilibrium and is not reported: its actions and reactions leave " + rounded(left) +
         " of the largest of them";
}

std::vector<double> contact_fractions(const Structure& structure, const Eigen::VectorXd& y) {
  const ResolvedModel& model = *structure.model;
  std::vector<double> out;
  for (std::size_t i = 0; i < model.foundations.size(); ++i) {
    const ResolvedFoundation& foundation = model.foundations[i];
    const double length =
        structure.axes[foundation.member]->length() * (foundation.range[1] - foundation.range[0]);
    double contact = 0.0;
    for (const auto& interval : contact_intervals(structure, y, static_cast<int>(i)))
      contact += interval[1] - interval[0];
    out.push_back(std::clamp(contact / length, 0.0, 1.0));
  }
  return out;
}

}  // namespace snapthrough
