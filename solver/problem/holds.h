#pragma once
/// @file
/// What holds a structure against motions that nothing resists.

#include <Eigen/Core>
#include <memory>

#include "solver/support/regime.h"

namespace snapthrough {

/// @brief Linear springs against motions without stiffness: forces k H (H^T u - at), u the first unknowns.
///
/// Where nothing resists the motions H, all states u + H a are in equilibrium: the springs choose the one
/// with H^T u = at, carry no force, and turn an eigenvalue that is zero into a positive one, so that the
/// count of negative eigenvalues is that of the rest. A spring that carries a force holds something that is
/// no motion without stiffness.
struct Holds {
  Eigen::MatrixXd motions;  ///< H: orthonormal columns over the first unknowns of the problem
  Eigen::VectorXd at;
  double stiffness = 1.0;  ///< k, of the order of the problem's scaled stiffnesses
};

/// Shared by the points of a path; empty: nothing is held.
using SharedHolds = std::shared_ptr<const Holds>;

class EquilibriumProblem;

/// What resists held motions at a point, in its principal directions.
struct MotionStiffness {
  Eigen::MatrixXd motions;    ///< orthonormal columns
  Eigen::VectorXd stiffness;  ///< without the holds, ascending
  Eigen::VectorXd force;      ///< that the holds carry
};

/// @brief What resists the motions of `holds` at (y, lambda), by one factorisation and a solution a motion:
/// with S = H^T J^-1 H of the held tangent J it is S^-1 - k.
/// @pre holds has motions
[[nodiscard]] MotionStiffness motion_stiffness(EquilibriumProblem& problem, const SharedHolds& holds,
                                               const Eigen::VectorXd& y, double lambda,
                                               const Regime& regime = {});

/// @brief All free motions of the problem held so softly that what resists them decides where they go; null
/// when it has none.
[[nodiscard]] SharedHolds held_softly(const EquilibriumProblem& problem);
/// What became of motions that were held softly.
struct SoftlyHeld {
  SharedHolds neutral;    ///< those that nothing resists, held where they are; empty: none
  bool resisted = false;  ///< all are, so firmly that their springs changed nothing that counts
};
/// @brief What the motions of held_softly() met at (y, lambda), an equilibrium with them.
[[nodiscard]] SoftlyHeld softly_held(EquilibriumProblem& problem, const SharedHolds& soft,
                                     const Eigen::VectorXd& y, double lambda, const Regime& regime = {});

/// Largest values that count as none.
struct NeutralBounds {
  double stiffness = 0.0;
  double force = 0.0;
};

/// @brief Size of a force on the motions of `holds` that counts as none beside what acts on them at (y,
/// lambda): the parts of the load along them, each by itself. Actions that do not move them, as strains of
/// stiff members, say nothing.
/// @param actions over the load of factor one
[[nodiscard]] double no_force(EquilibriumProblem& problem, const Holds& holds, const Eigen::VectorXd& y,
                              double lambda, double actions);

/// @brief The motions of `holds` that nothing resists at (y, lambda): neither stiffness nor a force on them.
/// @return held where they are, with the stiffness 1; empty: there are none
[[nodiscard]] SharedHolds neutral_part(EquilibriumProblem& problem, const SharedHolds& holds,
                                       const Eigen::VectorXd& y, double lambda, const NeutralBounds& bounds);

}  // namespace snapthrough
