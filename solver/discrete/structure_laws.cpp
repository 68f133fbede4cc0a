#include "solver/discrete/structure_laws.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "solver/discrete/stops.h"
#include "solver/mesh/dof_map.h"

namespace snapthrough {
namespace {

/// Stiffness of a stop over that of the members at its place: a stop gives way by 1e-8 of what the members
/// do. Of the force of a stop that is a stiff spring the rounding of displacements, 1e-16, leaves eight
/// digits.
constexpr double kStopStiffness = 1e8;

/// Stiffness of the members at a stop against its displacement, scaled.
struct StiffnessAtStop {
  double axial = 0.0;
  double bending = 0.0;
};

StiffnessAtStop stiffness_at_stop(const Structure& structure, const ResolvedSpring& spring,
                                  const SpringLaw& law) {
  const ResolvedModel& model = *structure.model;
  const Scales& scales = structure.scales;
  StiffnessAtStop sum;
  for (std::size_t m = 0; m < model.members.size(); ++m) {
    const ResolvedMember& member = model.members[m];
    if (spring.at.is_on_member() ? static_cast<int>(m) != spring.at.member
                                 : member.start != spring.at.node && member.end != spring.at.node)
      continue;
    const Section& section = model.sections[member.section];
    const AxisCurve& axis = *structure.axes[m];
    const double length = scales.scaled_length(axis.length());
    const double at_node = member.end == spring.at.node ? 1.0 : 0.0;
    const double fraction = spring.at.is_on_member() ? spring.at.fraction : at_node;
    const double bending = section.EI.at(fraction) / (scales.force * std::pow(scales.length, 2) * length);
    const double axial = section.EA.at(fraction) / (scales.force * length);
    const double angle = axis.angle_at(fraction * axis.length());
    const double along = law.row[0] * std::cos(angle) + law.row[1] * std::sin(angle);
    if (std::isfinite(bending))
      sum.bending += spring.direction ? 12.0 * bending / (length * length) : 4.0 * bending;
    if (spring.direction && std::isfinite(axial)) sum.axial += along * along * axial;
  }
  if (!(sum.bending > 0.0)) sum.bending = 1.0;  // a node that rods alone reach
  return sum;
}

/// Sets the law of a spring that stands for a stop. A stop at a node has its force as an unknown.
void set_stop(const Structure& structure, const ResolvedSpring& spring, SpringLaw& law) {
  const StiffnessAtStop members = stiffness_at_stop(structure, spring, law);
  law.law.stiffness = kStopStiffness * (members.axial + members.bending);
  if (!is_stop(spring) || node_of_stop(structure, spring) < 0) return;
  law.give = 1.0 / law.law.stiffness;
  law.law.stiffness = members.bending;
}

}  // namespace

void add_laws(const std::vector<ResolvedSpring>& springs, const std::vector<ResolvedFoundation>& foundations,
              const Structure& structure, std::vector<SpringLaw>& spring_laws,
              std::vector<FoundationLaw>& foundation_laws) {
  int ground = structure.first_ground;
  const auto ground_under = [&ground](const auto& support) {
    if (!support.displacement) return -1;
    return DofMap::first(ground++);
  };
  for (const ResolvedSpring& spring : springs) {
    SpringLaw& law = spring_laws.emplace_back(law_of(spring, structure.scales));
    law.ground = ground_under(spring);
    if (spring.has_length()) law.without_force = DofMap::first(ground++);
    if (!std::isfinite(law.law.stiffness)) set_stop(structure, spring, law);
  }
  for (const ResolvedFoundation& foundation : foundations) {
    foundation_laws.push_back(law_of(foundation, structure.scales, structure.origin));
    foundation_laws.back().fixed_tangents =
        structure.geometry == Geometry::linear || structure.mesh.foundation == FoundationRule::lumped;
    foundation_laws.back().ground = ground_under(foundation);
  }
}

std::vector<GroundMovement> ground_displacements(const ResolvedModel& model) {
  std::vector<GroundMovement> out;
  const auto add = [&out](const std::array<double, 3>& amount, Pattern pattern) {
    GroundMovement& moved = out.emplace_back();
    (pattern == Pattern::proportional ? moved.proportional : moved.constant) = amount;
  };
  for (const ResolvedSpring& spring : model.springs)
    if (const auto& moved = spring.displacement)
      add({moved->x, moved->y, moved->rotation}, moved->pattern);
    else if (spring.has_length())
      out.push_back({{spring.without_force[1], 0.0, 0.0}, {spring.without_force[0], 0.0, 0.0}});
  for (const ResolvedFoundation& foundation : model.foundations)
    if (const auto& moved = foundation.displacement)
      add({largest_size(moved->x), largest_size(moved->y), 0.0}, moved->pattern);
  return out;
}

void bound_stiffness(Structure& structure) {
  const ResolvedModel& model = *structure.model;
  const Mesh& mesh = structure.mesh;
  for (std::size_t m = 0; m < model.members.size(); ++m) {
    const AlongMember& EI = model.sections[model.members[m].section].EI;
    const auto length_of = [&](int e) {
      const MeshElement& cell = mesh.elements[static_cast<std::size_t>(e)];
      return (cell.to - cell.from) * structure.axes[m]->length();
    };
    double longest = 0.0;
    for (int e = mesh.first[m]; e < mesh.first[m + 1]; ++e) longest = std::max(longest, length_of(e));
    for (int e = mesh.first[m]; e < mesh.first[m + 1]; ++e) {
      const MeshElement& cell = mesh.elements[static_cast<std::size_t>(e)];
      const double least = std::min(EI.at(cell.from), EI.at(cell.to));
      const auto at_decay = [&](double length) {
        return structure.scales.scaled_modulus(4.0 * least / std::pow(length, 4));
      };
      structure.stiffest.push_back(at_decay(length_of(e) / mesh.decay_lengths));
      // a bed that were stiffer beside short elements would bend the member there
      structure.stiffest_rigid.push_back(at_decay(longest / kResolvedDecays));
    }
  }
}

double stiffness_on(const Structure& structure, const ResolvedFoundation& foundation, int member) {
  const double stiffness = initial_stiffness(foundation);
  if (std::isfinite(stiffness)) return stiffness;
  const auto first = structure.stiffest_rigid.begin();
  return *std::max_element(first + structure.mesh.first[member], first + structure.mesh.first[member + 1]) /
         structure.scales.scaled_modulus(1.0);
}

}  // namespace snapthrough
