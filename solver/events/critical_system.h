#pragma once
/// @file
/// Critical points as solutions of regular (extended) systems of equations.

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "solver/newton/corrector.h"
#include "solver/problem/equilibrium_problem.h"

namespace snapthrough {

/// Initial guess of a critical point.
struct CriticalGuess {
  Eigen::VectorXd y;
  double lambda = 0.0;
  /// Motions whose stiffness vanishes at or near the point, as columns.
  Eigen::MatrixXd null;
  /// Index of the motion whose stiffness vanishes at the solution, counted along the load.
  Eigen::Index target = 0;
};

/// Direction of norm one in (y, lambda) with the rate of the first null motion's stiffness along it.
struct CriticalDirection {
  Eigen::VectorXd y;
  double lambda = 0.0;
  double stiffness_rate = 0.0;
};

/// Solution of the extended equations of a bifurcation or of a limit point.
struct CriticalSolution {
  Eigen::VectorXd y;
  double lambda = 0.0;
  /// n: columns, orthonormal in W. The first has no stiffness, the others almost none.
  Eigen::MatrixXd null;
  Eigen::VectorXd response;  ///< q: J q = load, orthogonal to n
  /// Second derivatives of F along the null motions and z = (q, 1): A[k](i, j) = n_i.F''[n_j, n_k], B(i,
  /// j) = n_i.F''[n_j, z], C(i) = n_i.F''[z, z]. A and B are the rates of the stiffness of n along n and z.
  std::vector<Eigen::MatrixXd> A;
  Eigen::MatrixXd B;
  Eigen::VectorXd C;
  Eigen::MatrixXd stiffness;  ///< stiffness n_i.J n_j of the null motions
  Eigen::VectorXd unfolding;  ///< forces along W n that restore exact bifurcations; empty at limit points
  int others = 0;             ///< number of negative eigenvalues besides the null motions

  /// @brief Imperfection of the bifurcation: unfolding forces over |lambda| times the least rate of the null
  /// motions' stiffness with the load. About the root mean square slope of the imperfection's shape.
  [[nodiscard]] double imperfection() const;
  /// Distances to the vanishing stiffnesses of the null motions along the load, linearised.
  struct Spectrum {
    Eigen::VectorXd distances;  ///< distances in the load factor, ascending
    Eigen::MatrixXd shares;     ///< columns: combination of the null motions whose stiffness vanishes
  };
  /// @brief Empty when some null motions gain stiffness with the load and others lose it.
  [[nodiscard]] std::optional<Spectrum> spectrum() const;
  /// @brief Tangents of the paths through a simple bifurcation, of norm one in the metric: two, or none at an
  /// isolated point. For several null motions: the one path along which they change least.
  [[nodiscard]] std::vector<CriticalDirection> tangents(const PathMetric& metric) const;
};

/// Tolerances and limits of Newton's method on the extended systems.
struct CriticalOptions {
  double tolerance = 1e-9;             ///< relative tolerance on the load factor
  double least_load = 0.0;             ///< lower bound of the load factor to which `tolerance` is relative
  double reach = 0.1;                  ///< largest distance from the guess, in the metric
  double place = 1e-6;                 ///< displacement tolerance over the reach
  bool to_rounding = true;             ///< iterates until the residual is at rounding level
  double largest_residual = 1e-8;      ///< relative residual allowed with one-sided supports
  double largest_imperfection = 1e-2;  ///< iteration stops at larger imperfections
};

/// @brief Finds the bifurcation next to a guess by Newton's method on Moore's system F + W n mu = 0, J n = 0,
/// n.load = 0 in y, lambda and mu. The system is regular also on a path that misses the bifurcation by a
/// small imperfection, which mu measures.
///
/// Neighbouring null motions are bordered together, including motions that the guess does not have, because
/// no single motion is determined at a multiple bifurcation. Each iteration costs one factorisation, two
/// solves and one per null motion.
/// @param factorisations incremented by the number of factorisations
/// @pre the tangent is symmetric
/// @return empty when the iteration diverges or leaves `options.reach`
[[nodiscard]] std::optional<CriticalSolution> solve_bifurcation(EquilibriumProblem& problem,
                                                                const PathMetric& metric,
                                                                const CriticalGuess& guess,
                                                                const CriticalOptions& options,
                                                                int& factorisations);
/// @brief Finds the limit point next to a guess: F = 0, J n = 0.
/// @pre one null motion
[[nodiscard]] std::optional<CriticalSolution> solve_limit_point(EquilibriumProblem& problem,
                                                                const PathMetric& metric,
                                                                const CriticalGuess& guess,
                                                                const CriticalOptions& options,
                                                                int& factorisations);

}  // namespace snapthrough
