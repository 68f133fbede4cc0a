#include "solver/problem/node_spring_work.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "solver/mesh/dof_map.h"

namespace snapthrough {

using Eigen::Vector3d;
using Eigen::VectorXd;

NodeSpringWork::NodeSpringWork(std::span<const NodeSpring> springs)
    : springs_(springs), states_(springs.size()) {
  for (const NodeSpring& spring : springs) stops_ += spring.is_stop() ? 1 : 0;
}

/// Whether a spring acts. @param index of the spring among those at nodes
bool NodeSpringWork::acts(std::size_t index, double w, const Regime& regime) const {
  if (regime.is_frozen()) return regime.frozen->node_springs[index] != 0;
  return regime.bilateral() || springs_[index].acts(w);
}

/// @param index of the spring among those at nodes
NodeSpringWork::Reaction NodeSpringWork::reaction(std::size_t index, double w, const Regime& regime) const {
  const NodeSpring& spring = springs_[index];
  const double gap = regime.bilateral() ? 0.0 : spring.law.gap;
  Law::Response law = spring.law.response_at(w - gap);
  if (const auto* at = regime.linearised_at(); at != nullptr && spring.law.curve != nullptr) {
    law.stiffness = spring.law.stiffness_at(spring.linear(*at) - gap);
    law.force = law.stiffness * (w - gap);
  }
  const double share = (acts(index, w, regime) ? 1.0 : 0.0) * (spring.law.one_sided ? regime.softness : 1.0);
  Reaction out{share * law.force, share * law.stiffness};
  if (!spring.law.one_sided || regime.grip == 0.0) return out;
  // a share of the support acts at every displacement, without gap
  out.force += regime.grip * spring.law.force_at(w);
  out.stiffness += regime.grip * spring.law.stiffness_at(w);
  return out;
}

/// A softened stop gives way more. A grip acts with the stiffness of the stop's law.
NodeSpringWork::State NodeSpringWork::state_of_stop(std::size_t index, const VectorXd& y,
                                                    const Regime& regime) const {
  const NodeSpring& stop = springs_[index];
  const double w = stop.moved(y);
  const double force = y[stop.force_unknown];
  State out;
  out.gradient = stop.direction();
  out.stiffness = regime.grip * stop.law.stiffness;
  out.force = out.stiffness * w;
  out.give = 1.0 / stop.law.stiffness;
  if (acts(index, stop.linear(y), regime)) {
    out.force += force;
    out.row = out.gradient;
    out.give = stop.give / regime.softness;
    out.gap = w - (regime.bilateral() ? 0.0 : stop.law.gap);
  }
  out.gap -= out.give * force;
  out.tangent = out.stiffness * out.gradient * out.gradient.transpose();
  return out;
}

/// The pull, from that as drawn, is minus the derivative of the energy by r. Small displacements leave the
/// cable's tangent as it is where the nodes are drawn.
NodeSpringWork::State NodeSpringWork::state_of_cable(const NodeSpring& cable, const VectorXd& y,
                                                     const Regime& regime) {
  Catenary::Ends ends = cable.ends(y);
  Eigen::Vector2d moved = Eigen::Vector2d::Zero();
  if (regime.small_displacements) {
    moved = cable.change_of_ends(y).chord;
    ends.chord -= moved;
  }
  const Catenary::Pull pull = cable.cable->pull(ends);
  const Eigen::Vector2d force = pull.force + pull.stiffness * moved - cable.drawn_pull;
  State out;
  out.force = force.norm();
  out.gradient.head<2>() = -force.normalized();
  out.stiffness = pull.stiffness.trace();
  out.tangent.topLeftCorner<2, 2>() = pull.stiffness;
  out.by_pretension.head<2>() = pull.by_lengthening;
  return out;
}

/// Adds the resistance of a rod to displacements from those of another state.
void NodeSpringWork::add_drag(const NodeSpring& rod, const VectorXd& y, const Regime& regime, State& state) {
  const double stiffness = regime.drag * rod.law.stiffness;
  const Vector3d moved = rod.relative(y) - rod.relative(*regime.dragged_from);
  state.drag.head<2>() = stiffness * moved.head<2>();
  state.tangent.diagonal().head<2>().array() += stiffness;
}

void NodeSpringWork::evaluate(const VectorXd& y, const Regime& regime) {
  for (std::size_t i = 0; i < springs_.size(); ++i) {
    const NodeSpring& spring = springs_[i];
    if (spring.is_stop()) {
      states_[i] = state_of_stop(i, y, regime);
      continue;
    }
    if (spring.is_cable()) {
      states_[i] = state_of_cable(spring, y, regime);
      if (regime.drag > 0.0) add_drag(spring, y, regime, states_[i]);
      continue;
    }
    const auto [w, gradient, curvature] = spring.motion(y, regime.small_displacements);
    const Reaction at = reaction(i, w, regime);
    const double turning =
        regime.prestress != nullptr ? reaction(i, spring.linear(*regime.prestress), regime).force : at.force;
    states_[i] = {};
    states_[i].stiffness = at.stiffness;
    states_[i].gradient = gradient;
    states_[i].force = at.force;
    states_[i].by_pretension = -spring.sense * at.stiffness * gradient;
    states_[i].tangent = at.stiffness * gradient * gradient.transpose() + turning * curvature;
    if (regime.drag > 0.0 && spring.is_rod()) add_drag(spring, y, regime, states_[i]);
  }
}

void NodeSpringWork::add_forces(VectorXd& f) const {
  for (std::size_t i = 0; i < springs_.size(); ++i)
    springs_[i].add(states_[i].force * states_[i].gradient + states_[i].drag, f);
  for (std::size_t i = 0; stops_ > 0 && i < springs_.size(); ++i)
    if (springs_[i].is_stop()) f[springs_[i].force_unknown] += states_[i].gap;
}

double NodeSpringWork::log_abs_det_of_stops() const {
  double sum = 0.0;
  for (std::size_t i = 0; i < springs_.size(); ++i)
    if (springs_[i].is_stop()) sum += std::log(states_[i].give);
  return sum;
}

void NodeSpringWork::add_products(const Eigen::Ref<const VectorXd>& motion, Eigen::Ref<VectorXd> out) const {
  for (std::size_t i = 0; i < springs_.size(); ++i) {
    Vector3d force = states_[i].tangent * springs_[i].relative(motion);
    if (const int given = springs_[i].without_force; given >= 0)
      force += force_by_pretension(i) * motion[given];
    springs_[i].add(force, out);
  }
  for (std::size_t i = 0; stops_ > 0 && i < springs_.size(); ++i) {
    if (!springs_[i].is_stop()) continue;
    const double force = motion[springs_[i].force_unknown];
    springs_[i].add(force * states_[i].row, out);
    out[springs_[i].force_unknown] +=
        states_[i].row.dot(springs_[i].relative(motion)) - states_[i].give * force;
  }
}

/// With p(w) the reaction, g and C the derivatives of w, the tangent K = p' g g^T + p C changes along a by
/// p'' (g.a) g g^T + p' [C a g^T + g (C a)^T + (g.a) C] + p dC. Of a motion that changes a pretension, g.a
/// contains that change.
void NodeSpringWork::add_changes(const VectorXd& y, bool small_displacements, const VectorXd& along,
                                 const Eigen::Ref<const VectorXd>& motion, Eigen::Ref<VectorXd> out) const {
  for (const NodeSpring& spring : springs_) {
    if (spring.is_cable()) {
      if (small_displacements) continue;
      Vector3d force = Vector3d::Zero();
      force.head<2>() =
          -spring.cable->second(spring.ends(y), spring.change_of_ends(along), spring.change_of_ends(motion));
      spring.add(force, out);
      continue;
    }
    const bool turns = spring.is_rod() && !small_displacements;
    if (spring.law.curve == nullptr && !turns) continue;
    const auto [w, g, C] = spring.motion(y, small_displacements);
    if (!spring.acts(w)) continue;
    const Law::Response law = spring.law.response_at(w - spring.law.gap);
    const Vector3d a = spring.relative(along);
    const Vector3d b = spring.relative(motion);
    const double wa = g.dot(a) + spring.pretensioned(along);
    const double wb = g.dot(b) + spring.pretensioned(motion);
    Vector3d change = law.rate * wa * wb * g;
    if (turns)
      change += law.stiffness * (wb * (C * a) + b.dot(C * a) * g + wa * (C * b)) +
                law.force * (spring.curvature_change(y, along) * b);
    spring.add(change, out);
  }
}

double NodeSpringWork::rounding(const VectorXd& y) const {
  double largest = 0.0;
  for (std::size_t i = 0; i < springs_.size(); ++i) {
    const NodeSpring& spring = springs_[i];
    if (states_[i].stiffness == 0.0) continue;
    Vector3d sizes = DofMap::at(y, spring.node).cwiseAbs();
    if (spring.to >= 0) sizes += DofMap::at(y, spring.to).cwiseAbs();
    const double size =
        spring.law.gap + std::abs(spring.pretensioned(y)) + states_[i].gradient.cwiseAbs().dot(sizes);
    largest = std::max(largest, states_[i].stiffness * size);
  }
  return largest * std::numeric_limits<double>::epsilon();
}

}  // namespace snapthrough
