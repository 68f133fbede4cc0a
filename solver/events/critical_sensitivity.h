#pragma once
/// @file
/// How a critical load changes with the equations.

#include <Eigen/Core>

#include "solver/events/bordered_point.h"
#include "solver/problem/equilibrium_problem.h"

namespace snapthrough {

/// @brief The first-order change of a critical load under a change of the equations, by the adjoint of the
/// system whose solution the point is: one factorisation for the point, two solves a change at a bifurcation,
/// none at a limit point.
///
/// With F(y, lambda, p) = 0, J n = 0, l the left null vector of J (n, and the forces that hold what is fixed
/// against it) and z = (q, 1), at a limit point lambda' = - l.F_p / l.F_lambda. At a bifurcation l.F_p must
/// vanish, else p breaks it; then y' = y_p + a n + lambda' q with J y_p = -F_p, and lambda' and a follow from
///   l.J_p n + l.F''[n, y_p] + A a + B lambda' = 0,
///   l.(J_p q - load_p) + l.F''[z, y_p] + B a + C lambda' = 0,
/// the changes of the eigenvalue and of the condition l.load = 0 that another path crosses.
class CriticalSensitivity {
 public:
  /// @param point kept by reference; solves at a bifurcation
  /// @param limit whether it is a limit point, with one null motion; else the target of several is meant
  CriticalSensitivity(const BorderedPoint& point, Eigen::Index target, bool limit)
      : point_(point), target_(target), limit_(limit) {}

  /// @brief Columns of what a change of the equations is told by, for any problem of the same unknowns: F,
  /// and at a bifurcation J n for each null motion, and J q - load.
  [[nodiscard]] Eigen::MatrixXd equations(EquilibriumProblem& problem) const;

  struct Rate {
    double lambda = 0.0;
    /// |n.F_p| of the motion that crosses: over the sum of its terms' sizes, and as the imperfection that a
    /// unit of p makes. Of a bifurcation.
    double breaking_share = 0.0;
    double breaking = 0.0;
  };
  /// @param change derivative of equations(problem) by p
  [[nodiscard]] Rate rate(const Eigen::MatrixXd& change) const;

 private:
  [[nodiscard]] Eigen::MatrixXd share_of_target() const;

  const BorderedPoint& point_;
  Eigen::Index target_;
  bool limit_;
};

}  // namespace snapthrough
