#include "solver/problem/node_spring_work.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace snapthrough {

using Eigen::Vector3d;
using Eigen::VectorXd;

NodeSpringWork::NodeSpringWork(std::span<const NodeSpring> springs)
    : springs_(springs), states_(springs.size()) {}

/// @param index of the spring among those at nodes
NodeSpringWork::Reaction NodeSpringWork::reaction(std::size_t index, double w, const Regime& regime) const {
  const NodeSpring& spring = springs_[index];
  const double gap = regime.bilateral() ? 0.0 : spring.law.gap;
  bool acts = regime.bilateral() || spring.acts(w);
  if (regime.is_frozen()) acts = regime.frozen->node_springs[index] != 0;
  Law::Response law = spring.law.response_at(w - gap);
  if (const auto* at = regime.linearised_at(); at != nullptr && spring.law.curve != nullptr) {
    law.stiffness = spring.law.stiffness_at(spring.linear(*at) - gap);
    law.force = law.stiffness * (w - gap);
  }
  const double share = (acts ? 1.0 : 0.0) * (spring.law.one_sided ? regime.softness : 1.0);
  Reaction out{share * law.force, share * law.stiffness};
  if (!spring.law.one_sided || regime.grip == 0.0) return out;
  // a share of the support acts at every displacement, without gap
  out.force += regime.grip * spring.law.force_at(w);
  out.stiffness += regime.grip * spring.law.stiffness_at(w);
  return out;
}

void NodeSpringWork::evaluate(const VectorXd& y, const Regime& regime) {
  for (std::size_t i = 0; i < springs_.size(); ++i) {
    const NodeSpring& spring = springs_[i];
    const auto [w, gradient, curvature] = spring.motion(y, regime.small_displacements);
    const Reaction at = reaction(i, w, regime);
    const double turning =
        regime.prestress != nullptr ? reaction(i, spring.linear(*regime.prestress), regime).force : at.force;
    states_[i] = {at.stiffness, gradient, at.force,
                  at.stiffness * gradient * gradient.transpose() + turning * curvature};
  }
}

void NodeSpringWork::add_forces(VectorXd& f) const {
  for (std::size_t i = 0; i < springs_.size(); ++i)
    springs_[i].add(states_[i].force * states_[i].gradient, f);
}

void NodeSpringWork::add_products(const Eigen::Ref<const VectorXd>& motion, Eigen::Ref<VectorXd> out) const {
  for (std::size_t i = 0; i < springs_.size(); ++i)
    springs_[i].add(states_[i].tangent * springs_[i].relative(motion), out);
}

/// With p(w) the reaction, g and C the derivatives of w, the tangent K = p' g g^T + p C changes along a by
/// p'' (g.a) g g^T + p' [C a g^T + g (C a)^T + (g.a) C] + p dC.
void NodeSpringWork::add_changes(const VectorXd& y, bool small_displacements, const VectorXd& along,
                                 const Eigen::Ref<const VectorXd>& motion, Eigen::Ref<VectorXd> out) const {
  for (const NodeSpring& spring : springs_) {
    const bool turns = spring.is_rod() && !small_displacements;
    if (spring.law.curve == nullptr && !turns) continue;
    const auto [w, g, C] = spring.motion(y, small_displacements);
    if (!spring.acts(w)) continue;
    const Law::Response law = spring.law.response_at(w - spring.law.gap);
    const Vector3d a = spring.relative(along);
    const Vector3d b = spring.relative(motion);
    Vector3d change = law.rate * g.dot(a) * g.dot(b) * g;
    if (turns)
      change += law.stiffness * (g.dot(b) * (C * a) + b.dot(C * a) * g + g.dot(a) * (C * b)) +
                law.force * (spring.curvature_change(y, along) * b);
    spring.add(change, out);
  }
}

double NodeSpringWork::rounding(const VectorXd& y) const {
  double largest = 0.0;
  for (std::size_t i = 0; i < springs_.size(); ++i) {
    const NodeSpring& spring = springs_[i];
    if (states_[i].stiffness == 0.0) continue;
    Vector3d sizes = y.segment<3>(3 * static_cast<Eigen::Index>(spring.node)).cwiseAbs();
    if (spring.to >= 0) sizes += y.segment<3>(3 * static_cast<Eigen::Index>(spring.to)).cwiseAbs();
    largest = std::max(largest,
                       states_[i].stiffness * (spring.law.gap + states_[i].gradient.cwiseAbs().dot(sizes)));
  }
  return largest * std::numeric_limits<double>::epsilon();
}

}  // namespace snapthrough
