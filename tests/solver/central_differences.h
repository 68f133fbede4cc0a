#pragma once
/// @file
/// Central differences of an equilibrium problem, against which its derivatives are tested.

#include <Eigen/Core>

#include "solver/problem/equilibrium_problem.h"

namespace snapthrough::testing {

/// @brief Derivative of the residual along the unknowns `d`, by displacements of `step` times d to both
/// sides.
inline Eigen::VectorXd residual_difference(EquilibriumProblem& problem, const Eigen::VectorXd& y,
                                           double lambda, const Eigen::VectorXd& d, double step) {
  Eigen::VectorXd ahead;
  Eigen::VectorXd behind;
  problem.residual(y + step * d, lambda, ahead);
  problem.residual(y - step * d, lambda, behind);
  return (ahead - behind) / (2.0 * step);
}

/// @brief Derivative of the tangent stiffness along the unknowns `a`, times d.
inline Eigen::VectorXd tangent_difference(EquilibriumProblem& problem, const Eigen::VectorXd& y,
                                          double lambda, const Eigen::VectorXd& a, const Eigen::VectorXd& d,
                                          double step) {
  return (problem.tangent_product(y + step * a, lambda, d) -
          problem.tangent_product(y - step * a, lambda, d)) /
         (2.0 * step);
}

}  // namespace snapthrough::testing
