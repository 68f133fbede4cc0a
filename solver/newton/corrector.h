#pragma once
/// @file
/// Newton's method on F(y, lambda) = 0 with one linear side condition.

#include <Eigen/Core>
#include <cmath>
#include <limits>

#include "solver/problem/equilibrium_problem.h"

namespace snapthrough {

/// Norm of the response to a unit load (displacement gradient per Euler load) that indicates a mechanism.
inline constexpr double kSingularResponse = 1e13;
/// Relative residual of a state that is exact to rounding; the corrector stops below it.
inline constexpr double kRoundingResidual = 1e-14;

/// @brief Norm of a step (dy, dlambda): sqrt(dy.W dy + weight dlambda^2), W the problem's metric.
struct PathMetric {
  const Eigen::VectorXd* weights = nullptr;  ///< not owned
  double load_weight = 0.0;

  template <class A, class B>
  [[nodiscard]] double inner(const Eigen::MatrixBase<A>& a, double la, const Eigen::MatrixBase<B>& b,
                             double lb) const {
    return (a.array() * weights->array() * b.array()).sum() + load_weight * la * lb;
  }
  /// Accepts Eigen expressions, so that the norm of a difference needs no temporary vector.
  template <class A>
  [[nodiscard]] double norm(const Eigen::MatrixBase<A>& a, double la) const {
    return std::sqrt(inner(a, la, a, la));
  }
};

/// @brief Side condition normal.(y - y_0) + normal_lambda (lambda - lambda_0) = 0, (y_0, lambda_0) the
/// starting point.
struct SideCondition {
  Eigen::VectorXd normal;  ///< already weighted by the metric; empty: zero vector (load control)
  double normal_lambda = 1.0;
};

struct CorrectorOptions {
  int max_iterations = 12;
  int most_stalled = 3;     ///< allowed corrections that exceed half of the smallest one so far
  double tolerance = 1e-9;  ///< for the predicted norm of the next correction over the step
  /// Replaces the step as reference of `tolerance` where smaller: the displacement part of the step.
  double displacement = std::numeric_limits<double>::infinity();
  /// Norm of the last correction over the step at which iteration may stop: the tangent then has this
  /// relative error, the point about its square. Zero: iterates to `tolerance`.
  double tangent_tolerance = 0.0;
  double largest_residual = 1e-8;   ///< relative residual above which no state counts as converged
  double largest_correction = 2.0;  ///< correction over the step above which the iteration diverges
  /// Bound on the first correction over the step.
  double largest_first = std::numeric_limits<double>::infinity();
  /// Bound on the ratio of successive corrections.
  double largest_growth = std::numeric_limits<double>::infinity();
  Regime regime;  ///< contact and stiffness of one-sided supports
  /// Frozen contact for the first correction; null: contact of `regime`.
  const FrozenContact* first_contact = nullptr;
  bool least_energy = false;  ///< line search along each correction for the least energy, see correct()
  /// Relative residual below which a residual that no longer falls is rounding.
  double stagnant_residual = 1e-11;
};

/// @brief Options for minimising the energy at a given load, with corrections of any size.
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
  double first_correction = 0.0;  ///< norm of the first correction: error of the predictor
  double first_residual = 0.0;    ///< relative residual at the predictor
  /// Relative residual at the last linearisation, before the last correction.
  double relative_residual = 0.0;
  TangentReport tangent;  ///< inertia at the last linearisation
};

/// @brief Scratch vectors of the corrector and the predictor.
struct Workspace {
  Eigen::VectorXd residual, trial;
  Eigen::MatrixXd block;  ///< the correction, and J^-1 load: solved together

  [[nodiscard]] auto correction() { return block.col(0); }
  [[nodiscard]] auto load_response() { return block.col(1); }
};

/// @brief Corrects (y, lambda) in place.
///
/// Each iteration factorises once and solves twice (bordering). The last correction uses the last factors, so
/// that the point is more accurate than the tolerance; `work.load_response()` is J^-1 load with these
/// factors, for the tangent. With `least_energy` (fixed load, small displacements) each correction ends where
/// the forces do no work along it; the energy of one-sided supports is convex and decreases monotonically.
/// @param scale norm of the step that led to the starting point
[[nodiscard]] CorrectorOutcome correct(EquilibriumProblem& problem, const PathMetric& metric,
                                       const SideCondition& side, double scale,
                                       const CorrectorOptions& options, Eigen::VectorXd& y, double& lambda,
                                       Workspace& work);

}  // namespace snapthrough
