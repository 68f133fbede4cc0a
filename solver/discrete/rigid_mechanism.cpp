#include "solver/discrete/rigid_mechanism.h"

#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include "solver/discrete/rigid_loads.h"
#include "solver/mesh/dof_map.h"
#include "solver/numeric/gauss_rule.h"
#include "solver/numeric/null_space.h"
#include "solver/numeric/rounding.h"
#include "solver/support/capacity.h"
#include "solver/support/law.h"

namespace snapthrough {
namespace {

using Row = RigidParts::Row;

/// Constraints of a model's supports, springs and foundations on rigid parts; any stiffness above zero
/// constrains.
class Holding {
 public:
  Holding(const RigidParts& parts, HeldBy held_by) : parts_(parts), held_by_(held_by) {
    for (const ResolvedSupport& support : parts.model().supports) add(support);
    for (const ResolvedSpring& spring : parts.model().springs)
      if (is_there(spring)) add(spring);
    for (const ResolvedFoundation& foundation : parts.model().foundations)
      if (is_there(foundation)) add(foundation);
  }

  /// Rows that vanish in a motion that no support resists.
  std::vector<Row> held;
  /// Displacements of the supported places.
  std::vector<Row> moved;

 private:
  template <class Support>
  [[nodiscard]] bool is_there(const Support& support) const {
    return initial_stiffness(support) > 0.0 &&
           (held_by_ == HeldBy::all_as_bilateral || support.reaction == Reaction::bilateral ||
            (held_by_ == HeldBy::bilateral && is_tight(support)));
  }
  /// Whether a support does not hold its place, because it carries no more than its capacity.
  template <class Support>
  [[nodiscard]] bool gives_way(const Support& support) const {
    return held_by_ == HeldBy::without_capacity && has_capacity(support);
  }
  void add(const ResolvedSupport& support);
  void add(const ResolvedSpring& spring);
  void add(const ResolvedFoundation& foundation);
  void hold(const Row& rotation, double radius);
  void hold(int node, double x, double y);
  void hold(int member, RigidParts::Point at, double x, double y);

