#include "solver/events/locate.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <utility>

#include "solver/events/newton_event.h"
#include "solver/numeric/bracket.h"
#include "solver/numeric/cubic.h"

namespace snapthrough {

using Eigen::Index;

namespace {

constexpr int kMaxEvaluations = 100;
constexpr int kMaxDepth = 48;
/// Looks into a step that nothing but a suspicion asks for: on a plateau rounding does so on every part.
constexpr int kMostGuesses = 12;
/// Points this near (in the path's norm, a displacement gradient) are on one path: rounding leaves about
/// 1e-16 over the relative distance to the bifurcation, a broken bifurcation about the cube root of its
/// imperfection.
constexpr double kSamePath = 1e-5;
/// Load, relative, to which a bifurcation is located at least: one with an imperfection of 1e-14, as rounding
/// of the nodes' coordinates makes it, looks whole from further.
constexpr double kBrokenBifurcation = 1e-9;

/// State of the search between two points of a path.
struct Search {
  Continuation& continuation;
  Chord chord;         ///< of the whole step: places are told by their distance along it
  double log_abs_det;  ///< at the start of the step
  const LocateOptions& options;
  LocatedEvents& out;
  double stiffness = 0.0;  ///< of the softest motion at the ends of the step
  int guesses = 0;         ///< looks that nothing but a suspicion asked for
};

bool loads_agree(double l0, double l1, double tolerance, double least) {
  return std::abs(l1 - l0) <= tolerance * std::max({std::abs(l0), std::abs(l1), least});
}

/// Whether two points are farther apart than their places along the chord allow: they are on two different
/// paths.
bool apart(const Continuation& continuation, const Chord& chord, const PathPoint& a, const PathPoint& b) {
  constexpr double kSteepest = 10.0;
  return continuation.distance_in(chord, a, b) >
         kSteepest * continuation.distance_along(chord, a, b) + kSamePath;
}

/// det(J) / (dlambda/dtau), scaled by its size at the start of the search.
double bifurcation_function(const Search& search, const PathPoint& at) {
  return at.determinant(search.log_abs_det) / search.continuation.load_rate(search.chord, at);
}

/// Value at a closed bracket, over that at the first one's ends, which only a jump of the tangent leaves.
constexpr double kJump = 1e-3;

/// A function whose sign changes in a closed bracket without passing zero jumps, because a support begins or
/// ceases to act. Where the step itself is short the bracket is closed at a share of it at which a smooth
/// function still has its share of the first value.
CriticalCause cause_of(const Search& search, const LocatedRoot& root, double first_value, const PathPoint& a,
                       const PathPoint& b) {
  constexpr double kCurved = 10.0;  // times what a linear function leaves
  const Continuation& path = search.continuation;
  const double share =
      path.distance_along(search.chord, root.before, root.after) / path.distance_along(search.chord, a, b);
  const double left = std::max(std::abs(root.value_before), std::abs(root.value_after));
  return search.continuation.problem().one_sided() &&
                 left > std::max(kJump, kCurved * share) * std::abs(first_value)
             ? CriticalCause::contact
             : CriticalCause::smooth;
}

void add_event(Search& search, CriticalType type, const LocatedRoot& root, int before, int after) {
  if (!root.found) {
    search.out.same_path = false;
    return;
  }
  CriticalEvent event;
  event.type = type;
  event.point = root.root;
  if (type == CriticalType::bifurcation) {
    // the tangent is singular there: take the path's direction from the ends of the step instead
    event.point.tangent = search.chord.y;
    event.point.tangent_lambda = search.chord.lambda;
  }
  event.negative_before = before;
  event.negative_after = after;
  event.multiplicity = std::max(1, std::abs(after - before));
  event.bracket_loads[0] = root.before.lambda;
  event.bracket_loads[1] = root.after.lambda;
  search.out.events.push_back(std::move(event));
}

CriticalType limit_type(const PathPoint& before) {
  return before.tangent_lambda > 0.0 ? CriticalType::limit_max : CriticalType::limit_min;
}

/// A simple event between a and b; a closed bracket whose ends do not have the counts of a and b is on
/// another path.
void add_simple_event(Search& search, CriticalType type, LocatedRoot root, double first_value,
                      const PathPoint& a, const PathPoint& b) {
  root.found = root.found && root.before.negative == a.negative && root.after.negative == b.negative;
  add_event(search, type, root, a.negative, b.negative);
  if (root.found) search.out.events.back().cause = cause_of(search, root, first_value, a, b);
}

/// Whether the load turns at a kink where the tangent is singular: two paths that cross there, and the step
/// went from one to the other. (At a limit point the load turns smoothly, at a contact's kink nothing is
/// singular.)
bool changes_paths(const Search& search, const LocatedRoot& root, double first_rate) {
  constexpr double kSingular = 1e-3;  // det there, over that at the start of the step
  const double left = std::min(std::abs(root.value_before), std::abs(root.value_after));
  const double det = std::max(root.before.log_abs_det, root.after.log_abs_det) - search.log_abs_det;
  return left > kJump * first_rate && det < std::log(kSingular);
}

/// A simple point by Newton's method from the softest motions; false when it is not found so.
bool locate_by_modes(Search& search, const PathPoint& a, const PathPoint& b, bool limit) {
  if (search.chord.displacement_only) return false;
  auto event = crossing_between(search.continuation, search.chord, a, b, limit, search.options);
  if (!event) return false;
  search.out.events.push_back(*std::move(event));
  return true;
}

void locate_limit(Search& search, const PathPoint& a, const PathPoint& b) {
  if (locate_by_modes(search, a, b, true)) return;
  const auto rate = [&search](const PathPoint& at) {
    return search.continuation.load_rate(search.chord, at);
  };
  const double least = search.continuation.least_load();
  const auto done = [&](const PathPoint& lo, const PathPoint& hi, double value) {
    const double length = search.continuation.distance_along(search.chord, lo, hi);
    const double size = std::max(std::abs(lo.lambda), least);
    return std::abs(value) * length <= 0.1 * search.options.tolerance * size &&
           loads_agree(lo.lambda, hi.lambda, search.options.tolerance, least) &&
           length <= std::min(kSamePath, 10.0 * search.options.tolerance);
  };
  LocatedRoot root = find_root(search.continuation, search.chord, a, rate(a), b, rate(b), rate, done);
  const double first_rate = std::max(std::abs(rate(a)), std::abs(rate(b)));
  root.found = root.found && !changes_paths(search, root, first_rate);
  add_simple_event(search, limit_type(a), root, first_rate, a, b);
}

void locate_bifurcation(Search& search, const PathPoint& a, const PathPoint& b) {
  if (locate_by_modes(search, a, b, false)) return;
  const auto value = [&search](const PathPoint& at) { return bifurcation_function(search, at); };
  // a bifurcation broken by an imperfection e looks whole from further than e^(2/3) in the load
  const double tolerance = std::min(search.options.tolerance, kBrokenBifurcation);
  const auto done = [&search, tolerance](const PathPoint& lo, const PathPoint& hi, double) {
    return loads_agree(lo.lambda, hi.lambda, tolerance, search.continuation.least_load());
  };
  const LocatedRoot root =
      find_root(search.continuation, search.chord, a, value(a), b, value(b), value, done);
  add_simple_event(search, CriticalType::bifurcation, root, std::max(std::abs(value(a)), std::abs(value(b))),
                   a, b);
}

/// What cannot be separated any more: a limit point if the load turns, and a bifurcation for the other
/// eigenvalues.
void add_cluster(Search& search, const PathPoint& a, const PathPoint& b, bool turns, bool together) {
  const LocatedRoot root{a, b, a, 0.0, 0.0, together};
  int between = a.negative;
  if (turns) {
    between += b.negative >= a.negative ? 1 : -1;
    add_event(search, limit_type(a), root, a.negative, between);
  }
  if (between != b.negative) add_event(search, CriticalType::bifurcation, root, between, b.negative);
}

void search_between(Search& search, const PathPoint& a, const PathPoint& b, int depth);

double softest(const PathPoint& at) { return at.modes ? std::abs(at.modes->stiffness[0]) : 0.0; }

/// The point between two others, with its softest motions where those of the ends are known.
std::optional<PathPoint> look(Search& search, const PathPoint& a, const PathPoint& b, double share) {
  auto middle = search.continuation.between(search.chord, a, b, share);
  const PathPoint& near = share < 0.5 ? a : b;
  if (middle && near.modes) search.continuation.find_modes(*middle, near.modes);
  return middle;
}

/// Distance at which a value with this rate vanishes when it bends towards zero by this much a squared
/// distance.
double bent_to_zero(double value, double rate, double bend) {
  return 2.0 * value / (std::sqrt(rate * rate + 4.0 * bend * value) - rate);
}

/// Where between the ends a stiffness may lie beyond zero although its tangents do not: when it bends, at
/// either end, as sharply as a change between the ends asks for that half of the way brings about.
std::optional<double> bent_dip(const Cubic& stiffness) {
  constexpr double kHalf = 4.0;  // a change in half of the way, by the square of the way
  const double change = stiffness.f1 - stiffness.f0;
  const double bend = kHalf * std::max(std::abs(change - stiffness.m0), std::abs(change - stiffness.m1));
  const double from = bent_to_zero(stiffness.f0, stiffness.m0, bend);
  const double to = 1.0 - bent_to_zero(stiffness.f1, -stiffness.m1, bend);
  return from < to ? std::optional(0.5 * (from + to)) : std::nullopt;
}

/// A place to look at where the stiffness of a motion that both ends have may lie beyond zero, as before a
/// knee, where it falls from what it was and rises faster than the tangents at the ends tell.
std::optional<double> dip_before_knee(const Search& search, const PathPoint& a, const PathPoint& b,
                                      double length) {
  constexpr double kSame = 0.7;  // of a motion that is the other's
  if (!a.modes || !b.modes) return std::nullopt;
  const PathMetric& metric = search.continuation.metric();
  for (Index i = 0; i < a.modes->count(); ++i) {
    const double sign = std::copysign(1.0, a.modes->stiffness[i]);
    for (Index j = 0; j < b.modes->count(); ++j) {
      if (sign * b.modes->stiffness[j] <= 0.0) continue;
      if (std::abs(metric.inner(a.modes->motions.col(i), 0.0, b.modes->motions.col(j), 0.0)) < kSame)
        continue;
      const auto share = bent_dip({sign * a.modes->stiffness[i], sign * length * a.modes->rate[i],
                                   sign * b.modes->stiffness[j], sign * length * b.modes->rate[j]});
      if (share) return share;
    }
  }
  return std::nullopt;
}

/// Looks into a dip of a motion's stiffness.
void search_dip(Search& search, const PathPoint& a, const PathPoint& b, int depth) {
  constexpr double kRounding = 1e-10;  // of a stiffness, beside that at the ends of the step
  const double length = search.continuation.distance_along(search.chord, a, b);
  const auto dip = find_dip(a, b, length);
  auto share = dip ? std::optional(dip->share) : std::nullopt;
  if (!share && search.guesses < kMostGuesses) {
    share = dip_before_knee(search, a, b, length);
    search.guesses += share ? 1 : 0;
  }
  if (!share || depth >= kMaxDepth) return;
  const auto middle = look(search, a, b, *share);
  if (!middle || !middle->modes) return;
  if (softest(*middle) <= kRounding * search.stiffness) {
    search.out.touching.push_back(*middle);
    return;
  }
  search_between(search, a, *middle, depth + 1);
  if (search.out.same_path) search_between(search, *middle, b, depth + 1);
}

/// Where the cubic through both ends' loads and load rates turns although it does not turn at the ends.
/// Within a step that was looked into the load must have changed by less than both ends' rates make it, which
/// a jump of the rate at a kink does not do, and by more than the tolerance.
std::optional<double> hidden_turn(const Search& search, const PathPoint& a, const PathPoint& b, int depth) {
  const Continuation& path = search.continuation;
  const double length = path.distance_in(search.chord, a, b);
  const Cubic load{a.lambda, length * path.load_rate(search.chord, a), b.lambda,
                   length * path.load_rate(search.chord, b)};
  const double less = std::min(std::abs(load.m0), std::abs(load.m1)) - std::abs(load.f1 - load.f0);
  const double least = search.options.tolerance * std::max(std::abs(a.lambda), path.least_load());
  if (depth > 0 && less <= least) return std::nullopt;
  const auto at = load.inflection();
  return at && (load.slope(*at) > 0.0) != (load.m0 > 0.0) ? at : std::nullopt;
}

/// Searches both sides of a turn that the ends do not show; false when there is none to be seen.
bool search_turn(Search& search, const PathPoint& a, const PathPoint& b, int depth) {
  if (search.guesses >= kMostGuesses) return false;
  const auto share = hidden_turn(search, a, b, depth);
  const auto inside = share ? look(search, a, b, *share) : std::nullopt;
  if (!inside) return false;
  ++search.guesses;
  search_between(search, a, *inside, depth + 1);
  if (search.out.same_path) search_between(search, *inside, b, depth + 1);
  return true;
}

void search_between(Search& search, const PathPoint& a, const PathPoint& b, int depth) {
  const int change = std::abs(b.negative - a.negative);
  const bool turns = (a.tangent_lambda > 0.0) != (b.tangent_lambda > 0.0);
  if (!turns && (change == 0 || depth == 0) && search_turn(search, a, b, depth)) return;
  if (change == 0 && !turns) {
    search_dip(search, a, b, depth);
    return;
  }
  if (change == 1) {
    if (turns)
      locate_limit(search, a, b);
    else
      locate_bifurcation(search, a, b);
    return;
  }
  if (apart(search.continuation, search.chord, a, b)) {
    search.out.same_path = false;
    return;
  }
  const double length = search.continuation.distance_along(search.chord, a, b);
  const bool together = length <= kSamePath && loads_agree(a.lambda, b.lambda, search.options.tolerance,
                                                           search.continuation.least_load());
  std::optional<PathPoint> middle;
  if (!together && depth < kMaxDepth) middle = look(search, a, b, 0.5);
  if (!middle) {
    add_cluster(search, a, b, turns, together);
    return;
  }
  search_between(search, a, *middle, depth + 1);
  if (search.out.same_path) search_between(search, *middle, b, depth + 1);
}

}  // namespace

namespace {

constexpr double kLeastShare = 1e-5;  ///< of a bracket that a place is from its ends
constexpr double kOtherShare = 0.37;  ///< where to look when no point was found

/// As far beyond an estimate near an end of a bracket as it is from there, so that the bracket closes from
/// both sides.
double just_beyond(double place, double from, double to) {
  constexpr double kNear = 0.1;
  const double share = (place - from) / (to - from);
  if (share < kNear) return from + 2.0 * (place - from);
  if (share > 1.0 - kNear) return to - 2.0 * (to - place);
  return place;
}

}  // namespace

LocatedRoot find_root(Continuation& continuation, const Chord& chord, const PathPoint& a, double value_a,
                      const PathPoint& b, double value_b,
                      const std::function<double(const PathPoint&)>& value,
                      const std::function<bool(const PathPoint&, const PathPoint&, double)>& done) {
  LocatedRoot out{a, b, a, value_a, value_b};
  SignBracket bracket(0.0, value_a, 1.0, value_b);
  const bool at_an_end = value_a == 0.0 || value_b == 0.0;
  double from = 0.0;  // share of the way from a to b at which the bracket begins
  double to = 1.0;
  for (int it = 0; it < kMaxEvaluations && !apart(continuation, chord, out.before, out.after); ++it) {
    const double best = std::min(std::abs(out.value_before), std::abs(out.value_after));
    out.found = at_an_end || done(out.before, out.after, best);
    if (out.found) break;
    const auto point_at = [&](double place) {
      return continuation.between(chord, out.before, out.after, (place - from) / (to - from));
    };
    double place = just_beyond(bracket.next(kLeastShare), from, to);
    auto point = point_at(place);
    if (!point) point = point_at(place = from + kOtherShare * (to - from));
    if (!point) break;
    double v = value(*point);
    // on a zero that a look meets the inertia is one side's or the other's, and so is the point
    if (v == 0.0)
      v = std::copysign(std::numeric_limits<double>::min(),
                        point->negative == a.negative ? value_a : value_b);
    bracket.take(place, v);
    const bool at_start = (v > 0.0) == (value_a > 0.0);
    (at_start ? from : to) = place;
    (at_start ? out.value_before : out.value_after) = v;
    (at_start ? out.before : out.after) = std::move(*point);
  }
  out.root = std::abs(out.value_before) <= std::abs(out.value_after) ? out.before : out.after;
  return out;
}

void move_to_load(Continuation& continuation, double load, PathPoint& at) {
  if (load == 0.0 || std::abs(at.lambda - load) <= kSameLoadFactor * std::abs(load)) return;
  PathPoint moved = at;
  // along the tangent: a little load moves the structure by less than its equilibrium is corrected to
  if (at.tangent_lambda != 0.0) moved.y += ((load - at.lambda) / at.tangent_lambda) * at.tangent;
  moved.lambda = load;
  const double size = continuation.metric().norm(at.y, 0.0);
  if (size == 0.0 || continuation.correct_at_load(size, moved)) at = std::move(moved);
}

PathPoint point_at_load(Continuation& continuation, const PathPoint& a, const PathPoint& b, double load) {
  const double size = std::abs(b.lambda - a.lambda);
  const auto value = [load](const PathPoint& at) { return at.lambda - load; };
  const auto done = [size](const PathPoint&, const PathPoint&, double v) {
    return std::abs(v) <= 1e-12 * size;
  };
  PathPoint point =
      find_root(continuation, continuation.chord(a, b), a, value(a), b, value(b), value, done).root;
  move_to_load(continuation, load, point);
  return point;
}

namespace {

constexpr double kSamePlace = 1e-3;  ///< distance within which rounding tells no two apart

/// Whether two events are at one place, as far as rounding near singular points lets one say.
bool at_one_place(const Continuation& continuation, double tolerance, const CriticalEvent& a,
                  const CriticalEvent& b) {
  const double agree = 10.0 * std::max(tolerance, 1e-9);
  return loads_agree(a.point.lambda, b.point.lambda, agree, continuation.least_load()) &&
         continuation.distance(a.point, b.point) <= kSamePlace;
}

/// Joins neighbouring events at one place. Bifurcations add up to one of higher multiplicity. On a path that
/// crosses another at a symmetric bifurcation the load has an extremum there and an eigenvalue touches zero:
/// a limit point and a bifurcation which leave the inertia as it was are that one bifurcation.
void merge_events(Continuation& continuation, double tolerance, std::vector<CriticalEvent>& events) {
  for (std::size_t i = 0; i + 1 < events.size();) {
    CriticalEvent& first = events[i];
    const CriticalEvent second = events[i + 1];
    const bool bifurcations =
        first.type == CriticalType::bifurcation && second.type == CriticalType::bifurcation;
    const bool one_limit =
        (first.type == CriticalType::bifurcation) != (second.type == CriticalType::bifurcation);
    const bool crossing = one_limit && first.negative_before == second.negative_after;
    if (!(bifurcations || crossing) || !at_one_place(continuation, tolerance, first, second)) {
      ++i;
      continue;
    }
    const int before = first.negative_before;
    if (first.type != CriticalType::bifurcation) first = second;
    first.negative_before = before;
    first.negative_after = second.negative_after;
    first.multiplicity = std::max(1, std::abs(first.negative_after - before));
    events.erase(events.begin() + static_cast<std::ptrdiff_t>(i) + 1);
  }
}

}  // namespace

std::optional<Dip> find_dip(const PathPoint& a, const PathPoint& b, double length) {
  if (!a.modes || !b.modes) return std::nullopt;
  const SoftModes& from = *a.modes;
  const SoftModes& to = *b.modes;
  for (Index i = 0; i < from.count(); ++i) {
    for (Index j = 0; j < to.count(); ++j) {
      if ((from.stiffness[i] > 0.0) != (to.stiffness[j] > 0.0)) continue;
      if (!(from.distance_to_zero(i, 1.0) + to.distance_to_zero(j, -1.0) < length)) continue;
      const double meet =
          (to.stiffness[j] - from.stiffness[i] - to.rate[j] * length) / (from.rate[i] - to.rate[j]);
      return Dip{i, std::clamp(meet / length, 1e-3, 1.0 - 1e-3)};
    }
  }
  return std::nullopt;
}

LocatedEvents locate_critical_points(Continuation& continuation, const PathPoint& a, const PathPoint& b,
                                     const LocateOptions& options) {
  LocatedEvents out;
  Search search{continuation, continuation.chord(a, b),        a.log_abs_det, options,
                out,          std::max(softest(a), softest(b))};
  search_between(search, a, b, 0);
  merge_events(continuation, options.tolerance, out.events);
  const auto same = [&](const PathPoint& one, const PathPoint& other) {
    return continuation.distance(one, other) <= kSamePlace;
  };
  out.touching.erase(std::unique(out.touching.begin(), out.touching.end(), same), out.touching.end());
  return out;
}

namespace {

/// What cannot be bracketed at a kink is at the last point before it.
std::vector<CriticalEvent> events_before(const PathPoint& kink, const PathPoint& to) {
  std::vector<CriticalEvent> events;
  CriticalEvent event;
  event.cause = CriticalCause::contact;
  event.point = kink;
  event.bracket_loads[0] = kink.lambda;
  event.bracket_loads[1] = to.lambda;
  event.negative_before = kink.negative;
  event.negative_after = kink.negative;
  if ((kink.tangent_lambda > 0.0) != (to.tangent_lambda > 0.0)) {
    event.type = limit_type(kink);
    event.negative_after += to.negative >= kink.negative ? 1 : -1;
    events.push_back(event);
  }
  if (event.negative_after == to.negative) return events;
  event.type = CriticalType::bifurcation;
  event.negative_before = event.negative_after;
  event.negative_after = to.negative;
  event.multiplicity = std::abs(event.negative_after - event.negative_before);
  events.push_back(event);
  return events;
}

}  // namespace

LocatedEvents locate_at_kink(Continuation& continuation, const PathPoint& a, const PathPoint& b, double size,
                             const LocateOptions& options) {
  LocatedEvents out;
  Search search{continuation, continuation.displacement_chord(a, b), a.log_abs_det, options, out};
  search_between(search, a, b, 0);
  if (out.same_path) return out;
  PathPoint kink = continuation.last_before_kink(a, size);
  kink.arc_length = std::nextafter(kink.arc_length, std::numeric_limits<double>::infinity());
  return {events_before(kink, b), true, {}};
}

}  // namespace snapthrough
