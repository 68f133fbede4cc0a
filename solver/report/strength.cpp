#include "solver/report/strength.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "solver/discrete/layer_state.h"
#include "solver/report/member_reader.h"
#include "solver/report/rod_state.h"
#include "solver/report/utilisation.h"

namespace snapthrough {
namespace {

/// Stress over strength at sampled places from which a member is searched between them. Between those places
/// forces are smooth, so that a stress that is twice as large there would need a mesh that does not resolve
/// it.
constexpr double kNear = 0.5;

/// Keeps the larger of two in size.
void keep(const std::string& member, const Utilisation& place, std::optional<MemberUtilisation>& largest) {
  if (!largest || exceeds(place, largest->place)) largest = {member, place};
}

/// Largest stress over strength of a member whose section has a strength.
Utilisation utilisation_of(const MemberReader& reader) {
  const Utilisation sampled = reader.sampled_utilisation();
  return std::abs(sampled.value) < kNear ? sampled : reader.largest_utilisation({});
}

void keep_rods(const Structure& structure, const Eigen::VectorXd& y,
               std::optional<MemberUtilisation>& largest) {
  const std::vector<ResolvedSpring>& springs = structure.model->springs;
  for (std::size_t i = 0; i < springs.size(); ++i)
    if (springs[i].strength) keep(springs[i].id, rod_utilisation(structure, i, y), largest);
}

}  // namespace

bool has_strength(const ResolvedModel& model) {
  return std::ranges::any_of(
             model.members,
             [&](const ResolvedMember& one) { return model.section_of(one).strength.has_value(); }) ||
         std::ranges::any_of(model.springs,
                             [](const ResolvedSpring& one) { return one.strength.has_value(); });
}

std::optional<MemberUtilisation> largest_utilisation(const Structure& structure, const Eigen::VectorXd& y,
                                                     double lambda) {
  const ResolvedModel& model = *structure.model;
  const std::vector<LayerState> layers = layer_states(structure, y);
  std::optional<MemberUtilisation> largest;
  for (std::size_t m = 0; m < model.members.size(); ++m)
    if (model.section_of(model.members[m]).strength)
      keep(model.members[m].id,
           utilisation_of(MemberReader(structure, y, lambda, layers, static_cast<int>(m))), largest);
  keep_rods(structure, y, largest);
  return largest;
}

}  // namespace snapthrough
