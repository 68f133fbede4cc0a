#include "solver/path/continuation.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace snapthrough {

using Eigen::VectorXd;

namespace {

/// A displacement gradient (root mean square) at which a structure has changed its shape for good.
constexpr double kLargeGradient = 0.3;
/// Smallest displacement gradient that one load scale counts for in the path's norm: a structure that hardly
/// moves before it buckles (a straight column) still has its load seen.
constexpr double kSmallGradient = 0.003;
/// Response to a unit load, in units of its Euler load's, that only a mechanism gives.
constexpr double kSingularResponse = 1e13;

/// Smallest factor from one step size to the next.
constexpr double kLeastGrowth = 0.3;
/// First correction, over the step, beyond which the predictor said nothing about where the path goes.
constexpr double kLargestCorrection = 0.5;
/// A turn is a corner when it did not change while the steps shrank by this much, and their chords with them.
constexpr double kCornerShrink = 0.02;
constexpr double kCornerLength = 4.0;

/// Corrections of this size are rounding's where the tangent is nearly singular, however close two points
/// are.
constexpr double kNoise = 1e-6;
/// Size (displacement gradient) of the first, very small step where supports act on one side only.
constexpr double kSmallStart = 1e-7;

/// Cubic Hermite interpolation on [0, d] at tau with end values and slopes.
struct Hermite {
  double a, da, b, db;
  Hermite(double tau, double d) {
    const double t = tau / d;
    a = (1.0 + 2.0 * t) * (1.0 - t) * (1.0 - t);
    b = t * t * (3.0 - 2.0 * t);
    da = d * t * (1.0 - t) * (1.0 - t);
    db = d * t * t * (t - 1.0);
  }
};

}  // namespace

Continuation::Continuation(EquilibriumProblem& problem, ContinuationOptions options)
    : problem_(problem), options_(options) {
  metric_.weights = &problem.metric();
  metric_.load_weight = 1.0;
}

void Continuation::count(const CorrectorOutcome& outcome) {
  statistics_.factorizations += outcome.factorisations;
  statistics_.iterations += outcome.factorisations;
}

bool Continuation::unit_response(const VectorXd& at, bool bonded, VectorXd& response, TangentReport& report) {
  problem_.set_bonded(bonded);
  report = problem_.linearise(at, 0.0, work_.residual);
  problem_.set_bonded(false);
  ++statistics_.factorizations;
  problem_.load(at, 0.0, response);
  problem_.solve(response);
  return response.allFinite() && metric_.norm(response, 0.0) < kSingularResponse;
}

bool Continuation::one_sided_response(double direction, VectorXd& response, TangentReport& report) {
  VectorXd guess;
  const VectorXd zero = VectorXd::Zero(problem_.size());
  const SideCondition load_control;
  CorrectorOptions options = options_.corrector;
  options.max_iterations = 60;
  options.largest_correction = std::numeric_limits<double>::infinity();
  for (const bool bonded : {true, false}) {
    if (!unit_response(zero, bonded, guess, report)) continue;
    const double norm = metric_.norm(guess, 0.0);
    if (norm == 0.0) {
      response = guess;
      return true;
    }
    double lambda = direction * kSmallStart / norm;
    VectorXd y = lambda * guess;
    const auto outcome = correct(problem_, metric_, load_control, kSmallStart, options, y, lambda, work_);
    count(outcome);
    if (outcome.status != CorrectorStatus::converged) continue;
    response = y / lambda;
    report = outcome.tangent;
    return true;
  }
  return false;
}

void Continuation::set_load_scale(const VectorXd& response) {
  const double norm = metric_.norm(response, 0.0);
  load_scale_ = problem_.critical_load_scale(response);
  if (norm > 0.0) load_scale_ = std::min(load_scale_, kLargeGradient / norm);
  if (!std::isfinite(load_scale_)) load_scale_ = 1.0;
  const double gradient = std::clamp(norm * load_scale_, kSmallGradient, kLargeGradient) / load_scale_;
  metric_.load_weight = gradient * gradient;
}

PathPoint Continuation::first_point(const VectorXd& y, const VectorXd& response, double direction,
                                    const TangentReport& report) {
  set_load_scale(response);
  PathPoint point;
  point.y = y;
  const double norm = direction * metric_.norm(response, 1.0);
  point.tangent = response / norm;
  point.tangent_lambda = 1.0 / norm;
  point.negative = report.negative;
  point.log_abs_det = report.log_abs_det;
  return point;
}

std::optional<PathPoint> Continuation::start(double direction) {
  metric_.load_weight = 0.0;
  VectorXd response;
  TangentReport report;
  const VectorXd zero = VectorXd::Zero(problem_.size());
  const bool found = problem_.one_sided() ? one_sided_response(direction, response, report)
                                          : unit_response(zero, false, response, report);
  if (!found) return std::nullopt;
  return first_point(zero, response, direction, report);
}

std::optional<PathPoint> Continuation::start_at(const VectorXd& y, double direction) {
  metric_.load_weight = 0.0;
  VectorXd response;
  TangentReport report;
  if (!unit_response(y, false, response, report)) return std::nullopt;
  return first_point(y, response, direction, report);
}

void Continuation::set_tangent(PathPoint& point, const CorrectorOutcome& outcome, const VectorXd& direction,
                               double direction_lambda) {
  const double norm = metric_.norm(work_.load_response, 1.0);
  const double sign = metric_.inner(work_.load_response, 1.0, direction, direction_lambda) < 0.0 ? -1.0 : 1.0;
  point.tangent = (sign / norm) * work_.load_response;
  point.tangent_lambda = sign / norm;
  point.negative = outcome.tangent.negative;
  point.log_abs_det = outcome.tangent.log_abs_det;
}

