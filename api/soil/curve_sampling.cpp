#include "api/soil/curve_sampling.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace snapthrough::api::soil {

namespace {

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();
constexpr double kGolden = 0.6180339887498949;
/// The golden section leaves 1e-8 of the interval; a value at its largest then has lost about the square of
/// that.
constexpr int kSections = 40;

/// Where a function is largest between two ends, and that value.
struct Largest {
  double at = 0.0, value = 0.0;
};

/// Returns the largest value of a function that rises and then falls between a and b, by golden section.
template <class Function>
Largest largest(const Function& value, double a, double b) {
  double left = b - kGolden * (b - a);
  double right = a + kGolden * (b - a);
  double at_left = value(left);
  double at_right = value(right);
  for (int i = 0; i < kSections; ++i) {
    if (at_left > at_right) {
      b = std::exchange(right, left);
      at_right = at_left;
      left = b - kGolden * (b - a);
      at_left = value(left);
    } else {
      a = std::exchange(left, right);
      at_left = at_right;
      right = a + kGolden * (b - a);
      at_right = value(right);
    }
  }
  return at_left > at_right ? Largest{left, at_left} : Largest{right, at_right};
}

/// Returns the largest force at the ends of stretches, which bounds the largest force of the curve from
/// below.
double largest_end(const std::vector<Stretch>& stretches) {
  double found = 0.0;
  for (const Stretch& stretch : stretches) {
    found = std::max(found, stretch.force(stretch.to));
  }
  return found;
}

/// Adds the points of stretches one after the other.
class Sampler {
 public:
  explicit Sampler(double tolerance) : tolerance_(tolerance) {}

  void add(const Stretch& stretch) {
    if (!stretch.is_straight) {
      divide(stretch, stretch.to);
    }
    add_point(stretch.to, stretch.force(stretch.to));
  }
  Curve take() { return std::move(curve_); }

 private:
  /// Adds the points that are needed between the last one and `to`.
  void divide(const Stretch& stretch, double to) {
    const std::array<double, 2> from = curve_.points.back();
    if (!(to > from[0])) {
      return;
    }
    const double slope = (stretch.force(to) - from[1]) / (to - from[0]);
    const Largest error = largest(
        [&](double x) { return std::abs(stretch.force(x) - from[1] - slope * (x - from[0])); }, from[0], to);
    if (error.value > tolerance_ && error.at > from[0] && error.at < to) {
      divide(stretch, error.at);
      add_point(error.at, stretch.force(error.at));
      divide(stretch, to);
    }
  }

  /// Adds a point unless rounding alone parts it from the last one.
  void add_point(double y, double p) {
    if (y > curve_.points.back()[0] * (1.0 + 8.0 * kEpsilon)) {
      curve_.points.push_back({y, std::max(p, 0.0)});
    }
  }

  double tolerance_;
  Curve curve_{{{0.0, 0.0}}};
};

/// Returns where a stretch comes below the line of a stiffness; its end is below, its beginning is not or is
/// 0.
double crossing(const Stretch& stretch, double from, double stiffness) {
  double above = from;
  double below = stretch.to;
  while (below - above > 2.0 * kEpsilon * below && below > 0.0) {
    const double middle = 0.5 * (above + below);
    (stretch.force(middle) < stiffness * middle ? below : above) = middle;
    if (middle == 0.0) {
      return 0.0;
    }
  }
  return below;
}

}  // namespace

Stretch line(double from, double force_from, double to, double force_to) {
  const double slope = (force_to - force_from) / (to - from);
  return {to, [=](double y) { return force_to + slope * (y - to); }, true};
}

std::vector<Stretch> below_line(std::vector<Stretch> stretches, double stiffness) {
  if (!(stiffness > 0.0)) {
    return {};
  }
  double from = 0.0;
  for (auto stretch = stretches.begin(); stretch != stretches.end(); ++stretch) {
    if (stretch->force(stretch->to) < stiffness * stretch->to) {
      const double y = crossing(*stretch, from, stiffness);
      stretches.erase(stretches.begin(), stretch);
      if (y > 0.0) {
        stretches.insert(stretches.begin(), line(0.0, 0.0, y, stiffness * y));
      }
      return stretches;
    }
    from = stretch->to;
  }
  const double last = stretches.back().force(stretches.back().to);
  return {line(0.0, 0.0, last / stiffness, last)};
}

Curve sampled(const std::vector<Stretch>& stretches, double accuracy) {
  const double force = largest_end(stretches);
  Sampler sampler(accuracy * force);
  if (force > 0.0) {
    for (const Stretch& stretch : stretches) {
      sampler.add(stretch);
    }
  }
  return sampler.take();
}

}  // namespace snapthrough::api::soil
