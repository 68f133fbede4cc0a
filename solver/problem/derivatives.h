#pragma once
/// @file
/// Derivatives of the tangent stiffness and of the load along a direction, by central differences.

#include <Eigen/Core>

#include "solver/problem/equilibrium_problem.h"

namespace snapthrough {

/// A direction in (y, lambda) and its norm there, which differences are taken by.
struct PathDirection {
  const Eigen::VectorXd& y;
  double lambda = 0.0;
  double norm = 1.0;
};

/// @brief d/de J(y + e a, lambda + e da) b, by a central difference of products.
/// @param b motions at fixed load, columns
[[nodiscard]] Eigen::MatrixXd tangent_change(EquilibriumProblem& problem, const Eigen::VectorXd& y,
                                             double lambda, const PathDirection& along,
                                             const Eigen::Ref<const Eigen::MatrixXd>& b);
/// @brief d/de load(y + e a, lambda + e da), by a central difference.
[[nodiscard]] Eigen::VectorXd load_change(EquilibriumProblem& problem, const Eigen::VectorXd& y,
                                          double lambda, const PathDirection& along);

}  // namespace snapthrough
