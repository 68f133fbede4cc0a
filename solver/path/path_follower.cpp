#include "solver/path/path_follower.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "solver/path/kink.h"
#include "solver/path/step_trial.h"

namespace snapthrough {
namespace {

/// Numbers of the step control beside StepLimits; ratios without unit.
struct FollowerFactors {
  static constexpr double decay = 0.7;       ///< decay of the remembered full step, per accepted step
  static constexpr double taken_back = 0.3;  ///< next size over that of a step which was taken back
  /// Share of the load in a point's norm, over that of the displacement, at which the load is weighed anew.
  static constexpr double load_dominates = 3.0;
};

}  // namespace

PathFollower::PathFollower(EquilibriumProblem& problem, const PathOptions& options)
    : solver_(problem, options.corrector), limits_(options.step) {}

StepOutcome PathFollower::step(const PathPoint& from, StepSize& step, PathPoint& to) {
  to.context = from.context;
  to.perturbed = false;
  solver_.problem().set_context(from.context);
  const bool one_sided = problem().traits().one_sided;
  const double arc_rate = norm().arc_per_step(from);
  const double largest = limits_.max_step / arc_rate;
  double size = std::min(step.wanted, largest);
  const double first_size = size;
  if (last_full_step_ == 0.0) last_full_step_ = size;
  if (one_sided) predictor_.begin_forecast(problem(), from);
  while (size * arc_rate >= limits_.min_step) {
    const StepSizes sizes{size, last_full_step_};
    const bool forecast = one_sided && size >= limits_.kink_share * last_full_step_;
    const StepMeasures measures = try_step(solver_, predictor_, limits_, {from, sizes, forecast}, to);
    predictor_.forget_curvature();
    const StepDecision decision = judge_step(measures, limits_, sizes, problem().traits().may_kink());
    if (decision.verdict == StepVerdict::accepted) {
      auto& counts = solver_.statistics().corrections;
      ++counts[std::min<std::size_t>(measures.corrections, counts.size() - 1)];
      took_full_step_ = size == first_size;
      if (took_full_step_) last_full_step_ = std::max(size, FollowerFactors::decay * last_full_step_);
      const double growth = size < first_size ? std::min(decision.factor, 1.0) : decision.factor;
      return complete(StepOutcome::advanced, {size, std::min(size * growth, largest)}, step);
    }
    ++solver_.statistics().rejected_steps;
    size *= decision.factor;
    if (decision.verdict == StepVerdict::kink &&
        step_around_kink(solver_, limits_, from, {size, last_full_step_}, to))
      return complete(StepOutcome::kinked, {size, std::min(size * limits_.max_growth, largest)}, step);
  }
  step.wanted = size;
  return StepOutcome::step_underflow;
}

/// Counts an accepted step and sets its size and the next one's.
StepOutcome PathFollower::complete(StepOutcome outcome, const StepSize& size, StepSize& step) {
  ++solver_.statistics().steps;
  step = size;
  return outcome;
}

void PathFollower::reject(StepSize& step) {
  --solver_.statistics().steps;
  ++solver_.statistics().rejected_steps;
  step.wanted = FollowerFactors::taken_back * step.taken;
}

void PathFollower::remember(const PathPoint& before, const PathPoint& from) {
  predictor_.remember(norm(), before, from, took_full_step_ || !problem().traits().one_sided);
}

PathPoint PathFollower::last_point_before_kink(const PathPoint& from, double size) {
  return snapthrough::last_point_before_kink(solver_, limits_, from, {size, last_full_step_});
}

void PathFollower::limit_steps(const StepOptions& steps, double load_rate) {
  if (steps.min) limits_.min_step = *steps.min * norm().load_scale() / load_rate;
  if (steps.max) limits_.max_step = *steps.max * norm().load_scale() / load_rate;
}

void PathFollower::reweigh_load(bool to_limit, PathPoint& point, StepSize& step) {
  const PathMetric& metric = norm().metric();
  const bool stuck = step.wanted < limits_.kink_share * last_full_step_;
  if (!to_limit && !stuck && !problem().traits().one_sided) return;
  const double loaded = std::sqrt(metric.load_weight) * std::abs(point.lambda);
  const double moved = std::max(metric.norm(point.y, 0.0), stuck ? Gradients::tiny : Gradients::small);
  if (loaded <= FollowerFactors::load_dominates * moved) return;
  norm().reweigh(moved / loaded);
  const double length = metric.norm(point.tangent, point.tangent_lambda);
  point.tangent /= length;
  point.tangent_lambda /= length;
  step.wanted *= length;
  last_full_step_ *= length;
  predictor_.rescale(length);
}

}  // namespace snapthrough
