#include "solver/report/support_state.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "solver/discrete/element_reader.h"
#include "solver/discrete/foundation_springs.h"
#include "solver/discrete/layer_state.h"
#include "solver/discrete/least_euler_load.h"
#include "solver/discrete/stops.h"
#include "solver/mesh/dof_map.h"
#include "solver/newton/corrector.h"
#include "solver/numeric/rounding.h"
#include "solver/problem/joint_work.h"
#include "solver/report/resultant.h"
#include "solver/support/capacity.h"

namespace snapthrough {
namespace {

using Eigen::VectorXd;

/// Scaled resultant of springs or of a foundation on the structure, with its rounding: stiffness times the
/// rounding of the displacements in the penetration.
struct Bearing {
  Wrench wrench{};
  double rounding = 0.0;
};

/// Scaled force of a spring in a state.
struct SpringForce {
  SparseRow row;              ///< displacement into the medium
  double displacement = 0.0;  ///< value of `row`
  double force = 0.0;         ///< force on the structure, against `row`
  bool closed = false;
  double rounding = 0.0;  ///< rounding of the force
};

SpringForce force_of(const Structure& structure, std::size_t index, const VectorXd& y) {
  const SpringLaw& spring = structure.spring_laws[index];
  SpringForce out;
  SpringReading reading = reading_of(structure, index, y);
  out.row = std::move(reading.row);
  out.displacement = reading.displacement;
  out.force = reading.force;
  out.closed = spring.law.stiffness > 0.0 && (!spring.law.one_sided || reading.depth > 0.0);
  if (spring.force_unknown >= 0) return out;  // the force is an unknown
  double size = spring.law.gap;
  for (const auto& [at, weight] : out.row.entries) size += std::abs(weight * y[at]);
  if (out.force != 0.0)
    out.rounding = spring.law.tangent(out.displacement) * size * std::numeric_limits<double>::epsilon();
  return out;
}

/// Adds the springs to the state, without those that stand for rods and follow the others; returns their
/// forces on the nodes, in the problem's rows.
VectorXd add_springs(const Structure& structure, const VectorXd& y, const RigidMotions& rigid, State& state,
                     std::vector<Bearing>& bearings) {
  const ResolvedModel& model = *structure.model;
  VectorXd on_nodes = VectorXd::Zero(DofMap::count(structure.nodes));
  for (std::size_t i = 0; i < model.springs.size(); ++i) {
    const ResolvedSpring& spring = model.springs[i];
    const SpringForce at = force_of(structure, i, y);
    const SpringLaw& law = structure.spring_laws[i];
    const double sense = law.sense;
    // the displacement without force is the user's: the reported one is that from the undeformed structure
    const double given = law.without_force >= 0 ? sense * y[law.without_force] : 0.0;
    const double L = structure.scales.length;
    const double F = structure.scales.force;
    Bearing& bearing = bearings.emplace_back();
    bearing.wrench = rigid.work(at.row);
    for (double& component : bearing.wrench) component *= -at.force;
    bearing.rounding = at.rounding;
    if (!spring.rod) {
      state.springs.push_back(
          {spring.id,
           in_users_sense(sense, at.force * (spring.direction ? F : F * L)),
           in_users_sense(sense, (at.displacement + given) * (spring.direction ? L : 1.0)),
           at.closed,
           {},
           has_capacity(spring) ? std::optional(std::abs(at.force) / law.law.capacity) : std::nullopt});
    }
    if (!spring.at.is_on_member())
      for (const auto& [index, weight] : at.row.entries) on_nodes[index] -= at.force * weight;
    else if (law.force_unknown >= 0)
      DofMap::at(on_nodes, node_of_stop(structure, spring)) -=
          at.force * Eigen::Vector3d(law.row[0], law.row[1], law.row[2]);
  }
  return on_nodes;
}

/// Nodal forces and moments that only rigid supports can balance, in global axes.
VectorXd held_forces(const Structure& structure, ElementWork& elements, const VectorXd& y, double lambda,
                     const VectorXd& springs) {
  VectorXd f = -lambda * structure.proportional_load - structure.constant_load;
  if (structure.drawn_pull.size() > 0) f += structure.drawn_pull;
  FollowerLoads(structure.follower_ends, structure.follower_forces).add_load(y, {-lambda, -1.0}, f);
  Regime regime;
  regime.small_displacements = structure.geometry == Geometry::linear;
  elements.add_residual(y, {lambda, 1.0}, regime, f);
  JointWork joints(structure.joints);
  joints.evaluate(y, regime);
  joints.add_moments(f);
  return f.head(DofMap::count(structure.nodes)) - springs;
}

/// Adds the supports to the state; returns their forces on the nodes, in the problem's rows.
VectorXd add_supports(const Structure& structure, const VectorXd& held, State& state) {
  const ResolvedModel& model = *structure.model;
  const double F = structure.scales.force;
  VectorXd reactions = VectorXd::Zero(structure.size);
  for (const ResolvedSupport& support : model.supports) {
    const int node = support.node;
    const auto [ux, uy, turn] = DofMap::of(node);
    const NodeSupport& held_by = structure.supports[node];
    const std::array<std::array<double, 2>, 2> axes{{{std::cos(held_by.angle), std::sin(held_by.angle)},
                                                     {-std::sin(held_by.angle), std::cos(held_by.angle)}}};
    for (int c = 0; c < 2; ++c) {
      if (!held_by.fixed[c]) continue;
      const double along = held[ux] * axes[c][0] + held[uy] * axes[c][1];
      for (int k = 0; k < 2; ++k) reactions[ux + k] += along * axes[c][k];
    }
    if (held_by.fixed[2]) reactions[turn] = held[turn];
    state.supports.push_back({model.nodes[node].id, F * reactions[ux], F * reactions[uy],
                              F * structure.scales.length * reactions[turn]});
  }
  return reactions;
}

/// Springs of a foundation that act on one element.
std::vector<SupportSpring> acting_springs(const Structure& structure, const FoundationLaw& foundation,
                                          const FoundationPart& part, const VectorXd& y) {
  if (!part.contact || structure.mesh.foundation == FoundationRule::lumped)
    return winkler_springs(structure, foundation, part.element, part.range);
  const ElementReader reader(structure, y, part.element, foundation);
  const auto intervals = part.contact->smooth_pieces({reader.start()[0], reader.start()[1]},
                                                     reader.gradient(0), reader.gradient(1));
  std::vector<SupportSpring> out;
  for (const auto& interval : intervals)
    for (SupportSpring& support : contact_springs(structure, foundation, reader, part.element, interval))
      out.push_back(std::move(support));
  return out;
}

void add_springs_of(const std::vector<SupportSpring>& springs, const VectorXd& y, const RigidMotions& rigid,
                    Bearing& sum) {
  for (const SupportSpring& support : springs) {
    const auto [value, size] = rigid.value(support, y);
    const double w = value - support.law.gap;
    if (support.law.one_sided && w <= 0.0) continue;
    const Wrench unit = rigid.work(support);
    for (int c = 0; c < 3; ++c) sum.wrench[c] -= support.law.force_at(w) * unit[c];
    sum.rounding +=
        support.law.stiffness_at(w) * (size + support.law.gap) * std::numeric_limits<double>::epsilon();
  }
}

/// Adds a one-sided foundation with a shear layer: base and layer where the member touches, and the ground
/// beyond each end of contact.
void add_layer(const Structure& structure, const FoundationLaw& foundation, const LayerState& layer,
               const VectorXd& y, const RigidMotions& rigid, Bearing& sum) {
  for (std::size_t i = 0; i < layer.cells.size(); ++i) {
    const int element = layer.elements[i];
    const ElementReader reader(structure, y, element);
    for (const ElementPart& part : layer.parts[i]) {
      if (!(part.to > part.from)) continue;
      add_springs_of(contact_springs(structure, foundation, reader, element, part), y, rigid, sum);
      add_springs_of(shear_layer_springs(structure, foundation, element, {part.from, part.to}), y, rigid,
                     sum);
    }
  }
  for (std::size_t i = 0; i < layer.edges.size(); ++i) {
    const LayerEdge& edge = layer.edges[i];
    const auto d = layer.cells[edge.cell].contact->direction_at(edge.xi);
    const SupportSpring place = support_at(structure, layer.elements[edge.cell], edge.xi, {d[0], d[1], 0.0});
    const Wrench unit = rigid.work(place);
    const double force = edge_force(layer.cells, layer.edges, i);
    for (int c = 0; c < 3; ++c) sum.wrench[c] -= force * unit[c];
    const double stiffness = edge.stiffness + (edge.other >= 0 ? 1.0 / edge.compliance : 0.0);
    sum.rounding += stiffness * rigid.value(place, y).size * std::numeric_limits<double>::epsilon();
  }
}

void add_foundations(const Structure& structure, const VectorXd& y, const RigidMotions& rigid,
                     std::vector<Bearing>& bearings) {
  const ResolvedModel& model = *structure.model;
  const std::size_t first = bearings.size();
  bearings.resize(first + model.foundations.size());
  for (std::size_t i = 0; i < model.foundations.size(); ++i)
    if (const FoundationLaw& law = structure.foundation_laws[i]; law.has_layer())
      add_layer(structure, law, layer_state(structure, y, static_cast<int>(i)), y, rigid,
                bearings[first + i]);
  for (const FoundationPart& part : structure.foundation_parts) {
    const FoundationLaw foundation =
        law_on(structure, structure.foundation_laws[part.foundation], part.element);
    if (foundation.has_layer()) continue;
    Bearing& sum = bearings[first + static_cast<std::size_t>(part.foundation)];
    if (foundation.shear > 0.0)
      add_springs_of(shear_layer_springs(structure, foundation, part.element, part.range), y, rigid, sum);
    if (foundation.law.stiffness > 0.0)
      add_springs_of(acting_springs(structure, foundation, part, y), y, rigid, sum);
  }
}

/// Largest of the element end forces and of the forces given.
double largest_force(const Structure& structure, const VectorXd& y, const VectorXd& others) {
  double force = others.lpNorm<Eigen::Infinity>();
  for (const ElementDofs& dofs : structure.dofs)
    force = std::max(force, y.segment<3>(dofs.m).lpNorm<Eigen::Infinity>());
  return force;
}

/// Distributes the residual of the sum of all forces to springs and foundations in proportion to their
/// rounding: the displacements have converged, so that the residual comes from stiff supports, whose
/// reactions equilibrium determines better than stiffness times penetration.
/// @param largest largest other force; a residual above the corrector's tolerance and above rounding stays
/// @return what is left of the sum
Wrench balance(const Wrench& others, double largest, std::vector<Bearing>& bearings) {
  Wrench left = others;
  double rounding = 0.0;
  for (const Bearing& bearing : bearings) {
    for (int c = 0; c < 3; ++c) {
      left[c] += bearing.wrench[c];
      largest = std::max(largest, std::abs(bearing.wrench[c]));
    }
    rounding += bearing.rounding;
  }
  const double size = std::max({std::abs(left[0]), std::abs(left[1]), std::abs(left[2])});
  if (rounding == 0.0 ||
      size > std::max(CorrectorOptions{}.largest_residual * largest, Rounding::element_sum * rounding))
    return left;
  for (Bearing& bearing : bearings)
    for (int c = 0; c < 3; ++c) bearing.wrench[c] -= bearing.rounding / rounding * left[c];
  return {};
}

/// Force and moment at which rounding of the displacements counts as no force, over StateLimits::imbalance:
/// imposed strains that nothing resists leave forces of that size.
double rounding_of_forces(const Structure& structure, const VectorXd& y) {
  const double softest = least_euler_load(structure);
  double displacement = Rounding::displacement;  // where nothing moves
  for (const ElementDofs& dofs : structure.dofs)
    for (const std::array<int, 3>& end : {dofs.a, dofs.b})
      for (const int dof : end) displacement = std::max(displacement, std::abs(y[dof]));
  return Rounding::force / StateLimits::imbalance * softest * displacement;
}

/// Largest moment that the distances between ends of members that meet at a node may leave, see
/// RigidMotions::apart().
double moment_between_ends(const Structure& structure, const RigidMotions& rigid, const VectorXd& y) {
  double forces = 0.0;
  for (std::size_t m = 0; m + 1 < structure.mesh.first.size(); ++m) {
    double largest = 0.0;
    for (int e = structure.mesh.first[m]; e < structure.mesh.first[m + 1]; ++e)
      largest = std::max(largest, y.segment<2>(structure.dofs[static_cast<std::size_t>(e)].m).norm());
    forces += 2.0 * largest;
  }
  return rigid.apart() * forces;
}

/// What is left of the sum of all forces on a structure, over the largest force and moment that acts on it.
/// @param loads, reactions in the rows of the problem
/// @param least force and moment that count at least
double relative_imbalance(const RigidMotions& rigid, double least, const VectorXd& loads,
                          const VectorXd& reactions, const std::vector<Bearing>& bearings,
                          const Wrench& left) {
  const Wrench actions = rigid.work_without_sign(loads);
  const Wrench supports = rigid.work_without_sign(reactions);
  double force = std::max({actions[0], actions[1], supports[0], supports[1], least});
  double moment = std::max(actions[2], supports[2]);
  for (const Bearing& bearing : bearings) {
    force = std::max({force, std::abs(bearing.wrench[0]), std::abs(bearing.wrench[1])});
    moment = std::max(moment, std::abs(bearing.wrench[2]));
  }
  const double forces = std::max(std::abs(left[0]), std::abs(left[1]));
  return std::max(force > 0.0 ? forces / force : forces,
                  std::abs(left[2]) / std::max({moment, force, std::numeric_limits<double>::min()}));
}

}  // namespace

double add_forces_on_structure(const Structure& structure, const VectorXd& y, double lambda, State& state) {
  const ResolvedModel& model = *structure.model;
  const RigidMotions rigid(structure, y);
  const std::unique_ptr<ElementWork> elements = structure.elements->make_work();
  std::vector<Bearing> bearings;  // resultants of springs, then foundations
  const VectorXd springs = add_springs(structure, y, rigid, state, bearings);
  const VectorXd reactions =
      add_supports(structure, held_forces(structure, *elements, y, lambda, springs), state);
  add_foundations(structure, y, rigid, bearings);
  VectorXd loads = lambda * structure.proportional_load + structure.constant_load;
  if (structure.drawn_pull.size() > 0) loads -= structure.drawn_pull;
  elements->add_pressure_load(y, {lambda, 1.0}, structure.geometry == Geometry::linear, loads);
  FollowerLoads(structure.follower_ends, structure.follower_forces).add_load(y, {lambda, 1.0}, loads);
  Wrench acting = rigid.work(loads);
  // half of a cable's weight acts at each node, and its pull there makes up for the place of its centre
  for (std::size_t i = 0; i < model.springs.size(); ++i)
    if (structure.spring_laws[i].cable)
      for (std::size_t c = 0; c < acting.size(); ++c) acting[c] += bearings[i].wrench[c];
  state.loads = rigid.unscaled(acting);
  Wrench left = balance(rigid.work(loads + reactions), largest_force(structure, y, reactions), bearings);
  left[2] = std::max(std::abs(left[2]) - moment_between_ends(structure, rigid, y), 0.0);
  const std::size_t first = model.springs.size();
  for (std::size_t i = 0; i < state.springs.size(); ++i)
    state.springs[i].resultant = rigid.unscaled(bearings[i].wrench);
  for (std::size_t i = 0; i < state.foundations.size(); ++i)
    state.foundations[i].resultant = rigid.unscaled(bearings[first + i].wrench);
  return relative_imbalance(rigid, rounding_of_forces(structure, y), loads, reactions, bearings, left);
}

}  // namespace snapthrough
