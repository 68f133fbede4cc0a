#pragma once
/// @file
/// The motions that a structure resists least at a point of its path.

#include <Eigen/Core>
#include <memory>

#include "solver/problem/equilibrium_problem.h"

namespace snapthrough {

/// @brief Eigenpairs of the tangent stiffness in the problem's metric, those nearest to zero:
/// J n = stiffness W n, n.W n = 1; the nearest first.
struct SoftModes {
  Eigen::MatrixXd motions;    ///< columns n, all unknowns
  Eigen::VectorXd stiffness;  ///< negative where the motion is unstable
  Eigen::VectorXd rate;       ///< d stiffness / ds along the path's tangent

  [[nodiscard]] Eigen::Index count() const { return stiffness.size(); }
  /// @brief Distance along the tangent at which a stiffness vanishes, as its value and its rate let expect;
  /// infinity where it moves away from zero.
  /// @param sense 1: ahead; -1: behind
  [[nodiscard]] double distance_to_zero(Eigen::Index mode, double sense) const;
};

/// Shared by the copies of a path point; null: not known there.
using SharedModes = std::shared_ptr<const SoftModes>;

/// @brief The eigenpairs nearest to zero, by block inverse iteration with the factors at hand and
/// Rayleigh-Ritz; without rates.
///
/// From the motions of a neighbouring point one iteration is enough: stiffnesses are as accurate as the
/// square of the vectors. One generic vector is added each time, so that a motion which becomes soft from far
/// away is met.
/// @param start motions to start from, columns; may have none
/// @param count how many are wanted; fewer where the problem has fewer
/// @pre the problem is factorised
[[nodiscard]] SoftModes soft_modes(EquilibriumProblem& problem, const Eigen::MatrixXd& start,
                                   Eigen::Index count, int iterations);

}  // namespace snapthrough
