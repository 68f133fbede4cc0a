#pragma once
/// @file
/// Stiffness of motions that artificial springs hold.

#include <Eigen/Core>

#include "solver/problem/equilibrium_problem.h"
#include "solver/problem/holds.h"
#include "solver/support/regime.h"

namespace snapthrough {

/// Stiffness and spring force of held motions at a point, in principal directions.
struct MotionStiffness {
  Eigen::MatrixXd motions;    ///< orthonormal columns
  Eigen::VectorXd stiffness;  ///< stiffness without the springs, ascending
  Eigen::VectorXd force;      ///< force in the springs
};

/// @brief Stiffness of the motions of `holds` at (y, lambda): S^-1 - k with S = H^T J^-1 H of the held
/// tangent J. Costs one factorisation and one solution per motion; leaves `holds` set in the problem.
/// @pre holds is not null and has motions
[[nodiscard]] MotionStiffness motion_stiffness(EquilibriumProblem& problem, const SharedHolds& holds,
                                               const Eigen::VectorXd& y, double lambda,
                                               const Regime& regime = {});

/// @brief All free motions of the problem, held by springs of stiffness 1e-6; null when there are none.
[[nodiscard]] SharedHolds held_softly(const EquilibriumProblem& problem);
/// Classification of softly held motions at an equilibrium.
struct SoftlyHeld {
  SharedHolds neutral;    ///< motions without stiffness, held at their present values; null: none
  bool resisted = false;  ///< every motion is stiffer than 1e5 times its soft spring
};
/// @brief Classifies the motions of held_softly() at an equilibrium (y, lambda) that includes their springs.
[[nodiscard]] SoftlyHeld softly_held(EquilibriumProblem& problem, const SharedHolds& soft,
                                     const Eigen::VectorXd& y, double lambda, const Regime& regime = {});

/// Largest stiffness and spring force of a motion that counts as free.
struct NeutralBounds {
  double stiffness = 0.0;
  double force = 0.0;
};

/// @brief Largest spring force that counts as zero: 1e-6 of the load's parts along a held motion, added
/// without sign, at least 1e-12. Actions that do no work on the held motions do not count.
/// @param actions factor on the unit load
[[nodiscard]] double no_force(EquilibriumProblem& problem, const Holds& holds, const Eigen::VectorXd& y,
                              double lambda, double actions);

/// @brief The motions of `holds` with neither stiffness nor spring force at (y, lambda).
/// @return motions held at their present values, with the stiffness 1; null when there are none
[[nodiscard]] SharedHolds neutral_part(EquilibriumProblem& problem, const SharedHolds& holds,
                                       const Eigen::VectorXd& y, double lambda, const NeutralBounds& bounds);

}  // namespace snapthrough
