#include <algorithm>
#include <cmath>
#include <map>

#include "solver/sweep/chart.h"
#include "solver/sweep/chart_tolerance.h"

namespace snapthrough {
namespace {

/// Largest distance of the ends of pieces from those that are computed, as a share of the inner axis.
constexpr double kPlaceShare = 0.0005;

/// First and last place of a piece, and their indices among the places of the curve.
struct Piece {
  std::size_t first = 0;
  std::size_t last = 0;
};

Piece piece_of(const ChartCurve& curve, int number) {
  const auto [begin, end] = std::equal_range(curve.pieces.begin(), curve.pieces.end(), number);
  Piece piece{static_cast<std::size_t>(begin - curve.pieces.begin()),
              static_cast<std::size_t>(end - curve.pieces.begin()) - 1};
  if (piece.last > piece.first && curve.values[piece.first].value && !curve.values[piece.last].value) {
    --piece.last;  // the place without value that separates it from the next piece
  }
  return piece;
}

/// Returns the straight line at a place of a curve; nothing between pieces.
std::optional<double> on_curve(const ChartCurve& curve, double place) {
  const auto after = std::lower_bound(curve.places.begin(), curve.places.end(), place);
  if (after == curve.places.end()) {
    return std::nullopt;
  }
  const auto i = static_cast<std::size_t>(after - curve.places.begin());
  if (*after == place || i == 0) {
    return *after == place ? curve.values[i].value : std::nullopt;
  }
  if (curve.pieces[i] != curve.pieces[i - 1] || !curve.values[i].value) {
    return std::nullopt;
  }
  const double t = (place - curve.places[i - 1]) / (curve.places[i] - curve.places[i - 1]);
  return (1.0 - t) * *curve.values[i - 1].value + t * *curve.values[i].value;
}

std::optional<double> blended(const std::optional<double>& a, const std::optional<double>& b, double share) {
  return a && b ? std::optional((1.0 - share) * *a + share * *b) : std::nullopt;
}

double blend(double a, double b, double share) { return (1.0 - share) * a + share * b; }

/// Ends of a piece between two curves.
struct Ends {
  double first = 0.0;
  double last = 0.0;
};

Ends ends_between(const ChartCurve& before, const ChartCurve& after, double share, int number) {
  const Piece a = piece_of(before, number);
  const Piece b = piece_of(after, number);
  return {blend(before.places[a.first], after.places[b.first], share),
          blend(before.places[a.last], after.places[b.last], share)};
}

/// Returns the blend of both curves at a share of the length of a piece.
std::optional<double> in_piece(const ChartCurve& before, const ChartCurve& after, double share, int number,
                               double along) {
  const auto value = [&](const ChartCurve& curve) {
    const Piece piece = piece_of(curve, number);
    return on_curve(curve, blend(curve.places[piece.first], curve.places[piece.last], along));
  };
  return blended(value(before), value(after), share);
}

double along(const Ends& ends, double place) {
  return ends.last > ends.first ? std::clamp((place - ends.first) / (ends.last - ends.first), 0.0, 1.0) : 0.0;
}

class SurfaceSearch {
 public:
  SurfaceSearch(const std::function<ChartValue(int, int)>& value, const ChartAxis& outer,
                const ChartAxis& inner, const ChartLimits& limits)
      : value_(value), outer_(outer), inner_(inner), limits_(limits), tolerance_(0.5 * limits.within) {}

  ChartSurface search() {
    const int step = outer_.intervals / outer_.first;
    for (int place = outer_.intervals; place > 0; place -= step) {
      open_.emplace_back(place - step, place);
    }
    std::optional<ChartGap> unfinished;
    while (!open_.empty() && !unfinished) {
      const ChartGap next = open_.back();
      open_.pop_back();
      look_into(next, next.second - next.first == step);
      unfinished = full_ ? std::optional(next) : std::nullopt;
    }
    ChartSurface out;
    for (auto& [place, curve] : curves_) {
      out.places.push_back(place);
      out.curves.push_back(std::move(curve));
    }
    out.unfinished = unfinished;
    return out;
  }

