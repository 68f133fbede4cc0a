#include "solver/discrete/mechanism.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <numeric>
#include <optional>
#include <string>
#include <variant>

#include "solver/discrete/rigid_mechanism.h"

namespace snapthrough {
namespace {

/// Limits of the fast test whether a structure is held; chosen far on the safe side of rounding, because a
/// model beyond them is only tested in full.
struct PlainlyHeldLimits {
  static constexpr std::size_t members = 10;  ///< most members
  static constexpr double stiffness = 1e-3;   ///< least stiffness over the largest
  static constexpr double restraint = 1e-3;   ///< least restraint, see firmness()
};

/// Length of a straight member or an arc; empty for other curves.
std::optional<double> length_of(const ResolvedModel& model, const ResolvedMember& member) {
  const Node& a = model.nodes[member.start];
  const Node& b = model.nodes[member.end];
  const double chord = std::hypot(b.x - a.x, b.y - a.y);
  if (std::holds_alternative<LineCurve>(member.curve)) return chord;
  const auto* arc = std::get_if<ArcCurve>(&member.curve);
  if (arc == nullptr) return std::nullopt;
  const double half = 0.5 * std::abs(arc->sweep_degrees) * std::numbers::pi / 180.0;
  return chord * half / std::sin(half);
}

bool is_connected(const ResolvedModel& model) {
  std::vector<std::size_t> group(model.nodes.size());
  std::iota(group.begin(), group.end(), std::size_t{0});
  for (const ResolvedMember& member : model.members) {
    const std::size_t one = group[member.start];
    const std::size_t other = group[member.end];
    std::replace(group.begin(), group.end(), one, other);
  }
  return std::all_of(group.begin(), group.end(), [&](std::size_t g) { return g == group.front(); });
}

/// Restraint of a rigid body by the supports: det of the sum of r r^T over the constrained directions r
/// (force, force, moment over unit length), divided by that for equal eigenvalues.
double firmness(const ResolvedModel& model, double length) {
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  const Node& origin = model.nodes.front();
  for (const ResolvedSupport& support : model.supports) {
    const Node& node = model.nodes[support.node];
    const double angle = support.angle_degrees * std::numbers::pi / 180.0;
    const auto hold = [&](double dx, double dy) {
      const double moment = ((node.x - origin.x) * dy - (node.y - origin.y) * dx) / length;
      const Eigen::Vector3d row(dx, dy, moment);
      sum += row * row.transpose();
    };
    if (support.x) hold(std::cos(angle), std::sin(angle));
    if (support.y) hold(-std::sin(angle), std::cos(angle));
    if (support.rotation) sum(2, 2) += 1.0;
  }
  const double mean = sum.trace() / 3.0;
  return mean > 0.0 ? sum.determinant() / (mean * mean * mean) : 0.0;
}

}  // namespace

bool is_plainly_held(const ResolvedModel& model) {
  if (model.members.size() > PlainlyHeldLimits::members || model.supports.empty()) return false;
  double length = 0.0;
  double least_EI = std::numeric_limits<double>::infinity();
  double largest_EI = 0.0;
  double least_force = least_EI;
  for (const ResolvedMember& member : model.members) {
    const Section& section = model.sections[member.section];
    const std::optional<double> own = length_of(model, member);
    if (!own || is_rod(member) || member.release_start_rotation || member.release_end_rotation) return false;
    length = std::max(length, *own);
    least_EI = std::min(least_EI, section.EI.least());
    largest_EI = std::max(largest_EI, section.EI.largest());
    least_force = std::min({least_force, section.EA.least(), section.GA.value_or(section.EA).least()});
  }
  return least_EI >= PlainlyHeldLimits::stiffness * largest_EI &&
         least_force >= PlainlyHeldLimits::stiffness * largest_EI / (length * length) &&
         is_connected(model) && firmness(model, length) >= PlainlyHeldLimits::restraint;
}

bool is_loose(const ResolvedModel& model) {
  const auto hangs = [](const ResolvedSpring& spring) { return spring.cable.has_value(); };
  const auto pulls = [&](const ResolvedSpring& spring) {
    return hangs(spring) || (spring.rod && spring.reaction == Reaction::tension_only);
  };
  const auto is_slack = [&](const ResolvedSpring& spring) {
    return hangs(spring) || (pulls(spring) && spring.without_force[0] < 0.0);
  };
  if (std::ranges::none_of(model.springs, pulls)) return false;
  // where nothing bends, the state of least energy is the only one, and it needs no path that leads there
  if (model.members.empty() && std::ranges::any_of(model.springs, hangs)) return true;
  const RigidMechanism mechanism(model, HeldBy::all_as_bilateral);
  if (mechanism.unknown() || mechanism.motions().empty()) return false;
  return mechanism.motions().size() == MechanismLimits::motions ||
         std::ranges::any_of(model.springs, is_slack) || mechanism.driven_by(Pattern::proportional) ||
         mechanism.driven_by(Pattern::constant);
}

bool can_move(const ResolvedModel& model) {
  return !RigidMechanism(model, HeldBy::all_as_bilateral).motions().empty();
}

std::vector<Finding> find_mechanism(const ResolvedModel& model) {
  if (is_plainly_held(model)) return {};
  const RigidMechanism mechanism(model, HeldBy::all_as_bilateral);
  if (mechanism.unknown())
    return {
        {"/model/members", "too_connected",
         "these members connect far nodes in so many ways that their equations fill up: neither whether the "
         "structure can move nor what it does under load can be computed in reasonable time"}};
  if (mechanism.motions().empty()) return {};
  if (mechanism.motions().size() == MechanismLimits::motions)
    return {{"/model/supports", "mechanism",
             "supports and foundations leave at least " + std::to_string(MechanismLimits::motions) +
                 " motions without strain: more than an analysis can hold"}};
  std::optional<Eigen::VectorXd> motion = mechanism.driven_by(Pattern::proportional);
  if (!motion) motion = mechanism.driven_by(Pattern::constant);
  if (!motion) return {};
  return {{"/model/supports", "mechanism",
           "the loads can move the structure without strain (supports and foundations do not hold it; the "
           "motion is "
           "largest near node \"" +
               model.nodes[mechanism.node_of(*motion)].id + "\")"}};
}

}  // namespace snapthrough
