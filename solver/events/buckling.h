#pragma once
/// @file
/// Linearised buckling: eigenvalues of the tangent about a linear prestress.

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "solver/events/buckling_pencil.h"
#include "solver/events/least_piece.h"
#include "solver/problem/structural_problem.h"

namespace snapthrough {

/// Eigenvalues lambda > 0 of (K_E + K_G(s_c) + lambda K_G(s_p)) x = 0, ascending; s_c and s_p are the linear
/// stresses of the constant actions and of the proportional actions at unit scaled load factor.
struct LinearBuckling {
  std::vector<double> loads;           ///< scaled load factors; fewer than requested when no more exist
  std::vector<Eigen::VectorXd> modes;  ///< modes in the problem's unknowns, largest displacement one
  /// For each load the largest compression of each member in the linear prestress, scaled; negative: tension.
  std::vector<std::vector<double>> compressions;
  /// Prestress under the first load, as unknowns; empty unless some law has a curve.
  Eigen::VectorXd prestress;
  int negative_at_start = 0;  ///< negative eigenvalues under the constant actions alone
  SharedHolds holds;          ///< artificial springs on motions without stiffness
  /// A free motion is driven by the actions or resisted by their stresses alone, so that no linear reference
  /// state exists; `loads` is then empty.
  bool is_mechanism = false;
  /// Largest share of the reference load with an equilibrium of small displacements, to three digits; empty:
  /// the reference load has one. Otherwise `loads` is empty.
  std::optional<double> held_share;
  /// Inertia counts confirm that `loads` are the lowest and, where they are fewer than asked for, all below
  /// the largest load factor that the digits of the tangent resolve.
  bool complete = true;
  int factorizations = 0;
  bool touches = false;   ///< some one-sided supports touch without pressure under the reference load
  LeastPiece piece;       ///< stability result of the touching supports
  TouchingMarks marks;    ///< supports that touch
  FrozenContact contact;  ///< contact for which the loads hold
  FrozenContact pressed;  ///< where one-sided supports are pressed or touch under the reference load
};

/// @brief The lowest `count` buckling loads of a structure.
///
/// lowest_eigenpairs() of the pencil from a load factor below the first one, which inertia counts find.
/// One-sided supports are bilateral where they are pressed at the linear equilibrium under `reference`, and
/// absent elsewhere. Supports that touch without pressure act in the combination that becomes unstable first
/// (set_least_piece()): the first load is the critical one, the others belong to that combination. If nothing
/// else restrains the structure, touching supports are bilateral.
/// @param structure with nonlinear geometry
/// @param reference scaled load factor of the reference load
/// @param near first mode on a coarser mesh, for supports that touch without pressure; empty: unknown
/// @param sense `reversed`: loads multiply the opposite of the proportional actions
/// @pre no support is one-sided where `sense` is `reversed` (contact is that of the reference load)
[[nodiscard]] LinearBuckling linear_buckling(const Structure& structure, StructuralProblem& problem,
                                             int count, double reference, const Eigen::VectorXd& near = {},
                                             LoadSense sense = LoadSense::as_given);

/// @brief Small-displacement equilibrium under a load factor, to five digits.
/// @param problem its holds are overwritten
/// @param lambda scaled load factor
/// @param factorizations incremented by the number of factorisations
/// @return empty when no such equilibrium was found
[[nodiscard]] std::optional<Eigen::VectorXd> small_displacement_state(StructuralProblem& problem,
                                                                      double lambda, int& factorizations);

/// @brief Contact of one-sided supports (pressed or touching) at the small-displacement equilibrium under a
/// load factor.
/// @param problem its holds are overwritten
/// @param lambda scaled load factor
/// @param factorizations incremented by the number of factorisations
/// @return empty when no such equilibrium was found
[[nodiscard]] std::optional<FrozenContact> linear_contact(StructuralProblem& problem, double lambda,
                                                          int& factorizations);

}  // namespace snapthrough
