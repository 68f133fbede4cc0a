#include "solver/trace/trace.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>

#include "solver/events/locate.h"
#include "solver/numeric/cancelled.h"
#include "solver/path/pinned_motions.h"
#include "solver/trace/asked_states.h"
#include "solver/trace/bifurcations_ahead.h"
#include "solver/trace/bounds.h"
#include "solver/trace/imperfect_bifurcations.h"

namespace snapthrough {
namespace {

/// Numbers of a trace beside the rules.
struct TraceLimits {
  static constexpr double first_step = 0.15;  ///< default first step over the load scale
  static constexpr double sharp_turn = 0.8;   ///< cosine of the tangents below which a step turned sharply
  static constexpr double same_place =
      1e-4;  ///< distance of points at one bifurcation, a displacement gradient
};

/// An accepted step, or one whose acceptance the events on it decide.
struct TracedStep {
  StepOutcome outcome = StepOutcome::advanced;
  LocatedEvents located;
  bool onto_bifurcation = false;  ///< its end is a bifurcation
  bool kink = false;              ///< the path turns sharply on it
  std::vector<ContactChange> changes;
};

/// Limit points among the critical points of a step, up to its end.
std::vector<PathPoint> turns_of(const std::vector<CriticalEvent>& events, const PathPoint& end) {
  std::vector<PathPoint> out;
  for (const CriticalEvent& event : events)
    if (is_limit(event.type) && event.point.arc_length < end.arc_length) out.push_back(event.point);
  return out;
}

/// The arc length just beyond another one.
double beyond(double arc) { return std::nextafter(arc, std::numeric_limits<double>::infinity()); }

/// The state that changes while a path is traced.
class Tracer {
 public:
  Tracer(PathFollower& follower, const TraceRules& rules, const PathObservers& observers)
      : follower_(follower),
        solver_(follower.solver()),
        rules_(rules),
        observers_(observers),
        asked_(solver_, rules.asked),
        broken_(rules, follower.norm()) {}

  TraceOutcome run(const PathPoint& start, const StepOptions& steps, const std::stop_token& stop);

 private:
  void follow(PathPoint& from, const StepOptions& steps, const std::stop_token& stop);
  [[nodiscard]] bool begin(PathPoint& from);
  [[nodiscard]] bool next_step(PathPoint& from, PathPoint& to, StepSize& size, bool& accepted);
  [[nodiscard]] bool stop_before_step(const PathPoint& point, int steps, const std::stop_token& stop);
  [[nodiscard]] bool leaves_capacity(const PathPoint& point);
  [[nodiscard]] bool unpinned_loses_stability(const PathPoint& from);
  void complete_step(const PathPoint& from, StepSize& size, PathPoint& to, TracedStep& step);
  void advance_history(const PathPoint& from, PathPoint& to);
  [[nodiscard]] bool record(const PathPoint& from, PathPoint& to, TracedStep& step,
                            const std::optional<BoundedEnd>& bound);
  [[nodiscard]] bool report_events(const std::vector<CriticalEvent>& events);
  [[nodiscard]] bool ends_path(const CriticalEvent& event);
  void report(const CriticalEvent& event);
  static void add_growth(const PathPoint& from, CriticalEvent growth, std::vector<CriticalEvent>& events);
  void step_to_bifurcation(const std::vector<CriticalEvent>& events, const PathPoint& from, StepSize& size,
                           PathPoint& to);
  void find_modes(const PathPoint& from, PathPoint& to);
  void measure_arc(const PathPoint& from, std::vector<CriticalEvent>& events, PathPoint& to) const;
  [[nodiscard]] bool is_known(const PathPoint& point) const;
  [[nodiscard]] bool is_too_unstable(const PathPoint& point, int negative) const;
  bool finish(TraceEnd end, const PathPoint& last);
  [[nodiscard]] BifurcationBounds bifurcation_bounds() const {
    return {rules_.locate.tolerance, rules_.most_broken};
  }
  template <class Function>
  void tell(const Function& function) const {
    for (PathObserver* observer : observers_) function(*observer);
  }

