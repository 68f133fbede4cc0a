#pragma once
/// @file
/// A point of an equilibrium path with its tangent and stability.

#include <Eigen/Core>
#include <cmath>

#include "solver/path/soft_mode.h"
#include "solver/problem/holds.h"

namespace snapthrough {

struct PathPoint {
  Eigen::VectorXd y;
  double lambda = 0.0;
  double arc_length = 0.0;
  Eigen::VectorXd tangent;      ///< dy/ds, of norm one together with tangent_lambda in the path's metric
  double tangent_lambda = 0.0;  ///< dlambda/ds: zero at a limit point
  int negative = 0;             ///< negative eigenvalues of the constrained tangent stiffness
  double log_abs_det = 0.0;
  bool perturbed = false;  ///< an equilibrium but for the imperfection that breaks a bifurcation there
  SharedHolds holds;       ///< part of the equations there
  SharedModes modes;       ///< the softest motions, where they were asked for

  /// The determinant with its sign, over e^log_scale.
  [[nodiscard]] double determinant(double log_scale) const {
    return (negative % 2 == 0 ? 1.0 : -1.0) * std::exp(log_abs_det - log_scale);
  }
};

}  // namespace snapthrough
