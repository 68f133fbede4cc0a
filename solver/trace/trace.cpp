#include "solver/trace/trace.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>
#include <utility>

#include "solver/events/newton_event.h"
#include "solver/numeric/cancelled.h"

namespace snapthrough {
namespace {

/// A bound that a step crossed: the function of the path that is zero there.
struct Crossing {
  TraceEnd end = TraceEnd::load_factor;
  std::function<double(const PathPoint&)> value;
  double bound = 0.0;  ///< value of the quantity there
};

std::optional<Crossing> crossing_of(const std::function<double(const PathPoint&)>& quantity,
                                    const std::array<double, 2>& range, TraceEnd end, const PathPoint& to) {
  const double now = quantity(to);
  if (now >= range[0] && now <= range[1]) return std::nullopt;
  const double bound = now < range[0] ? range[0] : range[1];
  return Crossing{end, [quantity, bound](const PathPoint& at) { return quantity(at) - bound; }, bound};
}

/// Relative difference of the loads of points at one place; the norm may hardly see the load.
constexpr double kSameLoad = 1e-3;

bool is_near(double load, double other) { return std::abs(load - other) <= kSameLoad * std::abs(load); }

/// Whether a displacement has moved against its rate, which has one sign at both ends: there are two turns
/// between.
bool went_back(double from, double to, bool goes_up) {
  constexpr double kRounding = 1e-12;
  return (goes_up ? from - to : to - from) > kRounding * std::abs(from);
}

/// The state that changes while a path is traced.
class Tracer {
 public:
  Tracer(Continuation& continuation, const TraceRules& rules, const TraceSink& sink)
      : continuation_(continuation), rules_(rules), sink_(sink) {}

  TraceOutcome run(const PathPoint& start, const StepOptions& steps, const std::stop_token& stop);

 private:
  [[nodiscard]] double first_step(const StepOptions& steps, const PathPoint& start) const;
  struct Bound {
    PathPoint point;
    bool found = false;
    TraceEnd end = TraceEnd::load_factor;
  };
  [[nodiscard]] std::optional<Bound> bounded_end(const PathPoint& from, const PathPoint& to, bool kink);
  void tell(const CriticalEvent& event);
  [[nodiscard]] bool take_events(const std::vector<CriticalEvent>& events);
  void go(PathPoint& from, const StepOptions& steps, const std::stop_token& stop);
  [[nodiscard]] bool ends_here(const PathPoint& at, int steps, const std::stop_token& stop);
  [[nodiscard]] bool accept(const PathPoint& from, PathPoint& to, const std::vector<CriticalEvent>& events,
                            const std::optional<Bound>& bound);
  void measure_arc(const PathPoint& from, std::vector<CriticalEvent>& events, PathPoint& to) const;
  [[nodiscard]] std::vector<CriticalEvent> beyond(const PathPoint& from, Eigen::Index first, double reach);
  [[nodiscard]] std::vector<CriticalEvent> ahead(const PathPoint& from, double wanted);
  [[nodiscard]] std::vector<CriticalEvent> left_behind(const PathPoint& from, const PathPoint& to);
  [[nodiscard]] bool are_whole(const std::vector<CriticalEvent>& events);
  [[nodiscard]] double careful(const PathPoint& from, double wanted) const;
  void step_onto(const std::vector<CriticalEvent>& events, const PathPoint& from, StepSize& size,
                 PathPoint& to);
  void find_modes(const PathPoint& from, PathPoint& to);
  void go_on(bool smooth, PathPoint& from, PathPoint& to);
  [[nodiscard]] LocatedEvents arrive(const PathPoint& from, StepOutcome outcome, StepSize& size,
                                     PathPoint& to);
  void tell_contact(const PathPoint& from, StepOutcome outcome, const PathPoint& to,
                    const LocatedEvents& located);
  void tell_passed(const PathPoint& to, bool may_end, std::vector<CriticalEvent>& events);
  [[nodiscard]] bool turns_sharply(const PathPoint& from, const PathPoint& to) const;
  [[nodiscard]] bool is_known(const PathPoint& point) const;
  [[nodiscard]] bool is_too_unstable(const PathPoint& at, int negative) const;
  bool finish(TraceEnd end, const PathPoint& last);

