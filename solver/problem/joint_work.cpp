#include "solver/problem/joint_work.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace snapthrough {

using Eigen::VectorXd;

void JointWork::evaluate(const VectorXd& y, const Regime& regime) {
  const VectorXd* linearised_at = regime.linearised_at();
  for (std::size_t i = 0; i < joints_.size(); ++i) {
    const JointSpring& joint = joints_[i];
    const double rotation = joint.rotation(y);
    const Law::Response law = joint.law.response_at(rotation);
    states_[i] = {law.force, law.stiffness};
    if (linearised_at == nullptr || joint.law.curve == nullptr) continue;
    const double stiffness = joint.law.stiffness_at(joint.rotation(*linearised_at));
    states_[i] = {stiffness * rotation, stiffness};
  }
}

void JointWork::add_moments(VectorXd& f) const {
  for (std::size_t i = 0; i < joints_.size(); ++i) joints_[i].add(states_[i].moment, f);
}

void JointWork::add_products(const Eigen::Ref<const VectorXd>& motion, Eigen::Ref<VectorXd> out) const {
  for (std::size_t i = 0; i < joints_.size(); ++i)
    joints_[i].add(states_[i].stiffness * joints_[i].rotation(motion), out);
}

void JointWork::add_changes(const VectorXd& y, const VectorXd& along,
                            const Eigen::Ref<const VectorXd>& motion, Eigen::Ref<VectorXd> out) const {
  for (const JointSpring& joint : joints_) {
    if (joint.law.curve == nullptr) continue;
    const double rate = joint.law.response_at(joint.rotation(y)).rate;
    joint.add(rate * joint.rotation(along) * joint.rotation(motion), out);
  }
}

double JointWork::rounding(const VectorXd& y) const {
  double largest = 0.0;
  for (std::size_t i = 0; i < joints_.size(); ++i) {
    const double size = std::abs(y[joints_[i].node_rotation]) + std::abs(y[joints_[i].end_rotation]);
    largest = std::max(largest, std::abs(states_[i].stiffness) * size);
  }
  return largest * std::numeric_limits<double>::epsilon();
}

}  // namespace snapthrough
