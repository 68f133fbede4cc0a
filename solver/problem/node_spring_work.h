#pragma once
/// @file
/// Forces and tangent stiffness of the springs at the nodes of a structure.

#include <Eigen/Core>
#include <cstddef>
#include <span>
#include <vector>

#include "solver/discrete/node_spring.h"
#include "solver/support/regime.h"

namespace snapthrough {

/// @brief Springs at nodes at one state of the unknowns. Their forces are added to the rows of the nodes,
/// before these are turned to the axes of supports.
class NodeSpringWork {
 public:
  /// @param springs kept by reference; must outlive this object
  explicit NodeSpringWork(std::span<const NodeSpring> springs);

  /// @brief Evaluates all springs at y; the functions below refer to this state.
  void evaluate(const Eigen::VectorXd& y, const Regime& regime);
  void add_forces(Eigen::VectorXd& f) const;
  /// Tangent stiffness of a spring by its displacement r, see NodeSpring.
  [[nodiscard]] const Eigen::Matrix3d& tangent(std::size_t spring) const { return states_[spring].tangent; }
  /// Adds the tangent stiffness times a motion.
  void add_products(const Eigen::Ref<const Eigen::VectorXd>& motion, Eigen::Ref<Eigen::VectorXd> out) const;
  /// @brief Adds the derivative of the tangent stiffness along `along`, times a motion, at y in the default
  /// regime; refers to no earlier state.
  void add_changes(const Eigen::VectorXd& y, bool small_displacements, const Eigen::VectorXd& along,
                   const Eigen::Ref<const Eigen::VectorXd>& motion, Eigen::Ref<Eigen::VectorXd> out) const;
  /// @brief Largest force that one unit in the last place of the displacements changes.
  [[nodiscard]] double rounding(const Eigen::VectorXd& y) const;

 private:
  struct State {
    double stiffness = 0.0;                              ///< d force / dw
    Eigen::Vector3d gradient = Eigen::Vector3d::Zero();  ///< dw / dr
    double force = 0.0;                                  ///< against w
    Eigen::Matrix3d tangent = Eigen::Matrix3d::Zero();
  };
  /// Reaction at a displacement w, with its derivative by w.
  struct Reaction {
    double force = 0.0;
    double stiffness = 0.0;
  };
  [[nodiscard]] Reaction reaction(std::size_t index, double w, const Regime& regime) const;

  std::span<const NodeSpring> springs_;
  std::vector<State> states_;
};

}  // namespace snapthrough
