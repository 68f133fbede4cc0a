#pragma once
/// @file
/// Solves and second derivatives at a critical point itself, where the tangent is singular.

#include <Eigen/Core>

#include "solver/events/critical_system.h"
#include "solver/newton/corrector.h"
#include "solver/problem/equilibrium_problem.h"

namespace snapthrough {

/// @brief A critical point to rounding, with what bordering its tangent by the null motions allows.
class BorderedPoint {
 public:
  /// Forces with those that hold what is fixed where their rows say, and that motion.
  struct Held {
    Eigen::VectorXd forces;
    Eigen::VectorXd motion;
    bool moves = false;
  };

  /// @param solution to rounding, of that problem, which is kept by reference and factorised once if
  /// @param solves response() and the second derivatives are wanted
  BorderedPoint(EquilibriumProblem& problem, const PathMetric& metric, const CriticalSolution& solution,
                bool solves);

  /// Whether the factors that solves need were found.
  [[nodiscard]] bool is_ready() const { return ready_; }
  /// The solution; response and second derivatives are those of this place, if asked for.
  [[nodiscard]] const CriticalSolution& at() const { return at_; }
  [[nodiscard]] EquilibriumProblem& problem() const { return problem_; }
  [[nodiscard]] const PathMetric& metric() const { return metric_; }
  /// n.load
  [[nodiscard]] const Eigen::VectorXd& load_along() const { return load_along_; }

  [[nodiscard]] Held held(const Eigen::VectorXd& rows) const;
  /// Work of forces on the null motions.
  [[nodiscard]] Eigen::VectorXd works(const Eigen::VectorXd& forces) const;
  /// The motion without a part along n that balances forces but for a part along W n.
  [[nodiscard]] Eigen::VectorXd response(const Held& to) const;
  /// Size of a motion that differences are taken by: in the metric, or beside the forces of the state where
  /// it is one of forces alone.
  [[nodiscard]] double size_of(const Eigen::VectorXd& motion) const;
  /// d/de J(y + e motion) b
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
