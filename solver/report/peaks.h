#pragma once
/// @file
/// Extreme values of functions along a member, between sampled places too.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "solver/numeric/rounding.h"
#include "solver/resolve/resolved_model.h"
#include "solver/result.h"

namespace snapthrough {

/// Numbers of the search. Differences of values are shares of the range of the sampled values.
struct PeakLimits {
  static constexpr double doubt = 1e-4;  ///< difference of two parabolas that asks for a sample between
  static constexpr double reach = 3.0;   ///< an extreme beyond a parabola, over that difference
  static constexpr double exact = 1e-7;  ///< difference of a value from its estimate that ends the search
  static constexpr double near =
      1e-3;  ///< distance of two places that are one, over that of their neighbours
  static constexpr double beside_end =
      0.1;  ///< distance of a place from an end, over that of the next sample
  static constexpr std::size_t samples = 5;  ///< least number of samples of a piece
  static constexpr int most_added = 64;      ///< samples that are added to a piece at most
  static constexpr int trials = 20;          ///< places that are tried for one extreme at most
};

/// @brief Finds the extremes of several functions that are smooth on pieces and may jump between them.
///
/// Each piece is sampled at its ends and between. Beside samples that are larger than their neighbours, and
/// beside ends, the parabola through three samples tells where a larger value may be; places are then tried
/// by repeated parabolas.
template <std::size_t count>
class PeakSearch {
 public:
  using Values = std::array<double, count>;
  struct Sample {
    double s;
    Values values;
  };

  /// @brief Adds a piece, sampled at its ends and at known places inside it, five places in all at least.
  /// @param known places, ascending, whose values known_values(index) gives
  /// @param values_at values at a place inside the piece
  template <class KnownValues, class ValuesAt>
  void add_piece(const std::vector<double>& known, const KnownValues& known_values, const Sample& from,
                 const Sample& to, const ValuesAt& values_at) {
    Piece piece{from};
    const double apart = kOnePlace * (to.s - from.s);
    for (auto at = std::upper_bound(known.begin(), known.end(), from.s + apart);
         at != known.end() && *at < to.s - apart; ++at)
      piece.push_back({*at, known_values(static_cast<std::size_t>(at - known.begin()))});
    piece.push_back(to);
    while (piece.size() < PeakLimits::samples) {
      const auto wide = widest(piece);
      const double s = 0.5 * (piece[wide].s + piece[wide + 1].s);
      piece.insert(piece.begin() + static_cast<std::ptrdiff_t>(wide) + 1, {s, values_at(s)});
    }
    for (const Sample& sample : piece) widen(sample);
    pieces_.push_back(std::move(piece));
  }
  /// @brief Adds samples where neighbouring parabolas differ and an extreme may be between samples.
  template <class ValuesAt>
  void refine(const ValuesAt& values_at) {
    for (Piece& piece : pieces_) {
      int added = 0;
      for (std::size_t i = 0; i + 1 < piece.size();) {
        if (added >= PeakLimits::most_added || !is_doubtful(piece, i)) {
          ++i;
          continue;
        }
        const double s = 0.5 * (piece[i].s + piece[i + 1].s);
        widen(*piece.insert(piece.begin() + static_cast<std::ptrdiff_t>(i) + 1, {s, values_at(s)}));
        ++added;
        i = i > 1 ? i - 2 : 0;
      }
    }
  }
  /// @brief Extremes of function `k`.
  /// @param values_at values at a place inside a piece
  template <class ValuesAt>
  [[nodiscard]] PeakRange range(std::size_t k, const ValuesAt& values_at) const {
    const Peak least = largest(k, -1.0, values_at);
    return {{0.0 - least.value, least.s}, largest(k, 1.0, values_at)};  // no negative zero
  }
  /// Largest value of function `k` times a sign.
  template <class ValuesAt>
  [[nodiscard]] Peak largest(std::size_t k, double sign, const ValuesAt& values_at) const {
    Peak best{-std::numeric_limits<double>::infinity(), 0.0};
    for (const Piece& piece : pieces_)
      for (const Sample& sample : piece) raise({sign * sample.values[k], sample.s}, best);
    const double range = most_[k] - least_[k];
    if (!(range > Rounding::motion * std::max(std::abs(most_[k]), std::abs(least_[k])))) {
      // rounding must not choose the place of a value that is the same everywhere
      if (!pieces_.empty() && !pieces_.front().empty()) best.s = pieces_.front().front().s;
      return best;
    }
    const auto value_at = [&](double s) { return sign * values_at(s)[k]; };
    for (const Candidate& one : candidates(k, sign, best.value)) {
      const Piece& piece = *one.piece;
      const auto peak = [&](std::size_t j) { return Peak{sign * piece[j].values[k], piece[j].s}; };
      if (one.bound <= best.value) break;
      search({peak(one.first), peak(one.first + 1), peak(one.first + 2)}, one.first == 0,
             one.first + 3 == piece.size(), range, value_at, best);
    }
    return best;
  }

