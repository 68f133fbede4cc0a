#include "solver/accuracy/layers.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace snapthrough {
namespace {

/// Largest curvature by moment on a member, over that without moment.
double largest_softening(const Structure& structure, std::size_t m, const Eigen::VectorXd& y) {
  const ResolvedModel& model = *structure.model;
  const BendingCurve* curve =
      structure.bending_curves[static_cast<std::size_t>(model.members[m].section)].get();
  if (curve == nullptr) return 1.0;
  const CollocationRule& rule = CollocationRule::of(structure.mesh.order);
  const int p = rule.order();
  std::vector<double> values(static_cast<std::size_t>(p));
  double largest = 1.0;
  for (int e = structure.mesh.first[m]; e < structure.mesh.first[m + 1]; ++e) {
    const double* moments = y.data() + structure.dofs[static_cast<std::size_t>(e)].s + 2 * p;
    for (const double end : {0.0, 1.0}) {
      rule.values_at(end, values);
      double moment = 0.0;
      for (int q = 0; q < p; ++q) moment += values[static_cast<std::size_t>(q)] * moments[q];
      largest = std::max(largest, curve->at(moment).slope);
    }
  }
  return largest;
}

}  // namespace

std::vector<double> bending_decays(const Structure& structure, const Eigen::VectorXd& y) {
  const ResolvedModel& model = *structure.model;
  std::vector<double> decays;
  for (std::size_t m = 0; m < model.members.size(); ++m) {
    const ResolvedMember& member = model.members[m];
    const Section& section = model.sections[member.section];
    double tension = 0.0;
    for (int e = structure.mesh.first[m]; e < structure.mesh.first[m + 1]; ++e)
      tension = std::max(tension, y.segment(structure.dofs[e].s, structure.mesh.order).maxCoeff());
    const double softening = largest_softening(structure, m, y);
    const double length = structure.axes[m]->length();
    double squared = softening * tension * structure.scales.force / section.EI.least();
    squared += (softening - 1.0) / (length * length);  // 0 for a member without a law
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
