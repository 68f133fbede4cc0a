#include "solver/report/strain.h"
#include "solver/model/id_index.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace snapthrough {

StrainGauge::StrainGauge(const Structure& structure, const Model& model)
    : structure_(structure), model_(model) {
  const double F = structure.scales.force;
  for (const Member& member : model.members) {
    const Section& section = model.sections[index_of(model.sections, member.section)];
    compliances_.push_back({F / section.EA, section.GA ? F / *section.GA : 0.0,
                            F * structure.scales.length / std::sqrt(section.EI * section.EA)});
  }
}

bool StrainGauge::raise(const Eigen::VectorXd& y, LargestStrain& largest) const {
  const int p = structure_.mesh.order;
  bool raised = false;
  for (std::size_t e = 0; e < structure_.dofs.size(); ++e) {
    const MeshElement& cell = structure_.mesh.elements[e];
    const Compliance& by = compliances_[cell.member];
    const double* forces = y.data() + structure_.dofs[e].s;
    for (int q = 0; q < p; ++q) {
      const double strain = std::max({by.axial * std::abs(forces[q]), by.shear * std::abs(forces[p + q]),
                                      by.bending * std::abs(forces[2 * p + q])});
      if (strain <= largest.strain) continue;
      const double fraction = cell.from + CollocationRule::of(p).point(q) * (cell.to - cell.from);
      largest = {strain, model_.members[cell.member].id, fraction * structure_.axes[cell.member]->length()};
      raised = true;
    }
  }
  for (std::size_t i = 0; i < model_.springs.size(); ++i) {
    if (!model_.springs[i].rod) continue;
    const double strain =
        reading_of(structure_, model_, i, y).displacement / structure_.spring_laws[i].length;
    if (strain <= largest.strain) continue;  // a slack rod has a negative displacement
    largest = {strain, model_.springs[i].id, 0.0};
    raised = true;
  }
  return raised;
}

bool StrainGauge::is_beyond_theory(const Eigen::VectorXd& y) const {
  const int p = structure_.mesh.order;
  for (std::size_t e = 0; e < structure_.dofs.size(); ++e) {
    const ElementDofs& dofs = structure_.dofs[e];
    const Compliance& by = compliances_[structure_.mesh.elements[e].member];
    const auto forces = y.segment(dofs.s, 3 * p);
    if (std::abs(y[dofs.b[2]]) > StrainLimits::largest_rotation ||
        by.axial * forces.head(p).lpNorm<Eigen::Infinity>() > StrainLimits::largest ||
        by.bending * forces.tail(p).lpNorm<Eigen::Infinity>() > StrainLimits::largest)
      return true;
  }
  return false;
}

}  // namespace snapthrough
