#pragma once
/// @file
/// Newton's method on F(y, lambda) = 0 with one linear side condition.

#include <Eigen/Core>
#include <cmath>
#include <limits>

#include "solver/problem/equilibrium_problem.h"

namespace snapthrough {

/// Response to a unit load, a displacement gradient in units of the structure's Euler load, that only a
/// mechanism gives.
inline constexpr double kSingularResponse = 1e13;
/// Relative residual that rounding always leaves: a state with it is as good as exact.
inline constexpr double kRoundingResidual = 1e-14;
/// Relative residual that rounding allows: iterations for a state that is returned stop there.
inline constexpr double kResidualFloor = 2e-13;

/// @brief Norm of a step (dy, dlambda): sqrt(dy.W dy + weight dlambda^2), W the problem's metric.
struct PathMetric {
  const Eigen::VectorXd* weights = nullptr;  ///< not owned
  double load_weight = 0.0;

  template <class A, class B>
  [[nodiscard]] double inner(const Eigen::MatrixBase<A>& a, double la, const Eigen::MatrixBase<B>& b,
                             double lb) const {
    return (a.array() * weights->array() * b.array()).sum() + load_weight * la * lb;
  }
  /// Also of a difference, which is not put into a vector for it.
  template <class A>
  [[nodiscard]] double norm(const Eigen::MatrixBase<A>& a, double la) const {
    return std::sqrt(inner(a, la, a, la));
  }
};

/// @brief The side condition normal.(y - y_0) + normal_lambda (lambda - lambda_0) = 0 through the starting
/// point.
struct SideCondition {
  Eigen::VectorXd
      normal;  ///< already weighted: a plain dot product with dy; empty counts as zero (load control)
  double normal_lambda = 1.0;
};

struct CorrectorOptions {
  int max_iterations = 12;
  int most_stalled = 3;     ///< corrections that are not half the least so far: it does not converge
  double tolerance = 1e-9;  ///< on the predicted norm of the next correction, relative to the step
  /// What the tolerance is relative to where it is less than the step: the displacement part of it.
  double displacement = std::numeric_limits<double>::infinity();
  /// A correction below this share of the step is the last: the tangent at hand is the path's to this share,
  /// the point to about its square. Zero: iterates to `tolerance`.
  double tangent_tolerance = 0.0;
  double largest_residual = 1e-8;   ///< relative residual above which nothing counts as converged
  double largest_correction = 2.0;  ///< a correction beyond this many steps ends the iteration as diverged
  double largest_first = std::numeric_limits<double>::infinity();   ///< the same for the first
  double largest_growth = std::numeric_limits<double>::infinity();  ///< from one correction to the next
  Regime regime;                                                    ///< how supports are taken
  /// Where supports are taken to act for the first correction; null: as for all.
  const FrozenContact* first_contact = nullptr;
  bool least_energy = false;         ///< shortens corrections to where the energy is least, see correct()
  double stagnant_residual = 1e-11;  ///< below it, one that no longer falls is rounding's, too
};

/// @brief The same options for going downhill in the energy at a given load, however far that leads.
[[nodiscard]] inline CorrectorOptions downhill(CorrectorOptions options, int max_iterations) {
  options.max_iterations = max_iterations;
  options.most_stalled = max_iterations;
  options.largest_correction = std::numeric_limits<double>::infinity();
  options.least_energy = true;
  return options;
}

enum class CorrectorStatus { converged, too_many_iterations, diverged };

struct CorrectorOutcome {
  CorrectorStatus status = CorrectorStatus::diverged;
  int factorisations = 0;
  double first_correction = 0.0;   ///< norm of the first correction: the predictor's error
  double first_residual = 0.0;     ///< relative residual at the predictor
  double relative_residual = 0.0;  ///< at the last linearisation, before the last correction
  TangentReport tangent;           ///< at the last linearisation
};

/// @brief Vectors that the corrector and the predictor reuse, so that iterations do not allocate.
struct Workspace {
  Eigen::VectorXd residual, correction, load_response, trial;
};

/// @brief Corrects (y, lambda) in place.
///
/// Each iteration factorises once and solves twice (bordering); the step taken with the last factors leaves
/// the point more accurate than the tolerance, and `work.load_response` = J^-1 load with those factors, for
/// the tangent.
/// With least_energy, for a given load and small displacements, a correction ends where the
/// forces do no work on it: the energy of one-sided supports is convex, and falls with each.
/// @param scale norm of the step that led to the starting point
[[nodiscard]] CorrectorOutcome correct(EquilibriumProblem& problem, const PathMetric& metric,
                                       const SideCondition& side, double scale,
                                       const CorrectorOptions& options, Eigen::VectorXd& y, double& lambda,
                                       Workspace& work);

}  // namespace snapthrough
