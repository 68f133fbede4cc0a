#include "solver/path/continuation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include "solver/numeric/cubic.h"

namespace snapthrough {

using Eigen::VectorXd;

namespace {

/// A displacement gradient (root mean square) at which a structure has changed its shape for good.
constexpr double kLargeGradient = 0.3;
/// Smallest displacement gradient that one load scale counts for in the path's norm: a structure that hardly
/// moves before it buckles (a straight column) still has its load seen.
constexpr double kSmallGradient = 0.003;
/// Smallest factor from one step size to the next. Below this share of the last size that was accepted at
/// once a step may take all corrections it needs; a larger one is shortened first, which costs less.
constexpr double kLeastGrowth = 0.3;
/// First correction, over the step, beyond which the predictor said nothing about where the path goes.
constexpr double kLargestCorrection = 0.5;
/// Share of a step's displacement that may lie outside what the rates at its ends give: steps of smooth paths
/// stay below 0.15, those that end on another path or pass over a snap are at 0.5 and more.
constexpr double kLargestUnexplained = 0.4;
/// Contact that a step's forecast should miss, in elements, and may miss: it is off by the third power of the
/// step's length. A step that misses more may end on another path.
constexpr double kContactMissed = 0.5;
constexpr double kMostContactMissed = 2.0;
/// What a step that was never shortened much is given up at, to try a shorter one, which costs less.
constexpr double kLargestGrowth = 2.0;
constexpr int kMostStalled = 2;
/// Share of the last size that was accepted at once to which steps must have shrunk before a turn is looked
/// for.
constexpr double kKinkShrink = 1e-3;

/// A path's load bound over the scale of the member that buckles first, and of that which does so last.
constexpr double kAboveWeakest = 1e4;
constexpr double kAboveStrongest = 30.0;

/// What an accepted step leaves of the memory of larger ones.
constexpr double kForget = 0.7;

/// Displacement gradient at which a structure has hardly moved: that of the first, very small step where
/// supports act on one side only; what two points lie apart at least, where corrections are rounding's
/// because the tangent is nearly singular; and what the load is weighed against at least.
constexpr double kSmallDisplacement = 1e-7;

/// Share of the load in the path's norm, over that of the displacement, at which the load is weighed anew.
constexpr double kLoadDominates = 3.0;
/// Of a displacement: what the tangent at its end may miss it by where contact changes in proportion to it.
constexpr double kProportional = 0.1;
/// Corrections downhill in the energy.
constexpr int kIterations = 60;

/// Sign of det [J, -load; tangent]: parity of the negative eigenvalues times the sense of the load. It is the
/// same on both sides of a kink, because both sides' tangents agree in the plane that separates them.
bool keeps_orientation(const PathPoint& from, const PathPoint& to) {
  return (from.negative % 2 == to.negative % 2) == ((from.tangent_lambda > 0.0) == (to.tangent_lambda > 0.0));
}

void reverse(PathPoint& point) {
  point.tangent = -point.tangent;
  point.tangent_lambda = -point.tangent_lambda;
}

/// A load that is small by what it moves and, since a thin column hardly moves before it buckles, by what the
/// load counts for in the path's norm at least.
/// @param response size of the displacement by unit load
double small_load(double response, double load_scale) {
  return kSmallDisplacement * std::min(1.0 / response, load_scale / kSmallGradient);
}

/// Negative eigenvalues next to a point that has `before` of them. Where the tangent is not symmetric, real
/// eigenvalues pass zero where the determinant does; its symmetric part may lose its sign elsewhere, and only
/// tells which way a change goes.
int count_next_to(int before, const TangentReport& report) {
  if (!report.parity_only || report.negative == 0) return report.negative;
  if (report.negative % 2 == before % 2) return before;
  return report.negative > before ? before + 1 : before - 1;
}

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

bool Continuation::unit_response(const VectorXd& at, double lambda, Regime::Contact contact,
                                 VectorXd& response, TangentReport& report) {
  Regime regime;
  regime.contact = contact;
  report = problem_.linearise(at, lambda, work_.residual, regime);
  ++statistics_.factorizations;
  problem_.load(at, lambda, response);
  problem_.solve(response);
  return response.allFinite() && metric_.norm(response, 0.0) < kSingularResponse;
}

/// The start of a path on which supports may act on one side only: what they do under a very small load.
///
/// How small is not known beforehand: a structure that leaves stiff supports moves far more than one that is
/// glued to them. So the load falls until the displacement is small, or no longer falls with it: then the
/// structure moves until gaps close, and the path begins where it comes to rest.
std::optional<PathPoint> Continuation::one_sided_start(double direction) {
  constexpr double kLargestFall = 1e-3;
  VectorXd response;
  TangentReport report;
  const VectorXd zero = VectorXd::Zero(problem_.size());
  if (!unit_response(zero, 0.0, Regime::Contact::bilateral, response, report)) return std::nullopt;
  const double norm = metric_.norm(response, 0.0);
  if (norm == 0.0) return first_point(zero, 0.0, response, direction, report);
  double lambda = direction * std::min(small_load(norm, problem_.critical_load_scale(response)),
                                       options_.largest_first_load);
  double last = std::numeric_limits<double>::infinity();
  VectorXd guess;
  PathPoint rest;  // at the load before, which holds the structure better than this one
  const double first = lambda;
  const double least = kRoundingResidual * std::abs(lambda);
  while (std::abs(lambda) > least) {
    const auto state = find_contact_state(problem_, metric_, lambda, work_, statistics_.factorizations,
                                          guess.size() > 0 ? &guess : nullptr);
    const double size = state ? metric_.norm(state->y, 0.0) : 0.0;
    if (state && size <= 10.0 * kSmallDisplacement) {
      if (is_loose()) return std::nullopt;
      loosening_ = size / std::abs(lambda * norm);
      return first_point(zero, 0.0, state->y / lambda, direction, state->tangent);
    }
    if (state && size > 0.5 * last) {
      if (auto start = start_at_rest(std::move(rest), direction)) return start;
      break;
    }
    const double fall = state ? std::max(kSmallDisplacement / size, kLargestFall) : 0.01;
    if (state) {
      last = size;
      rest.y = state->y;
      rest.lambda = lambda;
      guess = fall * state->y;
    }
    lambda *= fall;
  }
  return near_start(first, direction);
}

CorrectorOutcome Continuation::correct_downhill(double scale, int iterations, PathPoint& at) {
  const CorrectorOptions options = downhill(options_.corrector, iterations);
  const auto outcome = correct(problem_, metric_, {}, scale, options, at.y, at.lambda, work_);
  count(outcome);
  return outcome;
}

void Continuation::set_load_scale(const VectorXd& response) {
  const double norm = metric_.norm(response, 0.0);
  load_scale_ = problem_.critical_load_scale(response);
  if (norm > 0.0) load_scale_ = std::min(load_scale_, kLargeGradient / norm);
  if (!std::isfinite(load_scale_)) load_scale_ = 1.0;
  load_bound_ =
      std::max(kAboveWeakest * load_scale_, kAboveStrongest * problem_.largest_critical_load_scale(response));
  const double gradient = std::clamp(norm * load_scale_, kSmallGradient, kLargeGradient) / load_scale_;
  metric_.load_weight = gradient * gradient;
  arc_weight_ = metric_.load_weight;
}

PathPoint Continuation::first_point(const VectorXd& y, double lambda, const VectorXd& response,
                                    double direction, const TangentReport& report) {
  set_load_scale(response);
  PathPoint point;
  point.y = y;
  point.lambda = lambda;
  const double norm = direction * metric_.norm(response, 1.0);
  point.tangent = response / norm;
  point.tangent_lambda = 1.0 / norm;
  point.negative = report.negative;
  point.log_abs_det = report.log_abs_det;
  symmetric_ = !report.parity_only;
  return point;
}

std::optional<PathPoint> Continuation::start(double direction) {
  const SharedHolds soft = held_softly(problem_);
  if (!problem_.one_sided()) {
    const SharedHolds all =
        soft ? std::make_shared<const Holds>(Holds{soft->motions, soft->at, 1.0}) : nullptr;
    return start_at(VectorXd::Zero(problem_.size()), direction, all);
  }
  metric_.load_weight = 0.0;
  SoftlyHeld held;
  PathPoint loaded;
  if (soft) {
    auto start = softly_held_start(soft, direction, held, loaded);
    if (held.resisted) return start;
  }
  problem_.set_holds(held.neutral);
  auto start = one_sided_start(direction);
  // a motion that only the loads stiffen leaves the glued structure singular
  if (!start && loaded.y.size() > 0) start = start_at_rest(std::move(loaded), direction);
  if (start) start->holds = held.neutral;
  return start;
}

/// The start with all free motions held softly: then there is one whatever supports of one side do, and it
/// shows which of the motions they resist.
/// @param loaded the softly held structure's state under a small load; set where there is one
std::optional<PathPoint> Continuation::softly_held_start(const SharedHolds& soft, double direction,
                                                         SoftlyHeld& held, PathPoint& loaded) {
  problem_.set_holds(soft);
  auto start = one_sided_start(direction);
  if (start) {
    const double moved = metric_.norm(start->tangent, 0.0);
    const double rate = std::abs(start->tangent_lambda);
    const double size = small_load(moved / rate, load_scale_) / rate;
    loaded.y = start->y + size * start->tangent;
    loaded.lambda = start->lambda + size * start->tangent_lambda;
    held = softly_held(problem_, soft, loaded.y, loaded.lambda);
    ++statistics_.factorizations;
  }
  problem_.set_holds(nullptr);
  loose_motion_.resize(0);
  far_start_.reset();
  return start;
}

/// Stiffness by unit load below which nothing resists a motion.
constexpr double kNeutral = 1e-6;

NeutralBounds Continuation::neutral_bounds(const Holds& holds, const PathPoint& at) {
  const double actions = std::max(1.0, std::abs(at.lambda));  // constant ones may be as large
  return {kNeutral * actions, no_force(problem_, holds, at.y, at.lambda, actions)};
}

bool Continuation::may_be_neutral(const PathPoint& from, const PathPoint& to) const {
  // a motion that loses its stiffness takes the determinant down by as much
  return problem_.free_motions().cols() > 0 && to.log_abs_det < from.log_abs_det + std::log(kNeutral);
}

bool Continuation::correct_at_load(double scale, PathPoint& at) {
  problem_.set_holds(at.holds);
  const auto outcome = correct(problem_, metric_, {}, scale, options_.corrector, at.y, at.lambda, work_);
  count(outcome);
  return outcome.status == CorrectorStatus::converged;
}

bool Continuation::hold_neutral(const PathPoint& from, PathPoint& at) {
  const Eigen::MatrixXd& motions = problem_.free_motions();
  const double scale = std::max(distance(from, at), kRoundingResidual);
  const auto settle_with = [&](const SharedHolds& holds, PathPoint& point) {
    point.holds = holds;
    return correct_at_load(scale, point);
  };
  // where the structure is free, supports that it leaves may still touch it on one side, pressed by rounding
  const auto all =
      std::make_shared<const Holds>(Holds{motions, motions.transpose() * from.y.head(motions.rows()), 1.0});
  PathPoint held = at;
  if (!settle_with(all, held)) return false;
  held.holds = neutral_part(problem_, all, held.y, held.lambda, neutral_bounds(*all, held));
  ++statistics_.factorizations;
  const Eigen::Index before = from.holds ? from.holds->motions.cols() : 0;
  if (!held.holds || held.holds->motions.cols() <= before || !settle_with(held.holds, held)) return false;
  VectorXd response;
  TangentReport report;
  if (!unit_response(held.y, held.lambda, Regime::Contact::unilateral, response, report)) return false;
  const double norm = metric_.norm(response, 1.0);
  const double sign = metric_.inner(response, 1.0, at.tangent, at.tangent_lambda) < 0.0 ? -1.0 : 1.0;
  held.tangent = (sign / norm) * response;
  held.tangent_lambda = sign / norm;
  held.negative = report.negative;
  held.log_abs_det = report.log_abs_det;
  at = std::move(held);
  return true;
}

bool Continuation::release(PathPoint& from, const PathPoint& to) {
  if (!from.holds) return false;
  const NeutralBounds bounds = neutral_bounds(*from.holds, to);
  ++statistics_.factorizations;
  const MotionStiffness held = motion_stiffness(problem_, from.holds, to.y, to.lambda);
  std::vector<Eigen::Index> idle;
  for (Eigen::Index i = 0; i < held.stiffness.size(); ++i) {
    if (std::abs(held.stiffness[i]) <= bounds.stiffness && std::abs(held.force[i]) <= bounds.force)
      idle.push_back(i);
    else if (from.arc_length == 0.0 && held.stiffness[i] < 0.0)
      ++from.negative;  // under the smallest load already
  }
  if (static_cast<Eigen::Index>(idle.size()) == held.stiffness.size()) return false;
  SharedHolds rest;
  if (!idle.empty()) {
    const Eigen::MatrixXd motions = held.motions(Eigen::all, idle);
    rest =
        std::make_shared<const Holds>(Holds{motions, motions.transpose() * from.y.head(motions.rows()), 1.0});
  }
  from.holds = rest;
  return true;
}

/// Where supports touch without pressure the tangent at the start takes them as absent. The direction is that
/// of the equilibrium under a little load, if another.
void Continuation::turn_where_supports_touch(PathPoint& start, double direction, const VectorXd& response) {
  const double norm = metric_.norm(response, 0.0);
  PathPoint next;
  next.lambda = direction * small_load(norm, load_scale_);
  next.y = start.y + next.lambda * response;
  const auto outcome = correct_downhill(std::abs(next.lambda) * norm, kIterations, next);
  if (outcome.status != CorrectorStatus::converged) return;
  const VectorXd rate = (next.y - start.y) / next.lambda;
  if (metric_.norm(rate - response, 0.0) > kProportional * metric_.norm(rate, 1.0))
    start = first_point(start.y, 0.0, rate, direction, outcome.tangent);
}

void Continuation::set_tangent(PathPoint& point, int before, const CorrectorOutcome& outcome,
                               const VectorXd& direction, double direction_lambda) {
  const double norm = metric_.norm(work_.load_response, 1.0);
  const double sign = metric_.inner(work_.load_response, 1.0, direction, direction_lambda) < 0.0 ? -1.0 : 1.0;
  point.tangent = (sign / norm) * work_.load_response;
  point.tangent_lambda = sign / norm;
  point.negative = count_next_to(before, outcome.tangent);
  point.log_abs_det = outcome.tangent.log_abs_det;
  symmetric_ = !outcome.tangent.parity_only;
}

void Continuation::extrapolate(const PathPoint& before, const PathPoint& from) {
  bend_ = {};
  const double chord = distance(before, from);
  if (problem_.one_sided()) {
    forecast_.follow(chord);
    // where contact changes the cubic says less than the tangent
    if (!easy_) return;
  }
  if (!(chord > 0.0)) return;
  const double half = 0.5 * angle_between(before, from);
  const double d = half > 0.0 ? chord * half / std::sin(half) : chord;
  const double rise_lambda = from.lambda - before.lambda;
  bend_.y2 = second_derivative_at_end(from.y - before.y, before.tangent, from.tangent, d);
  bend_.y3 = third_derivative(from.y - before.y, before.tangent, from.tangent, d);
  bend_.lambda2 = second_derivative_at_end(rise_lambda, before.tangent_lambda, from.tangent_lambda, d);
  bend_.lambda3 = third_derivative(rise_lambda, before.tangent_lambda, from.tangent_lambda, d);
}

void Continuation::predict(const PathPoint& from, double step, PathPoint& to) const {
  to.y = from.y + step * from.tangent;
  to.lambda = from.lambda + step * from.tangent_lambda;
  if (bend_.y2.size() == 0) return;
  to.y += (0.5 * step * step) * bend_.y2 + (step * step * step / 6.0) * bend_.y3;
  to.lambda += 0.5 * step * step * bend_.lambda2 + step * step * step / 6.0 * bend_.lambda3;
}

/// Corrects `to` from the predictor under the side condition at hand.
CorrectorOutcome Continuation::correct_step(const PathPoint& from, double step, double displacement,
                                            PathPoint& to, ContactForecast* forecast) {
  CorrectorOptions options = options_.corrector;
  // supports act on a structure that hardly moves under much load, too
  if (problem_.one_sided())
    options.displacement = std::max(step * metric_.norm(from.tangent, 0.0), kRoundingResidual);
  if (step >= kLeastGrowth * easy_size_) {
    options.largest_first = kLargestCorrection;
    options.largest_growth = kLargestGrowth;
    options.most_stalled = std::min(options.most_stalled, kMostStalled);
  }
  predict(from, step, to);
  if (forecast != nullptr) options.first_contact = forecast->at(problem_, step, to.y);
  const auto outcome = correct(problem_, metric_, side_, displacement, options, to.y, to.lambda, work_);
  count(outcome);
  return outcome;
}

double Continuation::unexplained(const PathPoint& from, double step, const VectorXd& rise,
                                 const PathPoint& to) const {
  const double cosine = metric_.inner(from.tangent, from.tangent_lambda, to.tangent, to.tangent_lambda);
  const VectorXd turn = to.tangent - cosine * from.tangent;  // in the plane that `to` was corrected in
  const double along = metric_.inner(rise, 0.0, turn, 0.0);
  const double turned = metric_.inner(turn, 0.0, turn, 0.0);
  const double share = along > 0.0 ? std::min(along / turned, step / std::abs(cosine)) : 0.0;
  return metric_.norm(rise - share * turn, 0.0) /
         std::max(metric_.norm(to.y - from.y, 0.0), kSmallDisplacement);
}

Continuation::Trial Continuation::try_step(const PathPoint& from, double step, PathPoint& to,
                                           ContactForecast* forecast) {
  side_.normal = metric_.weights->cwiseProduct(from.tangent);
  side_.normal_lambda = metric_.load_weight * from.tangent_lambda;
  // where the load dwarfs the displacements, a step may be long while the structure hardly moves
  const double displacement = std::min(step, kLargeGradient);
  const auto outcome = correct_step(from, step, displacement, to, forecast);
  Trial trial;
  if (outcome.status != CorrectorStatus::converged) return trial;
  set_tangent(to, from.negative, outcome, from.tangent, from.tangent_lambda);
  trial.converged = true;
  trial.corrections = outcome.factorisations;
  trial.angle = angle_between(from, to);
  const VectorXd rise = to.y - from.y - step * from.tangent;
  if (!from.perturbed) trial.unexplained = unexplained(from, step, rise, to);
  // what the residual does not show is rounding, which shorter steps would not lessen
  if (outcome.first_residual > kRoundingResidual) trial.correction = outcome.first_correction / displacement;
  const double room = std::min(options_.target_angle / std::max(trial.angle, 1e-12),
                               options_.target_correction / std::max(trial.correction, 1e-12));
  trial.growth = std::clamp(room, kLeastGrowth, options_.max_growth);
  trial.largest_angle = options_.max_angle;
  if (forecast != nullptr) {
    // where a zone ends the path may turn back, and another be near
    if (forecast->changes()) trial.largest_angle = options_.target_angle;
    trial.missed = forecast->missed(problem_, to.y);
    trial.growth = std::max(
        kLeastGrowth, std::min(trial.growth, std::cbrt(kContactMissed / std::max(trial.missed, 1e-12))));
  }
  to.arc_length = from.arc_length + arc(from, to);
  statistics_.max_relative_residual = std::max(statistics_.max_relative_residual, outcome.relative_residual);
  return trial;
}

bool Continuation::is_smooth(const Trial& trial) const {
  return trial.converged && trial.angle <= trial.largest_angle && trial.correction <= kLargestCorrection &&
         trial.unexplained <= kLargestUnexplained && trial.missed <= kMostContactMissed;
}

/// A point beyond a kink that is less than `depth` from `from`, with the path's direction there: that of
/// the supports which act beyond, in the sense that keeps the orientation.
std::optional<PathPoint> Continuation::beyond_kink(const PathPoint& from, double depth) {
  PathPoint beyond = from;
  beyond.y += depth * from.tangent;
  beyond.lambda += depth * from.tangent_lambda;
  VectorXd response;
  TangentReport report;
  if (!unit_response(beyond.y, beyond.lambda, Regime::Contact::unilateral, response, report))
    return std::nullopt;
  beyond.negative = count_next_to(from.negative, report);
  const double norm = metric_.norm(response, 1.0);
  beyond.tangent = response / norm;
  beyond.tangent_lambda = 1.0 / norm;
  if (!keeps_orientation(from, beyond)) reverse(beyond);
  return beyond;
}

/// Takes the path round a kink that is within `size` of `from`, where it goes back against its tangent or
/// so nearly across it that no step along the tangent meets it again. How far beyond it supports show what
/// they do is not known: stiff ones that begin to act are as good as absent where they hardly touch.
///
/// Where the inertia changes, the load turns back if one support's change is the cause. Where several change
/// at once, the cause may lie beside the path, as at a bifurcation; then the load goes on.
bool Continuation::step_round_kink(const PathPoint& from, double size, PathPoint& to) {
  constexpr std::array<double, 4> kDepths{1e3, 1e2, 1e1, 1e0};
  constexpr double kBeyond = 10.0;  // the step over the distance to the kink
  for (const double share : kDepths) {
    auto beyond = beyond_kink(from, share * size);
    if (!beyond) continue;
    const double step = kBeyond * share * size;
    if (step_from_beyond(from, *beyond, step, to)) return true;
    if ((from.tangent_lambda > 0.0) == (beyond->tangent_lambda > 0.0)) continue;
    reverse(*beyond);
    if (step_from_beyond(from, *beyond, step, to)) return true;
  }
  return false;
}

/// The point of the path one step from a point beyond a kink: by Newton's method or, where it is stable,
/// downhill in the energy.
bool Continuation::step_from_beyond(const PathPoint& from, const PathPoint& beyond, double step,
                                    PathPoint& to) {
  const Trial trial = try_step(beyond, step, to);
  to.arc_length = from.arc_length + arc(from, to);
  if (is_smooth(trial) && to.negative == beyond.negative) return true;
  return beyond.negative == 0 && settle_beyond(from, beyond, step, to);
}

/// From a stable point on to the equilibrium at the load beyond, downhill in the energy: where supports touch
/// without pressure, any increment of the load, however small, changes where they act, in proportion to
/// itself. The last tangent says nothing there, and Newton's method cycles between contact patterns at every
/// size.
/// @param beyond a point with the direction in which the load and the guess lie
bool Continuation::settle_beyond(const PathPoint& from, const PathPoint& beyond, double size, PathPoint& to) {
  if (beyond.tangent_lambda == 0.0) return false;
  to.y = beyond.y + size * beyond.tangent;
  to.lambda = beyond.lambda + size * beyond.tangent_lambda;
  auto outcome = correct_downhill(size, kIterations, to);
  if (outcome.status != CorrectorStatus::converged && from.arc_length == 0.0) {
    // where constant actions leave parts unloaded that lie on stiff supports: as at the start of a path
    const auto state =
        find_contact_state(problem_, metric_, to.lambda, work_, statistics_.factorizations, &from.y);
    if (!state) return false;
    to.y = state->y;
    outcome = correct_downhill(size, kIterations, to);
  }
  if (outcome.status != CorrectorStatus::converged || outcome.tangent.negative > 0) return false;
  const VectorXd displacement = to.y - from.y;
  const double dlambda = to.lambda - from.lambda;
  set_tangent(to, beyond.negative, outcome, displacement, dlambda);
  to.arc_length = from.arc_length + arc(from, to);
  const VectorXd missed = displacement - (dlambda / to.tangent_lambda) * to.tangent;
  return metric_.norm(missed, 0.0) <= kProportional * metric_.norm(displacement, dlambda) &&
         (to.tangent_lambda > 0.0) == (dlambda > 0.0);
}

void Continuation::begin_forecast(const PathPoint& from) {
  if (from.arc_length > 0.0) return forecast_.begin(problem_, from.y, from.tangent);
  // where everything touches from nothing, contact is that of the first small load
  forecast_.begin(problem_, from.y + kSmallDisplacement * from.tangent, from.tangent);
}

StepOutcome Continuation::step(const PathPoint& from, StepSize& step, PathPoint& to) {
  problem_.set_holds(from.holds);
  to.holds = from.holds;
  to.perturbed = false;
  const double arc_rate = arc_per_step(from);
  const double largest = options_.max_step / arc_rate;
  double size = std::min(step.wanted, largest);
  const double first_size = size;
  if (easy_size_ == 0.0) easy_size_ = size;
  if (problem_.one_sided()) begin_forecast(from);
  while (size * arc_rate >= options_.min_step) {
    const bool forecast = problem_.one_sided() && size >= kKinkShrink * easy_size_;
    const Trial trial = try_step(from, size, to, forecast ? &forecast_ : nullptr);
    bend_ = {};
    if (is_smooth(trial)) {
      ++statistics_.steps;
      ++statistics_.corrections[std::min<std::size_t>(trial.corrections, statistics_.corrections.size() - 1)];
      easy_ = size == first_size;
      if (easy_) easy_size_ = std::max(size, kForget * easy_size_);
      step.taken = size;
      const double growth = size < first_size ? std::min(trial.growth, 1.0) : trial.growth;
      step.wanted = std::min(size * growth, largest);
      return StepOutcome::advanced;
    }
    ++statistics_.rejected_steps;
    size *= std::min(trial.growth, 0.5);
    // a smooth turn that a shorter step will follow is no kink, however small
    const bool smooth = trial.converged && trial.angle <= options_.max_angle;
    if (problem_.one_sided() && !smooth && size < kKinkShrink * easy_size_ &&
        step_round_kink(from, size, to)) {
      ++statistics_.steps;
      step.taken = size;
      step.wanted = std::min(size * options_.max_growth, largest);
      return StepOutcome::kinked;
    }
  }
  step.wanted = size;
  return StepOutcome::step_underflow;
}

PathPoint Continuation::last_before_kink(const PathPoint& from, double size) {
  problem_.set_holds(from.holds);
  PathPoint last = from;
  PathPoint probe;
  probe.holds = from.holds;
  const double least = options_.min_step / arc_per_step(from);
  while ((size *= 0.5) >= least) {
    const Trial trial = try_step(last, size, probe);
    if (is_smooth(trial) && probe.negative == from.negative) std::swap(last, probe);
  }
  return last;
}

namespace {

/// The softest motions with the factors at hand; null where there are none.
/// @param negative eigenvalues there
/// @param start modes of a neighbouring point; null: there are none
std::shared_ptr<SoftModes> modes_at_hand(EquilibriumProblem& problem, int negative,
                                         const SharedModes& start) {
  constexpr int kAhead = 2;  // motions that may lose their stiffness next, behind those that have lost it
  constexpr int kMost = 8;
  constexpr int kFromAfar = 3;  // iterations from drawn motions
  const int count = std::min(kAhead + negative, kMost);
  const Eigen::MatrixXd none;
  auto modes = std::make_shared<SoftModes>(start ? soft_modes(problem, start->motions, count, 1)
                                                 : soft_modes(problem, none, count, kFromAfar));
  return modes->count() == 0 ? nullptr : modes;
}

}  // namespace

void Continuation::find_modes(PathPoint& at, const SharedModes& start) {
  at.modes = nullptr;
  if (!symmetric_) return;
  auto modes = modes_at_hand(problem_, at.negative, start);
  if (!modes) return;
  const Eigen::MatrixXd change =
      tangent_change(problem_, at.y, at.lambda, {at.tangent, at.tangent_lambda}, modes->motions);
  modes->rate.resize(modes->count());
  for (Eigen::Index i = 0; i < modes->count(); ++i)
    modes->rate[i] = problem_.work(change.col(i), modes->motions.col(i));
  at.modes = std::move(modes);
}

void Continuation::find_first_modes(PathPoint& start) {
  problem_.set_holds(start.holds);
  problem_.linearise(start.y + kSmallDisplacement * start.tangent,
                     start.lambda + kSmallDisplacement * start.tangent_lambda, work_.residual);
  ++statistics_.factorizations;
  if (!problem_.one_sided())
    find_modes(start, nullptr);
  else if (symmetric_)
    start.modes = modes_at_hand(problem_, start.negative, nullptr);
}

int Continuation::negative_at(const PathPoint& at) {
  problem_.set_holds(at.holds);
  ++statistics_.factorizations;
  return count_next_to(at.negative, problem_.linearise(at.y, at.lambda, work_.residual));
}

void Continuation::limit_steps(const StepOptions& steps, double load_rate) {
  if (steps.min) options_.min_step = *steps.min * load_scale_ / load_rate;
  if (steps.max) options_.max_step = *steps.max * load_scale_ / load_rate;
}

void Continuation::settle(const PathPoint& from, PathPoint& point) {
  CorrectorOptions options = options_.corrector;
  if (options.tangent_tolerance == 0.0 && !problem_.one_sided()) return;
  problem_.set_holds(point.holds);
  options.tangent_tolerance = 0.0;
  side_.normal = metric_.weights->cwiseProduct(point.tangent);
  side_.normal_lambda = metric_.load_weight * point.tangent_lambda;
  PathPoint settled = point;
  const double scale = std::min(distance(from, point), kLargeGradient);
  const auto outcome = correct(problem_, metric_, side_, scale, options, settled.y, settled.lambda, work_);
  count(outcome);
  if (outcome.status != CorrectorStatus::converged) return;
  set_tangent(settled, from.negative, outcome, point.tangent, point.tangent_lambda);
  point = std::move(settled);
}

void Continuation::weigh_load(bool to_limit, PathPoint& at, StepSize& step) {
  const bool stuck = step.wanted < kKinkShrink * easy_size_;
  if (!to_limit && !stuck && !problem_.one_sided()) return;
  const double loaded = std::sqrt(metric_.load_weight) * std::abs(at.lambda);
  const double moved = std::max(metric_.norm(at.y, 0.0), stuck ? kSmallDisplacement : kSmallGradient);
  if (loaded <= kLoadDominates * moved) return;
  metric_.load_weight *= (moved / loaded) * (moved / loaded);
  const double length = metric_.norm(at.tangent, at.tangent_lambda);
  at.tangent /= length;
  at.tangent_lambda /= length;
  step.wanted *= length;
  easy_size_ *= length;
  forecast_.scale(length);
  bend_ = {};
}

void Continuation::reject(StepSize& step) {
  --statistics_.steps;
  ++statistics_.rejected_steps;
  step.wanted = 0.3 * step.taken;
}

double Continuation::angle_between(const PathPoint& a, const PathPoint& b) const {
  return std::acos(
      std::clamp(metric_.inner(a.tangent, a.tangent_lambda, b.tangent, b.tangent_lambda), -1.0, 1.0));
}

double Continuation::arc(const PathPoint& a, const PathPoint& b) const {
  return PathMetric{metric_.weights, arc_weight_}.norm(b.y - a.y, b.lambda - a.lambda);
}

double Continuation::arc_per_step(const PathPoint& at) const {
  return PathMetric{metric_.weights, arc_weight_}.norm(at.tangent, at.tangent_lambda);
}

double Continuation::path_length_to(const PathPoint& at) const {
  return std::min({at.arc_length, metric_.norm(at.y, at.lambda), kLargeGradient});
}

double Continuation::distance(const PathPoint& a, const PathPoint& b) const {
  return metric_.norm(b.y - a.y, b.lambda - a.lambda);
}

double Continuation::distance_along(const Chord& chord, const PathPoint& a, const PathPoint& b) const {
  return metric_.inner(b.y - a.y, b.lambda - a.lambda, chord.y, chord.lambda);
}

Chord Continuation::chord(const PathPoint& a, const PathPoint& b) const {
  const double length = distance(a, b);
  return {(b.y - a.y) / length, (b.lambda - a.lambda) / length, false};
}

Chord Continuation::displacement_chord(const PathPoint& a, const PathPoint& b) const {
  const double length = metric_.norm(b.y - a.y, 0.0);
  return {(b.y - a.y) / length, 0.0, true};
}

double Continuation::distance_in(const Chord& chord, const PathPoint& a, const PathPoint& b) const {
  return metric_.norm(b.y - a.y, chord.displacement_only ? 0.0 : b.lambda - a.lambda);
}

double Continuation::load_rate(const Chord& chord, const PathPoint& at) const {
  return at.tangent_lambda / metric_.inner(at.tangent, at.tangent_lambda, chord.y, chord.lambda);
}

void Continuation::interpolate(const Chord& chord, const PathPoint& lo, const PathPoint& hi, double share,
                               PathPoint& at) const {
  constexpr double kSmoothRate =
      0.3;  // below it a tangent is a singular point's, or turns away from the chord
  const double length = distance_along(chord, lo, hi);
  const double rate_lo = metric_.inner(lo.tangent, lo.tangent_lambda, chord.y, chord.lambda);
  const double rate_hi = metric_.inner(hi.tangent, hi.tangent_lambda, chord.y, chord.lambda);
  if (rate_lo > kSmoothRate && rate_hi > kSmoothRate) {
    const CubicWeights h(share * length, length);
    at.y = h.a * lo.y + (h.da / rate_lo) * lo.tangent + h.b * hi.y + (h.db / rate_hi) * hi.tangent;
    at.lambda = h.a * lo.lambda + h.da / rate_lo * lo.tangent_lambda + h.b * hi.lambda +
                h.db / rate_hi * hi.tangent_lambda;
  } else {
    at.y = (1.0 - share) * lo.y + share * hi.y;
    at.lambda = (1.0 - share) * lo.lambda + share * hi.lambda;
  }
}

std::optional<PathPoint> Continuation::between(const Chord& chord, const PathPoint& lo, const PathPoint& hi,
                                               double share) {
  PathPoint point;
  problem_.set_holds(lo.holds);
  point.holds = lo.holds;
  interpolate(chord, lo, hi, share, point);
  side_.normal = metric_.weights->cwiseProduct(chord.y);
  side_.normal_lambda = metric_.load_weight * chord.lambda;
  const double scale =
      std::max(distance_in(chord, lo, hi), chord.displacement_only ? kRoundingResidual : kSmallDisplacement);
  const auto outcome =
      correct(problem_, metric_, side_, scale, options_.corrector, point.y, point.lambda, work_);
  count(outcome);
  if (outcome.status != CorrectorStatus::converged) return std::nullopt;
  const bool at_start = outcome.tangent.negative % 2 == lo.negative % 2;
  set_tangent(point, at_start ? lo.negative : hi.negative, outcome, chord.y, chord.lambda);
  point.arc_length = (1.0 - share) * lo.arc_length + share * hi.arc_length;
  return point;
}

}  // namespace snapthrough
