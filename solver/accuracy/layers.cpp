#include "solver/accuracy/layers.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "solver/model/id_index.h"

namespace snapthrough {

std::vector<double> bending_decays(const Structure& structure, const Model& model, const Eigen::VectorXd& y) {
  std::vector<double> decays;
  for (std::size_t m = 0; m < model.members.size(); ++m) {
    const Member& member = model.members[m];
    const Section& section = model.sections[index_of(model.sections, member.section)];
    double tension = 0.0;
    for (int e = structure.mesh.first[m]; e < structure.mesh.first[m + 1]; ++e)
      tension = std::max(tension, y.segment(structure.dofs[e].s, structure.mesh.order).maxCoeff());
    double squared = tension * structure.scales.force / section.EI.least();
    for (const Foundation& foundation : model.foundations)
      if (section.GA && foundation.member == member.id && std::isfinite(initial_stiffness(foundation)))
        squared += initial_stiffness(foundation) / section.GA->least();
    decays.push_back(1.0 / std::sqrt(squared));
  }
  return decays;
}

}  // namespace snapthrough
