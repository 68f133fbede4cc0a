#include "solver/report/strain.h"
#include "solver/model/id_index.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace snapthrough {

StrainGauge::StrainGauge(const Structure& structure, const Model& model)
    : structure_(structure), model_(model) {
  const double F = structure.scales.force;
  const CollocationRule& rule = CollocationRule::of(structure.mesh.order);
  for (std::size_t m = 0; m < model.members.size(); ++m) {
    const Section& section = model.sections[index_of(model.sections, model.members[m].section)];
    for (int e = structure.mesh.first[m]; e < structure.mesh.first[m + 1]; ++e) {
      const MeshElement& cell = structure.mesh.elements[static_cast<std::size_t>(e)];
      for (int q = 0; q < rule.order(); ++q) {
        const double fraction = cell.from + rule.point(q) * (cell.to - cell.from);
        const double EA = section.EA.at(fraction);
        compliances_.push_back({F / EA, section.GA ? F / section.GA->at(fraction) : 0.0,
                                F * structure.scales.length / std::sqrt(section.EI.at(fraction) * EA)});
      }
    }
  }
}

bool StrainGauge::raise(const Eigen::VectorXd& y, LargestStrain& largest) const {
  const int p = structure_.mesh.order;
  bool raised = false;
  for (std::size_t e = 0; e < structure_.dofs.size(); ++e) {
    const MeshElement& cell = structure_.mesh.elements[e];
    const double* forces = y.data() + structure_.dofs[e].s;
    for (int q = 0; q < p; ++q) {
      const Compliance& by = compliances_[e * static_cast<std::size_t>(p) + static_cast<std::size_t>(q)];
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
    if (std::abs(y[dofs.b[2]]) > StrainLimits::largest_rotation) return true;
    const double* forces = y.data() + dofs.s;
    for (int q = 0; q < p; ++q) {
      const Compliance& by = compliances_[e * static_cast<std::size_t>(p) + static_cast<std::size_t>(q)];
      if (by.axial * std::abs(forces[q]) > StrainLimits::largest ||
          by.bending * std::abs(forces[2 * p + q]) > StrainLimits::largest)
        return true;
    }
  }
  return false;
}

}  // namespace snapthrough