  const RigidParts& parts_;
  HeldBy held_by_;
};

void Holding::hold(const Row& rotation, double radius) {
  held.push_back(rotation);
  for (auto& [unknown, weight] : held.back()) weight *= radius;
}

void Holding::hold(int node, double x, double y) {
  const double size = std::hypot(x, y);
  held.push_back(parts_.displacement(node, {x / size, y / size}));
  moved.push_back(parts_.displacement(node, {1.0, 0.0}));
  moved.push_back(parts_.displacement(node, {0.0, 1.0}));
}

void Holding::hold(int member, RigidParts::Point at, double x, double y) {
  const double size = std::hypot(x, y);
  held.push_back(parts_.displacement(member, at, {x / size, y / size}));
  moved.push_back(parts_.displacement(member, at, {1.0, 0.0}));
  moved.push_back(parts_.displacement(member, at, {0.0, 1.0}));
}

void Holding::add(const ResolvedSupport& support) {
  const int node = support.node;
  const double angle = support.angle_degrees * std::numbers::pi / 180.0;
  if (support.x) hold(node, std::cos(angle), std::sin(angle));
  if (support.y) hold(node, -std::sin(angle), std::cos(angle));
  if (support.rotation) hold(parts_.node_rotation(node), parts_.node_radius(node));
}

void Holding::add(const ResolvedSpring& spring) {
  if (gives_way(spring)) return;
  const ResolvedLocation& at = spring.at;
  if (!spring.direction) {
    hold(parts_.displacement(spring),
         at.is_on_member() ? parts_.radius(at.member) : parts_.node_radius(at.node));
    return;
  }
  held.push_back(parts_.displacement(spring));
  for (const RigidParts::Point& axis : {RigidParts::Point{1.0, 0.0}, RigidParts::Point{0.0, 1.0}}) {
    moved.push_back(parts_.displacement(at, axis));
    if (spring.to) moved.push_back(parts_.displacement(*spring.to, axis));
  }
}

/// Adds the constraints of a foundation at points of its range; two points suffice on a straight axis. One
/// against rotation holds the member's rotation. A
/// surface constrains motions along its normals as seen from the initial axis. The
/// shear layer constrains the derivative of the displacement n.u along the axis: n'.u and the rotation of n.
void Holding::add(const ResolvedFoundation& foundation) {
  const int member = foundation.member;
  if (foundation.component == FoundationComponent::rotation) {
    if (!gives_way(foundation)) hold(parts_.rotation(member), parts_.radius(member));
    return;
  }
  const bool straight = parts_.axes()[static_cast<std::size_t>(member)]->straight();
  const bool is_uniform = straight && !foundation.outline;
  const Quadrature points = gauss_legendre(is_uniform ? 2 : MechanismLimits::places_on_curve);
  const FoundationLaw law = parts_.law(foundation);
  for (const double point : points.points) {
    const AxisPoint at =
        parts_.place(member, foundation.range[0] + point * (foundation.range[1] - foundation.range[0]));
    const double c = std::cos(at.angle);
    const double s = std::sin(at.angle);
    const auto [x, y] = law.initial_direction({{at.x, at.y}, at.angle, 0.0});
    if (!gives_way(foundation)) hold(member, {at.x, at.y}, x, y);
    if (!(foundation.shear_stiffness > 0.0)) continue;
    const double turn = foundation.direction ? 0.0 : -at.curvature;
    Row row = parts_.displacement(member, {at.x, at.y}, {turn * c, turn * s});
    for (const auto& [unknown, weight] : parts_.rotation(member))
      row.emplace_back(unknown, weight * (y * c - x * s) / std::hypot(x, y) * parts_.radius(member));
    held.push_back(std::move(row));
  }
}

}  // namespace

RigidMechanism::RigidMechanism(const ResolvedModel& model, HeldBy held_by) : parts_(model) {
  Holding holding(parts_, held_by);
  std::vector<Row> rows = parts_.joints();
  rows.insert(rows.end(), holding.held.begin(), holding.held.end());
  std::vector<Row> sizes = parts_.turns();
  sizes.insert(sizes.end(), holding.moved.begin(), holding.moved.end());
  NullSpace space(matrix_of(rows, parts_.unknowns()), matrix_of(sizes, parts_.unknowns()),
                  MechanismLimits::one_direction);
  unknown_ = space.too_dense();
  while (motions_.size() < MechanismLimits::motions) {
    std::optional<Eigen::VectorXd> motion = space.next();
    if (!motion) break;
    motions_.push_back(std::move(*motion));
  }
}

Eigen::VectorXd RigidMechanism::of_nodes(const Eigen::VectorXd& motion) const {
  const auto value = [&motion](const Row& row) {
    double sum = 0.0;
    for (const auto& [unknown, weight] : row) sum += weight * motion[unknown];
    return sum;
  };
  const auto nodes = static_cast<int>(parts_.model().nodes.size());
  Eigen::VectorXd out(DofMap::count(nodes));
  for (int j = 0; j < nodes; ++j)
    DofMap::at(out, j) << value(parts_.displacement(j, {1.0, 0.0})),
        value(parts_.displacement(j, {0.0, 1.0})), value(parts_.node_rotation(j));
  return out;
}

std::size_t RigidMechanism::node_of(const Eigen::VectorXd& motion) const {
  const Eigen::VectorXd moved = of_nodes(motion);
  Eigen::Index node = 0;
  const auto nodes = static_cast<Eigen::Index>(parts_.model().nodes.size());
  for (Eigen::Index j = 1; j < nodes; ++j)
    if (DofMap::at(moved, j).lpNorm<Eigen::Infinity>() >
        Rounding::first_of_equal * DofMap::at(moved, node).lpNorm<Eigen::Infinity>())
      node = j;
  return static_cast<std::size_t>(node);
}

std::optional<Eigen::VectorXd> RigidMechanism::driven_by(Pattern pattern) const {
  const RigidLoads loading(parts_, pattern);
  Eigen::VectorXd driven = Eigen::VectorXd::Zero(parts_.unknowns());
  for (const Eigen::VectorXd& motion : motions_) driven += loading.forces().dot(motion) * motion;
  const double work = driven.norm();  // work on the motion normalised to length one
  if (work == 0.0) return std::nullopt;
  driven /= work;
  if (!(work > Rounding::motion * loading.size() * of_nodes(driven).lpNorm<Eigen::Infinity>()))
    return std::nullopt;
  return driven;
}

}  // namespace snapthrough
