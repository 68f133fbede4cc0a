#include "solver/events/contact_change.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "solver/numeric/bracket.h"

namespace snapthrough {
namespace {

constexpr int kMostCorrections = 25;
constexpr int kMostChanges = 200;  ///< largest number of contact changes located per step

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
  // fraction of the bracket at which new contact zones are deeper than rounding
  constexpr double kAtOnce = 1e-6;
  PathPoint point;
  segment.interpolate(kAtOnce, point);
  count(point.y, beyond);
  return beyond != old;
}

/// Fraction slightly past the prediction, seen from the nearer end: the bracket shrinks from both sides.
double next_fraction(double predicted) {
  constexpr double kBeyond = 1.5;  // factor on the distance from the nearer end
  constexpr double kLeast = 1e-6;  // distance from the bracket's ends, a fraction
  const double beyond = predicted < 0.5 ? kBeyond * predicted : 1.0 - kBeyond * (1.0 - predicted);
  return std::clamp(beyond, kLeast, 1.0 - kLeast);
}

bool is_closed(const PathNorm& norm, const Bracket& bracket, double tolerance) {
  constexpr double kNear = 1e-3;  // distance of the ends, in the path's norm
  const double size =
      std::max({std::abs(bracket.before.lambda), std::abs(bracket.after.lambda), norm.least_load()});
  return std::abs(bracket.after.lambda - bracket.before.lambda) <= tolerance * size &&
         norm.distance(bracket.before, bracket.after) <= kNear;
}

/// Shrinks the bracket around its first change to the tolerance; false when no corrected point was found.
bool close(const Segment& step, const ZoneCounter& count, const std::vector<int>& old, double tolerance,
           Bracket& bracket) {
  std::vector<int> zones;
  for (int i = 0; i < kMostCorrections && !is_closed(step.solver().norm(), bracket, tolerance); ++i) {
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
    out.push_back({a, old, beyond});
    old = std::move(beyond);
  }
  while (old != last && out.size() < kMostChanges) {
    Bracket bracket{from, b};
    const bool closed = close(step, count, old, tolerance, bracket);
    ContactChange change;
    change.before = old;
    count(bracket.after.y, old);
    change.after = old;
    // at a kink the contact change is next to the start of the step
    change.point = at_kink && !closed ? bracket.before : bracket.after;
    out.push_back(std::move(change));
    from = std::move(bracket.after);
  }
  return out;
}

}  // namespace snapthrough
