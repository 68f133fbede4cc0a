#include "solver/events/hidden_events.h"

#include <algorithm>
#include <cmath>

#include "solver/numeric/cubic.h"

namespace snapthrough {

using Eigen::Index;

namespace {

/// Suspicion of hidden events. Source: docs/decisions/0022.
struct Suspicion {
  /// Coefficient of the squared distance in the bend that the stiffness of a motion may have on a step, over
  /// the larger difference between its slope at an end and its mean slope. Assumed: the slope changes within
  /// half of the step.
  static constexpr double curvature = 4.0;
  static constexpr double margin = 1e-3;      ///< least distance of a dip from the ends, fraction of the step
  static constexpr double same_motion = 0.7;  ///< least cosine of two points' modes that are one motion
};

/// Distance at which a value vanishes that has this rate and bends towards zero by `bend` times the squared
/// distance.
double bent_to_zero(double value, double rate, double bend) {
  return 2.0 * value / (std::sqrt(rate * rate + 4.0 * bend * value) - rate);
}

/// Position where a stiffness could cross zero if its curvature were four times the mismatch of its end
/// slopes: a change of slope that half of the way brings about.
std::optional<double> bent_dip(const Cubic& stiffness) {
  const double change = stiffness.f1 - stiffness.f0;
  const double bend =
      Suspicion::curvature * std::max(std::abs(change - stiffness.m0), std::abs(change - stiffness.m1));
  const double from = bent_to_zero(stiffness.f0, stiffness.m0, bend);
  const double to = 1.0 - bent_to_zero(stiffness.f1, -stiffness.m1, bend);
  return from < to ? std::optional(0.5 * (from + to)) : std::nullopt;
}

}  // namespace

std::optional<Dip> find_dip(const PathPoint& a, const PathPoint& b, double length) {
  if (!a.modes || !b.modes) return std::nullopt;
  const SoftModes& from = *a.modes;
  const SoftModes& to = *b.modes;
  for (Index i = 0; i < from.count(); ++i) {
    for (Index j = 0; j < to.count(); ++j) {
      if ((from.stiffness[i] > 0.0) != (to.stiffness[j] > 0.0)) continue;
      if (!(from.distance_to_zero(i, 1.0) + to.distance_to_zero(j, -1.0) < length)) continue;
      const double meet =
          (to.stiffness[j] - from.stiffness[i] - to.rate[j] * length) / (from.rate[i] - to.rate[j]);
      return Dip{i, std::clamp(meet / length, Suspicion::margin, 1.0 - Suspicion::margin)};
    }
  }
  return std::nullopt;
}

std::optional<double> knee_fraction(const Segment& segment) {
  const PathPoint& a = segment.from();
  const PathPoint& b = segment.to();
  if (!a.modes || !b.modes) return std::nullopt;
  const PathMetric& metric = segment.solver().norm().metric();
  const double length = segment.length();
  for (Index i = 0; i < a.modes->count(); ++i) {
    const double sign = std::copysign(1.0, a.modes->stiffness[i]);
    for (Index j = 0; j < b.modes->count(); ++j) {
      if (sign * b.modes->stiffness[j] <= 0.0) continue;
      if (std::abs(metric.inner(a.modes->motions.col(i), 0.0, b.modes->motions.col(j), 0.0)) <
          Suspicion::same_motion)
        continue;
      const auto fraction = bent_dip({sign * a.modes->stiffness[i], sign * length * a.modes->rate[i],
                                      sign * b.modes->stiffness[j], sign * length * b.modes->rate[j]});
      if (fraction) return fraction;
    }
  }
  return std::nullopt;
}

std::optional<double> turn_fraction(const Segment& segment, bool inside, double tolerance) {
  const PathPoint& a = segment.from();
  const PathPoint& b = segment.to();
  const double length = segment.distance();
  const Cubic load{a.lambda, length * segment.load_rate(a), b.lambda, length * segment.load_rate(b)};
  const double excess = std::min(std::abs(load.m0), std::abs(load.m1)) - std::abs(load.f1 - load.f0);
  const double least = tolerance * std::max(std::abs(a.lambda), segment.solver().norm().least_load());
  if (inside && excess <= least) return std::nullopt;
  const auto at = load.inflection();
  return at && (load.slope(*at) > 0.0) != (load.m0 > 0.0) ? at : std::nullopt;
}

}  // namespace snapthrough
