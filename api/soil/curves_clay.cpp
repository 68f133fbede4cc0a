/// Curves of clay.

#include <algorithm>
#include <cmath>
#include <span>

#include "api/soil/curve_sampling.h"

namespace snapthrough::api::soil {

namespace {

/// Ultimate resistance of clay per length of pile by Matlock's formula, and how deep the place is. The
/// formula's shallow mechanism may have another strength Su than the deep one.
struct ClayResistance {
  double ultimate = 0.0;  ///< Pmax
  double ratio = 0.0;     ///< X/X_R, at most 1
};

ClayResistance clay_resistance(double Su, double Su_shallow, double J, const Place& place) {
  const double D = place.diameter;
  const double deep = 9.0 * Su * D;
  const double gain = place.stress * D + J * Su_shallow * place.depth;
  const double needed = deep - 3.0 * Su_shallow * D;  // 6 Su D where both strengths are one
  return {std::min(3.0 * Su_shallow * D + gain, deep), gain < needed ? gain / needed : 1.0};
}

constexpr double kStrainFactor = 2.5;     ///< y50 / (eps50 D) of Matlock
constexpr double kCyclicCapacity = 0.72;  ///< p/Pmax that cyclic loads leave below the transition depth
constexpr double kFallFrom = 3.0;         ///< y/y50 from where the cyclic curve falls above that depth
constexpr double kFallTo = 15.0;

/// Adds straight lines through points (y/y50, p/Pmax).
void add_lines(std::vector<Stretch>& stretches, std::span<const std::array<double, 2>> points, double y50,
               double ultimate) {
  for (std::size_t i = 1; i < points.size(); ++i) {
    stretches.push_back(line(points[i - 1][0] * y50, points[i - 1][1] * ultimate, points[i][0] * y50,
                             points[i][1] * ultimate));
  }
}

/// Adds p = Pmax (y/y_ultimate)^exponent up to p = capacity Pmax; a straight line to `first`, if that is
/// positive.
void add_power(std::vector<Stretch>& stretches, double first, double ultimate, double y_ultimate,
               double exponent, double capacity) {
  const auto power = [=](double y) { return ultimate * std::pow(y / y_ultimate, exponent); };
  if (first > 0.0) {
    stretches.push_back(line(0.0, 0.0, first, power(first)));
  }
  stretches.push_back({y_ultimate * std::pow(capacity, 1.0 / exponent), power});
}

/// Ends a falling line where its force is 0, if that is before its own end.
void cut_at_zero(Stretch& fall, double from) {
  const double start = fall.force(from);
  const double end = fall.force(fall.to);
  if (end < 0.0) {
    fall = line(from, start, from + (fall.to - from) * start / (start - end), 0.0);
  }
}

/// Static curve of Reese's stiff clay without its first line.
std::vector<Stretch> softening(double pc, double y50, double A) {
  const double first = A * y50;
  const auto root = [=](double y) { return 0.5 * pc * std::sqrt(y / y50); };
  const auto bent = [=](double y) { return root(y) - 0.055 * pc * std::pow(y / first - 1.0, 1.25); };
  const double peak = bent(6.0 * first);
  Stretch fall = line(6.0 * first, peak, 18.0 * first, peak - 0.0625 * 12.0 * A * pc);
  cut_at_zero(fall, 6.0 * first);
  return {{first, root}, {6.0 * first, bent}, fall};
}

/// Cyclic curve of Reese's stiff clay without its first line.
std::vector<Stretch> cyclic_softening(double pc, double y50, double A) {
  const double yp = 4.1 * A * y50;
  const auto hump = [=](double y) { return A * pc * (1.0 - std::pow(std::abs(y / (0.45 * yp) - 1.0), 2.5)); };
  const double left = hump(0.6 * yp);
  return {{0.6 * yp, hump}, line(0.6 * yp, left, 1.8 * yp, left - 0.085 * 1.2 * pc * yp / y50)};
}

}  // namespace

double ultimate_of(const SoftClayMatlock& clay, const Place& place) {
  return clay_resistance(clay.Su, clay.Su, clay.J, place).ultimate;
}

double ultimate_of(const StiffClayFreeWater& clay, const Place& place) {
  const double D = place.diameter;
  return std::min((2.0 * clay.Su_mean + place.stress) * D + 2.83 * clay.Su_mean * place.depth,
                  11.0 * clay.Su * D);
}

double ultimate_of(const StiffClay& clay, const Place& place) {
  return clay_resistance(clay.Su, clay.Su_mean, clay.J, place).ultimate;
}

Curve curve_of(const SoftClayMatlock& clay, const Place& place, double accuracy) {
  static constexpr std::array<double, 2> kApiPoints[] = {{0.0, 0.0}, {0.1, 0.23}, {0.3, 0.33},
                                                         {1.0, 0.5}, {3.0, 0.72}, {8.0, 1.0}};
  const auto [ultimate, ratio] = clay_resistance(clay.Su, clay.Su, clay.J, place);
  const double y50 = kStrainFactor * clay.eps50 * place.diameter;
  const bool cyclic = place.loading == Loading::cyclic;
  std::vector<Stretch> stretches;
  if (clay.start == SoftClayStart::api_points) {
    add_lines(stretches, std::span(kApiPoints).first(cyclic ? 5 : 6), y50, ultimate);
  } else {
    add_power(stretches, clay.first_point * y50, ultimate, 8.0 * y50, 1.0 / 3.0,
              cyclic ? kCyclicCapacity : 1.0);
  }
  if (cyclic && ratio < 1.0) {
    const double capacity = kCyclicCapacity * ultimate;
    if (stretches.back().to < kFallFrom * y50) {
      stretches.push_back(line(stretches.back().to, capacity, kFallFrom * y50, capacity));
    }
    stretches.push_back(line(kFallFrom * y50, capacity, kFallTo * y50, capacity * ratio));
  }
  return sampled(stretches, accuracy);
}

Curve curve_of(const StiffClayFreeWater& clay, const Place& place, double accuracy) {
  const double D = place.diameter;
  const double pc = ultimate_of(clay, place);
  const double y50 = clay.eps50 * D;
  const double depth = place.depth / D;
  if (!(pc > 0.0)) {
    return sampled({}, accuracy);
  }
  auto stretches = place.loading == Loading::cyclic
                       ? cyclic_softening(pc, y50, 0.2 + 0.1 * std::tanh(1.5 * depth))
                       : softening(pc, y50, 0.2 + 0.4 * std::tanh(0.62 * depth));
  return sampled(below_line(std::move(stretches), clay.k * place.depth), accuracy);
}

Curve curve_of(const StiffClay& clay, const Place& place, double accuracy) {
  const double ultimate = ultimate_of(clay, place);
  const double y50 = kStrainFactor * clay.eps50 * place.diameter;
  const double extent = 16.0 + (place.loading == Loading::cyclic ? 9.6 * std::log10(clay.cycles) : 0.0);
  std::vector<Stretch> stretches;
  add_power(stretches, clay.first_point * y50, ultimate, extent * y50, 0.25, 1.0);
  return sampled(stretches, accuracy);
}

}  // namespace snapthrough::api::soil
