#pragma once
/// @file
/// What a structure does under a small load.

#include <Eigen/Core>

#include "solver/discrete/structure.h"
#include "solver/problem/structural_problem.h"

namespace snapthrough::testing {

/// The structure's unknowns by its tangent at rest and the load's scale.
inline Eigen::VectorXd linear_response(const Structure& structure) {
  StructuralProblem problem(structure);
  Eigen::VectorXd y = Eigen::VectorXd::Zero(structure.size);
  Eigen::VectorXd residual;
  problem.linearise(y, 0.0, residual);
  problem.load(y, 0.0, y);
  problem.solve(y);
  return y;
}

}  // namespace snapthrough::testing
