#include "solver/report/mode.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "solver/discrete/element_reader.h"

namespace snapthrough {

Mode mode_displacements(const Structure& structure, const Model& model, const Eigen::VectorXd& mode,
                        int points) {
  const double L = structure.scales.length;
  Mode out;
  for (std::size_t m = 0; m < model.members.size(); ++m) {
    MemberMode member;
    member.id = model.members[m].id;
    for (int i = 0; i < points; ++i) {
      const double fraction = static_cast<double>(i) / (points - 1);
      const MeshPlace place = place_of(structure.mesh, static_cast<int>(m), fraction);
      const auto u = ElementReader(structure, mode, place.element).displacement(place.xi);
      member.s.push_back(fraction * structure.axes[m]->length());
      member.u.push_back(L * u[0]);
      member.v.push_back(L * u[1]);
      member.rotation.push_back(u[2]);
    }
    out.members.push_back(std::move(member));
  }
  return out;
}

double scale_to_largest(Mode& mode) {
  constexpr double kNothing = 1e-12;      // of what the rotations would move over a member's length
  constexpr double kLarger = 1.0 + 1e-6;  // equal ones differ by rounding: the first gives the sign
  double largest = 0.0;
  double first_large = 0.0;
  double sign = 1.0;
  double turned = 0.0;
  double length = 0.0;
  for (const MemberMode& member : mode.members) {
    length = std::max(length, member.s.back());
    for (std::size_t i = 0; i < member.s.size(); ++i) {
      if (std::abs(member.rotation[i]) > std::abs(turned) * kLarger) turned = member.rotation[i];
      const double size = std::hypot(member.u[i], member.v[i]);
      largest = std::max(largest, size);
      if (size <= first_large * kLarger) continue;
      first_large = size;
      sign = std::abs(member.u[i]) > std::abs(member.v[i]) ? member.u[i] : member.v[i];
    }
  }
  double scale = 1.0;
  if (largest > kNothing * std::abs(turned) * length)
    scale = (sign < 0.0 ? -1.0 : 1.0) / largest;
  else if (turned != 0.0)
    scale = 1.0 / turned;
  for (MemberMode& member : mode.members)
    for (auto* values : {&member.u, &member.v, &member.rotation})
      for (double& value : *values) value *= scale;
  return scale;
}

std::vector<CubicSpline> normal_offsets(const Structure& structure, const Model& model,
                                        const Eigen::VectorXd& mode, double amplitude) {
  constexpr int kPointsPerElement = 8;
  std::vector<std::vector<double>> s(model.members.size());
  std::vector<std::vector<double>> w(model.members.size());
  double largest = 0.0;
  for (std::size_t m = 0; m < model.members.size(); ++m) {
    const int points = kPointsPerElement * (structure.mesh.first[m + 1] - structure.mesh.first[m]) + 1;
    const AxisCurve& axis = *structure.axes[m];
    const MemberMode member = mode_displacements(structure, model, mode, points).members[m];
    for (std::size_t i = 0; i < member.s.size(); ++i) {
      const double angle = axis.at(member.s[i]).angle;
      s[m].push_back(member.s[i]);
      w[m].push_back(-std::sin(angle) * member.u[i] + std::cos(angle) * member.v[i]);
      if (std::abs(w[m].back()) > std::abs(largest) * (1.0 + 1e-6)) largest = w[m].back();
    }
  }
  std::vector<CubicSpline> out;
  for (std::size_t m = 0; m < model.members.size(); ++m) {
    for (double& value : w[m]) value *= largest == 0.0 ? 0.0 : amplitude / largest;
    out.emplace_back(s[m], w[m]);
  }
  return out;
}

}  // namespace snapthrough
