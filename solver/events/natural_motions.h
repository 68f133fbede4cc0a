#pragma once
/// @file
/// Small free vibrations about an equilibrium.

#include <Eigen/Core>
#include <complex>
#include <vector>

#include "solver/discrete/mass_matrix.h"
#include "solver/events/eigenpairs.h"
#include "solver/problem/structural_problem.h"

namespace snapthrough {

/// @brief The lowest eigenvalues of J x = mu M x at an equilibrium, mu = omega^2 in scaled units.
///
/// A motion x varies as exp(i omega t): it oscillates where mu > 0, grows where mu < 0 (divergence), and
/// grows and oscillates where mu is complex (flutter; unsymmetric tangents only).
struct NaturalMotions {
  std::vector<std::complex<double>> squares;  ///< mu by ascending real part; conjugate pairs adjoin
  /// A column for each entry of `squares`; real and imaginary part of the motion for a conjugate pair.
  Eigen::MatrixXd motions;
  bool complete = true;    ///< no lower eigenvalue was missed, by an inertia count where one was asked for
  bool converged = false;  ///< every eigenvalue has the asked digits
  int factorizations = 0;
};

/// What is searched for: eigenvalues mu and motions nearby.
struct MotionSearch : EigenSearch {
  double scale = 0.0;  ///< magnitude of the lowest eigenvalues; 0: unknown

  /// Begins the next search, of a state nearby, with what was found.
  void begin_with(const NaturalMotions& found);
};

/// @brief Finds the lowest natural motions at (y, lambda).
///
/// lowest_eigenpairs() of the pencil J - mu M with a shift -sigma below all eigenvalues, by the inertia of
/// J + sigma M. Unknowns without mass are eliminated exactly by each solution.
/// @param problem without holds; its factors are overwritten
/// @param columns overwritten
/// @param y, lambda an equilibrium; one-sided supports act as they do there
[[nodiscard]] NaturalMotions natural_motions(const Structure& structure, StructuralProblem& problem,
                                             const MassMatrix& masses, const Eigen::VectorXd& y,
                                             double lambda, const MotionSearch& search,
                                             KrylovColumns& columns);

}  // namespace snapthrough