  Continuation& continuation_;
  const TraceRules& rules_;
  const TraceSink& sink_;
  TraceOutcome out_;
  int limit_points_ = 0;
  double travelled_ = 0.0;                  ///< sum of the displacements of all steps
  std::vector<ContactChange> changes_;      ///< on the step that is being taken
  std::optional<CriticalEvent> passed_by_;  ///< the last bifurcation that was found beside the path
  SharedModes first_modes_;                 ///< softest motions where the path begins, on one-sided supports
  bool onto_ = false;                       ///< the step that is being taken ends on a bifurcation
  std::vector<CriticalEvent> beside_;       ///< those that are still to be told
};

/// Round a kink a point's share of the step is not its share of the arc: along the polygon instead.
void Tracer::measure_arc(const PathPoint& from, std::vector<CriticalEvent>& events, PathPoint& to) const {
  const PathPoint* last = &from;
  for (CriticalEvent& event : events) {
    event.point.arc_length = last->arc_length + continuation_.arc(*last, event.point);
    last = &event.point;
  }
  to.arc_length = last->arc_length + continuation_.arc(*last, to);
}

bool Tracer::turns_sharply(const PathPoint& from, const PathPoint& to) const {
  constexpr double kSharply = 0.8;  // cosine; smooth steps turn less
  return continuation_.metric().inner(from.tangent, from.tangent_lambda, to.tangent, to.tangent_lambda) <
         kSharply;
}

double Tracer::first_step(const StepOptions& steps, const PathPoint& start) const {
  constexpr double kDefaultInitial = 0.15;
  return steps.initial.value_or(kDefaultInitial) * continuation_.load_scale() /
         std::abs(start.tangent_lambda);
}

bool Tracer::finish(TraceEnd end, const PathPoint& last) {
  out_.end = end;
  out_.last = last;
  return true;
}

/// The point where the step first crosses a bound of the stop rules; empty when it crosses none.
std::optional<Tracer::Bound> Tracer::bounded_end(const PathPoint& from, const PathPoint& to, bool kink) {
  std::vector<Crossing> crossings;
  if (rules_.load) {
    const auto load = [](const PathPoint& at) { return at.lambda; };
    if (auto c = crossing_of(load, *rules_.load, TraceEnd::load_factor, to)) crossings.push_back(*c);
  }
  if (rules_.monitor_range)
    if (auto c = crossing_of(rules_.monitor, *rules_.monitor_range, TraceEnd::monitor, to))
      crossings.push_back(*c);
  if (rules_.monitor_turns) {
    // the monitor is linear in the unknowns: its rate is its value on the tangent
    const auto rate = [this](const PathPoint& at) { return rules_.monitor_rate(at); };
    const bool goes_up = rate(from) > 0.0;
    if (goes_up != (rate(to) > 0.0))
      crossings.push_back({TraceEnd::monitor_turned, rate, 0.0});
    else if (went_back(rules_.controlled(from), rules_.controlled(to), goes_up))
      return Bound{to, false, TraceEnd::monitor_turned};
  }
  constexpr double kReached = 1e-9;  // of the step's change
  constexpr double kShort = 1e-6;
  std::optional<Bound> first;
  for (const Crossing& crossing : crossings) {
    const double va = crossing.value(from);
    const double vb = crossing.value(to);
    const double size = std::abs(vb - va);
    const auto done = [size](const PathPoint&, const PathPoint&, double value) {
      return std::abs(value) <= 1e-12 * size;
    };
    const LocatedRoot root =
        find_root(continuation_, continuation_.chord(from, to), from, va, to, vb, crossing.value, done);
    const bool outside_before = (va > 0.0) == (vb > 0.0);
    // a rate jumps at a kink, which then is where it changes its sign
    const bool jumps =
        crossing.end == TraceEnd::monitor_turned && (kink || continuation_.distance(from, to) < kShort);
    const bool found = root.found || outside_before || jumps ||
                       std::min(std::abs(root.value_before), std::abs(root.value_after)) <= kReached * size;
    if (first && found && first->point.arc_length <= root.root.arc_length) continue;
    first = Bound{root.root, found, crossing.end};
    if (found && crossing.end == TraceEnd::load_factor)
      move_to_load(continuation_, crossing.bound, first->point);
    if (!found) break;
  }
  return first;
}

bool Tracer::is_known(const PathPoint& point) const {
  constexpr double kSamePlace = 1e-4;  // a displacement gradient; rounding leaves less at a bifurcation
  return std::any_of(rules_.known.begin(), rules_.known.end(), [&](const PathPoint& other) {
    const double apart = std::abs(point.lambda - other.lambda);
    return apart <= kSameLoad * std::max(std::abs(point.lambda), std::abs(other.lambda)) &&
           continuation_.metric().norm(point.y - other.y, apart) < kSamePlace;
  });
}

void Tracer::tell(const CriticalEvent& event) {
  out_.critical.push_back(event);
  if (sink_.on_critical) sink_.on_critical(event);
}

/// Reports what was found on a step; true when that ends the path.
bool Tracer::take_events(const std::vector<CriticalEvent>& events) {
  for (const CriticalEvent& event : events) {
    if (is_known(event.point)) {
      PathPoint last = event.point;
      last.negative = event.negative_before;  // what changes there is told where it was found first
      return finish(TraceEnd::rejoined, last);
    }
    const bool passed_by = event.type == CriticalType::broken_bifurcation;
    const bool lost = !passed_by && event.negative_before == 0 && event.negative_after > 0;
    if (is_limit(event.type)) ++limit_points_;
    tell(event);
    const bool loss = rules_.first_loss_of_stability && lost;
    const bool last_limit = rules_.limit_points && limit_points_ >= *rules_.limit_points;
    const bool too_many = !passed_by && is_too_unstable(event.point, event.negative_after);
    if (!loss && !last_limit && !too_many) continue;
    PathPoint last = event.point;
    // Newton's method ends on either side of a singular tangent
    if (too_many)
      last.negative = event.negative_after;
    else if (event.null.size() > 0)
      last.negative = continuation_.negative_at(last);
    out_.on_critical = true;
    return finish(loss         ? TraceEnd::critical_point
                  : last_limit ? TraceEnd::limit_points
                               : TraceEnd::negative_eigenvalues,
                  last);
  }
  return false;
}

/// The bifurcations beyond a point of the path where a motion loses (or regains) its stiffness, with all
/// those that do so close by.
std::vector<CriticalEvent> Tracer::beyond(const PathPoint& from, Eigen::Index first, double reach) {
  constexpr double kClose = 1.5;  // times the distance
  const SoftModes& modes = *from.modes;
  const double distance = modes.distance_to_zero(first, 1.0);
  std::vector<Eigen::Index> close;
  for (Eigen::Index i = 0; i < modes.count(); ++i) {
    const bool same_sign = (modes.stiffness[i] > 0.0) == (modes.stiffness[first] > 0.0);
    if (same_sign && modes.distance_to_zero(i, 1.0) <= kClose * distance) close.push_back(i);
  }
  auto events = bifurcations_beyond(continuation_, from, close, distance, reach, rules_.locate.tolerance);
  if (!events.empty() && events.front().imperfection > rules_.most_broken) events.clear();
  return events;
}

/// The bifurcations that motions' stiffnesses let expect within the next step or the one after: found before
/// a step is taken over them, which could end on a path that crosses there.
std::vector<CriticalEvent> Tracer::ahead(const PathPoint& from, double wanted) {
  constexpr double kSteps = 1.5;
  constexpr double kMostAlong = 0.5;  // of the tangent along the motion: at a limit point it is all
  // what is held at the start may turn out to be resisted
  if (!from.modes || (from.holds && from.arc_length == 0.0)) return {};
  const SoftModes& modes = *from.modes;
  Eigen::Index first = 0;
  for (Eigen::Index i = 1; i < modes.count(); ++i)
    if (modes.distance_to_zero(i, 1.0) < modes.distance_to_zero(first, 1.0)) first = i;
  if (!(modes.distance_to_zero(first, 1.0) < kSteps * wanted)) return {};
  const PathMetric& metric = continuation_.metric();
  const double along = metric.inner(from.tangent, 0.0, modes.motions.col(first), 0.0);
  if (std::abs(along) > kMostAlong) return {};
  return beyond(from, first, 2.0 * wanted);
}

/// The bifurcations that a step left behind although its ends have the same inertia: a motion's stiffness
/// fell before them and rises beyond, because the step ended on a path that crosses there, or passes them by.
std::vector<CriticalEvent> Tracer::left_behind(const PathPoint& from, const PathPoint& to) {
  const double length = continuation_.distance(from, to);
  const auto dip = find_dip(from, to, length);
  if (from.negative != to.negative || !dip) return {};
  return beyond(from, dip->mode, length);
}

/// Whether bifurcations are such that only rounding or the mesh makes the path pass by. Others are told with
/// the next step.
bool Tracer::are_whole(const std::vector<CriticalEvent>& events) {
  if (events.empty()) return false;
  const CriticalEvent& first = events.front();
  constexpr double kFall = 0.1;  // of an imperfection that is the mesh's, on a finer mesh
  if (first.imperfection <= rules_.locate.perfect) return true;
  if (passed_by_ && is_near(first.point.lambda, passed_by_->point.lambda)) return false;
  const auto finer = rules_.finer_imperfection ? rules_.finer_imperfection(first) : first.imperfection;
  if (finer && *finer <= kFall * first.imperfection) return true;
  passed_by_ = first;
  if (!finer) return false;
  CriticalEvent event = first;
  event.type = CriticalType::broken_bifurcation;
  beside_.push_back(std::move(event));
  return false;
}

/// Size of the next step beside a bifurcation that is broken: the path turns away from it within what the
/// imperfection changes of its load, and a longer step would cross to the path that goes on where it turns.
/// The same where a path on another mesh had its critical points.
double Tracer::careful(const PathPoint& from, double wanted) const {
  constexpr double kHalf = 0.5;   // of the distance
  constexpr double kNear = 2e-3;  // of an expected load
  if (passed_by_) {
    const double load = broken_share(passed_by_->imperfection) * std::abs(passed_by_->point.lambda);
    const double reach = load / std::abs(passed_by_->point.tangent_lambda);
    wanted = std::min(wanted, std::max(kHalf * continuation_.distance(from, passed_by_->point), reach));
  }
  for (const double load : rules_.expected) {
    const double room = std::max(kHalf * std::abs(load - from.lambda), kNear * std::abs(load));
    wanted = std::min(wanted, room / std::abs(from.tangent_lambda));
  }
  return wanted;
}

/// Takes bifurcations as the next point of the path, which leaves them along its own tangent.
void Tracer::step_onto(const std::vector<CriticalEvent>& events, const PathPoint& from, StepSize& size,
                       PathPoint& to) {
  const CriticalEvent& last = events.back();
  onto_ = true;
  to = last.point;
  to.negative = last.negative_after;
  size.taken = continuation_.distance(from, to);
  continuation_.find_modes(to, from.modes);
  if (!to.modes) return;
  // their own motions are beyond zero from here on
  SoftModes passed = *to.modes;
  const Eigen::Index own = std::min(passed.count(), last.null.cols());
  for (Eigen::Index i = 0; i < own; ++i)
    passed.stiffness[i] = std::copysign(std::numeric_limits<double>::min(), passed.rate[i]);
  to.modes = std::make_shared<const SoftModes>(std::move(passed));
}

void Tracer::find_modes(const PathPoint& from, PathPoint& to) {
  const SharedModes& known = from.modes ? from.modes : first_modes_;
  continuation_.find_modes(to, from.holds == to.holds ? known : nullptr);
}

/// The end of a step becomes the start of the next.
void Tracer::go_on(bool smooth, PathPoint& from, PathPoint& to) {
  if (smooth)
    continuation_.extrapolate(from, to);
  else
    continuation_.extrapolate_nothing();
  std::swap(from, to);
  to.modes = nullptr;
}

/// Whether a point with so many negative eigenvalues ends the path.
bool Tracer::is_too_unstable(const PathPoint& at, int negative) const {
  return rules_.most_negative && negative > *rules_.most_negative &&
         !(rules_.most_negative_waits && rules_.most_negative_waits(at));
}

/// What ends the path before the next step is tried; false when nothing does.
bool Tracer::ends_here(const PathPoint& at, int steps, const std::stop_token& stop) {
  if (stop.stop_requested()) return finish(TraceEnd::cancelled, at);
  if (is_too_unstable(at, at.negative)) return finish(TraceEnd::negative_eigenvalues, at);
  if (steps >= rules_.steps) return finish(TraceEnd::steps, at);
  if (continuation_.metric().norm(at.y, 0.0) > rules_.gradient || travelled_ > rules_.travel ||
      (rules_.beyond_theory && rules_.beyond_theory(at)))
    return finish(TraceEnd::displacement_bound, at);
  if (!rules_.load && std::abs(at.lambda) > continuation_.load_bound())
    return finish(TraceEnd::load_bound, at);
  return false;
}

/// Takes the step from -> to into the path; true when it ends there (then `to` is the path's last point).
bool Tracer::accept(const PathPoint& from, PathPoint& to, const std::vector<CriticalEvent>& events,
                    const std::optional<Bound>& bound) {
  if (bound) {
    to = bound->point;
    to.arc_length = std::max(to.arc_length, from.arc_length + continuation_.arc(from, to));
    static_cast<void>(continuation_.negative_at(to));  // its factors
    find_modes(from, to);
  }
  // a turn within rounding's reach still is a step, and what is on it is not on the last one
  const auto beyond = [](double arc) { return std::nextafter(arc, std::numeric_limits<double>::infinity()); };
  std::vector<CriticalEvent> reached;
  int count = from.negative;
  for (const CriticalEvent& event : events) {
    // at a kink both are at one place, where the count at the bound tells on which side it is
    if (bound && event.point.arc_length > to.arc_length && count == to.negative) continue;
    if (event.type != CriticalType::broken_bifurcation) count = event.negative_after;
    reached.push_back(event);
    double& arc = reached.back().point.arc_length;
    arc = std::max(arc, beyond(from.arc_length));
  }
  travelled_ += continuation_.metric().norm(to.y - from.y, 0.0);
  bool ended = take_events(reached);
  if (ended) to = out_.last;
  const double least = ended || reached.empty() ? from.arc_length : reached.back().point.arc_length;
  to.arc_length = std::max(to.arc_length, beyond(least));
  if (!ended && bound) ended = finish(bound->end, to);
  for (const ContactChange& change : changes_)
    if (sink_.on_contact && change.point.arc_length <= to.arc_length) sink_.on_contact(change);
  if (sink_.on_step) sink_.on_step(from, to);
  // a bifurcation that the path steps onto is told as such, and has no count of its own
  if (sink_.on_point && (ended || !onto_)) sink_.on_point(to);
  return ended;
}

/// Completes the end of a step that was taken; what is found between it and the start. It may become a
/// bifurcation that was left behind.
LocatedEvents Tracer::arrive(const PathPoint& from, StepOutcome outcome, StepSize& size, PathPoint& to) {
  const bool may_be_free = continuation_.may_be_neutral(from, to);
  const bool freed = may_be_free && continuation_.hold_neutral(from, to);
  // the question was asked with other factors
  if (may_be_free && !freed) to.negative = continuation_.negative_at(to);
  if (!freed && outcome == StepOutcome::advanced && to.negative != from.negative)
    continuation_.settle(from, to);
  find_modes(from, to);
  if (outcome == StepOutcome::kinked)
    return locate_at_kink(continuation_, from, to, size.taken, rules_.locate);
  auto left = left_behind(from, to);
  if (!are_whole(left)) {
    // it may have crossed to the other path there
    if (!left.empty() && careful(from, size.taken) < size.taken) return {{}, false, {}};
    return locate_critical_points(continuation_, from, to, rules_.locate);
  }
  step_onto(left, from, size, to);
  return {std::move(left), true, {}};
}

/// Contact that begins or ends on a step, and places where stability cannot be decided.
void Tracer::tell_contact(const PathPoint& from, StepOutcome outcome, const PathPoint& to,
                          const LocatedEvents& located) {
  if (rules_.zones)
    changes_ = locate_contact_changes(continuation_, from, to, outcome == StepOutcome::kinked, rules_.zones,
                                      rules_.locate.tolerance);
  for (const PathPoint& point : located.touching)
    if (sink_.on_touching) sink_.on_touching(point);
}

/// Bifurcations that were found beside the path are told when it is past them, or before what may end it; not
/// at all where it meets them after all.
void Tracer::tell_passed(const PathPoint& to, bool may_end, std::vector<CriticalEvent>& events) {
  const auto is_met = [&](const CriticalEvent& beside) {
    return std::any_of(events.begin(), events.end(), [&](const CriticalEvent& event) {
      return event.type == CriticalType::bifurcation && is_near(beside.point.lambda, event.point.lambda);
    });
  };
  std::erase_if(beside_, is_met);
  const auto is_ahead = [&](const CriticalEvent& beside) {
    return continuation_.metric().inner(beside.point.y - to.y, beside.point.lambda - to.lambda, to.tangent,
                                        to.tangent_lambda) > 0.0;
  };
  const auto waiting =
      may_end || !events.empty()
          ? beside_.end()
          : std::stable_partition(beside_.begin(), beside_.end(),
                                  [&](const CriticalEvent& event) { return !is_ahead(event); });
  // one that the path turns away from is told where it does
  const double reached = events.empty() ? to.arc_length : events.front().point.arc_length;
  for (auto event = beside_.begin(); event != waiting; ++event)
    event->point.arc_length = std::min(event->point.arc_length, reached);
  events.insert(events.begin(), beside_.begin(), waiting);
  beside_.erase(beside_.begin(), waiting);
}

/// From point to point, until something ends the path.
void Tracer::go(PathPoint& from, const StepOptions& steps, const std::stop_token& stop) {
  continuation_.find_first_modes(from);
  if (sink_.on_point) sink_.on_point(from);
  if (continuation_.problem().one_sided()) first_modes_ = std::exchange(from.modes, nullptr);
  if (rules_.first_loss_of_stability && from.negative > 0) {
    finish(TraceEnd::unstable_at_start, from);
    return;
  }
  StepSize size{0.0, rules_.first_step ? *rules_.first_step : first_step(steps, from)};
  if (!rules_.first_step) continuation_.limit_steps(steps, std::abs(from.tangent_lambda));
  PathPoint to;
  for (int n = 0; !ends_here(from, n, stop);) {
    onto_ = false;
    StepOutcome outcome = StepOutcome::advanced;
    LocatedEvents located{ahead(from, size.wanted), true, {}};
    if (are_whole(located.events)) {
      step_onto(located.events, from, size, to);
    } else {
      size.wanted = careful(from, size.wanted);
      outcome = continuation_.step(from, size, to);
      if (outcome == StepOutcome::step_underflow) {
        finish(TraceEnd::step_underflow, from);
        break;
      }
      if (continuation_.release(from, to)) {
        if (sink_.on_holds) sink_.on_holds(from);
        if (!(rules_.first_loss_of_stability && from.negative > 0)) continue;
        finish(TraceEnd::unstable_at_start, from);
        break;
      }
      located = arrive(from, outcome, size, to);
    }
    const bool kink = outcome == StepOutcome::kinked || turns_sharply(from, to);
    if (kink) measure_arc(from, located.events, to);
    const auto bound = located.same_path ? bounded_end(from, to, kink) : std::nullopt;
    if (!located.same_path || (bound && !bound->found)) {
      continuation_.reject(size);
      continue;
    }
    ++n;
    tell_contact(from, outcome, to, located);
    tell_passed(to, bound.has_value(), located.events);
    if (accept(from, to, located.events, bound)) break;
    go_on(!kink && from.holds == to.holds, from, to);
    continuation_.weigh_load(rules_.first_loss_of_stability || rules_.limit_points.has_value(), from, size);
  }
}

TraceOutcome Tracer::run(const PathPoint& start, const StepOptions& steps, const std::stop_token& stop) {
  PathPoint from = start;
  if (!unless_cancelled([&] { go(from, steps, stop); })) finish(TraceEnd::cancelled, from);
  for (const CriticalEvent& event : beside_) tell(event);
  return std::move(out_);
}

}  // namespace

TraceOutcome trace(Continuation& continuation, const std::optional<PathPoint>& start, const TraceRules& rules,
                   const StepOptions& steps, const TraceSink& sink, const std::stop_token& stop) {
  if (!start) return {};
  continuation.extrapolate_nothing();
  TraceOutcome out = Tracer(continuation, rules, sink).run(*start, steps, stop);
  continuation.extrapolate_nothing();
  return out;
}

}  // namespace snapthrough
