#include "solver/report/mode.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <numeric>
#include <utility>

#include "solver/discrete/element_reader.h"
#include "solver/mesh/dof_map.h"
#include "solver/numeric/number_text.h"
#include "solver/numeric/rounding.h"
#include "solver/report/rod_state.h"
#include "solver/resolve/rods.h"

namespace snapthrough {

namespace {

/// Numbers of the description of a mode, ratios. Chosen.
struct ModeLimits {
  /// Factor by which a later of several values must exceed the first to be taken for larger: symmetric modes
  /// agree to six digits.
  static constexpr double larger = 1.0 + 1e-6;
  static constexpr double alone = 0.9;  ///< least share of strain energy of a member that buckles alone
  static constexpr double small_compression = 1e-2;  ///< over the largest, below which a member has no length
  static constexpr int points_per_element = 8;       ///< points of the spline through a mode
};

MemberMode member_mode(const Structure& structure, std::size_t member, const Eigen::VectorXd& mode,
                       int points) {
  const ResolvedModel& model = *structure.model;
  const double L = structure.scales.length;
  MemberMode out;
  out.id = model.members[member].id;
  for (int i = 0; i < points; ++i) {
    const double fraction = static_cast<double>(i) / (points - 1);
    const MeshPlace place = place_of(structure.mesh, static_cast<int>(member), fraction);
    const auto u = ElementReader(structure, mode, place.element).displacement(place.xi);
    out.s.push_back(fraction * structure.axes[member]->length());
    out.u.push_back(L * u[0]);
    out.v.push_back(L * u[1]);
    out.rotation.push_back(u[2]);
  }
  return out;
}

/// Indices of the nodes at the start and at the end of a member or rod.
std::array<int, 2> ends_of(const ResolvedModel& model, const std::string& id) {
  for (const ResolvedMember& member : model.members)
    if (member.id == id) return {member.start, member.end};
  const auto is_rod = [&id](const ResolvedSpring& spring) { return spring.rod && spring.id == id; };
  const ResolvedSpring& rod = *std::find_if(model.springs.begin(), model.springs.end(), is_rod);
  return {rod.at.node, rod.to->node};
}

}  // namespace

Mode mode_displacements(const Structure& structure, const Eigen::VectorXd& mode, int points) {
  const ResolvedModel& model = *structure.model;
  Mode out;
  for (std::size_t m = 0; m < model.members.size(); ++m)
    out.members.push_back(member_mode(structure, m, mode, points));
  const auto mode_of = [&](std::size_t spring) { return rod_mode(structure, spring, mode, points); };
  insert_rods(model.springs, mode_of, out.members);
  return out;
}

double scale_to_largest(std::span<Mode> parts) {
  std::vector<MemberMode*> members;
  for (Mode& mode : parts)
    for (MemberMode& member : mode.members) members.push_back(&member);
  double largest = 0.0;
  double first_large = 0.0;
  double sign = 1.0;
  double turned = 0.0;
  double length = 0.0;
  for (const MemberMode* member : members) {
    length = std::max(length, member->s.back());
    for (std::size_t i = 0; i < member->s.size(); ++i) {
      if (std::abs(member->rotation[i]) > std::abs(turned) * ModeLimits::larger) turned = member->rotation[i];
      const double size = std::hypot(member->u[i], member->v[i]);
      largest = std::max(largest, size);
      if (size <= first_large * ModeLimits::larger) continue;
      first_large = size;
      sign = std::abs(member->u[i]) > std::abs(member->v[i]) ? member->u[i] : member->v[i];
    }
  }
  double scale = 1.0;
  // a mode without displacements is scaled by its largest rotation
  if (largest > Rounding::distance * std::abs(turned) * length)
    scale = (sign < 0.0 ? -1.0 : 1.0) / largest;
  else if (turned != 0.0)
    scale = 1.0 / turned;
  for (MemberMode* member : members)
    for (auto* values : {&member->u, &member->v, &member->rotation})
      for (double& value : *values) value *= scale;
  return scale;
}

std::vector<EffectiveLength> effective_lengths(const ResolvedModel& model, const std::vector<double>& lengths,
                                               const std::vector<double>& compressions) {
  const double largest = *std::max_element(compressions.begin(), compressions.end());
  std::vector<EffectiveLength> out;
  for (std::size_t m = 0; m < model.members.size(); ++m) {
    EffectiveLength& one = out.emplace_back();
    one.id = model.members[m].id;
    const Section& section = model.sections[model.members[m].section];
    const AlongMember& EI = section.EI;
    if (!(compressions[m] > ModeLimits::small_compression * largest)) continue;
    if (EI.varies() || std::isinf(EI.constant) || section.bending) continue;
    one.length = std::numbers::pi * std::sqrt(EI.constant / compressions[m]);
    one.ratio = *one.length / lengths[m];
  }
  const auto none = [&model](std::size_t spring) {
    return EffectiveLength{model.springs[spring].id, {}, {}};
  };
  insert_rods(model.springs, none, out);
  return out;
}

std::string motion_text(const Mode& mode, const ResolvedModel& model) {
  double largest = 0.0;
  std::size_t moved = 0;  // index of the member
  std::size_t place = 0;
  for (std::size_t m = 0; m < mode.members.size(); ++m) {
    for (std::size_t i = 0; i < mode.members[m].s.size(); ++i) {
      const double size = std::hypot(mode.members[m].u[i], mode.members[m].v[i]);
      if (size <= largest * ModeLimits::larger) continue;
      largest = size;
      moved = m;
      place = i;
    }
  }
  if (largest == 0.0) return "turns members only";
  const MemberMode& along = mode.members[moved];
  std::string where = "s = " + rounded(along.s[place]) + " of member \"" + along.id + "\"";
  const auto [start, end] = ends_of(model, along.id);
  const auto named = [&model](int node) {
    return "node \"" + model.nodes[static_cast<std::size_t>(node)].id + "\"";
  };
  if (place == 0) where = named(start);
  if (place + 1 == along.s.size()) where = named(end);
  const auto component = [largest](double value) {
    return rounded(std::abs(value) < Rounding::motion * largest ? 0.0 : value);
  };
  return "is largest at " + where + ", along (" + component(along.u[place]) + ", " +
         component(along.v[place]) + ")";
}

std::optional<std::size_t> member_that_buckles(const Structure& structure, const Eigen::VectorXd& mode) {
  const ResolvedModel& model = *structure.model;
  const int p = structure.mesh.order;
  const CollocationRule& rule = CollocationRule::of(p);
  const double length = structure.scales.length;
  std::vector<double> energy(model.members.size(), 0.0);
  for (std::size_t e = 0; e < structure.dofs.size(); ++e) {
    const auto member = static_cast<std::size_t>(structure.mesh.elements[e].member);
    const Section& section = model.sections[static_cast<std::size_t>(model.members[member].section)];
    const double h = length_of_element(structure, static_cast<int>(e));
    const auto forces = mode.segment(structure.dofs[e].s, DofMap::count(p));
    const MeshElement& cell = structure.mesh.elements[e];
    for (int q = 0; q < p; ++q) {
      const double bending = length * forces[2 * p + q];
      const double fraction = cell.from + rule.point(q) * (cell.to - cell.from);
      // with a bending law the stiffness is that of the state, which moment and curvature of the mode have
      const double curvature = mode[structure.dofs[e].v + 2 * p + q];
      const double bent = section.bending ? forces[2 * p + q] * curvature / structure.scales.force
                                          : bending * bending / section.EI.at(fraction);
      double density = forces[q] * forces[q] / section.EA.at(fraction) + bent;
      if (section.GA) density += forces[p + q] * forces[p + q] / section.GA->at(fraction);
      energy[member] += h * rule.weight(q) * density;
    }
  }
  const auto most = std::max_element(energy.begin(), energy.end());
  const double sum = std::accumulate(energy.begin(), energy.end(), 0.0);
  if (!(sum > 0.0) || *most < ModeLimits::alone * sum) return std::nullopt;
  return static_cast<std::size_t>(most - energy.begin());
}

std::vector<CubicSpline> normal_offsets(const Structure& structure, const Eigen::VectorXd& mode,
                                        double amplitude) {
  const ResolvedModel& model = *structure.model;
  std::vector<std::vector<double>> s(model.members.size());
  std::vector<std::vector<double>> w(model.members.size());
  double largest = 0.0;
  for (std::size_t m = 0; m < model.members.size(); ++m) {
    const int points =
        ModeLimits::points_per_element * (structure.mesh.first[m + 1] - structure.mesh.first[m]) + 1;
    const AxisCurve& axis = *structure.axes[m];
    const MemberMode member = member_mode(structure, m, mode, points);
    for (std::size_t i = 0; i < member.s.size(); ++i) {
      const double angle = axis.at(member.s[i]).angle;
      s[m].push_back(member.s[i]);
      w[m].push_back(-std::sin(angle) * member.u[i] + std::cos(angle) * member.v[i]);
      if (std::abs(w[m].back()) > std::abs(largest) * ModeLimits::larger) largest = w[m].back();
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
