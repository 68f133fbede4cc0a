#include "solver/accuracy/layers.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace snapthrough {

std::vector<double> bending_decays(const Structure& structure, const Eigen::VectorXd& y) {
  const ResolvedModel& model = *structure.model;
  std::vector<double> decays;
  for (std::size_t m = 0; m < model.members.size(); ++m) {
    const ResolvedMember& member = model.members[m];
    const Section& section = model.sections[member.section];
    double tension = 0.0;
    for (int e = structure.mesh.first[m]; e < structure.mesh.first[m + 1]; ++e)
      tension = std::max(tension, y.segment(structure.dofs[e].s, structure.mesh.order).maxCoeff());
    double squared = tension * structure.scales.force / section.EI.least();
    for (const ResolvedFoundation& foundation : model.foundations) {
      const double stiffness = initial_stiffness(foundation);
      if (foundation.member != static_cast<int>(m) || !std::isfinite(stiffness)) continue;
      if (foundation.component == FoundationComponent::rotation)
        squared += stiffness / section.EI.least();
      else if (section.GA)
        squared += stiffness / section.GA->least();
    }
    decays.push_back(1.0 / std::sqrt(squared));
  }
  return decays;
}

}  // namespace snapthrough
