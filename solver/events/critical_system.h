#pragma once
/// @file
/// Critical points as solutions of regular systems of equations.

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "solver/newton/corrector.h"
#include "solver/problem/equilibrium_problem.h"

namespace snapthrough {

/// A guess of a critical point.
struct CriticalGuess {
  Eigen::VectorXd y;
  double lambda = 0.0;
  /// Motions that lose their stiffness there: one, or all those that do so close together.
  Eigen::MatrixXd null;
  /// Of several: which of them loses its stiffness at the solution, in the order of the load.
  Eigen::Index target = 0;
};

/// A direction of (y, lambda), and how fast the stiffness of the first null motion changes along it.
struct CriticalDirection {
  Eigen::VectorXd y;
  double lambda = 0.0;
  double stiffness_rate = 0.0;
};

/// A solution of the equations of bifurcations or of a limit point.
struct CriticalSolution {
  Eigen::VectorXd y;
  double lambda = 0.0;
  /// n: orthonormal in W. The tangent has no stiffness along the first, and hardly any along the others.
  Eigen::MatrixXd null;
  Eigen::VectorXd response;  ///< q: J q = load, without a part along n
  /// Second derivatives of F along the null motions and z = (q, 1): A[k](i, j) = n_i.F''[n_j, n_k],
  /// B(i, j) = n_i.F''[n_j, z], C(i) = n_i.F''[z, z]. The stiffness of n changes by A along n and by B along
  /// z.
  std::vector<Eigen::MatrixXd> A;
  Eigen::MatrixXd B;
  Eigen::VectorXd C;
  Eigen::MatrixXd stiffness;  ///< n_i.J n_j there
  Eigen::VectorXd unfolding;  ///< forces along W n that would make them bifurcations; none at limit points
  int others = 0;             ///< negative eigenvalues of all other motions

  /// @brief Size of what breaks the bifurcations: the unfolding forces over those by which the load changes
  /// the stiffness of n. About the root mean square slope of the imperfection's shape.
  [[nodiscard]] double imperfection() const;
  /// Where the stiffness vanishes, seen from here along the load.
  struct Spectrum {
    Eigen::VectorXd distances;  ///< in the load factor, ascending
    Eigen::MatrixXd shares;     ///< of the null motions in the motion that has no stiffness there, columns
  };
  /// @brief Empty where some of the motions gain stiffness by the load and others lose it.
  [[nodiscard]] std::optional<Spectrum> spectrum() const;
  /// @brief Tangents of the paths that cross at a simple bifurcation, of norm one in the metric: two, or none
  /// at an isolated point. Of several null motions: the one path along which they change least.
  [[nodiscard]] std::vector<CriticalDirection> tangents(const PathMetric& metric) const;
};

/// Stop rules of the iteration.
struct CriticalOptions {
  double tolerance = 1e-9;             ///< of the load factor, relative
  double least_load = 0.0;             ///< load that the tolerance is relative to at least
  double reach = 0.1;                  ///< farthest from the guess, in the metric
  double place = 1e-6;                 ///< of the reach: error left in the displacements
  bool to_rounding = true;             ///< iterates until the forces balance as far as rounding allows
  double largest_residual = 1e-8;      ///< relative residual that one-sided supports may leave
  double largest_imperfection = 1e-2;  ///< of a bifurcation that is worth going on for
};

/// @brief The bifurcations next to a guess, by Newton's method on Moore's system: F + W n mu = 0, J n = 0 and
/// n.load = 0 in y, lambda and mu. It is regular at bifurcations, also beside a path that misses them by a
/// small imperfection: mu is its size.
///
/// Where several motions lose their stiffness close together the others are bordered, too, also those that
/// the guess did not have (a multiple bifurcation has no place where one of its motions alone says where the
/// path goes on). One factorisation and two solves an iteration, and one for each motion; derivatives of the
/// tangent by differences of its products.
/// @param factorisations those that were made are added
/// @pre the tangent is symmetric
/// @return empty when it does not converge, or only farther away
[[nodiscard]] std::optional<CriticalSolution> solve_bifurcation(EquilibriumProblem& problem,
                                                                const PathMetric& metric,
                                                                const CriticalGuess& guess,
                                                                const CriticalOptions& options,
                                                                int& factorisations);
/// @brief The limit point next to a guess: F = 0, J n = 0.
/// @pre one null motion
[[nodiscard]] std::optional<CriticalSolution> solve_limit_point(EquilibriumProblem& problem,
                                                                const PathMetric& metric,
                                                                const CriticalGuess& guess,
                                                                const CriticalOptions& options,
                                                                int& factorisations);

}  // namespace snapthrough
