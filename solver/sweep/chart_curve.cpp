#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "solver/sweep/chart.h"
#include "solver/sweep/chart_tolerance.h"

namespace snapthrough {
namespace {

/// Part of the tolerance by which the middle of an interval that is kept may be off: where the value has a
/// corner, another place of the interval is off by up to twice as much.
constexpr double kKept = 0.5;
/// Places of the axis within which one jump only is a break, the largest one: a value that falls steeply
/// beside a jump belongs to it.
constexpr int kFront = 8;

struct Interval {
  int from = 0;
  int to = 0;
  bool sure = false;  ///< looked into whatever its ends are, and in its first quarter too
};

/// Places that are known, and the intervals between them that are not yet kept.
class CurveSearch {
 public:
  CurveSearch(const std::function<ChartValue(int)>& value, const ChartLimits& limits)
      : value_(value), tolerance_(limits.within), most_(limits.most) {}

  std::optional<ChartGap> search(const ChartAxis& axis) {
    const int step = axis.intervals / axis.first;
    for (int place = axis.intervals; place > 0; place -= step) {
      open_.push_back({place - step, place, true});
    }
    do {
      while (!open_.empty()) {
        const Interval next = open_.back();
        open_.pop_back();
        if (known_.size() >= most_) {
          return ChartGap{next.from, next.to};
        }
        look_into(next);
      }
      doubt_bent();
    } while (!open_.empty());
    return std::nullopt;
  }

  [[nodiscard]] ChartCurve curve() const {
    ChartCurve out;
    std::vector<double> heights;  // change of the value at the jump before each place; 0: no jump
    for (const auto& [place, here] : known_) {
      const bool jumps = !out.places.empty() && is_jump(out.places.back(), out.values.back(), place, here);
      heights.push_back(jumps ? std::abs(*here.value - *out.values.back().value) : 0.0);
      out.places.push_back(place);
      out.values.push_back(here);
    }
    for (std::size_t i = 0; i < out.places.size(); ++i) {
      const bool alone = heights[i] > 0.0 && is_largest(out, heights, i);
      out.jumps.push_back(alone);
      const bool begins = i > 0 && !is_gap(out, i) && (alone || !are_alike(out.values[i - 1], out.values[i]));
      out.pieces.push_back(i == 0 ? 0 : out.pieces.back() + (begins ? 1 : 0));
    }
    return out;
  }

 private:
  const ChartValue& at(int place) {
    const auto found = known_.find(place);
    if (found != known_.end()) {
      return found->second;
    }
    const ChartValue& here = known_.emplace(place, value_(place)).first->second;
    if (here.value) {
      tolerance_.include(*here.value);
    }
    return here;
  }

  static bool are_alike(const ChartValue& a, const ChartValue& b) {
    return a.kind == b.kind && a.value.has_value() == b.value.has_value();
  }

  /// Whether the value in the middle of two places lies near enough to the straight line.
  bool is_straight(int from, int to) {
    const ChartValue& middle = at(from + (to - from) / 2);
    const ChartValue& a = at(from);
    const ChartValue& b = at(to);
    return are_alike(a, middle) && are_alike(middle, b) &&
           (!a.value || tolerance_.is_near(*middle.value, 0.5 * (*a.value + *b.value), kKept));
  }

  void look_into(const Interval& interval) {
    const auto [from, to, sure] = interval;
    const ChartValue& a = at(from);
    const ChartValue& b = at(to);
    if (to - from < 2 ||
        (!sure && are_alike(a, b) && (!a.value || tolerance_.is_near(*a.value, *b.value, kKept)))) {
      return;
    }
    const int middle = from + (to - from) / 2;
    if (is_straight(from, to) && (!sure || to - from < 4 || is_straight(from, middle))) {
      return;
    }
    open_.push_back({middle, to});
    open_.push_back({from, middle});
  }

  /// Opens intervals again whose line meets those beside it at such an angle that the value may be bent
  /// between: each once.
  void doubt_bent() {
    if (known_.size() < 3) {
      return;
    }
    auto left = known_.begin();
    auto middle = std::next(left);
    for (auto right = std::next(middle); right != known_.end(); left = middle, middle = right, ++right) {
      if (!are_alike(left->second, middle->second) || !are_alike(middle->second, right->second) ||
          !middle->second.value) {
        continue;
      }
      const double before = middle->first - left->first;
      const double after = right->first - middle->first;
      const double turn = (*right->second.value - *middle->second.value) / after -
                          (*middle->second.value - *left->second.value) / before;
      // distance of a parabola with this turn from its chord
      const double bend = 0.25 * turn / (before + after);
      doubt(left->first, middle->first, bend * before * before, *middle->second.value);
      doubt(middle->first, right->first, bend * after * after, *middle->second.value);
    }
  }

  void doubt(int from, int to, double distance, double value) {
    if (to - from > 1 && !tolerance_.is_near(value, value + distance, kKept) &&
        doubted_.insert({from, to}).second) {
      open_.push_back({from, to, true});
    }
  }

  [[nodiscard]] bool is_jump(int before, const ChartValue& a, int place, const ChartValue& b) const {
    return place - before == 1 && a.value && b.value && !tolerance_.is_near(*a.value, *b.value, 1.0);
  }

  /// Whether place i alone has no value, right between its neighbours.
  static bool is_gap(const ChartCurve& curve, std::size_t i) {
    return i > 0 && i + 1 < curve.places.size() && !curve.values[i].value && curve.values[i - 1].value &&
           curve.values[i + 1].value && curve.places[i + 1] - curve.places[i - 1] == 2;
  }

  /// Whether no larger jump and no change of kind is near the jump before place i.
  static bool is_largest(const ChartCurve& curve, const std::vector<double>& heights, std::size_t i) {
    const auto outranks = [&](std::size_t other) {
      const bool changes = !are_alike(curve.values[other - 1], curve.values[other]);
      const bool changes_here = !are_alike(curve.values[i - 1], curve.values[i]);
      return changes != changes_here ? changes : heights[other] > heights[i];
    };
    for (std::size_t other = i; other-- > 1 && curve.places[i] - curve.places[other] <= kFront;) {
      if (outranks(other)) {
        return false;
      }
    }
    for (std::size_t other = i + 1;
         other < curve.places.size() && curve.places[other] - curve.places[i] <= kFront; ++other) {
      if (outranks(other)) {
        return false;
      }
    }
    return true;
  }

  const std::function<ChartValue(int)>& value_;
  ChartTolerance tolerance_;
  const std::size_t most_;
  std::map<int, ChartValue> known_;
  std::vector<Interval> open_;
  std::set<std::pair<int, int>> doubted_;  ///< intervals that were opened again
};

}  // namespace

ChartCurve chart_curve(const std::function<ChartValue(int)>& value, const ChartAxis& axis,
                       const ChartLimits& limits) {
  CurveSearch search(value, limits);
  const std::optional<ChartGap> unfinished = search.search(axis);
  ChartCurve curve = search.curve();
  curve.unfinished = unfinished;
  return curve;
}

}  // namespace snapthrough
