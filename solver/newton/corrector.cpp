#include "solver/newton/corrector.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace snapthrough {

double PathMetric::norm(const Eigen::VectorXd& a, double la) const { return std::sqrt(inner(a, la, a, la)); }

namespace {

/// One bordered Newton correction with the factors at hand; returns its norm.
double apply_correction(EquilibriumProblem& problem, const PathMetric& metric, const SideCondition& side,
                        Eigen::VectorXd& y, double& lambda, Workspace& work) {
  work.correction = -work.residual;
  problem.solve(work.correction);
  problem.load(y, lambda, work.load_response);
  problem.solve(work.load_response);
  double along = 0.0;
  double denominator = side.normal_lambda;
  if (side.normal.size() > 0) {
    along = side.normal.dot(work.correction);
    denominator += side.normal.dot(work.load_response);
  }
  const double dlambda = -along / denominator;
  work.correction += dlambda * work.load_response;
  y += work.correction;
  lambda += dlambda;
  return metric.norm(work.correction, dlambda);
}

}  // namespace

CorrectorOutcome correct(EquilibriumProblem& problem, const PathMetric& metric, const SideCondition& side,
                         double scale, const CorrectorOptions& options, Eigen::VectorXd& y, double& lambda,
                         Workspace& work) {
  CorrectorOutcome out;
  double previous = scale;
  double expected = std::numeric_limits<double>::infinity();
  for (int it = 0; it < options.max_iterations; ++it) {
    out.tangent = problem.linearise(y, lambda, work.residual);
    ++out.factorisations;
    out.relative_residual = problem.relative_residual(work.residual, y, lambda);
    if (!std::isfinite(out.relative_residual)) return out;
    const bool small =
        expected <= options.tolerance * scale && out.relative_residual <= options.largest_residual;
    const bool last = it > 0 && (small || out.relative_residual <= options.residual_floor);
    const double size = apply_correction(problem, metric, side, y, lambda, work);
    if (!std::isfinite(size)) return out;
    if (it == 0) out.first_correction = size;
    if (last) {
      out.status = CorrectorStatus::converged;
      return out;
    }
    if (size > options.largest_correction * scale) return out;
    // quadratic convergence: the next ratio of corrections is about this one squared
    const double ratio = std::min(1.0, size / previous);
    expected = size * ratio * ratio;
    previous = size;
  }
  out.status = CorrectorStatus::too_many_iterations;
  return out;
}

}  // namespace snapthrough
