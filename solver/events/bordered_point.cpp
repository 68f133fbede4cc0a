#include "solver/events/bordered_point.h"

#include <algorithm>
#include <cstddef>
#include <limits>

namespace snapthrough {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {
/// Solution with factors beside the critical point. Source: docs/decisions/0010; rounding.
struct BorderedLimits {
  static constexpr double beside = 1e-6;  ///< distance of the factors from the point, over its load factor
  static constexpr int most_corrections = 6;  ///< iterative refinements at most
  static constexpr double last = 1e-15;       ///< size of the last correction, over the solution's
};
}  // namespace

BorderedPoint::BorderedPoint(EquilibriumProblem& problem, const PathMetric& metric,
                             const CriticalSolution& solution, bool solves)
    : problem_(problem), metric_(metric), at_(solution) {
  const Index k = at_.null.cols();
  metric_rows_.resize(at_.y.size(), k);
  for (Index i = 0; i < k; ++i) problem_.metric_forces(at_.null.col(i), metric_rows_.col(i));
  VectorXd column;
  problem_.load(at_.y, at_.lambda, column);
  const Held load = held(column);
  load_along_ = works(load.forces);
  ready_ = !solves || factorise();
  if (!solves || !ready_) return;
  at_.response = response(load);
  differentiate();
}

BorderedPoint::Held BorderedPoint::held(const VectorXd& rows) const {
  Held out{rows, problem_.imposed_motion(rows)};
  out.moves = !out.motion.isZero(0.0);
  if (out.moves) out.forces -= problem_.tangent_product(at_.y, at_.lambda, out.motion);
  return out;
}

VectorXd BorderedPoint::works(const VectorXd& forces) const {
  VectorXd out(at_.null.cols());
  for (Index i = 0; i < out.size(); ++i) out[i] = problem_.work(forces, at_.null.col(i));
  return out;
}

/// Factorises the tangent beside the critical point, where it is usually regular; false: singular there, too.
bool BorderedPoint::factorise() {
  const double step = BorderedLimits::beside * at_.lambda;
  VectorXd residual;
  problem_.linearise(at_.y + step * at_.response, at_.lambda + step, residual);
  VectorXd probe = metric_rows_.col(0);
  problem_.solve(probe);
  return probe.allFinite();
}

/// Solves with the factors beside the critical point and refines with the residual of the tangent at it.
VectorXd BorderedPoint::response(const Held& to) const {
  const MatrixXd border = problem_.metric().asDiagonal() * at_.null;
  VectorXd out = VectorXd::Zero(to.forces.size());
  VectorXd left = to.forces;
  double before = std::numeric_limits<double>::infinity();
  for (int it = 0; it < BorderedLimits::most_corrections; ++it) {
    left -= metric_rows_ * works(left);
    problem_.solve(left);
    left -= at_.null * (border.transpose() * left);
    const double size = size_of(left);
    if (!(size < before)) break;  // the residual is rounding
    before = size;
    out += left;
    if (size <= BorderedLimits::last * size_of(out)) break;
    left = to.forces - problem_.tangent_product(at_.y, at_.lambda, out);
  }
  return to.moves ? VectorXd(out + to.motion) : out;
}

double BorderedPoint::size_of(const VectorXd& motion) const {
  const double share = motion.lpNorm<Eigen::Infinity>() / std::max(1.0, at_.y.lpNorm<Eigen::Infinity>());
  return std::max(metric_.norm(motion, 0.0), share);
}

MatrixXd BorderedPoint::tangent_change_along(const VectorXd& motion,
                                             const Eigen::Ref<const MatrixXd>& b) const {
  return problem_.tangent_change(at_.y, at_.lambda, {motion, 0.0}, b);
}

/// Evaluates the second derivatives A, B and C of CriticalSolution with the response at this point.
void BorderedPoint::differentiate() {
  const Index k = at_.null.cols();
  for (Index j = 0; j < k; ++j) {
    const MatrixXd change = tangent_change_along(at_.null.col(j), at_.null);
    for (Index i = 0; i < k; ++i) at_.A[static_cast<std::size_t>(j)].col(i) = works(change.col(i));
  }
  MatrixXd all(at_.y.size(), k + 1);
  all << at_.null, at_.response;
  const PathDirection z{at_.response, 1.0};
  const MatrixXd change = problem_.tangent_change(at_.y, at_.lambda, z, all);
  for (Index i = 0; i < k; ++i) at_.B.col(i) = works(change.col(i));
  at_.C = works(change.col(k) - problem_.load_change(at_.y, at_.lambda, z));
}

}  // namespace snapthrough
