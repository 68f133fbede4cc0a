/// Axial curves, and the choice among types.

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

#include "api/soil/curves.h"

namespace snapthrough::api::soil {

namespace {

/// Returns the curve through the origin and points (displacement/`length`, force/`force`).
Curve through(std::span<const std::array<double, 2>> points, double length, double force) {
  Curve curve{{{0.0, 0.0}}};
  if (force > 0.0) {
    for (const auto& [y, p] : points) {
      curve.points.push_back({y * length, p * force});
    }
  }
  return curve;
}

}  // namespace

Curve curve_of(const ApiTzClay& clay, const Place& place, double /*accuracy*/) {
  const std::array<double, 2> points[] = {{0.0016, 0.3}, {0.0031, 0.5}, {0.0057, 0.75},
                                          {0.008, 0.9},  {0.01, 1.0},   {0.02, clay.residual}};
  return through(points, place.diameter, std::numbers::pi * place.diameter * clay.friction);
}

Curve curve_of(const ApiTzSand& sand, const Place& place, double /*accuracy*/) {
  const std::array<double, 2> points[] = {{1.0, 1.0}};
  return through(points, sand.peak_displacement, std::numbers::pi * place.diameter * sand.friction);
}

Curve tip_curve_of(const ApiQz& tip, const Place& place) {
  const std::array<double, 2> points[] = {
      {0.002, 0.25}, {0.013, 0.5}, {0.042, 0.75}, {0.073, 0.9}, {0.1, 1.0}};
  return through(points, place.diameter, tip.area * tip.end_bearing);
}

double api_clay_friction(double Su, double stress) {
  if (!(Su > 0.0) || !(stress > 0.0)) {
    return 0.0;
  }
  const double ratio = Su / stress;
  return Su * std::min(1.0, 0.5 * std::pow(ratio, ratio > 1.0 ? -0.25 : -0.5));
}

Curve curve_of(const LayerType& type, const Place& place, double accuracy) {
  return std::visit([&](const auto& soil) { return curve_of(soil, place, accuracy); }, type);
}

Curve curve_of(const AxialType& type, const Place& place, double accuracy) {
  return std::visit([&](const auto& soil) { return curve_of(soil, place, accuracy); }, type);
}

}  // namespace snapthrough::api::soil
