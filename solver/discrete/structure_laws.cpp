#include "solver/discrete/structure_laws.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "solver/model/id_index.h"

namespace snapthrough {
namespace {

/// Stiffness of members at their place, over which that of a stop stands: a stop gives way by 1e-8 of what
/// the members do, and the rounding of displacements, 1e-16, leaves eight digits of its force.
constexpr double kStopStiffness = 1e8;

/// Stiffness of a spring that stands for a stop, scaled.
double stop_stiffness(const Model& model, const Structure& structure, const Spring& spring,
                      const SpringLaw& law) {
  const Scales& scales = structure.scales;
  double sum = 0.0;
  for (std::size_t m = 0; m < model.members.size(); ++m) {
    const Member& member = model.members[m];
    if (spring.at.member.empty() ? member.start != spring.at.node && member.end != spring.at.node
                                 : member.id != spring.at.member)
      continue;
    const Section& section = model.sections[index_of(model.sections, member.section)];
    const AxisCurve& axis = *structure.axes[m];
    const double length = scales.scaled_length(axis.length());
    const double at_node = member.end == spring.at.node ? 1.0 : 0.0;
    const double fraction = spring.at.member.empty() ? at_node : spring.at.fraction;
    const double bending = section.EI.at(fraction) / (scales.force * std::pow(scales.length, 2) * length);
    const double axial = section.EA.at(fraction) / (scales.force * length);
    const double angle = axis.angle_at(fraction * axis.length());
    const double along = law.row[0] * std::cos(angle) + law.row[1] * std::sin(angle);
    sum += spring.direction ? along * along * axial + 12.0 * bending / (length * length) : 4.0 * bending;
  }
  return kStopStiffness * (sum > 0.0 ? sum : 1.0);  // a node that rods alone reach
}

}  // namespace

void add_laws(const Model& members, const Model& supports, const Structure& structure,
              std::vector<FoundationLaw>& foundations, std::vector<SpringLaw>& springs) {
  int ground = 3 * structure.first_ground;
  const auto ground_under = [&ground](const auto& support) {
    if (!support.displacement) return -1;
    ground += 3;
    return ground - 3;
  };
  for (const Spring& spring : supports.springs) {
    SpringLaw& law = springs.emplace_back(law_of(spring, structure.scales));
    law.ground = ground_under(spring);
    if (!std::isfinite(law.law.stiffness))
      law.law.stiffness = stop_stiffness(members, structure, spring, law);
  }
  for (const Foundation& foundation : supports.foundations) {
    foundations.push_back(law_of(foundation, structure.scales, structure.origin));
    foundations.back().fixed_tangents =
        structure.geometry == Geometry::linear || structure.mesh.foundation == FoundationRule::lumped;
    foundations.back().ground = ground_under(foundation);
  }
}

std::vector<PrescribedDisplacement> ground_displacements(const Model& model) {
  std::vector<PrescribedDisplacement> out;
  for (const Spring& spring : model.springs)
    if (spring.displacement) out.push_back(*spring.displacement);
  for (const Foundation& foundation : model.foundations)
    if (const auto& moved = foundation.displacement)
      out.push_back({largest_size(moved->x), largest_size(moved->y), 0.0, moved->pattern});
  return out;
}

void bound_stiffness(const Model& model, Structure& structure) {
  const Mesh& mesh = structure.mesh;
  for (std::size_t m = 0; m < model.members.size(); ++m) {
    const AlongMember& EI = model.sections[index_of(model.sections, model.members[m].section)].EI;
    for (int e = mesh.first[m]; e < mesh.first[m + 1]; ++e) {
      const MeshElement& cell = mesh.elements[static_cast<std::size_t>(e)];
      const double length = (cell.to - cell.from) * structure.axes[m]->length();
      const double least = std::min(EI.at(cell.from), EI.at(cell.to));
      const auto at_decay = [&](double lengths) {
        return structure.scales.scaled_modulus(4.0 * least / std::pow(length / lengths, 4));
      };
      structure.stiffest.push_back(at_decay(mesh.decay_lengths));
      structure.stiffest_rigid.push_back(at_decay(kResolvedDecays));
    }
  }
}

double stiffness_on(const Structure& structure, const Foundation& foundation, int member) {
  const double stiffness = initial_stiffness(foundation);
  if (std::isfinite(stiffness)) return stiffness;
  const auto first = structure.stiffest_rigid.begin();
  return *std::max_element(first + structure.mesh.first[member], first + structure.mesh.first[member + 1]) /
         structure.scales.scaled_modulus(1.0);
}

}  // namespace snapthrough
