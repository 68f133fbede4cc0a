#include "solver/column/exact_column.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>

#include "solver/column/column_frame.h"
#include "solver/numeric/bracket.h"

namespace snapthrough {
namespace {

/// Limits of the search. Source: docs/theory.md, Straight columns without a mesh.
struct LoadLimits {
  static constexpr double most_pieces = 5e4;    ///< work limit; beyond, the exact solution is not attempted
  static constexpr int doublings = 100;         ///< doublings of Euler's load until enough loads are below
  static constexpr double equal_loads = 1e-14;  ///< relative difference up to which loads are equal
  static constexpr double mechanism = 1e-25;    ///< load of a mechanism, over Euler's
  static constexpr double bracket = 1e-15;      ///< relative width of the final bracket of a load
  static constexpr int most_counts = 200;       ///< counts of eigenvalues to locate one load
  static constexpr double least_error = 1e-13;  ///< smallest relative error that is tested
  static constexpr double most_error = 1e-6;    ///< largest relative error that is accepted
};

/// Searches the buckling loads of one column.
class LoadSearch {
 public:
  LoadSearch(const ColumnLine& line, int count) : line_(line), wanted_(count) {}
  [[nodiscard]] std::optional<ColumnBuckling> run();

 private:
  [[nodiscard]] ColumnCount count(double lambda) {
    ++out_.counts;
    return count_below(line_, lambda);
  }
  [[nodiscard]] bool enclose(LoadBracket& bracket);
  [[nodiscard]] bool take(const LoadBracket& bracket);
  [[nodiscard]] double root(const LoadBracket& bracket);
  [[nodiscard]] bool confirm(double load, int below);

  const ColumnLine& line_;
  int wanted_;
  ColumnBuckling out_;
  std::vector<int> below_;  ///< number of loads below each load
  double scale_ = 0.0;
  bool lost_ = false;
};

/// Finds a load factor with enough loads below it; false when that needs too many pieces.
bool LoadSearch::enclose(LoadBracket& bracket) {
  double hi = std::numeric_limits<double>::infinity();
  double length = 0.0;
  for (const ColumnSpan& span : line_.spans) length += span.length;
  for (const ColumnSpan& span : line_.spans)
    if (span.proportional > 0.0)
      hi =
          std::min(hi, std::numbers::pi * std::numbers::pi * span.EI / (length * length * span.proportional));
  out_.negative_at_start = count(0.0).negative;
  bracket = {0.0, 0.0, out_.negative_at_start, out_.negative_at_start};
  if (!std::isfinite(hi)) return true;  // nothing is compressed: no buckling load exists
  hi *= kOffMultiples;
  scale_ = hi;
  for (int i = 0; i < LoadLimits::doublings && bracket.below_hi - bracket.below_lo < wanted_;
       ++i, hi *= 2.0) {
    if (piece_count(line_, hi) > LoadLimits::most_pieces) return false;
    bracket.hi = hi;
    bracket.below_hi = count(hi).negative;
  }
  return bracket.below_hi - bracket.below_lo >= wanted_;
}

/// Accepts a bracket of one load or of equal loads; false: it must be divided further.
bool LoadSearch::take(const LoadBracket& bracket) {
  lost_ = lost_ || bracket.hi <= LoadLimits::mechanism * scale_;
  if (lost_) return true;
  const bool equal = bracket.hi - bracket.lo <= LoadLimits::equal_loads * bracket.hi;
  if (!bracket.is_single() && !equal) return false;
  const double load = bracket.is_single() ? root(bracket) : 0.5 * (bracket.lo + bracket.hi);
  for (int below = bracket.below_lo; below < bracket.below_hi; ++below) {
    out_.loads.push_back(load);
    below_.push_back(below);
  }
  return true;
}

/// Quotient a / b.
double ratio(const WideNumber& a, const WideNumber& b) {
  return std::ldexp(a.mantissa / b.mantissa, std::clamp(a.exponent - b.exponent, -2000, 2000));
}

/// The single load in a bracket.
double LoadSearch::root(const LoadBracket& bracket) {
  const ColumnCount at_hi = count(bracket.hi);
  // magnitude from the determinant, sign from the count
  const auto value = [&](double lambda, bool& above) {
    const ColumnCount now = count(lambda);
    above = now.negative > bracket.below_lo;
    if (now.determinant.mantissa == 0.0) return 0.0;
    const double size = std::clamp(std::abs(ratio(now.determinant, at_hi.determinant)), 1e-300, 1e300);
    return above ? size : -size;
  };
  bool above = false;
  SignBracket at(bracket.hi, 1.0, bracket.lo, value(bracket.lo, above));
  for (int i = 0; i < LoadLimits::most_counts; ++i) {
    const double least = LoadLimits::bracket * at.largest();
    if (at.width() <= least || at.is_exact()) return at.best();
    const double x = at.next(0.5 * least / at.width());
    at.take(x, value(x, above));
  }
  return at.middle();
}

/// Confirms a load by counts on both sides, with differently cut pieces, and records the distance as error.
bool LoadSearch::confirm(double load, int below) {
  for (double beside = LoadLimits::least_error; beside <= LoadLimits::most_error; beside *= 8.0) {
    out_.counts += 2;
    if (count_below(line_, load * (1.0 - beside), true).negative <= below &&
        count_below(line_, load * (1.0 + beside), true).negative > below) {
      out_.errors.push_back(beside);
      return true;
    }
  }
  return false;
}

std::optional<ColumnBuckling> LoadSearch::run() {
  LoadBracket all;
  if (!enclose(all)) return std::nullopt;
  isolate_loads(
      all, out_.negative_at_start + wanted_, [this](double load) { return count(load).negative; },
      [this](const LoadBracket& bracket) { return take(bracket); });
  if (lost_) return std::nullopt;
  if (static_cast<int>(out_.loads.size()) > wanted_) out_.loads.resize(static_cast<std::size_t>(wanted_));
  for (std::size_t i = 0; i < out_.loads.size(); ++i)
    if (!confirm(out_.loads[i], below_[i])) return std::nullopt;
  return std::move(out_);
}

}  // namespace

std::optional<ColumnBuckling> column_buckling(const ColumnLine& line, int count) {
  return LoadSearch(line, count).run();
}

}  // namespace snapthrough
