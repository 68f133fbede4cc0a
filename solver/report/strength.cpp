#include "solver/report/strength.h"

#include <algorithm>
#include <cstddef>

#include "solver/discrete/layer_state.h"
#include "solver/report/member_reader.h"
#include "solver/report/rod_state.h"
#include "solver/report/utilisation.h"

namespace snapthrough {
namespace {

/// Keeps the larger of two in size.
void keep(const std::string& member, const std::optional<Utilisation>& place,
          std::optional<MemberUtilisation>& largest) {
  if (!place) return;
  std::optional<Utilisation> value;
  if (largest) value = largest->place;
  raise(*place, value);
  if (!largest || value->value != largest->place.value) largest = {member, *value};
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
           MemberReader(structure, y, lambda, layers, static_cast<int>(m)).largest_utilisation({}), largest);
  keep_rods(structure, y, largest);
  return largest;
}

}  // namespace snapthrough