  PathFollower& follower_;
  PointSolver& solver_;
  const TraceRules& rules_;
  const PathObservers& observers_;
  TraceOutcome out_;
  int limit_points_ = 0;
  bool grows_ = false;                      ///< vibrations grow from a point of the path on
  double travelled_ = 0.0;                  ///< sum of the displacements of all steps
  std::optional<PathPoint> near_capacity_;  ///< last point near the capacity of supports, with a growing load
  SharedModes first_modes_;                 ///< softest motions where the path begins, on one-sided supports
  AskedStateSearch asked_;
  ImperfectBifurcations broken_;
};

/// Measures arc lengths along the polygon of a step's events: on a sharp turn a point's fraction of the step
/// is not its fraction of the arc.
void Tracer::measure_arc(const PathPoint& from, std::vector<CriticalEvent>& events, PathPoint& to) const {
  const PathPoint* last = &from;
  for (CriticalEvent& event : events) {
    event.point.arc_length = last->arc_length + follower_.norm().arc(*last, event.point);
    last = &event.point;
  }
  to.arc_length = last->arc_length + follower_.norm().arc(*last, to);
}

bool Tracer::finish(TraceEnd end, const PathPoint& last) {
  const bool gives_up = end == TraceEnd::displacement_bound || end == TraceEnd::step_underflow;
  out_.end = gives_up && rules_.capacity && rules_.capacity->is_near(last.lambda) ? TraceEnd::capacity : end;
  out_.last = last;
  return true;
}

bool Tracer::is_known(const PathPoint& point) const {
  return std::any_of(rules_.known.begin(), rules_.known.end(), [&](const PathPoint& other) {
    const double apart = std::abs(point.lambda - other.lambda);
    const double larger = std::max(std::abs(point.lambda), std::abs(other.lambda));
    return apart <= kSameLoad * larger &&
           follower_.norm().metric().norm(point.y - other.y, apart) < TraceLimits::same_place;
  });
}

/// Whether a point with so many negative eigenvalues ends the path.
bool Tracer::is_too_unstable(const PathPoint& point, int negative) const {
  return rules_.most_negative && negative > *rules_.most_negative &&
         !(rules_.most_negative_waits && rules_.most_negative_waits(point));
}

void Tracer::report(const CriticalEvent& event) {
  out_.critical.push_back(event);
  tell([&](PathObserver& observer) { observer.on_critical(event); });
}

/// Adds the point of a step from which on vibrations grow to its critical points.
void Tracer::add_growth(const PathPoint& from, CriticalEvent growth, std::vector<CriticalEvent>& events) {
  auto next = events.begin();
  int count = from.negative;
  for (; next != events.end() && next->point.arc_length <= growth.point.arc_length; ++next)
    if (next->type != CriticalType::broken_bifurcation) count = next->negative_after;
  growth.negative_before = growth.negative_after = count;
  events.insert(next, std::move(growth));
}

/// Whether a critical point that was just reported ends the path.
bool Tracer::ends_path(const CriticalEvent& event) {
  const bool passed_by = event.type == CriticalType::broken_bifurcation;
  const bool lost = is_loss(event);
  const bool loss = rules_.first_loss_of_stability && lost;
  const bool last_limit = rules_.limit_points && limit_points_ >= *rules_.limit_points;
  const bool exhausted =
      !passed_by && event.type != CriticalType::flutter && rules_.capacity &&
      rules_.capacity->is_near(event.point.lambda) &&
      (rules_.capacity->is_at(event.point.lambda) || rules_.capacity->moves_rigidly(event));
  const bool too_many = !passed_by && is_too_unstable(event.point, event.negative_after);
  if (!loss && !last_limit && !too_many && !exhausted) return false;
  PathPoint last = event.point;
  // Newton's method ends on either side of a singular tangent
  if (too_many || grows_from(event))
    last.negative = event.negative_after;
  else if (event.null.size() > 0)
    last.negative = solver_.negative_at(last);
  out_.on_critical = true;
  const TraceEnd end = exhausted    ? TraceEnd::capacity
                       : loss       ? TraceEnd::critical_point
                       : last_limit ? TraceEnd::limit_points
                                    : TraceEnd::negative_eigenvalues;
  return finish(end, last);
}

/// Reports the critical points of a step; true when one of them ends the path.
bool Tracer::report_events(const std::vector<CriticalEvent>& events) {
  for (const CriticalEvent& event : events) {
    if (is_known(event.point)) {
      PathPoint last = event.point;
      last.negative = event.negative_before;  // the change there is reported where it was found first
      return finish(TraceEnd::rejoined, last);
    }
    if (is_limit(event.type)) ++limit_points_;
    CriticalEvent met = event;
    met.after_growth = grows_;
    grows_ = grows_ || grows_from(event);
    report(met);
    if (ends_path(met)) return true;
  }
  return false;
}

/// Makes bifurcations the end of the step; the path leaves them along its own tangent.
void Tracer::step_to_bifurcation(const std::vector<CriticalEvent>& events, const PathPoint& from,
                                 StepSize& size, PathPoint& to) {
  const CriticalEvent& last = events.back();
  to = last.point;
  to.negative = last.negative_after;
  size.taken = follower_.norm().distance(from, to);
  solver_.find_modes(to, from.modes);
  if (!to.modes) return;
  // the motions of the bifurcation are beyond zero from here on
  SoftModes passed = *to.modes;
  const Eigen::Index own = std::min(passed.count(), last.null.cols());
  for (Eigen::Index i = 0; i < own; ++i)
    passed.stiffness[i] = std::copysign(std::numeric_limits<double>::min(), passed.rate[i]);
  to.modes = std::make_shared<const SoftModes>(std::move(passed));
}

void Tracer::find_modes(const PathPoint& from, PathPoint& to) {
  const SharedModes& known = from.modes ? from.modes : first_modes_;
  solver_.find_modes(to, from.context.holds == to.context.holds ? known : nullptr);
}

/// Whether a path near the capacity of its supports has turned, or jumped to another one, without a critical
/// point that was found: on a plateau the load does not tell the sense of the path.
bool Tracer::leaves_capacity(const PathPoint& point) {
  if (!rules_.capacity) return false;
  if (rules_.capacity->is_near(point.lambda) && point.lambda * point.tangent_lambda > 0.0) {
    near_capacity_ = point;
    return false;
  }
  return near_capacity_ && finish(TraceEnd::capacity, *near_capacity_);
}

/// What ends the path before the next step is tried; false when nothing does.
bool Tracer::stop_before_step(const PathPoint& point, int steps, const std::stop_token& stop) {
  if (stop.stop_requested()) return finish(TraceEnd::cancelled, point);
  if (leaves_capacity(point)) return true;
  if (is_too_unstable(point, point.negative)) return finish(TraceEnd::negative_eigenvalues, point);
  if (steps >= rules_.steps) return finish(TraceEnd::steps, point);
  if (follower_.norm().metric().norm(point.y, 0.0) > rules_.gradient || travelled_ > rules_.travel ||
      (rules_.beyond_theory && rules_.beyond_theory(point)))
    return finish(TraceEnd::displacement_bound, point);
  if (!rules_.load && std::abs(point.lambda) > follower_.norm().load_bound())
    return finish(TraceEnd::load_bound, point);
  return false;
}

/// Supports remember a point when it is recorded, so that steps that were tried leave nothing behind.
void Tracer::advance_history(const PathPoint& from, PathPoint& to) {
  EquilibriumProblem& problem = solver_.problem();
  if (!problem.traits().remembers) return;
  problem.set_history(from.context.history);
  to.context.history = problem.remembered(to.y, to.lambda);
}

/// Records an accepted step and tells the observers; true when the path ends on it (then `to` is the path's
/// last point).
bool Tracer::record(const PathPoint& from, PathPoint& to, TracedStep& step,
                    const std::optional<BoundedEnd>& bound) {
  if (bound) {
    to = bound->point;
    to.arc_length = std::max(to.arc_length, from.arc_length + follower_.norm().arc(from, to));
    static_cast<void>(solver_.negative_at(to));  // its factors
    find_modes(from, to);
  }
  advance_history(from, to);
  std::vector<CriticalEvent> reached;
  int count = from.negative;
  for (const CriticalEvent& event : step.located.events) {
    // at a kink both are at one place, where the count at the bound tells on which side it is
    if (bound && event.point.arc_length > to.arc_length && count == to.negative) continue;
    if (event.type != CriticalType::broken_bifurcation) count = event.negative_after;
    reached.push_back(event);
    // a turn within rounding's reach still is a step, and its events are not on the step before
    double& arc = reached.back().point.arc_length;
    arc = std::max(arc, beyond(from.arc_length));
  }
  travelled_ += follower_.norm().metric().norm(to.y - from.y, 0.0);
  bool ended = report_events(reached);
  if (!reached.empty()) near_capacity_.reset();
  if (ended) {
    advance_history(from, out_.last);
    to = out_.last;
  }
  const double least = ended || reached.empty() ? from.arc_length : reached.back().point.arc_length;
  to.arc_length = std::max(to.arc_length, beyond(least));
  if (!ended && bound) ended = finish(bound->end, to);
  for (const ContactChange& change : step.changes)
    if (change.point.arc_length <= to.arc_length)
      tell([&](PathObserver& observer) { observer.on_contact(change); });
  asked_.tell(from, turns_of(reached, to), to, [&](std::size_t row, const PathPoint& state) {
    tell([&](PathObserver& observer) { observer.on_asked(row, state); });
  });
  tell([&](PathObserver& observer) { observer.on_step(from, to); });
  // a bifurcation at the end of a step is reported as such, and has no count of its own
  if (ended || !step.onto_bifurcation) tell([&](PathObserver& observer) { observer.on_point(to); });
  return ended;
}

/// Completes the end of a step that the follower took: pins motions that became free, finds its softest
/// motions, and locates the critical points on the step. The end may become a bifurcation that was stepped
/// over.
void Tracer::complete_step(const PathPoint& from, StepSize& size, PathPoint& to, TracedStep& step) {
  const bool may_be_free = may_have_free_motion(solver_.problem(), from, to);
  const bool pinned = may_be_free && pin_free_motions(solver_, from, to);
  // the factors are no longer those of the point
  if (may_be_free && !pinned) to.negative = solver_.negative_at(to);
  if (!pinned && step.outcome == StepOutcome::advanced && to.negative != from.negative)
    recorrect_to_rounding(solver_, from, to);
  find_modes(from, to);
  if (step.outcome == StepOutcome::kinked) {
    LocateOptions options = rules_.locate;
    // laws that bend to their plateau change the inertia at a kink
    if (rules_.capacity) options.before_kink = CapacityRule::kink;
    step.located = locate_at_kink(follower_, from, to, size.taken, options);
    return;
  }
  auto passed = bifurcations_stepped_over(solver_, from, to, bifurcation_bounds());
  if (broken_.is_perfect(passed)) {
    step_to_bifurcation(passed, from, size, to);
    step.onto_bifurcation = true;
    step.located = {std::move(passed), true, {}};
    return;
  }
  // beside a broken bifurcation the step may have crossed to the other path
  if (!passed.empty() && broken_.limit_step(from, size.taken) < size.taken)
    step.located = {{}, false, {}};
  else
    step.located = locate_critical_points(solver_, from, to, rules_.locate);
}

/// Whether a path that is followed to its loss of stability ends because motions that are no longer pinned
/// are unstable from its start on.
bool Tracer::unpinned_loses_stability(const PathPoint& from) {
  tell([&](PathObserver& observer) { observer.on_unpinned(from); });
  return rules_.first_loss_of_stability && from.negative > 0 && finish(TraceEnd::unstable_at_start, from);
}

/// Tries one step of the path: onto bifurcations that are predicted, or as the follower takes it. A step is
/// taken back when its ends are on two paths, or when it crosses a bound or an asked load at a point that is
/// not found.
/// @param accepted whether `to` is the path's next point
/// @return whether the path ends
bool Tracer::next_step(PathPoint& from, PathPoint& to, StepSize& size, bool& accepted) {
  TracedStep step;
  step.located = {predicted_bifurcations(solver_, from, size.wanted, bifurcation_bounds()), true, {}};
  if (broken_.is_perfect(step.located.events)) {
    step_to_bifurcation(step.located.events, from, size, to);
    step.onto_bifurcation = true;
  } else {
    size.wanted = broken_.limit_step(from, size.wanted);
    step.outcome = follower_.step(from, size, to);
    if (step.outcome == StepOutcome::step_underflow) return finish(TraceEnd::step_underflow, from);
    if (unpin_resisted_motions(solver_, from, to)) return unpinned_loses_stability(from);
    complete_step(from, size, to, step);
  }
  if (rules_.vibrations && step.located.same_path) {
    StepVibrations vibrations = rules_.vibrations(from, to);
    if (vibrations.is_too_long && !step.onto_bifurcation)
      step.located = {{}, false, {}};
    else if (vibrations.loss)
      add_growth(from, *std::move(vibrations.loss), step.located.events);
  }
  const PathMetric& metric = follower_.norm().metric();
  const double cosine = metric.inner(from.tangent, from.tangent_lambda, to.tangent, to.tangent_lambda);
  step.kink = step.outcome == StepOutcome::kinked || cosine <= TraceLimits::sharp_turn;
  if (step.kink) measure_arc(from, step.located.events, to);
  const auto bound =
      step.located.same_path ? first_bound(solver_, rules_, from, to, step.kink) : std::nullopt;
  const PathPoint& end = bound ? bound->point : to;
  // on the shortest steps no other state is found: the path goes on without it
  if (!step.located.same_path || (bound && !bound->found) ||
      (!asked_.look_on(from, turns_of(step.located.events, end), end) && size.taken > Gradients::tiny)) {
    follower_.reject(size);
    return false;
  }
  accepted = true;
  if (rules_.zones)
    step.changes = locate_contact_changes(solver_, from, to, step.outcome == StepOutcome::kinked,
                                          rules_.zones, rules_.locate.tolerance);
  for (const PathPoint& point : step.located.touching)
    tell([&](PathObserver& observer) { observer.on_touching(point); });
  broken_.report_passed(to, bound.has_value(), step.located.events);
  if (record(from, to, step, bound)) return true;
  if (!step.kink && from.context.holds == to.context.holds)
    follower_.remember(from, to);
  else
    follower_.reset_predictor();
  return false;
}

/// Reports the first point; true when the path ends there.
bool Tracer::begin(PathPoint& from) {
  solver_.find_first_modes(from);
  tell([&](PathObserver& observer) { observer.on_point(from); });
  if (solver_.problem().traits().one_sided) first_modes_ = std::exchange(from.modes, nullptr);
  grows_ = rules_.grows_at_start;
  return rules_.first_loss_of_stability && (from.negative > 0 || grows_) &&
         finish(TraceEnd::unstable_at_start, from);
}

/// From point to point, until something ends the path.
void Tracer::follow(PathPoint& from, const StepOptions& steps, const std::stop_token& stop) {
  if (begin(from)) return;
  const double load_rate = std::abs(from.tangent_lambda);
  StepSize size{0.0, rules_.first_step.value_or(steps.initial.value_or(TraceLimits::first_step) *
                                                follower_.norm().load_scale() / load_rate)};
  if (!rules_.first_step) follower_.limit_steps(steps, load_rate);
  const bool to_limit = rules_.first_loss_of_stability || rules_.limit_points.has_value();
  PathPoint to;
  for (int accepted_steps = 0; !stop_before_step(from, accepted_steps, stop);) {
    bool accepted = false;
    if (next_step(from, to, size, accepted)) return;
    if (!accepted) continue;
    ++accepted_steps;
    std::swap(from, to);
    to.modes = nullptr;
    follower_.reweigh_load(to_limit, from, size);
  }
}

TraceOutcome Tracer::run(const PathPoint& start, const StepOptions& steps, const std::stop_token& stop) {
  PathPoint from = start;
  if (!unless_cancelled([&] { follow(from, steps, stop); })) finish(TraceEnd::cancelled, from);
  for (const CriticalEvent& event : broken_.pending()) report(event);
  return std::move(out_);
}

}  // namespace

TraceOutcome trace(PathFollower& follower, const std::optional<PathPoint>& start, const TraceRules& rules,
                   const StepOptions& steps, const PathObservers& observers, const std::stop_token& stop) {
  if (!start) return {};
  follower.reset_predictor();
  TraceOutcome out = Tracer(follower, rules, observers).run(*start, steps, stop);
  follower.reset_predictor();
  return out;
}

}  // namespace snapthrough
