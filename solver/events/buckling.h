#pragma once
/// @file
/// Linearised buckling: the eigenvalues of the tangent about a linear prestress.

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "solver/events/least_piece.h"
#include "solver/problem/structural_problem.h"

namespace snapthrough {

/// Whether buckling is looked for under the proportional actions as they are or under the opposite ones.
enum class LoadSense { as_given, reversed };

/// Eigenvalues lambda > 0 of (K_E + K_G(s_c) + lambda K_G(s_p)) x = 0, ascending, s_c and s_p the linear
/// stresses of the constant and of the proportional actions by unit (scaled) load factor.
struct LinearBuckling {
  std::vector<double> loads;           ///< scaled load factors; fewer than asked when there are no more
  std::vector<Eigen::VectorXd> modes;  ///< unknowns of the structural problem, largest displacement one
  int negative_at_start = 0;           ///< negative eigenvalues under the constant actions alone
  SharedHolds holds;                   ///< of motions that nothing resists
  /// A motion that no support resists is driven by the actions, or resisted by their stresses alone: there is
  /// no reference state to linearise about. No loads then.
  bool is_mechanism = false;
  int factorizations = 0;
  bool touches = false;   ///< some one-sided supports touch without pressure under the reference load
  LeastPiece piece;       ///< what was found for them
  TouchingMarks marks;    ///< of them
  FrozenContact contact;  ///< that the loads are of
  FrozenContact pressed;  ///< where one-sided supports are pressed or touch under the reference load
};

/// @brief The lowest `count` buckling loads of a structure.
///
/// Inertia counts isolate each eigenvalue or cluster (nothing is missed, repeated ones are counted), inverse
/// iteration on a block of the cluster's size with Rayleigh-Ritz gives its values and modes. One-sided
/// supports are glued where they are pressed at the linear equilibrium under the load factor `reference` and
/// absent where they are left. Those that touch without pressure act in the piece that becomes unstable first
/// (set_least_piece()): the first load is the critical one, the others are those of the same piece. Where
/// nothing else holds the structure they are glued.
/// @param structure not linear in its geometry
/// @param reference scaled load factor of the reference load
/// @param near the first mode on a coarser mesh, where supports touch without pressure; empty: not known
/// @param sense `reversed`: loads are positive multiples of the opposite of the proportional actions
/// @pre no support is one-sided where `sense` is `reversed`: contact is that of the reference load
[[nodiscard]] LinearBuckling linear_buckling(const Structure& structure, StructuralProblem& problem,
                                             int count, double reference, const Eigen::VectorXd& near = {},
                                             LoadSense sense = LoadSense::as_given);

/// @brief Where one-sided supports are pressed or touch at the equilibrium of small displacements under a
/// load factor.
/// @param problem its holds are set anew
/// @param lambda scaled load factor
/// @param factorizations counts are added to it
/// @return empty when no such equilibrium was found
[[nodiscard]] std::optional<FrozenContact> linear_contact(StructuralProblem& problem, double lambda,
                                                          int& factorizations);

}  // namespace snapthrough
