/// Curves of sand.

#include <algorithm>
#include <cmath>
#include <iterator>

#include "api/soil/curve_sampling.h"
#include "api/soil/ultimate_resistance.h"

namespace snapthrough::api::soil {

namespace {

/// Reading of the figures of Reese's sand at one relative depth.
struct SandFactors {
  double depth = 0.0;  ///< X/D
  double A_static = 0.0, A_cyclic = 0.0, B_static = 0.0, B_cyclic = 0.0;
};

constexpr SandFactors kSandFactors[] = {
    {0.0, 2.90, 0.75, 2.20, 0.50}, {0.5, 2.54, 0.91, 1.85, 0.71}, {1.0, 2.13, 1.06, 1.56, 0.84},
    {1.5, 1.77, 1.08, 1.26, 0.86}, {2.0, 1.48, 1.01, 1.05, 0.82}, {2.5, 1.24, 0.97, 0.88, 0.78},
    {3.0, 1.04, 0.93, 0.70, 0.69}, {4.0, 0.88, 0.88, 0.54, 0.56}, {5.0, 0.88, 0.88, 0.50, 0.55}};

/// Coefficients A and B of Reese's sand.
struct SandPair {
  double A = 0.0, B = 0.0;
};

SandPair sand_pair(double relative_depth, Loading loading) {
  const auto pair = [&](const SandFactors& row) {
    return loading == Loading::cyclic ? SandPair{row.A_cyclic, row.B_cyclic}
                                      : SandPair{row.A_static, row.B_static};
  };
  const SandFactors* below = std::ranges::upper_bound(kSandFactors, relative_depth, {}, &SandFactors::depth);
  if (below == std::end(kSandFactors)) {
    return pair(*std::prev(below));
  }
  const SandFactors& above = *std::prev(below);
  const double t = (relative_depth - above.depth) / (below->depth - above.depth);
  const SandPair a = pair(above);
  const SandPair b = pair(*below);
  return {std::lerp(a.A, b.A, t), std::lerp(a.B, b.B, t)};
}

/// Returns ps of Reese's sand.
double sand_strength(const ReeseSand& sand, const Place& place) {
  const auto [C1, C2, C3] = sand_coefficients(sand.phi);
  const double D = place.diameter;
  return std::min(C1 * place.depth + C2 * D, C3 * D) * place.stress;
}

/// Returns Pd of liquefied sand for a diameter in metres.
double diameter_factor(double D) {
  constexpr double kLeast = 0.3;
  constexpr double kLargest = 2.6;
  const double factor = 3.81 * std::log(std::clamp(D, kLeast, kLargest)) + 5.6;
  return D < kLeast ? factor * D / kLeast : factor;
}

}  // namespace

double ultimate_of(const ReeseSand& sand, const Place& place) {
  return sand_pair(place.depth / place.diameter, place.loading).A * sand_strength(sand, place);
}

Curve curve_of(const ReeseSand& sand, const Place& place, double accuracy) {
  const double D = place.diameter;
  const double ps = sand_strength(sand, place);
  if (!(ps > 0.0)) {
    return sampled({}, accuracy);
  }
  const auto [A, B] = sand_pair(place.depth / D, place.loading);
  const double y_m = D / 60.0;
  const double y_u = 3.0 * D / 80.0;
  const double exponent = (A / B - 1.0) * y_m / (y_u - y_m);
  const auto power = [=, p_m = B * ps](double y) { return p_m * std::pow(y / y_m, exponent); };
  return sampled(below_line({{y_m, power}, line(y_m, B * ps, y_u, A * ps)}, sand.k * place.depth), accuracy);
}

Curve curve_of(const LiquefiedSand& sand, const Place& place, double accuracy) {
  constexpr double kLargestDisplacement = 0.150;  // m
  constexpr double kLargestForce = 15.0;          // kN/m
  constexpr double kMillimetres = 1000.0;         // in a metre
  const double X = place.depth / sand.metre;
  const double A = 3e-7 * std::pow(X + 1.0, 6.05);
  const double B = 2.8 * std::pow(X + 1.0, 0.11);
  const double C = 2.85 * std::pow(X + 1.0, -0.41);
  const double end = std::min(kLargestDisplacement, std::pow(kLargestForce / A, 1.0 / C) / B / kMillimetres);
  const double scale = diameter_factor(place.diameter / sand.metre) * A * sand.kilonewton / sand.metre;
  const double factor = B * kMillimetres / sand.metre;
  const auto power = [=](double y) { return scale * std::pow(factor * y, C); };
  return sampled({{end * sand.metre, power}}, accuracy);
}

}  // namespace snapthrough::api::soil
