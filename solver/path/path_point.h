#pragma once
/// @file
/// Plain data of path following: a point of an equilibrium path, the size of a step, counts.

#include <Eigen/Core>
#include <array>
#include <cmath>

#include "solver/path/soft_mode.h"
#include "solver/problem/point_context.h"

namespace snapthrough {

/// A point of an equilibrium path with its tangent and its inertia.
struct PathPoint {
  Eigen::VectorXd y;        ///< scaled unknowns
  double lambda = 0.0;      ///< scaled load factor
  double arc_length = 0.0;  ///< from the path's first point, in the norm that the path began with
  /// dy/ds, of norm one together with tangent_lambda in the path's norm; empty: not known
  Eigen::VectorXd tangent;
  double tangent_lambda = 0.0;  ///< dlambda/ds: zero at a limit point
  int negative = 0;             ///< negative eigenvalues of the constrained tangent stiffness
  double log_abs_det = 0.0;     ///< log |det J| of the tangent stiffness
  bool perturbed = false;  ///< in equilibrium only without the imperfection that breaks a bifurcation here
  PointContext context;    ///< what else the equations depend on here
  SharedModes modes;       ///< softest motions; null where nobody asked for them

  /// The determinant with its sign, over e^log_scale.
  [[nodiscard]] double determinant(double log_scale) const {
    return (negative % 2 == 0 ? 1.0 : -1.0) * std::exp(log_abs_det - log_scale);
  }
};

/// Size of the step that was taken last, and of the step to try next, in the path's norm.
struct StepSize {
  double taken = 0.0;
  double wanted = 0.0;
};

/// Counts of the work on a path.
struct PathStatistics {
  int steps = 0;                       ///< accepted
  int rejected_steps = 0;              ///< tried and not accepted
  int iterations = 0;                  ///< Newton corrections
  int factorizations = 0;              ///< factorisations of the tangent stiffness
  double max_relative_residual = 0.0;  ///< over all accepted steps
  /// Entry i: accepted steps that took i corrections; the last entry counts steps with 31 or more.
  std::array<int, 32> corrections{};
};

/// Turns the tangent of a point round.
inline void reverse(PathPoint& point) {
  point.tangent = -point.tangent;
  point.tangent_lambda = -point.tangent_lambda;
}

}  // namespace snapthrough
