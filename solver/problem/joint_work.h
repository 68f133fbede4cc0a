#pragma once
/// @file
/// Moments and tangent stiffness of the semi-rigid joints of a structure.

#include <Eigen/Core>
#include <cstddef>
#include <span>
#include <vector>

#include "solver/discrete/structure.h"
#include "solver/support/regime.h"

namespace snapthrough {

/// @brief Semi-rigid joints at one state of the unknowns.
///
/// With w the rotation of the node relative to the member end, a joint of the law m(w) adds m to the row of
/// the node's rotation and -m to that of the end's; its tangent is m'(w) [1 -1; -1 1]. Rotations are exact
/// for large displacements, so that joints have no geometric stiffness.
class JointWork {
 public:
  /// @param joints kept by reference; must outlive this object
  explicit JointWork(std::span<const JointSpring> joints) : joints_(joints), states_(joints.size()) {}

  /// @brief Evaluates all joints at y; the functions below refer to this state.
  void evaluate(const Eigen::VectorXd& y, const Regime& regime);
  void add_moments(Eigen::VectorXd& f) const;
  /// Derivative m' of the moment of a joint.
  [[nodiscard]] double stiffness(std::size_t joint) const { return states_[joint].stiffness; }
  /// Adds the tangent stiffness times a motion.
  void add_products(const Eigen::Ref<const Eigen::VectorXd>& motion, Eigen::Ref<Eigen::VectorXd> out) const;
  /// @brief Adds the derivative of the tangent stiffness along `along`, times a motion, at y in the default
  /// regime; refers to no earlier state.
  void add_changes(const Eigen::VectorXd& y, const Eigen::VectorXd& along,
                   const Eigen::Ref<const Eigen::VectorXd>& motion, Eigen::Ref<Eigen::VectorXd> out) const;
  /// @brief Largest moment that one unit in the last place of the rotations changes.
  [[nodiscard]] double rounding(const Eigen::VectorXd& y) const;

 private:
  struct State {
    double moment = 0.0;
    double stiffness = 0.0;
  };

  std::span<const JointSpring> joints_;
  std::vector<State> states_;
};

}  // namespace snapthrough
