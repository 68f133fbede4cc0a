#include "solver/events/critical_sensitivity.h"

#include <Eigen/LU>
#include <cmath>
#include <cstddef>
#include <limits>

#include "solver/path/soft_mode.h"

namespace snapthrough {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

CriticalSensitivity::CriticalSensitivity(EquilibriumProblem& problem, const PathMetric& metric,
                                         const CriticalSolution& solution, Index target, bool limit)
    : problem_(problem), metric_(metric), at_(solution), target_(target), limit_(limit) {
  const Index k = at_.null.cols();
  metric_rows_.resize(at_.y.size(), k);
  VectorXd column;
  for (Index i = 0; i < k; ++i) {
    problem_.metric_forces(at_.null.col(i), column);
    metric_rows_.col(i) = column;
  }
  problem_.load(at_.y, at_.lambda, column);
  const Held load = held(column);
  load_along_ = works(load.forces);
  ready_ = limit_ || factorise();
  if (limit_ || !ready_) return;
  at_.response = response(load);
  differentiate();
}

CriticalSensitivity::Held CriticalSensitivity::held(const VectorXd& rows) const {
  Held out{rows, problem_.imposed_motion(rows)};
  out.moves = !out.motion.isZero(0.0);
  if (out.moves) out.forces -= problem_.tangent_product(at_.y, at_.lambda, out.motion);
  return out;
}

/// Work of forces on the null motions.
VectorXd CriticalSensitivity::works(const VectorXd& forces) const {
  VectorXd out(at_.null.cols());
  for (Index i = 0; i < out.size(); ++i) out[i] = problem_.work(forces, at_.null.col(i));
  return out;
}

/// Factors of the tangent beside the point, where it is regular.
bool CriticalSensitivity::factorise() {
  constexpr double kBeside = 1e-6;  // of the load
  const double step = kBeside * at_.lambda;
  VectorXd residual;
  problem_.linearise(at_.y + step * at_.response, at_.lambda + step, residual);
  VectorXd probe = metric_rows_.col(0);
  problem_.solve(probe);
  return probe.allFinite();
}

/// The motion without a part along n that balances forces but for a part along W n: by the factors beside the
/// point, corrected by what it leaves.
VectorXd CriticalSensitivity::response(const Held& to) const {
  constexpr int kMostCorrections = 6;
  constexpr double kSmall = 1e-15;
  const MatrixXd border = problem_.metric().asDiagonal() * at_.null;
  VectorXd out = VectorXd::Zero(to.forces.size());
  VectorXd left = to.forces;
  double before = std::numeric_limits<double>::infinity();
  for (int it = 0; it < kMostCorrections; ++it) {
    left -= metric_rows_ * works(left);
    problem_.solve(left);
    left -= at_.null * (border.transpose() * left);
    const double size = metric_.norm(left, 0.0);
    if (!(size < before)) break;  // what is left is rounding's
    before = size;
    out += left;
    if (size <= kSmall * metric_.norm(out, 0.0)) break;
    left = to.forces - problem_.tangent_product(at_.y, at_.lambda, out);
  }
  return to.moves ? VectorXd(out + to.motion) : out;
}

/// Second derivatives with the response to the load as it is here.
void CriticalSensitivity::differentiate() {
  const Index k = at_.null.cols();
  const auto along = [&](const VectorXd& y, double lambda) {
    return PathDirection{y, lambda, metric_.norm(y, lambda)};
  };
  for (Index j = 0; j < k; ++j) {
    const VectorXd motion = at_.null.col(j);
    const MatrixXd change = tangent_change(problem_, at_.y, at_.lambda, along(motion, 0.0), at_.null);
    for (Index i = 0; i < k; ++i) at_.A[static_cast<std::size_t>(j)].col(i) = works(change.col(i));
  }
  MatrixXd all(at_.y.size(), k + 1);
  all << at_.null, at_.response;
  const PathDirection z = along(at_.response, 1.0);
  const MatrixXd change = tangent_change(problem_, at_.y, at_.lambda, z, all);
  for (Index i = 0; i < k; ++i) at_.B.col(i) = works(change.col(i));
  at_.C = works(change.col(k) - load_change(problem_, at_.y, at_.lambda, z));
}

MatrixXd CriticalSensitivity::equations(EquilibriumProblem& problem) const {
  const Index k = at_.null.cols();
  MatrixXd out(at_.y.size(), limit_ ? 1 : k + 2);
  VectorXd column;
  problem.residual(at_.y, at_.lambda, column);
  out.col(0) = column;
  if (limit_) return out;
  MatrixXd motions(at_.y.size(), k + 1);
  motions << at_.null, at_.response;
  out.rightCols(k + 1) = problem.tangent_products(at_.y, at_.lambda, motions);
  problem.load(at_.y, at_.lambda, column);
  out.col(k + 1) -= column;
  return out;
}

/// S: the load of the target changes by -trace(S d stiffness) / trace(S B).
MatrixXd CriticalSensitivity::share_of_target() const {
  const auto spectrum = at_.spectrum();
  if (!spectrum) return at_.B.inverse();
  const VectorXd w = spectrum->shares.col(target_);
  return w * w.transpose();
}

CriticalSensitivity::Rate CriticalSensitivity::rate(const MatrixXd& change) const {
  const Held force = held(-change.col(0));
  const VectorXd along = works(force.forces);
  if (limit_) return {-along[0] / load_along_[0], 0.0, 0.0};
  const Index k = at_.null.cols();
  const MatrixXd share = share_of_target();
  const VectorXd moved = response(force);
  const double norm = metric_.norm(moved, 0.0);
  MatrixXd stiffness(k, k);
  for (Index i = 0; i < k; ++i) stiffness.col(i) = works(held(change.col(1 + i)).forces);
  VectorXd crossing = works(held(change.col(k + 1)).forces);
  if (norm > 0.0) {
    MatrixXd all(at_.y.size(), k + 1);
    all << at_.null, at_.response;
    const PathDirection way{moved, 0.0, norm};
    const MatrixXd by_motion = tangent_change(problem_, at_.y, at_.lambda, way, all);
    for (Index i = 0; i < k; ++i) stiffness.col(i) += works(by_motion.col(i));
    crossing += works(by_motion.col(k) - load_change(problem_, at_.y, at_.lambda, way));
  }
  MatrixXd equations(k + 1, k + 1);
  VectorXd right(k + 1);
  equations(0, 0) = (share * at_.B).trace();
  for (Index j = 0; j < k; ++j) equations(0, j + 1) = (share * at_.A[static_cast<std::size_t>(j)]).trace();
  right[0] = -(share * stiffness).trace();
  equations.block(1, 0, k, 1) = at_.C;
  equations.block(1, 1, k, k) = at_.B;
  right.tail(k) = -crossing;
  Rate out;
  out.lambda = equations.fullPivLu().solve(right)[0];
  const double sizes = at_.null.cwiseAbs().rowwise().sum().dot(force.forces.cwiseAbs());
  out.breaking_share = sizes > 0.0 ? along.norm() / sizes : 0.0;
  out.breaking = along.norm() / (std::abs(at_.lambda) * at_.B.norm());
  return out;
}

}  // namespace snapthrough
