#pragma once
/// @file
/// Sensitivity of a critical load to the equations.

#include <Eigen/Core>

#include "solver/events/bordered_point.h"
#include "solver/problem/equilibrium_problem.h"

namespace snapthrough {

/// @brief First-order change of a critical load under a change of the equations, by the adjoint method. Costs
/// one factorisation per point, and two solves per change at a bifurcation (none at a limit point).
///
/// Notation: F(y, lambda, p) = 0; J n = 0; l the left null vector of J (n with the reactions of prescribed
/// displacements); q the load response, z = (q, 1). Limit point: lambda' = - l.F_p / l.F_lambda. Bifurcation:
/// l.F_p must vanish, else p breaks the bifurcation; with J y_p = -F_p, y' = y_p + a n + lambda' q, where
///   l.J_p n + l.F''[n, y_p] + A a + B lambda' = 0,
///   l.(J_p q - load_p) + l.F''[z, y_p] + B a + C lambda' = 0,
/// which state that the eigenvalue and n.load (the condition for a crossing path) remain zero.
class CriticalSensitivity {
 public:
  /// @param point kept by reference; at a bifurcation it must provide solves
  /// @param target index of the null motion whose load is differentiated
  /// @param limit true: limit point, with one null motion
  CriticalSensitivity(const BorderedPoint& point, Eigen::Index target, bool limit)
      : point_(point), target_(target), limit_(limit) {}

  /// @brief Columns whose derivatives by p rate() needs, for any problem with the same unknowns: F; at a
  /// bifurcation also J n for each null motion, and J q - load.
  [[nodiscard]] Eigen::MatrixXd equations(EquilibriumProblem& problem) const;

  struct Rate {
    double lambda = 0.0;
    /// Bifurcation only: |n.F_p| of the crossing motion, as a share of the sum of its terms' magnitudes, and
    /// as the imperfection per unit of p.
    double breaking_share = 0.0;
    double breaking = 0.0;
  };
  /// @param change derivative of equations(problem) with respect to p
  [[nodiscard]] Rate rate(const Eigen::MatrixXd& change) const;

 private:
  [[nodiscard]] Eigen::MatrixXd share_of_target() const;

  const BorderedPoint& point_;
  Eigen::Index target_;
  bool limit_;
};

}  // namespace snapthrough
