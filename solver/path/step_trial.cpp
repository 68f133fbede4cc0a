#include "solver/path/step_trial.h"

#include <algorithm>
#include <cmath>

namespace snapthrough {

using Eigen::VectorXd;

namespace {

/// Bounds of the corrector on a step that was not shortened much yet: giving such a step up and trying a
/// shorter one costs less than its corrections.
struct FullStep {
  static constexpr double largest_growth = 2.0;  ///< ratio of one correction to the one before
  static constexpr int most_stalled = 2;         ///< corrections that do not halve the least so far
};

CorrectorOptions corrector_options(const PointSolver& solver, const StepLimits& limits,
                                   const StepAttempt& attempt) {
  CorrectorOptions options = solver.options();
  // one-sided supports act on a structure that hardly moves under much load, too
  if (solver.problem().traits().one_sided)
    options.displacement = std::max(
        attempt.sizes.size * solver.norm().metric().norm(attempt.from.tangent, 0.0), kRoundingResidual);
  if (attempt.sizes.size >= limits.min_growth * attempt.sizes.last_full_step) {
    options.largest_first = limits.max_correction;
    options.largest_growth = FullStep::largest_growth;
    options.most_stalled = std::min(options.most_stalled, FullStep::most_stalled);
  }
  return options;
}

/// Distance of the displacement increment from the span of both end tangents, over the increment.
/// @param rise part of the increment that the tangent at the step's start misses
double tangent_mismatch(const PathMetric& metric, const PathPoint& from, double step, const VectorXd& rise,
                        const PathPoint& to) {
  const double cosine = metric.inner(from.tangent, from.tangent_lambda, to.tangent, to.tangent_lambda);
  const VectorXd turn = to.tangent - cosine * from.tangent;  // in the plane that `to` was corrected in
  const double along = metric.inner(rise, 0.0, turn, 0.0);
  const double turned = metric.inner(turn, 0.0, turn, 0.0);
  const double share = along > 0.0 ? std::min(along / turned, step / std::abs(cosine)) : 0.0;
  return metric.norm(rise - share * turn, 0.0) / std::max(metric.norm(to.y - from.y, 0.0), Gradients::tiny);
}

}  // namespace

StepMeasures try_step(PointSolver& solver, Predictor& predictor, const StepLimits& limits,
                      const StepAttempt& attempt, PathPoint& to) {
  const PathPoint& from = attempt.from;
  const double step = attempt.sizes.size;
  // where the load dwarfs the displacements, a step may be long while the structure hardly moves
  const double displacement = std::min(step, Gradients::large);
  CorrectorOptions options = corrector_options(solver, limits, attempt);
  predictor.predict(from, step, to);
  if (attempt.forecast) options.first_contact = predictor.forecast(solver.problem(), step, to);
  const auto outcome = solver.correct_in_plane(from.tangent, from.tangent_lambda, displacement, options, to);
  StepMeasures measures;
  if (outcome.status != CorrectorStatus::converged) return measures;
  solver.set_tangent(to, outcome, from.negative, from.tangent, from.tangent_lambda);
  measures.converged = true;
  measures.corrections = outcome.factorisations;
  measures.angle = solver.norm().angle(from, to);
  const VectorXd rise = to.y - from.y - step * from.tangent;
  if (!from.perturbed)
    measures.tangent_mismatch = tangent_mismatch(solver.norm().metric(), from, step, rise, to);
  // a correction that the residual does not show is rounding, which shorter steps would not lessen
  if (outcome.first_residual > kRoundingResidual)
    measures.correction = outcome.first_correction / displacement;
  if (attempt.forecast) {
    measures.contact_zones_change = predictor.last_forecast().changes();
    measures.missed_contact = predictor.last_forecast().missed(solver.problem(), to.y);
  }
  to.arc_length = from.arc_length + solver.norm().arc(from, to);
  double& residual = solver.statistics().max_relative_residual;
  residual = std::max(residual, outcome.relative_residual);
  return measures;
}

}  // namespace snapthrough
