#include "solver/events/root_finder.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "solver/numeric/bracket.h"

namespace snapthrough {
namespace {

/// Numbers of the bracketed secant; fractions of the bracket. Source: docs/decisions/0022.
struct RootSearch {
  static constexpr int most_points = 100;         ///< points that are corrected at most
  static constexpr double least_fraction = 1e-5;  ///< least distance of a trial from the bracket's ends
  static constexpr double near_end = 0.1;         ///< an estimate nearer to an end is moved away from it
  static constexpr double other = 0.37;           ///< where to look when the correction failed
  static constexpr double zero = 1e-12;           ///< value over the first difference that counts as zero
  /// Distance of points on one path over their distance along the segment's direction, at most.
  static constexpr double steepest = 10.0;
  /// Length of the way between two points over their distance, at most: that round a right angle is 1.4.
  static constexpr double longest_way = 2.0;
  static constexpr int corrections = 60;  ///< most corrections that lower the energy
};

/// A place as far beyond an estimate near an end of a bracket as the estimate is from that end.
double just_beyond(double place, double from, double to) {
  const double fraction = (place - from) / (to - from);
  if (fraction < RootSearch::near_end) return from + 2.0 * (place - from);
  if (fraction > 1.0 - RootSearch::near_end) return to - 2.0 * (to - place);
  return place;
}

/// Whether a point lies where a path between two others may lead.
bool is_between(const PointSolver& solver, const PathPoint& a, const PathPoint& b, const PathPoint& point) {
  const PathNorm& norm = solver.norm();
  return norm.distance(a, point) + norm.distance(point, b) <=
         RootSearch::longest_way * norm.distance(a, b) + LocatedPoints::same_path;
}

/// The equilibrium at a load by corrections that lower the energy, from either end of a bracket: Newton's
/// method cycles between contact states where several supports begin to act within the bracket.
std::optional<PathPoint> point_of_least_energy(PointSolver& solver, const LocatedRoot& bracket, double load) {
  if (!solver.problem().traits().one_sided) return std::nullopt;
  for (const PathPoint* end : {&bracket.root, &bracket.before, &bracket.after}) {
    PathPoint point = *end;
    point.lambda = load;
    const double size = std::max(solver.norm().metric().norm(end->y, 0.0), kRoundingResidual);
    const auto outcome = solver.correct_by_least_energy(size, RootSearch::corrections, point);
    if (outcome.status != CorrectorStatus::converged) continue;
    point.negative = count_next_to(end->negative, outcome.tangent);
    return point;
  }
  return std::nullopt;
}

}  // namespace

bool on_different_paths(const Segment& segment) {
  return segment.distance() > RootSearch::steepest * segment.length() + LocatedPoints::same_path;
}

LocatedRoot find_root(const Segment& segment, double value_from, double value_to,
                      const RootFunction& function) {
  LocatedRoot out{segment.from(), segment.to(), segment.from(), value_from, value_to};
  SignBracket bracket(0.0, value_from, 1.0, value_to);
  const bool at_an_end = value_from == 0.0 || value_to == 0.0;
  double from = 0.0;  // fractions of the segment at which the bracket begins and ends
  double to = 1.0;
  for (int it = 0; it < RootSearch::most_points; ++it) {
    const Segment piece = segment.part(out.before, out.after);
    if (on_different_paths(piece)) break;
    const double least = std::min(std::abs(out.value_before), std::abs(out.value_after));
    out.found = at_an_end || function.is_closed(out.before, out.after, least);
    if (out.found) break;
    double place = just_beyond(bracket.next(RootSearch::least_fraction), from, to);
    auto point = piece.point_at((place - from) / (to - from));
    if (!point) {
      place = from + RootSearch::other * (to - from);
      point = piece.point_at((place - from) / (to - from));
    }
    if (!point) break;
    double value = function.value(*point);
    // on a zero the inertia is that of one side, and so is the point
    if (value == 0.0)
      value = std::copysign(std::numeric_limits<double>::min(),
                            point->negative == segment.from().negative ? value_from : value_to);
    bracket.take(place, value);
    const bool at_start = (value > 0.0) == (value_from > 0.0);
    (at_start ? from : to) = place;
    (at_start ? out.value_before : out.value_after) = value;
    (at_start ? out.before : out.after) = std::move(*point);
  }
  out.root = std::abs(out.value_before) <= std::abs(out.value_after) ? out.before : out.after;
  return out;
}

std::optional<PathPoint> moved_to_load(PointSolver& solver, double load, const PathPoint& point) {
  if (std::abs(point.lambda - load) <= kSameLoadFactor * std::abs(load)) return point;
  PathPoint moved = point;
  // along the tangent: a little load moves the structure by less than its equilibrium is corrected to
  if (point.tangent_lambda != 0.0) moved.y += ((load - point.lambda) / point.tangent_lambda) * point.tangent;
  moved.lambda = load;
  const double size = std::max(solver.norm().metric().norm(point.y, 0.0), kRoundingResidual);
  if (!solver.correct_at_load(size, moved)) return std::nullopt;
  return moved;
}

std::optional<PathPoint> point_at_load(PointSolver& solver, const PathPoint& a, const PathPoint& b,
                                       double load) {
  const double size = std::abs(b.lambda - a.lambda);
  const RootFunction function{[load](const PathPoint& point) { return point.lambda - load; },
                              [size](const PathPoint&, const PathPoint&, double v) {
                                return std::abs(v) <= RootSearch::zero * size;
                              }};
  const LocatedRoot root = find_root(Segment(solver, a, b), function.value(a), function.value(b), function);
  std::optional<PathPoint> point = moved_to_load(solver, load, root.root);
  if (point && is_between(solver, a, b, *point)) return point;
  // nothing may hold a structure without load
  if (load == 0.0 && root.found) return root.root;
  point = point_of_least_energy(solver, root, load);
  if (point && is_between(solver, a, b, *point)) return point;
  return std::nullopt;
}

}  // namespace snapthrough
