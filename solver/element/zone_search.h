#pragma once
/// @file
/// Search of the intervals in which a sampled function is above zero. Included by the sources of
/// FoundationContact only.

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>
#include <vector>

#include "solver/numeric/chebyshev_series.h"
#include "solver/numeric/cubic.h"
#include "solver/support/regime.h"

namespace snapthrough {

/// Interpolant of the penetration samples, set up on first use because most searches need none.
class SampledGap {
 public:
  explicit SampledGap(std::span<const double> samples) : samples_(samples) {}

  [[nodiscard]] double value(double z) const { return series().value(z); }
  [[nodiscard]] double slope(double z) const { return series().slope(z); }
  [[nodiscard]] Eigen::Array4d values(const Eigen::Array4d& z) const { return series().values(z); }

 private:
  [[nodiscard]] const ChebyshevSeries& series() const {
    if (!series_) series_.emplace(samples_);
    return *series_;
  }

  std::span<const double> samples_;
  mutable std::optional<ChebyshevSeries> series_;
};

namespace zone_search {

/// Search within one element. Source: docs/decisions/0022.
struct Limits {
  static constexpr int parts = 4;        ///< parts of a cell between two samples
  static constexpr int dip_trials = 20;  ///< points at most in the search of a minimum
  static constexpr double zero = 1e-10;  ///< |g| that is rounding, over |g| at the other end of a part
};

/// Position on the range, scaled to [0, 1], with the penetration there.
struct Sample {
  double z = 0.0;
  double g = 0.0;
};

template <class Gap>
double root_between(const Gap& gap, Sample lo, Sample hi) {
  // Illinois variant of regula falsi: keeps the bracket, converges superlinearly
  int last = 0;
  for (int it = 0; it < 60; ++it) {
    const double z = hi.z - hi.g * (hi.z - lo.z) / (hi.g - lo.g);
    if (hi.z - lo.z < 1e-15 || z <= lo.z || z >= hi.z) break;
    const double g = gap.value(z);
    if (g == 0.0) return z;
    if ((g > 0.0) == (hi.g > 0.0)) {
      hi = {z, g};
      if (last == 1) lo.g *= 0.5;
      last = 1;
    } else {
      lo = {z, g};
      if (last == -1) hi.g *= 0.5;
      last = -1;
    }
  }
  return std::clamp(hi.z - hi.g * (hi.z - lo.z) / (hi.g - lo.g), lo.z, hi.z);
}

/// Position at which g has the opposite of `sign` between two positions with `sign`; empty if none exists.
template <class Gap>
std::optional<Sample> dip_between(const Gap& gap, Sample left, Sample right, double sign) {
  double fall = sign * gap.slope(left.z);
  double rise = sign * gap.slope(right.z);
  const double whole = right.z - left.z;
  // beside a clamped end, where g and its slope are zero, g is not convex
  if (const auto t = Cubic{sign * left.g, fall * whole, sign * right.g, rise * whole}.minimum()) {
    const double z = left.z + *t * whole;
    if (const Sample least{z, gap.value(z)}; sign * least.g < 0.0) return least;
  }
  for (int n = 0; n < Limits::dip_trials && fall < 0.0 && rise > 0.0; ++n) {
    // a convex function stays above both end tangents
    const double width = right.z - left.z;
    const double meet = (sign * (right.g - left.g) - rise * width) / (fall - rise);
    if (sign * left.g + fall * meet > 0.0) break;
    const double share = std::clamp(-fall / (rise - fall), 0.1, 0.9);
    const double z = left.z + share * width;
    const Sample middle{z, gap.value(z)};
    if (sign * middle.g <= 0.0) return middle;
    const double slope = sign * gap.slope(z);
    (slope < 0.0 ? left : right) = middle;
    (slope < 0.0 ? fall : rise) = slope;
  }
  return std::nullopt;
}

/// Position of the sign change between two samples. Beside a fixed node g is zero up to rounding, whose sign
/// is ignored: a sign change before the node is searched for.
template <class Gap>
double change_between(const Gap& gap, const Sample& left, const Sample& right) {
  const bool to_zero = std::abs(right.g) < Limits::zero * std::abs(left.g);
  const bool from_zero = std::abs(left.g) < Limits::zero * std::abs(right.g);
  if (!to_zero && !from_zero) return root_between(gap, left, right);
  const Sample& far = to_zero ? left : right;
  const auto dip = dip_between(gap, left, right, far.g > 0.0 ? 1.0 : -1.0);
  if (!dip) return to_zero ? right.z : left.z;
  return to_zero ? root_between(gap, left, *dip) : root_between(gap, *dip, right);
}

/// Calls cross(position, true if contact begins there) for each sign change between two samples.
template <class Gap, class Cross>
void search_part(const Gap& gap, const Sample& left, const Sample& right, const Cross& cross) {
  const bool inside = left.g > 0.0;
  if (inside != (right.g > 0.0)) {
    cross(change_between(gap, left, right), !inside);
    return;
  }
  const auto dip = dip_between(gap, left, right, inside ? 1.0 : -1.0);
  if (!dip || (dip->g > 0.0) == inside) return;
  cross(root_between(gap, left, *dip), !inside);
  cross(root_between(gap, *dip, right), inside);
}

/// Whether g may change sign between two values: the signs differ, or the smaller |g| is at most `change`.
inline bool may_cross(double left, double right, double change) {
  return (left > 0.0) != (right > 0.0) || std::min(std::abs(left), std::abs(right)) <= change;
}

/// Searches a cell between two samples in four parts, to find zones smaller than the sampling.
/// @param before, after changes of g on the parts next to the cell
template <class Gap, class Cross>
void search_cell(const Gap& gap, const Sample& left, const Sample& right, double before, double after,
                 const Cross& cross) {
  constexpr int parts = Limits::parts;
  const double width = right.z - left.z;
  const Eigen::Array4d z =
      left.z + width * Eigen::Array4d(1.0 / parts, 2.0 / parts, 3.0 / parts, 4.0 / parts);
  const Eigen::Array4d inner = gap.values(z);
  std::array<Sample, parts + 1> places{left, Sample{z[0], inner[0]}, Sample{z[1], inner[1]},
                                       Sample{z[2], inner[2]}, right};
  std::array<double, parts + 2> moves{before};
  for (int i = 0; i < parts; ++i) moves[i + 1] = std::abs(places[i + 1].g - places[i].g);
  moves[parts + 1] = after;
  for (int i = 0; i < parts; ++i)
    if (may_cross(places[i].g, places[i + 1].g, std::max({moves[i], moves[i + 1], moves[i + 2]})))
      search_part(gap, places[i], places[i + 1], cross);
}

}  // namespace zone_search

/// @brief Appends the intervals of a range in which a function g is above zero, ascending.
/// @param gap the function of the position on the range, scaled to [0, 1]: value(), slope(), values()
/// @param z, g samples of position and function, ascending; the first `n` count, and there is place for one
/// more
template <class Gap, class Values>
void search_zones(const Gap& gap, const Values& z, const Values& g, int n, std::array<double, 2> range,
                  std::vector<ElementPart>& out) {
  using zone_search::Sample;
  const double length = range[1] - range[0];
  double from = range[0];
  const auto cross = [&](double place, bool entering) {
    const double at = range[0] + length * place;
    if (entering) from = at;
    if (!entering && at > from) out.push_back({from, at});
  };
  Values rate;  // slope of g in the cell before sample i
  rate[0] = 0.0;
  for (int i = 1; i < n; ++i) rate[i] = std::abs(g[i] - g[i - 1]) / (z[i] - z[i - 1]);
  rate[n] = 0.0;
  for (int i = 0; i + 1 < n; ++i) {
    const double width = z[i + 1] - z[i];
    if (!zone_search::may_cross(g[i], g[i + 1], width * std::max({rate[i], rate[i + 1], rate[i + 2]})))
      continue;
    zone_search::search_cell(gap, Sample{z[i], g[i]}, Sample{z[i + 1], g[i + 1]},
                             rate[i] * width / zone_search::Limits::parts,
                             rate[i + 2] * width / zone_search::Limits::parts, cross);
  }
  if (g[n - 1] > 0.0) out.push_back({from, range[1]});
}

}  // namespace snapthrough