 private:
  using Piece = std::vector<Sample>;
  using Triple = std::array<Peak, 3>;
  /// Three neighbouring samples between which a larger value than the largest sample may be.
  struct Candidate {
    const Piece* piece;
    std::size_t first;
    double bound;  ///< estimate of the largest value that may be there
  };

  void widen(const Sample& sample) {
    for (std::size_t k = 0; k < count; ++k) {
      least_[k] = std::min(least_[k], sample.values[k]);
      most_[k] = std::max(most_[k], sample.values[k]);
    }
  }

  /// Index of the place before the largest gap of a piece.
  static std::size_t widest(const Piece& piece) {
    std::size_t wide = 0;
    for (std::size_t i = 1; i + 1 < piece.size(); ++i)
      if (piece[i + 1].s - piece[i].s > piece[wide + 1].s - piece[wide].s) wide = i;
    return wide;
  }

  /// Value at s of the parabola through three samples from index i on.
  static double parabola(const Piece& piece, std::size_t i, std::size_t k, double s) {
    const auto slope = [&](std::size_t a, std::size_t b) {
      return (piece[b].values[k] - piece[a].values[k]) / (piece[b].s - piece[a].s);
    };
    const double first = slope(i, i + 1);
    const double bend = (slope(i + 1, i + 2) - first) / (piece[i + 2].s - piece[i].s);
    return piece[i].values[k] + (s - piece[i].s) * (first + (s - piece[i + 1].s) * bend);
  }

  /// Values of function `k` in the middle of two samples, by the parabolas before and after it.
  static std::array<double, 2> middle(const Piece& piece, std::size_t i, std::size_t k) {
    const std::size_t after = std::min(i, piece.size() - 3);
    const std::size_t before = i == 0 ? 1 : i == after ? i - 1 : i - 2;
    const double s = 0.5 * (piece[i].s + piece[i + 1].s);
    return {parabola(piece, before, k, s), parabola(piece, after, k, s)};
  }

  /// Whether an extreme of a function may be between two samples that the parabolas beside them do not tell
  /// alike.
  bool is_doubtful(const Piece& piece, std::size_t i) const {
    for (std::size_t k = 0; k < count; ++k) {
      const auto [one, other] = middle(piece, i, k);
      const double apart = std::abs(one - other);
      const double range = most_[k] - least_[k];
      const double margin = PeakLimits::reach * apart;
      const bool may_be =
          std::max(one, other) > most_[k] - margin || std::min(one, other) < least_[k] + margin;
      if (apart > PeakLimits::doubt * range && may_be) return true;
    }
    return false;
  }

  /// The triples that may have a larger value than `least`, the likeliest first.
  std::vector<Candidate> candidates(std::size_t k, double sign, double least) const {
    std::vector<Candidate> found;
    for (const Piece& piece : pieces_) {
      for (std::size_t i = 0; i + 2 < piece.size(); ++i) {
        const auto value = [&](std::size_t j) { return sign * piece[j].values[k]; };
        const bool peak = value(i + 1) >= value(i) && value(i + 1) >= value(i + 2);
        const bool falls = i == 0 && value(i) > value(i + 1);
        const bool rises = i + 3 == piece.size() && value(i + 2) > value(i + 1);
        if (!peak && !falls && !rises) continue;
        double bound = std::max({value(i), value(i + 1), value(i + 2)});
        double apart = 0.0;
        for (const std::size_t j : {i, i + 1}) {
          const auto [one, other] = middle(piece, j, k);
          apart = std::max(apart, std::abs(one - other));
          bound = std::max({bound, sign * one, sign * other});
        }
        const Peak top = vertex({Peak{value(i), piece[i].s}, Peak{value(i + 1), piece[i + 1].s},
                                 Peak{value(i + 2), piece[i + 2].s}});
        if (top.s > piece[i].s && top.s < piece[i + 2].s) bound = std::max(bound, top.value);
        bound += PeakLimits::reach * apart;
        if (bound > least) found.push_back({&piece, i, bound});
      }
    }
    std::sort(found.begin(), found.end(),
              [](const Candidate& a, const Candidate& b) { return a.bound > b.bound; });
    return found;
  }

