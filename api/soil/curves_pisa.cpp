/// Curves of PISA.

#include <algorithm>
#include <cmath>

#include "api/soil/curve_sampling.h"

namespace snapthrough::api::soil {

namespace {

/// @brief Returns v = y/y_u of a conic at u = x/x_u in [0, 1].
///
/// With r = k x_u/y_u the conic is a v^2 + b v + c = 0, of whose roots the one belongs to the curve that is 0
/// at u = 0 and 1 at u = 1. Each sign of b has the form of that root that subtracts nothing.
/// @pre 0 < n < 1, r > 1
double bent(double n, double r, double u) {
  const double a = 1.0 - 2.0 * n;
  const double b = 2.0 * n * u - (1.0 - n) * (1.0 + r * u);
  const double c = (1.0 - n) * r * u - n * u * u;
  const double root = std::sqrt(std::max(b * b - 4.0 * a * c, 0.0));
  return b > 0.0 ? (-b - root) / (2.0 * a) : 2.0 * c / (root - b);
}

/// Returns how far the tangent at the origin of a concave function may be followed: to where it is `most`
/// above the function.
template <class Function>
double tangent_until(const Function& force, double slope, double most, double end) {
  constexpr int kHalvings = 60;
  double near = 0.0;
  double far = end;
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = 0.5 * (near + far);
    (slope * middle - force(middle) > most ? far : near) = middle;
  }
  return near;
}

/// Returns two straight lines from 0 with slope k up to y_u.
Conic two_lines(double k, double y_u) { return {k, 0.0, y_u / k, y_u}; }

}  // namespace

double conic_value(const Conic& conic, double x) {
  const double u = std::clamp(x / conic.x_u, 0.0, 1.0);
  const double r = conic.k * conic.x_u / conic.y_u;
  if (conic.n >= 1.0 || !(r > 1.0)) {
    return conic.y_u * u;
  }
  return conic.y_u * (conic.n <= 0.0 ? std::min(r * u, 1.0) : bent(conic.n, r, u));
}

Curve conic_curve(const Conic& conic, double x_scale, double y_scale, double accuracy) {
  const double x_u = conic.x_u * x_scale;
  const double y_u = conic.y_u * y_scale;
  if (!(x_u > 0.0 && y_u > 0.0)) {
    return sampled({}, accuracy);
  }
  const double r = std::max(conic.k * conic.x_u / conic.y_u, 1.0);
  const bool is_bent = conic.n > 0.0 && conic.n < 1.0 && r > 1.0;
  const double end = conic.n <= 0.0 ? x_u / r : x_u;
  const auto force = [=](double x) { return y_scale * conic_value(conic, x / x_scale); };
  std::vector<Stretch> stretches{{end, force, !is_bent}};
  if (is_bent) {  // a chord would give the pile at rest too little stiffness
    const double slope = conic.k * y_scale / x_scale;
    const double to = tangent_until(force, slope, 0.5 * accuracy * y_u, end);
    stretches.insert(stretches.begin(), line(0.0, 0.0, to, slope * to));
  }
  return sampled(stretches, accuracy);
}

Curve curve_of(const PisaClay& clay, const Place& place, double accuracy) {
  const double D = place.diameter;
  const double depth = place.depth / D;
  return conic_curve(
      {10.6 - 1.65 * depth, 0.939 - 0.03345 * depth, 241.4, 10.7 - 7.101 * std::exp(-0.3085 * depth)},
      clay.Su * D / clay.G0, clay.Su * D, accuracy);
}

Curve moment_curve_of(const PisaClay& clay, const Place& place, double accuracy) {
  const double D = place.diameter;
  const double depth = place.depth / D;
  return conic_curve(two_lines(1.42 - 0.09643 * depth, 0.2899 - 0.04775 * depth), clay.Su / clay.G0,
                     clay.Su * D * D, accuracy);
}

Curve base_shear_curve_of(const PisaClay& clay, const Place& place, double accuracy) {
  const double D = place.diameter;
  const double length = place.embedded_length / D;
  return conic_curve({2.717 - 0.3575 * length, 0.8793 - 0.0315 * length, 235.7, 0.4038 + 0.04812 * length},
                     clay.Su * D / clay.G0, clay.Su * D * D, accuracy);
}

Curve base_moment_curve_of(const PisaClay& clay, const Place& place, double accuracy) {
  const double D = place.diameter;
  const double length = place.embedded_length / D;
  return conic_curve({0.2146 - 0.002132 * length, 1.079 - 0.1087 * length, 173.1, 0.8192 - 0.08588 * length},
                     clay.Su / clay.G0, clay.Su * D * D * D, accuracy);
}

Curve curve_of(const PisaSand& sand, const Place& place, double accuracy) {
  const double D = place.diameter;
  const double R = sand.relative_density;
  const double s = place.stress;
  return conic_curve({8.731 - 0.6982 * R - 0.9178 * place.depth / D, 0.917 + 0.06193 * R, 146.1 - 92.11 * R,
                      0.3667 + 25.89 * R + (0.3375 - 8.9 * R) * place.depth / place.embedded_length},
                     s * D / sand.G0, s * D, accuracy);
}

Curve moment_curve_of(const PisaSand& sand, const Place& place, double force, double accuracy) {
  const double R = sand.relative_density;
  const double fraction = place.depth / place.embedded_length;
  return conic_curve(two_lines(17.0, 0.2605 + (-0.1989 + 0.2019 * R) * fraction), place.stress / sand.G0,
                     force * place.diameter, accuracy);
}

Curve base_shear_curve_of(const PisaSand& sand, const Place& place, double accuracy) {
  const double D = place.diameter;
  const double R = sand.relative_density;
  const double s = place.stress;
  const double length = place.embedded_length / D;
  return conic_curve({6.505 - 2.985 * R + (-0.007969 - 0.4299 * R) * length,
                      0.09978 + 0.7974 * R + (0.004994 - 0.07005 * R) * length,
                      0.515 + 2.883 * R + (0.1695 - 0.7018 * R) * length,
                      0.09952 + 0.7996 * R + (0.03988 - 0.1606 * R) * length},
                     s * D / sand.G0, s * D * D, accuracy);
}

Curve base_moment_curve_of(const PisaSand& sand, const Place& place, double accuracy) {
  const double D = place.diameter;
  const double R = sand.relative_density;
  const double s = place.stress;
  const double length = place.embedded_length / D;
  return conic_curve(
      {0.3515, 0.3 + 0.4986 * R, 44.89, 0.09981 + 0.371 * R + (0.01998 - 0.09041 * R) * length}, s / sand.G0,
      s * D * D * D, accuracy);
}

}  // namespace snapthrough::api::soil
