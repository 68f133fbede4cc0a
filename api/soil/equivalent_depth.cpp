#include "api/soil/equivalent_depth.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "api/soil/faces.h"
#include "api/soil/ultimate_resistance.h"
#include "solver/numeric/work_limit.h"

namespace snapthrough::api::soil {

namespace {

/// Integrals differ from the exact ones by about this share.
constexpr double kIntegralError = 1e-12;
/// Halvings that leave a part of a kink's interval which no longer counts.
constexpr int kMostHalvings = 40;

/// Simpson's rule on an interval, with the values that it used.
struct Simpson {
  double a = 0.0, b = 0.0;
  double at_a = 0.0, at_middle = 0.0, at_b = 0.0;

  [[nodiscard]] double middle() const { return 0.5 * (a + b); }
  [[nodiscard]] double sum() const { return (b - a) / 6.0 * (at_a + 4.0 * at_middle + at_b); }
};

/// Returns an integral to a tolerance by halving intervals where Simpson's rule is not enough.
template <class Function>
double refined(const Function& value, const Simpson& whole, double tolerance, int halvings) {
  const double middle = whole.middle();
  const Simpson left{whole.a, middle, whole.at_a, value(0.5 * (whole.a + middle)), whole.at_middle};
  const Simpson right{middle, whole.b, whole.at_middle, value(0.5 * (middle + whole.b)), whole.at_b};
  const double correction = (left.sum() + right.sum() - whole.sum()) / 15.0;
  if (std::abs(correction) <= tolerance || halvings == 0) {
    return left.sum() + right.sum() + correction;
  }
  return refined(value, left, 0.5 * tolerance, halvings - 1) +
         refined(value, right, 0.5 * tolerance, halvings - 1);
}

/// Returns the integral of a function that is not negative, from a to b >= a.
template <class Function>
double integral(const Function& value, double a, double b) {
  constexpr int kParts = 8;
  double sum = 0.0;
  for (int i = 0; i < kParts; ++i) {
    const double from = a + (b - a) * i / kParts;
    const double to = a + (b - a) * (i + 1) / kParts;
    const Simpson whole{from, to, value(from), value(0.5 * (from + to)), value(to)};
    sum += refined(value, whole, kIntegralError * std::max(whole.sum(), sum), kMostHalvings);
  }
  return sum;
}

/// Ultimate resistance of the soil of a layer from the surface on: down to an equivalent depth with the
/// parameters of the layer's upper face, and beneath it with those of the layer.
class Resistance {
 public:
  Resistance(const Layer& layer, double diameter, Loading loading, double top)
      : layer_(layer), diameter_(diameter), loading_(loading), top_(top) {}

  double operator()(double X) const {
    const Place place{X, layer_.gamma * X, diameter_, 0.0, 0.0, loading_};
    const double fraction = std::max(0.0, X - top_) / (layer_.to - layer_.from);
    return std::visit([&](const auto& soil) { return of(soil, fraction, place); }, layer_.soil);
  }

 private:
  [[nodiscard]] double of(const Sand& sand, double /*fraction*/, const Place& place) const {
    return ultimate_of(sand, place);
  }
  [[nodiscard]] double of(const SoftClay& clay, double fraction, const Place& place) const {
    return ultimate_of(SoftClayMatlock{strength_at(layer_, fraction).value_or(0.0), clay.eps50, clay.J},
                       place);
  }
  [[nodiscard]] double of(const Faces<LayerType>& faces, double fraction, const Place& place) const {
    return std::visit(
        [&](const auto& type) {
          if constexpr (requires { ultimate_of(type, place); }) {
            return ultimate_of(type, place);
          } else {
            return 0.0;
          }
        },
        with_mean_strength(at(faces, fraction), mean_strength(fraction, place.depth)));
  }
  /// Returns the mean strength from the surface to a depth X, which is at a fraction of the thickness.
  [[nodiscard]] double mean_strength(double fraction, double X) const {
    const double top = strength_at(layer_, 0.0).value_or(0.0);
    if (!(fraction > 0.0)) {
      return top;
    }
    const double part = X - top_;
    return (top * top_ + strength_at(layer_, 0.5 * fraction).value_or(0.0) * part) / X;
  }

  const Layer& layer_;
  double diameter_;
  Loading loading_;
  double top_;  ///< equivalent depth of the layer's upper face
};

/// @brief Returns the depth at which the integral of a resistance from the surface on is a force.
/// @param guess first depth that is tried, > 0
/// @return at most the limit
double depth_of(const Resistance& resistance, double force, double guess, double limit) {
  double above = 0.0, reached = 0.0;  // the integral from 0 to `above`, less than the force
  double below = std::min(guess, limit);
  for (double next = integral(resistance, 0.0, below); reached + next < force;) {
    if (below >= limit) {
      return limit;
    }
    WorkLimit::poll();
    reached += next;
    above = below;
    below = std::min(2.0 * below, limit);
    next = integral(resistance, above, below);
  }
  double depth = 0.5 * (above + below);
  double low = above;
  while (below - low > 4.0 * std::numeric_limits<double>::epsilon() * below) {
    const double excess = reached + integral(resistance, above, depth) - force;
    (excess < 0.0 ? low : below) = depth;
    const double newton = depth - excess / resistance(depth);
    if (std::abs(newton - depth) <= kIntegralError * depth) {
      return newton;
    }
    depth = newton > low && newton < below ? newton : 0.5 * (low + below);
  }
  return depth;
}

}  // namespace

bool has_equivalent_depth(const Layer& layer) {
  const auto* faces = std::get_if<Faces<LayerType>>(&layer.soil);
  return faces == nullptr || std::visit(
                                 [](const auto& type) {
                                   return requires { ultimate_of(type, Place{}); };
                                 },
                                 faces->top);
}

std::optional<double> EquivalentDepths::next(const Layer& layer) {
  keeps_depths_ = keeps_depths_ || !has_equivalent_depth(layer);
  if (keeps_depths_) {
    return std::nullopt;
  }
  double top = 0.0;
  if (force_ > 0.0) {
    const Resistance alone(layer, diameter_, loading_, std::numeric_limits<double>::infinity());
    top = depth_of(alone, force_, std::max(layer.from, diameter_), limit_);
  }
  if (top < limit_) {
    force_ += integral(Resistance(layer, diameter_, loading_, top), top, top + layer.to - layer.from);
  }
  return top;
}

}  // namespace snapthrough::api::soil