  static void raise(const Peak& peak, Peak& best) {
    const double least = best.value + (Rounding::first_of_equal - 1.0) * std::abs(best.value);
    if (!std::isfinite(best.value) || peak.value > least) best = peak;
  }

  /// Vertex of the parabola through three places; value minus infinity where it opens upward.
  static Peak vertex(const Triple& at) {
    const double back = at[1].s - at[0].s;
    const double ahead = at[2].s - at[1].s;
    const double first = (at[1].value - at[0].value) / back;
    const double second = (at[2].value - at[1].value) / ahead;
    const double curvature = (second - first) / (back + ahead);
    if (!(curvature < 0.0)) return {-std::numeric_limits<double>::infinity(), at[1].s};
    const double slope = (first * ahead + second * back) / (back + ahead);
    return {at[1].value - 0.25 * slope * slope / curvature, at[1].s - 0.5 * slope / curvature};
  }

  static bool is_peak(const Triple& at) { return at[1].value >= at[0].value && at[1].value >= at[2].value; }

  /// Looks for a larger value beside the middle of three samples, or beside an end of their piece.
  template <class ValueAt>
  static void search(Triple at, bool first, bool last, double range, const ValueAt& value_at, Peak& best) {
    if (!is_peak(at)) {
      // beside an end a place close to it tells whether the values rise from there
      const bool falls = at[0].value > at[2].value;
      if (!(falls ? first : last)) return;
      double s = falls ? at[0].s + PeakLimits::beside_end * (at[1].s - at[0].s)
                       : at[2].s - PeakLimits::beside_end * (at[2].s - at[1].s);
      for (int i = 0; i < PeakLimits::trials && !is_peak(at); ++i) {
        if (!(falls ? s > at[0].s && s < at[1].s : s > at[1].s && s < at[2].s)) return;
        const Peak tried{value_at(s), s};
        at = falls ? Triple{at[0], tried, at[1]} : Triple{at[1], tried, at[2]};
        s = vertex(at).s;
      }
    }
    if (is_peak(at)) climb(at, range, value_at, best);
  }

  /// Adds a place between the first and the last one of a triple, and keeps the largest with those beside it.
  template <class ValueAt>
  static void take(double s, const ValueAt& value_at, Triple& at) {
    if (!(s > at[0].s && s < at[2].s) || s == at[1].s) return;
    const Peak tried{value_at(s), s};
    const bool before = s < at[1].s;
    if (tried.value > at[1].value)
      at = before ? Triple{at[0], tried, at[1]} : Triple{at[1], tried, at[2]};
    else
      (before ? at[0] : at[2]) = tried;
  }

  /// Shrinks three places around a largest value by repeated parabolas, until one tells the value that is
  /// met.
  template <class ValueAt>
  static void climb(Triple at, double range, const ValueAt& value_at, Peak& best) {
    for (int i = 0; i < PeakLimits::trials; ++i) {
      const Peak top = vertex(at);
      // a place next to the middle one tells nothing: the wider side is halved
      const double wide = at[2].s - at[1].s > at[1].s - at[0].s ? at[2].s : at[0].s;
      const bool is_near = std::abs(top.s - at[1].s) < PeakLimits::near * (at[2].s - at[0].s);
      take(is_near ? 0.5 * (at[1].s + wide) : top.s, value_at, at);
      if (std::abs(at[1].value - top.value) <= PeakLimits::exact * range) break;
    }
    raise(at[1], best);
  }

  std::vector<Piece> pieces_;
  Values least_ = filled(std::numeric_limits<double>::infinity());
  Values most_ = filled(-std::numeric_limits<double>::infinity());

  static Values filled(double value) {
    Values values;
    values.fill(value);
    return values;
  }
};

}  // namespace snapthrough
