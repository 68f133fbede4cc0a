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

/// Fraction of the bracket at which the counts change along the interpolated path.
double predicted_share(const Continuation& continuation, const Chord& chord, const Bracket& bracket,
                       const ZoneCounter& count, const std::vector<int>& old) {
  std::vector<int> zones;
  PathPoint at;
  return bisect(0.0, 1.0, 1e-9, [&](double share) {
    continuation.interpolate(chord, bracket.before, bracket.after, share, at);
    count(at.y, zones);
    return zones != old;
  });
}

/// Whether the counts change immediately after the start of the bracket, for example at zero load where
/// touching supports gain contact at once; `beyond` gets the counts just after the start.
bool changes_at_start(const Continuation& continuation, const Chord& chord, const Bracket& bracket,
                      const ZoneCounter& count, const std::vector<int>& old, std::vector<int>& beyond) {
  // fraction of the bracket at which new contact zones are deeper than rounding
  constexpr double kAtOnce = 1e-6;
  PathPoint at;
  continuation.interpolate(chord, bracket.before, bracket.after, kAtOnce, at);
  count(at.y, beyond);
  return beyond != old;
}

/// Fraction slightly past the prediction, seen from the nearer end: the bracket shrinks from both sides.
double next_share(double share) {
  constexpr double kBeyond = 1.5;  // factor on the distance from the nearer end
  share = share < 0.5 ? kBeyond * share : 1.0 - kBeyond * (1.0 - share);
  return std::clamp(share, 1e-6, 1.0 - 1e-6);
}

bool is_closed(const Continuation& continuation, const Bracket& bracket, double tolerance) {
  const double size =
      std::max({std::abs(bracket.before.lambda), std::abs(bracket.after.lambda), continuation.least_load()});
  return std::abs(bracket.after.lambda - bracket.before.lambda) <= tolerance * size &&
         continuation.distance(bracket.before, bracket.after) <= 1e-3;
}

/// Shrinks the bracket around its first change to the tolerance; false when no corrected point was found.
bool close(Continuation& continuation, const Chord& chord, const ZoneCounter& count,
           const std::vector<int>& old, double tolerance, Bracket& bracket) {
  std::vector<int> zones;
  for (int i = 0; i < kMostCorrections && !is_closed(continuation, bracket, tolerance); ++i) {
    const double share = next_share(predicted_share(continuation, chord, bracket, count, old));
    auto point = continuation.between(chord, bracket.before, bracket.after, share);
    if (!point) point = continuation.between(chord, bracket.before, bracket.after, 0.5);
    if (!point) return false;
    count(point->y, zones);
    (zones == old ? bracket.before : bracket.after) = std::move(*point);
  }
  return true;
}

}  // namespace

std::vector<ContactChange> locate_contact_changes(Continuation& continuation, const PathPoint& a,
                                                  const PathPoint& b, bool at_kink, const ZoneCounter& count,
                                                  double tolerance) {
  std::vector<ContactChange> out;
  std::vector<int> old;
  std::vector<int> last;
  count(a.y, old);
  count(b.y, last);
  if (old == last) return out;
  const Chord chord = at_kink ? continuation.displacement_chord(a, b) : continuation.chord(a, b);
  PathPoint from = a;
  std::vector<int> beyond;
  if (changes_at_start(continuation, chord, {a, b}, count, old, beyond)) {
    out.push_back({a, old, beyond});
    old = std::move(beyond);
  }
  while (old != last && out.size() < kMostChanges) {
    Bracket bracket{from, b};
    const bool closed = close(continuation, chord, count, old, tolerance, bracket);
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
