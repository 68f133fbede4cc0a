#include "solver/accuracy/layers.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numeric>

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
  std::array<std::vector<double>, 2> at_end{std::vector<double>(static_cast<std::size_t>(p)),
                                            std::vector<double>(static_cast<std::size_t>(p))};
  rule.values_at(0.0, at_end[0]);
  rule.values_at(1.0, at_end[1]);
  double largest = 1.0;
  for (int e = structure.mesh.first[m]; e < structure.mesh.first[m + 1]; ++e) {
    const double* moments = y.data() + structure.dofs[static_cast<std::size_t>(e)].s + 2 * p;
    for (const std::vector<double>& values : at_end)
      largest =
          std::max(largest, curve->at(std::inner_product(values.begin(), values.end(), moments, 0.0)).slope);
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
