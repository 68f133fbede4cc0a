#pragma once
/// @file
/// Linear solves and second derivatives at a critical point, where the tangent is singular.

#include <Eigen/Core>

#include "solver/events/critical_system.h"
#include "solver/newton/corrector.h"
#include "solver/problem/equilibrium_problem.h"

namespace snapthrough {

/// @brief A critical point exact to rounding, with its tangent bordered by the null motions n.
class BorderedPoint {
 public:
  /// Right-hand side with prescribed displacements moved to `motion` and their reactions added to `forces`.
  struct Held {
    Eigen::VectorXd forces;
    Eigen::VectorXd motion;
    bool moves = false;
  };

  /// @param problem kept by reference
  /// @param solution critical point of `problem`, exact to rounding
  /// @param solves whether response() and the second derivatives are needed; costs one factorisation
  BorderedPoint(EquilibriumProblem& problem, const PathMetric& metric, const CriticalSolution& solution,
                bool solves);

  /// False when the factors for the solves were not found.
  [[nodiscard]] bool is_ready() const { return ready_; }
  /// The critical point; its response and second derivatives are evaluated here when solves are asked for.
  [[nodiscard]] const CriticalSolution& at() const { return at_; }
  [[nodiscard]] EquilibriumProblem& problem() const { return problem_; }
  [[nodiscard]] const PathMetric& metric() const { return metric_; }
  /// Work of the reference load on the null motions, n.load.
  [[nodiscard]] const Eigen::VectorXd& load_along() const { return load_along_; }

  [[nodiscard]] Held held(const Eigen::VectorXd& rows) const;
  /// Work of forces on each null motion.
  [[nodiscard]] Eigen::VectorXd works(const Eigen::VectorXd& forces) const;
  /// Solves J x = forces up to a multiple of W n, with x orthogonal to n; adds the prescribed motion.
  [[nodiscard]] Eigen::VectorXd response(const Held& to) const;
  /// Norm of a motion: the larger of its metric norm and its largest entry over that of the state (for
  /// motions of forces alone).
  [[nodiscard]] double size_of(const Eigen::VectorXd& motion) const;
  /// Directional derivative d/de J(y + e motion) b at e = 0.
  [[nodiscard]] Eigen::MatrixXd tangent_change_along(const Eigen::VectorXd& motion,
                                                     const Eigen::Ref<const Eigen::MatrixXd>& b) const;

 private:
  [[nodiscard]] bool factorise();
  void differentiate();

  EquilibriumProblem& problem_;
  const PathMetric& metric_;
  CriticalSolution at_;
  bool ready_ = false;
  Eigen::VectorXd load_along_;
  Eigen::MatrixXd metric_rows_;
};

}  // namespace snapthrough
