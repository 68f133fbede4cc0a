#include "solver/discrete/places_on_axis.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>

namespace snapthrough {
namespace {

/// Numbers of the search for maxima along an axis. Source: docs/decisions/0018.
struct PlacesOnAxis {
  /// Samples of an axis per half turn, within which the displacement into a support has one or two maxima.
  static constexpr double by_half_turn = 16.0;
  static constexpr std::size_t by_knot = 4;  ///< samples per spline knot
  /// Steps of a golden section search: to 1e-10 of the interval, where the maximum is exact to rounding.
  static constexpr int golden_steps = 48;
};

/// Position of the maximum of a unimodal function on an interval (golden section search).
template <class Function>
double place_of_maximum(double lo, double hi, const Function& value) {
  const double golden = 0.5 * (std::sqrt(5.0) - 1.0);
  double left = hi - golden * (hi - lo);
  double right = lo + golden * (hi - lo);
  double at_left = value(left);
  double at_right = value(right);
  for (int step = 0; step < PlacesOnAxis::golden_steps; ++step) {
    if (at_left > at_right) {
      hi = std::exchange(right, left);
      at_right = at_left;
      left = hi - golden * (hi - lo);
      at_left = value(left);
    } else {
      lo = std::exchange(left, right);
      at_left = at_right;
      right = lo + golden * (hi - lo);
      at_right = value(right);
    }
  }
  return 0.5 * (lo + hi);
}

}  // namespace

std::vector<double> places_on(const AxisCurve& axis, const std::array<double, 2>& range) {
  const double length = axis.length();
  const auto [from, to] = range;
  const double turns = axis.turning(from * length, to * length) / std::numbers::pi;
  const auto parts = static_cast<std::size_t>(PlacesOnAxis::by_half_turn * (1.0 + turns)) +
                     PlacesOnAxis::by_knot * axis.knots().size();
  std::vector<double> places;
  for (std::size_t i = 0; i <= parts; ++i)
    places.push_back(from + (to - from) * static_cast<double>(i) / static_cast<double>(parts));
  return places;
}

std::vector<double> places_of_maxima(const AxisCurve& axis, const std::array<double, 2>& range,
                                     const std::function<double(double)>& value) {
  const std::vector<double> places = places_on(axis, range);
  std::vector<double> values;
  for (const double place : places) values.push_back(value(place));
  std::vector<double> maxima;
  const std::size_t last = places.size() - 1;
  for (std::size_t i = 0; i <= last; ++i) {
    if ((i > 0 && values[i - 1] > values[i]) || (i < last && values[i + 1] > values[i])) continue;
    const double at = place_of_maximum(places[i > 0 ? i - 1 : 0], places[std::min(i + 1, last)], value);
    maxima.push_back(value(at) > values[i] ? at : places[i]);
  }
  return maxima;
}

}  // namespace snapthrough
