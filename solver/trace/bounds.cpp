#include "solver/trace/bounds.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "solver/events/root_finder.h"

namespace snapthrough {
namespace {

/// Numbers of the search for a bound; relative to the change of the quantity on the step.
struct BoundSearch {
  static constexpr double zero = 1e-12;       ///< a difference to the bound that is none
  static constexpr double reached = 1e-9;     ///< a difference that remains where corrections fail
  static constexpr double went_back = 1e-12;  ///< motion against the rate, relative to the quantity
  /// Length of a step, in the path's norm, on which the rate of a quantity may jump.
  static constexpr double short_step = 1e-6;
};

/// A bound that a step crossed: a function of the path that is zero there.
struct Crossing {
  TraceEnd end = TraceEnd::load_factor;
  std::function<double(const PathPoint&)> value;
  double bound = 0.0;  ///< value of the quantity there
};

std::optional<Crossing> crossing_of(const BoundedQuantity& quantity, TraceEnd end, const PathPoint& to) {
  const double now = quantity.value(to);
  if (now >= quantity.range[0] && now <= quantity.range[1]) return std::nullopt;
  const double bound = now < quantity.range[0] ? quantity.range[0] : quantity.range[1];
  return Crossing{
      end, [value = quantity.value, bound](const PathPoint& point) { return value(point) - bound; }, bound};
}

/// Whether a quantity has moved against its rate, which has one sign at both ends of a step: it turned twice.
bool went_back(double from, double to, bool goes_up) {
  return (goes_up ? from - to : to - from) > BoundSearch::went_back * std::abs(from);
}

/// Locates a crossing on a step.
BoundedEnd end_at(PointSolver& solver, const Crossing& crossing, const PathPoint& from, const PathPoint& to,
                  bool kink) {
  const double value_from = crossing.value(from);
  const double value_to = crossing.value(to);
  const double size = std::abs(value_to - value_from);
  const RootFunction function{crossing.value, [size](const PathPoint&, const PathPoint&, double value) {
                                return std::abs(value) <= BoundSearch::zero * size;
                              }};
  const LocatedRoot root = find_root(Segment(solver, from, to), value_from, value_to, function);
  const bool outside_before = (value_from > 0.0) == (value_to > 0.0);
  // a rate jumps at a kink, which then is where it changes its sign
  const bool jumps = crossing.end == TraceEnd::monitor_turned &&
                     (kink || solver.norm().distance(from, to) < BoundSearch::short_step);
  const double left = std::min(std::abs(root.value_before), std::abs(root.value_after));
  const bool found = root.found || outside_before || jumps || left <= BoundSearch::reached * size;
  return {root.root, found, crossing.end};
}

/// Locates the end of a step on a bound of the load, at that load; elsewhere where the step began beyond it.
BoundedEnd end_at_load(PointSolver& solver, const Crossing& crossing, const PathPoint& from,
                       const PathPoint& to, bool kink) {
  // a step that loses the path before the bound may have its other end on another path
  BoundedEnd end = end_at(solver, crossing, from, to, kink);
  if (!end.found || (crossing.value(from) > 0.0) == (crossing.value(to) > 0.0)) return end;
  std::optional<PathPoint> at = point_at_load(solver, from, to, crossing.bound);
  const bool found = at.has_value();
  return {found ? *std::move(at) : to, found, crossing.end};
}

}  // namespace

std::optional<BoundedEnd> first_bound(PointSolver& solver, const TraceRules& rules, const PathPoint& from,
                                      const PathPoint& to, bool kink) {
  std::vector<Crossing> crossings;
  const auto add = [&](std::optional<Crossing> crossing) {
    if (crossing) crossings.push_back(*std::move(crossing));
  };
  if (rules.load)
    add(crossing_of({[](const PathPoint& point) { return point.lambda; }, *rules.load}, TraceEnd::load_factor,
                    to));
  if (rules.capacity)
    add(crossing_of({[](const PathPoint& point) { return point.lambda; }, rules.capacity->range},
                    TraceEnd::capacity, to));
  if (rules.monitor) add(crossing_of(*rules.monitor, TraceEnd::monitor, to));
  if (rules.controlled) {
    const Quantity& controlled = *rules.controlled;
    const bool goes_up = controlled.rate(from) > 0.0;
    if (goes_up != (controlled.rate(to) > 0.0))
      crossings.push_back({TraceEnd::monitor_turned, controlled.rate, 0.0});
    else if (went_back(controlled.value(from), controlled.value(to), goes_up))
      return BoundedEnd{to, false, TraceEnd::monitor_turned};
  }
  std::optional<BoundedEnd> first;
  for (const Crossing& crossing : crossings) {
    const bool is_load = crossing.end == TraceEnd::load_factor || crossing.end == TraceEnd::capacity;
    BoundedEnd end =
        is_load ? end_at_load(solver, crossing, from, to, kink) : end_at(solver, crossing, from, to, kink);
    if (first && end.found && first->point.arc_length <= end.point.arc_length) continue;
    first = std::move(end);
    if (!first->found) break;
  }
  return first;
}

}  // namespace snapthrough
