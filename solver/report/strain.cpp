#include "solver/report/strain.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace snapthrough {
namespace {

/// Moment that gives a curvature by the bending stiffness without moment.
double elastic_moment(const BendingCurve* curve, double moment) {
  return curve == nullptr ? moment : curve->at(moment).moment;
}

}  // namespace

StrainGauge::StrainGauge(const Structure& structure) : structure_(structure), model_(*structure.model) {
  const ResolvedModel& model = *structure.model;
  for (const ResolvedMember& member : model.members) sections_.push_back(&model.sections[member.section]);
}

StrainGauge::Compliance StrainGauge::compliance_at(const MeshElement& cell, double fraction) const {
  const Section& section = *sections_[cell.member];
  const double F = structure_.scales.force;
  const double EA = section.EA.at(fraction);
  return {F / EA, section.GA ? F / section.GA->at(fraction) : 0.0,
          F * structure_.scales.length / std::sqrt(section.EI.at(fraction) * EA)};
}

const BendingCurve* StrainGauge::curve_of(int member) const {
  const auto section = static_cast<std::size_t>(model_.members[static_cast<std::size_t>(member)].section);
  return structure_.bending_curves[section].get();
}

bool StrainGauge::raise(const Eigen::VectorXd& y, LargestStrain& largest) const {
  const CollocationRule& rule = CollocationRule::of(structure_.mesh.order);
  const int p = rule.order();
  bool raised = false;
  for (std::size_t e = 0; e < structure_.dofs.size(); ++e) {
    const MeshElement& cell = structure_.mesh.elements[e];
    const double* forces = y.data() + structure_.dofs[e].s;
    const BendingCurve* curve = curve_of(cell.member);
    for (int q = 0; q < p; ++q) {
      const double fraction = cell.from + rule.point(q) * (cell.to - cell.from);
      const Compliance by = compliance_at(cell, fraction);
      const double strain = std::max({by.axial * std::abs(forces[q]), by.shear * std::abs(forces[p + q]),
                                      by.bending * std::abs(elastic_moment(curve, forces[2 * p + q]))});
      if (strain <= largest.strain) continue;
      largest = {strain, model_.members[cell.member].id, fraction * structure_.axes[cell.member]->length()};
      raised = true;
    }
  }
  for (std::size_t i = 0; i < model_.springs.size(); ++i) {
    if (!model_.springs[i].rod) continue;
    const double strain = reading_of(structure_, i, y).displacement / structure_.spring_laws[i].length;
    if (strain <= largest.strain) continue;  // a slack rod has a negative displacement
    largest = {strain, model_.springs[i].id, 0.0};
    raised = true;
  }
  return raised;
}

bool StrainGauge::is_beyond_theory(const Eigen::VectorXd& y) const {
  const auto has_no_length = [&y](const NodeSpring& spring) {
    return spring.is_cable() && spring.ends(y).lengthening <= -StrainLimits::largest * spring.cable->length();
  };
  if (std::ranges::any_of(structure_.node_springs, has_no_length)) return true;
  const CollocationRule& rule = CollocationRule::of(structure_.mesh.order);
  const int p = rule.order();
  for (std::size_t e = 0; e < structure_.dofs.size(); ++e) {
    const MeshElement& cell = structure_.mesh.elements[e];
    const ElementDofs& dofs = structure_.dofs[e];
    if (std::abs(y[dofs.b[2]]) > StrainLimits::largest_rotation) return true;
    const double* forces = y.data() + dofs.s;
    const BendingCurve* curve = curve_of(cell.member);
    for (int q = 0; q < p; ++q) {
      const Compliance by = compliance_at(cell, cell.from + rule.point(q) * (cell.to - cell.from));
      if (by.axial * std::abs(forces[q]) > StrainLimits::largest ||
          by.bending * std::abs(elastic_moment(curve, forces[2 * p + q])) > StrainLimits::largest)
        return true;
    }
  }
  return false;
}

}  // namespace snapthrough