 private:
  const ChartCurve& at(int outer) {
    const auto found = curves_.find(outer);
    if (found != curves_.end()) {
      return found->second;
    }
    ChartCurve curve = chart_curve([&](int inner) { return value_(outer, inner); }, inner_,
                                   {0.5 * limits_.within, limits_.most - std::min(count_, limits_.most)});
    count_ += curve.places.size();
    full_ = full_ || curve.unfinished;
    for (const ChartValue& one : curve.values) {
      tolerance_.include(one.value.value_or(0.0));
    }
    return curves_.emplace(outer, std::move(curve)).first->second;
  }

  void look_into(const ChartGap& gap, bool first) {
    const auto [from, to] = gap;
    const ChartCurve& a = at(from);
    const ChartCurve& b = at(to);
    if (to - from < 2 || full_) {
      return;
    }
    const int middle = from + (to - from) / 2;
    if (are_near(a, b, at(middle)) &&
        (!first || to - from < 4 || is_near_at(from, middle, from + (middle - from) / 2))) {
      return;
    }
    open_.emplace_back(middle, to);
    open_.emplace_back(from, middle);
  }

  [[nodiscard]] bool agree(const std::optional<double>& guess, const std::optional<double>& value) const {
    return guess.has_value() == value.has_value() && (!value || tolerance_.is_near(*guess, *value, 0.5));
  }

  /// Whether a curve lies near what two curves around it say of their middle.
  [[nodiscard]] bool are_near(const ChartCurve& a, const ChartCurve& b, const ChartCurve& middle) const {
    const bool alike = a.count() == b.count();
    if (alike && middle.count() != a.count()) {
      return false;
    }
    for (std::size_t i = 0; i < middle.places.size(); ++i) {
      const int number = middle.pieces[i];
      if (!alike) {
        if (!agree(between_curves(a, b, 0.5, middle.places[i]), middle.values[i].value)) {
          return false;
        }
        continue;
      }
      const Ends guessed = ends_between(a, b, 0.5, number);
      const Ends found = ends_between(middle, middle, 0.0, number);
      const double off = std::max(std::abs(guessed.first - found.first), std::abs(guessed.last - found.last));
      if (off > kPlaceShare * inner_.intervals ||
          !agree(in_piece(a, b, 0.5, number, along(found, middle.places[i])), middle.values[i].value)) {
        return false;
      }
    }
    return true;
  }

  /// Whether single values at another place lie near what two curves say of it.
  bool is_near_at(int from, int to, int outer) {
    constexpr double kShares[] = {0.08, 0.29, 0.5, 0.71, 0.92};
    const double share = static_cast<double>(outer - from) / (to - from);
    for (const double part : kShares) {
      const int inner = static_cast<int>(part * inner_.intervals);
      const std::optional<double> guess = between_curves(at(from), at(to), share, inner);
      ++count_;
      if (!agree(guess, value_(outer, inner).value)) {
        return false;
      }
    }
    return true;
  }

  const std::function<ChartValue(int, int)>& value_;
  const ChartAxis outer_;
  const ChartAxis inner_;
  const ChartLimits limits_;
  ChartTolerance tolerance_;
  std::map<int, ChartCurve> curves_;
  std::vector<ChartGap> open_;
  std::size_t count_ = 0;  ///< places computed
  bool full_ = false;      ///< the limit was reached
};

}  // namespace

std::optional<double> between_curves(const ChartCurve& before, const ChartCurve& after, double share,
                                     double place) {
  if (before.count() != after.count()) {
    return blended(on_curve(before, place), on_curve(after, place), share);
  }
  for (int number = 0; number < before.count(); ++number) {
    const Ends ends = ends_between(before, after, share, number);
    if (place >= ends.first && place <= ends.last) {
      return in_piece(before, after, share, number, along(ends, place));
    }
  }
  return std::nullopt;
}

ChartSurface chart_surface(const std::function<ChartValue(int, int)>& value, const ChartAxis& outer,
                           const ChartAxis& inner, const ChartLimits& limits) {
  return SurfaceSearch(value, outer, inner, limits).search();
}

}  // namespace snapthrough
