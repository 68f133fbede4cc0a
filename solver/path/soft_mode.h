#pragma once
/// @file
/// Motions of least stiffness at a point of a path.

#include <Eigen/Core>
#include <memory>

#include "solver/problem/equilibrium_problem.h"

namespace snapthrough {

/// @brief Eigenpairs of the tangent stiffness J in the problem's metric W whose eigenvalues are nearest to
/// zero: J n = stiffness W n, n.W n = 1; the nearest first.
struct SoftModes {
  Eigen::MatrixXd motions;    ///< columns n, all unknowns
  Eigen::VectorXd stiffness;  ///< negative where the motion is unstable
  Eigen::VectorXd rate;       ///< d stiffness / ds along the path's tangent

  [[nodiscard]] Eigen::Index count() const { return stiffness.size(); }
  /// @brief Distance along the path's tangent at which a stiffness vanishes by its value and rate; infinity
  /// where the stiffness moves away from zero.
  /// @param sense 1: ahead; -1: behind
  [[nodiscard]] double distance_to_zero(Eigen::Index mode, double sense) const;
};

/// Modes that the copies of a path point share; null: the modes are not known.
using SharedModes = std::shared_ptr<const SoftModes>;

/// @brief Finds the eigenpairs nearest to zero by block inverse iteration with the problem's last factors and
/// Rayleigh-Ritz projection. Rates stay empty.
///
/// One iteration from the motions of a neighbouring point is enough, because the error of a stiffness is the
/// square of the error of its motion. One pseudo-random vector is added each time, so that a motion which
/// softens from far away is found.
/// @param start motions to start from, columns; may have none
/// @param count how many are wanted; fewer where the problem has fewer
/// @pre the problem is factorised
[[nodiscard]] SoftModes soft_modes(EquilibriumProblem& problem, const Eigen::MatrixXd& start,
                                   Eigen::Index count, int iterations);

}  // namespace snapthrough
