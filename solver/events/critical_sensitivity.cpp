#include "solver/events/critical_sensitivity.h"

#include <cmath>
#include <cstddef>
#include <limits>

#include "solver/numeric/dense.h"

namespace snapthrough {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

MatrixXd CriticalSensitivity::equations(EquilibriumProblem& problem) const {
  const CriticalSolution& at = point_.at();
  const Index k = at.null.cols();
  MatrixXd out(at.y.size(), limit_ ? 1 : k + 2);
  VectorXd column;
  problem.residual(at.y, at.lambda, column);
  out.col(0) = column;
  if (limit_) return out;
  MatrixXd motions(at.y.size(), k + 1);
  motions << at.null, at.response;
  out.rightCols(k + 1) = problem.tangent_products(at.y, at.lambda, motions);
  problem.load(at.y, at.lambda, column);
  out.col(k + 1) -= column;
  return out;
}

/// Matrix S such that the target's critical load changes by -trace(S d stiffness) / trace(S B).
MatrixXd CriticalSensitivity::share_of_target() const {
  const CriticalSolution& at = point_.at();
  const auto spectrum = at.spectrum();
  if (!spectrum) return inverse(at.B);
  const VectorXd w = spectrum->shares.col(target_);
  return w * w.transpose();
}

CriticalSensitivity::Rate CriticalSensitivity::rate(const MatrixXd& change) const {
  const CriticalSolution& at = point_.at();
  const BorderedPoint::Held force = point_.held(-change.col(0));
  const VectorXd along = point_.works(force.forces);
  if (limit_) return {-along[0] / point_.load_along()[0], 0.0, 0.0};
  const Index k = at.null.cols();
  const MatrixXd share = share_of_target();
  const VectorXd moved = point_.response(force);
  MatrixXd stiffness(k, k);
  for (Index i = 0; i < k; ++i) stiffness.col(i) = point_.works(point_.held(change.col(1 + i)).forces);
  VectorXd crossing = point_.works(point_.held(change.col(k + 1)).forces);
  if (!moved.isZero(0.0)) {
    MatrixXd all(at.y.size(), k + 1);
    all << at.null, at.response;
    const PathDirection way{moved, 0.0};
    const MatrixXd by_motion = point_.problem().tangent_change(at.y, at.lambda, way, all);
    for (Index i = 0; i < k; ++i) stiffness.col(i) += point_.works(by_motion.col(i));
    crossing += point_.works(by_motion.col(k) - point_.problem().load_change(at.y, at.lambda, way));
  }
  MatrixXd equations(k + 1, k + 1);
  VectorXd right(k + 1);
  equations(0, 0) = (share * at.B).trace();
  for (Index j = 0; j < k; ++j) equations(0, j + 1) = (share * at.A[static_cast<std::size_t>(j)]).trace();
  right[0] = -(share * stiffness).trace();
  equations.block(1, 0, k, 1) = at.C;
  equations.block(1, 1, k, k) = at.B;
  right.tail(k) = -crossing;
  Rate out;
  out.lambda = solve_full_pivoting(equations, right)[0];
  const double sizes = at.null.cwiseAbs().rowwise().sum().dot(force.forces.cwiseAbs());
  out.breaking_share = sizes > 0.0 ? along.norm() / sizes : 0.0;
  out.breaking = along.norm() / (std::abs(at.lambda) * at.B.norm());
  return out;
}

}  // namespace snapthrough
