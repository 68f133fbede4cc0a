#include "solver/events/locate.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <utility>

#include "solver/events/hidden_events.h"
#include "solver/events/newton_event.h"
#include "solver/events/root_finder.h"

namespace snapthrough {

namespace {

/// Numbers of the search on one step; ratios without unit. Source: docs/decisions/0010 and 0022.
struct LocateLimits {
  static constexpr int depth = 48;  ///< bisections of a step at most
  /// Points that are corrected on a step because of hidden_events.h alone: on a plateau rounding asks for one
  /// on every part.
  static constexpr int guesses = 12;
  /// Relative load to which a bifurcation is located at least: a bifurcation with an imperfection of 1e-14,
  /// as rounding of the nodes' coordinates makes it, looks perfect from further away.
  static constexpr double bifurcation_load = 1e-9;
  /// Value of a function at a closed bracket, over that at the first bracket's ends, which only a jump of the
  /// tangent leaves.
  static constexpr double jump = 1e-3;
  /// With one-sided supports: contact changes in a closed bracket where the function exceeds this factor
  /// times the value that a linear function would have there.
  static constexpr double curved = 10.0;
  /// Determinant at a turn of the load, over that at the step's start, which is that of a crossing of paths.
  static constexpr double singular = 1e-3;
  /// Stiffness beside that at the ends of the step which is zero to rounding.
  static constexpr double no_stiffness = 1e-10;
  /// Share of the tolerance on the load that the rate of the load may leave at a limit point.
  static constexpr double limit_share = 0.1;
  /// Distance of two events that rounding does not tell apart, in the path's norm.
  static constexpr double same_place = 1e-3;
  /// Factor on the tolerance, and least relative load, within which two events have one load.
  static constexpr double same_load = 10.0;
};

/// State of the search on one step.
struct Search {
  PointSolver& solver;
  const Segment& step;  ///< places are measured along its direction
  const LocateOptions& options;
  LocatedEvents& out;
  double stiffness = 0.0;  ///< stiffness of the softest motion at the ends of the step
  int guesses = 0;         ///< points that were corrected because of hidden_events.h alone
};

bool loads_agree(double l0, double l1, double tolerance, double least) {
  return std::abs(l1 - l0) <= tolerance * std::max({std::abs(l0), std::abs(l1), least});
}

/// det(J) / (dlambda/ds), scaled by its size at the start of the step.
double bifurcation_function(const Search& search, const PathPoint& point) {
  return point.determinant(search.step.from().log_abs_det) / search.step.load_rate(point);
}

/// Cause of a sign change in a closed bracket. A function that does not pass zero there jumps, because a
/// support begins or ceases to act; a smooth one leaves its share of the first value when the step itself is
/// short.
CriticalCause cause_of(const Search& search, const LocatedRoot& root, double first_value,
                       const Segment& piece) {
  const double share = piece.part(root.before, root.after).length() / piece.length();
  const double left = std::max(std::abs(root.value_before), std::abs(root.value_after));
  const double least = std::max(LocateLimits::jump, LocateLimits::curved * share) * std::abs(first_value);
  return search.solver.problem().traits().one_sided && left > least ? CriticalCause::contact
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
    event.point.tangent = search.step.direction();
    event.point.tangent_lambda = search.step.direction_lambda();
  }
  event.negative_before = before;
  event.negative_after = after;
  event.multiplicity = std::max(1, std::abs(after - before));
  event.bracket_loads[0] = root.before.lambda;
  event.bracket_loads[1] = root.after.lambda;
  search.out.events.push_back(std::move(event));
}

/// Adds a simple event of a piece; a closed bracket whose ends do not have the inertia of the piece's ends is
/// on another path.
void add_simple_event(Search& search, CriticalType type, LocatedRoot root, double first_value,
                      const Segment& piece) {
  root.found = root.found && root.before.negative == piece.from().negative &&
               root.after.negative == piece.to().negative;
  add_event(search, type, root, piece.from().negative, piece.to().negative);
  if (root.found) search.out.events.back().cause = cause_of(search, root, first_value, piece);
}

/// Whether the load turns at a kink where the tangent is singular: two paths cross there, and the step went
/// from one to the other. (At a limit point the load turns smoothly, at a contact's kink nothing is
/// singular.)
bool changes_paths(const Search& search, const LocatedRoot& root, double first_rate) {
  const double left = std::min(std::abs(root.value_before), std::abs(root.value_after));
  const double det =
      std::max(root.before.log_abs_det, root.after.log_abs_det) - search.step.from().log_abs_det;
  return left > LocateLimits::jump * first_rate && det < std::log(LocateLimits::singular);
}

/// Adds the simple point of a piece by Newton's method; false when it is not found so.
bool locate_by_newton(Search& search, const Segment& piece, bool limit) {
  if (piece.by_displacement()) return false;
  auto event = crossing_between(search.solver, piece, limit, search.options);
  if (!event) return false;
  search.out.events.push_back(*std::move(event));
  return true;
}

void locate_limit(Search& search, const Segment& piece) {
  if (locate_by_newton(search, piece, true)) return;
  const double least_load = search.solver.norm().least_load();
  const double tolerance = search.options.tolerance;
  const RootFunction rate{[&](const PathPoint& point) { return search.step.load_rate(point); },
                          [&](const PathPoint& before, const PathPoint& after, double value) {
                            const double length = piece.part(before, after).length();
                            const double size = std::max(std::abs(before.lambda), least_load);
                            return std::abs(value) * length <= LocateLimits::limit_share * tolerance * size &&
                                   loads_agree(before.lambda, after.lambda, tolerance, least_load) &&
                                   length <= std::min(LocatedPoints::same_path, 10.0 * tolerance);
                          }};
  const double from = rate.value(piece.from());
  const double to = rate.value(piece.to());
  LocatedRoot root = find_root(piece, from, to, rate);
  const double first_rate = std::max(std::abs(from), std::abs(to));
  root.found = root.found && !changes_paths(search, root, first_rate);
  add_simple_event(search, limit_type(piece.from()), root, first_rate, piece);
}

void locate_bifurcation(Search& search, const Segment& piece) {
  if (locate_by_newton(search, piece, false)) return;
  // a bifurcation broken by an imperfection e looks perfect from further than e^(2/3) in the load
  const double tolerance = std::min(search.options.tolerance, LocateLimits::bifurcation_load);
  const RootFunction function{[&](const PathPoint& point) { return bifurcation_function(search, point); },
                              [&](const PathPoint& before, const PathPoint& after, double) {
                                return loads_agree(before.lambda, after.lambda, tolerance,
                                                   search.solver.norm().least_load());
                              }};
  const double from = function.value(piece.from());
  const double to = function.value(piece.to());
  const LocatedRoot root = find_root(piece, from, to, function);
  add_simple_event(search, CriticalType::bifurcation, root, std::max(std::abs(from), std::abs(to)), piece);
}

/// Adds what cannot be separated any more: a limit point if the load turns, and a bifurcation for the other
/// eigenvalues.
void add_cluster(Search& search, const Segment& piece, bool turns, bool together) {
  const PathPoint& a = piece.from();
  const PathPoint& b = piece.to();
  const LocatedRoot root{a, b, a, 0.0, 0.0, together};
  int between = a.negative;
  if (turns) {
    between += b.negative >= a.negative ? 1 : -1;
    add_event(search, limit_type(a), root, a.negative, between);
  }
  if (between != b.negative) add_event(search, CriticalType::bifurcation, root, between, b.negative);
}

void search_piece(Search& search, const Segment& piece, int depth);

double softest(const PathPoint& point) { return point.modes ? std::abs(point.modes->stiffness[0]) : 0.0; }

/// The point of a piece at a fraction, with its softest motions where those of the nearer end are known.
std::optional<PathPoint> look(Search& search, const Segment& piece, double fraction) {
  auto middle = piece.point_at(fraction);
  const PathPoint& near = fraction < 0.5 ? piece.from() : piece.to();
  if (middle && near.modes) search.solver.find_modes(*middle, near.modes);
  return middle;
}

void search_both_sides(Search& search, const Segment& piece, const PathPoint& middle, int depth) {
  search_piece(search, piece.part(piece.from(), middle), depth + 1);
  if (search.out.same_path) search_piece(search, piece.part(middle, piece.to()), depth + 1);
}

/// Looks for a pair of critical points where a motion's stiffness may fall beyond zero between the ends.
void search_dip(Search& search, const Segment& piece, int depth) {
  const auto dip = find_dip(piece.from(), piece.to(), piece.length());
  auto fraction = dip ? std::optional(dip->fraction) : std::nullopt;
  if (!fraction && search.guesses < LocateLimits::guesses) {
    fraction = knee_fraction(piece);
    search.guesses += fraction ? 1 : 0;
  }
  if (!fraction || depth >= LocateLimits::depth) return;
  const auto middle = look(search, piece, *fraction);
  if (!middle || !middle->modes) return;
  if (softest(*middle) <= LocateLimits::no_stiffness * search.stiffness) {
    search.out.touching.push_back(*middle);
    return;
  }
  search_both_sides(search, piece, *middle, depth);
}

/// Searches both sides of a turn of the load that the ends do not show; false when there is no sign of one.
bool search_turn(Search& search, const Segment& piece, int depth) {
  if (search.guesses >= LocateLimits::guesses) return false;
  const auto fraction = turn_fraction(piece, depth > 0, search.options.tolerance);
  const auto middle = fraction ? look(search, piece, *fraction) : std::nullopt;
  if (!middle) return false;
  ++search.guesses;
  search_both_sides(search, piece, *middle, depth);
  return true;
}

/// Separates several critical points of a piece by bisection.
void search_cluster(Search& search, const Segment& piece, bool turns, int depth) {
  if (on_different_paths(piece)) {
    search.out.same_path = false;
    return;
  }
  const bool together = piece.length() <= LocatedPoints::same_path &&
                        loads_agree(piece.from().lambda, piece.to().lambda, search.options.tolerance,
                                    search.solver.norm().least_load());
  std::optional<PathPoint> middle;
  if (!together && depth < LocateLimits::depth) middle = look(search, piece, 0.5);
  if (middle)
    search_both_sides(search, piece, *middle, depth);
  else
    add_cluster(search, piece, turns, together);
}

/// Decides by both ends' inertia and load rates how the critical points of a piece are located: none is to be
/// seen, one, or several.
void search_piece(Search& search, const Segment& piece, int depth) {
  const PathPoint& a = piece.from();
  const PathPoint& b = piece.to();
  const int change = std::abs(b.negative - a.negative);
  const bool turns = (a.tangent_lambda > 0.0) != (b.tangent_lambda > 0.0);
  if (!turns && (change == 0 || depth == 0) && search_turn(search, piece, depth)) return;
  if (change == 0 && !turns)
    search_dip(search, piece, depth);
  else if (change == 1 && turns)
    locate_limit(search, piece);
  else if (change == 1)
    locate_bifurcation(search, piece);
  else
    search_cluster(search, piece, turns, depth);
}

/// Whether two events are at one place, as far as rounding near singular points lets one say.
bool at_one_place(const PathNorm& norm, double tolerance, const CriticalEvent& a, const CriticalEvent& b) {
  const double agree = LocateLimits::same_load * std::max(tolerance, 1e-9);
  return loads_agree(a.point.lambda, b.point.lambda, agree, norm.least_load()) &&
         norm.distance(a.point, b.point) <= LocateLimits::same_place;
}

/// Joins neighbouring events at one place. Bifurcations add up to one of higher multiplicity. On a path that
/// crosses another at a symmetric bifurcation the load has an extremum there and an eigenvalue touches zero:
/// a limit point and a bifurcation which leave the inertia as it was are that one bifurcation.
void merge_events(const PathNorm& norm, double tolerance, std::vector<CriticalEvent>& events) {
  for (std::size_t i = 0; i + 1 < events.size();) {
    CriticalEvent& first = events[i];
    const CriticalEvent second = events[i + 1];
    const bool bifurcations =
        first.type == CriticalType::bifurcation && second.type == CriticalType::bifurcation;
    const bool one_limit =
        (first.type == CriticalType::bifurcation) != (second.type == CriticalType::bifurcation);
    const bool crossing = one_limit && first.negative_before == second.negative_after;
    if (!(bifurcations || crossing) || !at_one_place(norm, tolerance, first, second)) {
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

/// The changes between the last point before a kink and the step's end that cannot be bracketed.
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

LocatedEvents locate_critical_points(PointSolver& solver, const PathPoint& a, const PathPoint& b,
                                     const LocateOptions& options) {
  LocatedEvents out;
  const Segment step(solver, a, b);
  Search search{solver, step, options, out, std::max(softest(a), softest(b))};
  search_piece(search, step, 0);
  const PathNorm& norm = solver.norm();
  merge_events(norm, options.tolerance, out.events);
  const auto same = [&](const PathPoint& one, const PathPoint& other) {
    return norm.distance(one, other) <= LocateLimits::same_place;
  };
  out.touching.erase(std::unique(out.touching.begin(), out.touching.end(), same), out.touching.end());
  return out;
}

LocatedEvents locate_at_kink(PathFollower& follower, const PathPoint& a, const PathPoint& b, double size,
                             const LocateOptions& options) {
  LocatedEvents out;
  const Segment step(follower.solver(), a, b, Segment::Measure::displacement);
  Search search{follower.solver(), step, options, out};
  search_piece(search, step, 0);
  if (out.same_path) return out;
  PathPoint kink = follower.last_point_before_kink(a, size);
  const PathMetric& metric = follower.norm().metric();
  const double apart = metric.norm(b.y - kink.y, 0.0);
  if (apart > options.before_kink * metric.norm(b.y, 0.0) && size > Gradients::tiny) return {{}, false, {}};
  kink.arc_length = std::nextafter(kink.arc_length, std::numeric_limits<double>::infinity());
  return {events_before(kink, b), true, {}};
}

}  // namespace snapthrough
