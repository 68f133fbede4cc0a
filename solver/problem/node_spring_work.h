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
///
/// A stop (NodeSpring::is_stop()) adds its force p to the node and has a row of its own, of a displacement:
///
///   w - g - c p  where the stop acts, else  - p / k;    by p:  - c  or  - 1 / k, one negative eigenvalue
///   each
class NodeSpringWork {
 public:
  /// @param springs kept by reference; must outlive this object
  explicit NodeSpringWork(std::span<const NodeSpring> springs);

  /// @brief Evaluates all springs at y; the functions below refer to this state.
  void evaluate(const Eigen::VectorXd& y, const Regime& regime);
  void add_forces(Eigen::VectorXd& f) const;
  /// Derivative of a stop's row by its force. @pre the spring is a stop
  [[nodiscard]] double row_by_force(std::size_t spring) const { return -states_[spring].give; }
  /// Derivative of the node's forces by the force of a stop, and of the stop's row by r.
  [[nodiscard]] const Eigen::Vector3d& row_by_motion(std::size_t spring) const { return states_[spring].row; }
  /// Number of stops.
  [[nodiscard]] int stops() const { return stops_; }
  /// Logarithm of the determinant of the diagonal that stops add.
  [[nodiscard]] double log_abs_det_of_stops() const;
  /// Tangent stiffness of a spring by its displacement r, see NodeSpring; of a stop with its force fixed.
  [[nodiscard]] const Eigen::Matrix3d& tangent(std::size_t spring) const { return states_[spring].tangent; }
  /// Derivative of the node's forces by the unknown of a pretension. @pre the spring has one
  [[nodiscard]] const Eigen::Vector3d& force_by_pretension(std::size_t spring) const {
    return states_[spring].by_pretension;
  }
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
    Eigen::Vector3d drag = Eigen::Vector3d::Zero();           ///< force of Regime::drag
    Eigen::Vector3d by_pretension = Eigen::Vector3d::Zero();  ///< see force_by_pretension()
    Eigen::Vector3d row = Eigen::Vector3d::Zero();            ///< derivative of a stop's row by r
    double give = 0.0;                                        ///< minus that by its force
    double gap = 0.0;                                         ///< value of the row, see NodeSpringWork
  };
  /// Reaction at a displacement w, with its derivative by w.
  struct Reaction {
    double force = 0.0;
    double stiffness = 0.0;
  };
  [[nodiscard]] bool acts(std::size_t index, double w, const Regime& regime) const;
  [[nodiscard]] Reaction reaction(std::size_t index, double w, const Regime& regime) const;
  static void add_drag(const NodeSpring& rod, const Eigen::VectorXd& y, const Regime& regime, State& state);
  static State state_of_cable(const NodeSpring& cable, const Eigen::VectorXd& y, const Regime& regime);
  [[nodiscard]] State state_of_stop(std::size_t index, const Eigen::VectorXd& y, const Regime& regime) const;

  std::span<const NodeSpring> springs_;
  std::vector<State> states_;
  int stops_ = 0;
};

}  // namespace snapthrough
