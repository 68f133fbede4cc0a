#include "solver/events/contact_change.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "solver/numeric/bracket.h"

namespace snapthrough {
namespace {

/// Fractions of the bracket where no unit is given. Source: rounding of penetrations, docs/decisions/0011.
struct ChangeLimits {
  static constexpr int corrections = 25;   ///< corrected points for each change
  static constexpr int changes = 200;      ///< changes located per step
  static constexpr double at_once = 1e-6;  ///< where new contact zones are deeper than rounding
  static constexpr double beyond = 1.5;    ///< factor on a prediction's distance from the nearer end
  static constexpr double margin = 1e-6;   ///< least distance of a trial from the ends
  static constexpr double closed = 1e-3;   ///< distance of the ends of a closed bracket, in the path's norm
};

/// Two path points around a contact change: zone counts are unchanged at `before` and changed at `after`.
struct Bracket {
  PathPoint before;
  PathPoint after;
};

/// Fraction of a bracket at which the interpolated path leaves the old counts.
double predicted_fraction(const Segment& bracket, const ZoneCounter& count, const std::vector<int>& old) {
  std::vector<int> zones;
  PathPoint point;
  return bisect(0.0, 1.0, 1e-9, [&](double fraction) {
    bracket.interpolate(fraction, point);
    count(point.y, zones);
    return zones != old;
  });
}

/// Whether the counts change at the start of a segment itself, so that they are others at once beyond it:
/// where the load begins, everything that touches touches from nothing. Sets the counts beyond.
bool changes_at_start(const Segment& segment, const ZoneCounter& count, const std::vector<int>& old,
                      std::vector<int>& beyond) {
  PathPoint point;
  segment.interpolate(ChangeLimits::at_once, point);
  count(point.y, beyond);
  return beyond != old;
}

/// Fraction slightly past the prediction, seen from the nearer end: the bracket shrinks from both sides.
double next_fraction(double predicted) {
  const double beyond =
      predicted < 0.5 ? ChangeLimits::beyond * predicted : 1.0 - ChangeLimits::beyond * (1.0 - predicted);
  return std::clamp(beyond, ChangeLimits::margin, 1.0 - ChangeLimits::margin);
}

bool is_closed(const PathNorm& norm, const Bracket& bracket, double tolerance) {
  const double size =
      std::max({std::abs(bracket.before.lambda), std::abs(bracket.after.lambda), norm.least_load()});
  return std::abs(bracket.after.lambda - bracket.before.lambda) <= tolerance * size &&
         norm.distance(bracket.before, bracket.after) <= ChangeLimits::closed;
}

/// Shrinks the bracket around its first change to the tolerance; false when no corrected point was found.
bool close(const Segment& step, const ZoneCounter& count, const std::vector<int>& old, double tolerance,
           Bracket& bracket) {
  std::vector<int> zones;
  for (int i = 0; i < ChangeLimits::corrections && !is_closed(step.solver().norm(), bracket, tolerance);
       ++i) {
    const Segment piece = step.part(bracket.before, bracket.after);
    auto point = piece.point_at(next_fraction(predicted_fraction(piece, count, old)));
    if (!point) point = piece.point_at(0.5);
    if (!point) return false;
    count(point->y, zones);
    (zones == old ? bracket.before : bracket.after) = std::move(*point);
  }
  return true;
}

}  // namespace

std::vector<ContactChange> locate_contact_changes(PointSolver& solver, const PathPoint& a, const PathPoint& b,
                                                  bool at_kink, const ZoneCounter& count, double tolerance) {
  std::vector<ContactChange> out;
  std::vector<int> old;
  std::vector<int> last;
  count(a.y, old);
  count(b.y, last);
  if (old == last) return out;
  const Segment step(solver, a, b, at_kink ? Segment::Measure::displacement : Segment::Measure::path_norm);
  PathPoint from = a;
  std::vector<int> beyond;
  if (changes_at_start(step, count, old, beyond)) {
    out.push_back({a, a, old, beyond});
    old = std::move(beyond);
  }
  while (old != last && out.size() < ChangeLimits::changes) {
    Bracket bracket{from, b};
    const bool closed = close(step, count, old, tolerance, bracket);
    ContactChange change;
    change.before = old;
    count(bracket.after.y, old);
    change.after = old;
    change.last_before = bracket.before;
    // at a kink the contact change is next to the start of the step
    change.point = at_kink && !closed ? bracket.before : bracket.after;
    out.push_back(std::move(change));
    from = std::move(bracket.after);
  }
  return out;
}

}  // namespace snapthrough