Continuation::Trial Continuation::try_step(const PathPoint& from, double step, PathPoint& to) {
  to.y = from.y + step * from.tangent;
  to.lambda = from.lambda + step * from.tangent_lambda;
  side_.normal = metric_.weights->cwiseProduct(from.tangent);
  side_.normal_lambda = metric_.load_weight * from.tangent_lambda;
  const auto outcome = correct(problem_, metric_, side_, step, options_.corrector, to.y, to.lambda, work_);
  count(outcome);
  Trial trial;
  if (outcome.status != CorrectorStatus::converged) return trial;
  set_tangent(to, outcome, from.tangent, from.tangent_lambda);
  const double cosine =
      std::clamp(metric_.inner(to.tangent, to.tangent_lambda, from.tangent, from.tangent_lambda), -1.0, 1.0);
  trial.converged = true;
  trial.angle = std::acos(cosine);
  trial.correction = outcome.first_correction / step;
  trial.growth = std::min({options_.max_growth, options_.target_angle / std::max(trial.angle, 1e-12),
                           options_.target_correction / std::max(trial.correction, 1e-12)});
  trial.growth = std::max(trial.growth, kLeastGrowth);
  trial.length = metric_.norm(to.y - from.y, to.lambda - from.lambda);
  to.arc_length = from.arc_length + trial.length;
  statistics_.max_relative_residual = std::max(statistics_.max_relative_residual, outcome.relative_residual);
  return trial;
}

/// A turn that stays the same while the steps that meet it shrink is a corner of the path itself: a support
/// that starts or stops to act. A jump to another path keeps its distance instead, so `to` must be as near as
/// the step is short.
bool Continuation::is_corner(const Trial& trial, double size) {
  if (!trial.converged || trial.angle <= options_.max_angle || trial.length > kCornerLength * size)
    return false;
  if (std::abs(trial.angle - corner_.angle) > 0.1 * trial.angle) corner_ = {trial.angle, size};
  if (size > kCornerShrink * corner_.first_size) return false;
  corner_ = {};
  return true;
}

StepOutcome Continuation::step(const PathPoint& from, StepSize& step, PathPoint& to) {
  double size = std::min(step.wanted, options_.max_step);
  while (size >= options_.min_step) {
    const Trial trial = try_step(from, size, to);
    const bool smooth = trial.angle <= options_.max_angle && trial.correction <= kLargestCorrection;
    if (trial.converged && (smooth || is_corner(trial, size))) {
      ++statistics_.steps;
      step.taken = size;
      step.wanted = std::min(size * (smooth ? trial.growth : options_.max_growth), options_.max_step);
      return StepOutcome::advanced;
    }
    ++statistics_.rejected_steps;
    size *= std::min(trial.growth, 0.5);
  }
  step.wanted = size;
  return StepOutcome::step_underflow;
}

void Continuation::limit_steps(const StepOptions& steps, double load_rate) {
  if (steps.min) options_.min_step = *steps.min * load_scale_ / load_rate;
  if (steps.max) options_.max_step = *steps.max * load_scale_ / load_rate;
}

void Continuation::reject(StepSize& step) {
  --statistics_.steps;
  ++statistics_.rejected_steps;
  step.wanted = 0.3 * step.taken;
}

double Continuation::distance(const PathPoint& a, const PathPoint& b) const {
  return metric_.norm(b.y - a.y, b.lambda - a.lambda);
}

double Continuation::distance_along(const Chord& chord, const PathPoint& a, const PathPoint& b) const {
  return metric_.inner(b.y - a.y, b.lambda - a.lambda, chord.y, chord.lambda);
}

Chord Continuation::chord(const PathPoint& a, const PathPoint& b) const {
  const double length = distance(a, b);
  return {(b.y - a.y) / length, (b.lambda - a.lambda) / length};
}

double Continuation::load_rate(const Chord& chord, const PathPoint& at) const {
  return at.tangent_lambda / metric_.inner(at.tangent, at.tangent_lambda, chord.y, chord.lambda);
}

std::optional<PathPoint> Continuation::between(const Chord& chord, const PathPoint& lo, const PathPoint& hi,
                                               double share) {
  constexpr double kSmoothRate =
      0.3;  // below it a tangent is a singular point's, or turns away from the chord
  const double length = distance_along(chord, lo, hi);
  const double rate_lo = metric_.inner(lo.tangent, lo.tangent_lambda, chord.y, chord.lambda);
  const double rate_hi = metric_.inner(hi.tangent, hi.tangent_lambda, chord.y, chord.lambda);
  PathPoint point;
  if (rate_lo > kSmoothRate && rate_hi > kSmoothRate) {
    const Hermite h(share * length, length);
    point.y = h.a * lo.y + (h.da / rate_lo) * lo.tangent + h.b * hi.y + (h.db / rate_hi) * hi.tangent;
    point.lambda = h.a * lo.lambda + h.da / rate_lo * lo.tangent_lambda + h.b * hi.lambda +
                   h.db / rate_hi * hi.tangent_lambda;
  } else {
    point.y = (1.0 - share) * lo.y + share * hi.y;
    point.lambda = (1.0 - share) * lo.lambda + share * hi.lambda;
  }
  side_.normal = metric_.weights->cwiseProduct(chord.y);
  side_.normal_lambda = metric_.load_weight * chord.lambda;
  const double scale = std::max(distance(lo, hi), kNoise);
  const auto outcome =
      correct(problem_, metric_, side_, scale, options_.corrector, point.y, point.lambda, work_);
  count(outcome);
  if (outcome.status != CorrectorStatus::converged) return std::nullopt;
  set_tangent(point, outcome, chord.y, chord.lambda);
  point.arc_length = (1.0 - share) * lo.arc_length + share * hi.arc_length;
  return point;
}

}  // namespace snapthrough
