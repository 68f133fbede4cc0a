#include "api/soil/ultimate_resistance.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace snapthrough::api::soil {

namespace {

constexpr double kDeepFactor = 0.9;      ///< A of sand under cyclic loads, and deep under static loads
constexpr double kSurfaceFactor = 3.0;   ///< A of sand at the surface under static loads
constexpr double kFactorGradient = 0.8;  ///< decrease of A for each diameter of depth
constexpr double kBearingFactor = 9.0;   ///< deep resistance of clay over Su D
constexpr double kSurfaceBearing = 3.0;  ///< resistance of clay at the surface over Su D

Cubic constant(double value) { return Cubic({value, 0.0, 0.0, 0.0}); }
Cubic linear(double at_zero, double slope) { return Cubic({at_zero, slope, 0.0, 0.0}); }

/// Resistances of clay that belong to the shallow and the deep mechanism.
struct ClayMechanisms {
  Cubic shallow, deep;

  /// Returns the excess of the shallow resistance, which is of second degree.
  [[nodiscard]] Cubic excess() const { return shallow + -1.0 * deep; }
};

ClayMechanisms clay_mechanisms(const SoftClay& clay, const Layer& layer, double D, const Cubic& stress) {
  const double slope = (clay.Su_bottom - clay.Su_top) / (layer.to - layer.from);
  const Cubic Su = linear(clay.Su_top - slope * layer.from, slope);
  return {kSurfaceBearing * D * Su + D * stress + linear(0.0, clay.J) * Su, kBearingFactor * D * Su};
}

/// Returns the real roots of a polynomial of second degree in ascending order.
std::vector<double> roots(const Cubic& p) {
  const double a = p.coefficient(2), b = p.coefficient(1), c = p.coefficient(0);
  const double discriminant = b * b - 4.0 * a * c;
  if (!(discriminant >= 0.0)) {
    return {};
  }
  const double q = -0.5 * (b + std::copysign(std::sqrt(discriminant), b));
  std::vector<double> found;
  for (const double root : {q / a, c / q}) {
    if (std::isfinite(root)) {
      found.push_back(root);
    }
  }
  std::sort(found.begin(), found.end());
  return found;
}

/// Divides a contact at those depths that lie within it, `shortest` away from its ends and from each other.
/// @param value returns the polynomial of the piece that contains a depth
template <class ValueAt>
std::vector<Piece> divide(const Contact& contact, std::vector<double> depths, double shortest,
                          const ValueAt& value) {
  std::sort(depths.begin(), depths.end());
  std::vector<Piece> pieces;
  double from = contact.from;
  const auto end_piece = [&](double to) {
    pieces.push_back({from, to, value(0.5 * (from + to))});
    from = to;
  };
  for (const double depth : depths) {
    if (depth > from + shortest && depth < contact.to - shortest) {
      end_piece(depth);
    }
  }
  end_piece(contact.to);
  return pieces;
}

}  // namespace

SandCoefficients sand_coefficients(double phi_degrees) {
  constexpr double kQuarter = std::numbers::pi / 4.0;
  constexpr double K0 = 0.4;
  const double phi = phi_degrees * std::numbers::pi / 180.0;
  const double a = phi / 2.0;
  const double b = kQuarter + phi / 2.0;
  const double Ka = std::pow(std::tan(kQuarter - phi / 2.0), 2);
  const double tan_b = std::tan(b);
  const double tan_wedge = std::tan(b - phi);
  return {K0 * std::tan(phi) * std::sin(b) / (tan_wedge * std::cos(a)) +
              tan_b * tan_b * std::tan(a) / tan_wedge +
              K0 * tan_b * (std::tan(phi) * std::sin(b) - std::tan(a)),
          tan_b / tan_wedge - Ka, Ka * (std::pow(tan_b, 8) - 1.0) + K0 * std::tan(phi) * std::pow(tan_b, 4)};
}

double Cubic::largest_curvature(double a, double b) const {
  const auto curvature = [this](double X) { return std::abs(2.0 * c_[2] + 6.0 * c_[3] * X); };
  return std::max(curvature(a), curvature(b));  // a linear function is largest at an end
}

Cubic operator+(const Cubic& p, const Cubic& q) {
  Cubic sum;
  for (std::size_t i = 0; i < sum.c_.size(); ++i) {
    sum.c_[i] = p.c_[i] + q.c_[i];
  }
  return sum;
}

Cubic operator*(const Cubic& p, const Cubic& q) {
  Cubic product;
  for (std::size_t i = 0; i < product.c_.size(); ++i) {
    for (std::size_t j = 0; i + j < product.c_.size(); ++j) {
      product.c_[i + j] += p.c_[i] * q.c_[j];
    }
  }
  return product;
}

Cubic operator*(double factor, const Cubic& p) { return constant(factor) * p; }

std::vector<Piece> sand_resistance(const Sand& sand, double D, Loading loading, const Contact& contact,
                                   double shortest) {
  const double deep_from = (sand.C3 - sand.C2) * D / sand.C1;
  const double factor_end =
      loading == Loading::static_ ? (kSurfaceFactor - kDeepFactor) / kFactorGradient * D : 0.0;
  return divide(contact, {deep_from, factor_end}, shortest, [&](double X) {
    const Cubic bearing = X < deep_from ? linear(sand.C2 * D, sand.C1) : constant(sand.C3 * D);
    const Cubic factor =
        X < factor_end ? linear(kSurfaceFactor, -kFactorGradient / D) : constant(kDeepFactor);
    return factor * (bearing * contact.stress);
  });
}

double ultimate_of(const Sand& sand, const Place& place) {
  const double D = place.diameter;
  const double factor = place.loading == Loading::static_
                            ? std::max(kDeepFactor, kSurfaceFactor - kFactorGradient * place.depth / D)
                            : kDeepFactor;
  return factor * std::min(sand.C1 * place.depth + sand.C2 * D, sand.C3 * D) * place.stress;
}

std::vector<Piece> clay_resistance(const SoftClay& clay, const Layer& layer, double D, const Contact& contact,
                                   double shortest) {
  const ClayMechanisms mechanisms = clay_mechanisms(clay, layer, D, contact.stress);
  return divide(contact, roots(mechanisms.excess()), shortest, [&](double X) {
    return mechanisms.shallow(X) < mechanisms.deep(X) ? mechanisms.shallow : mechanisms.deep;
  });
}

double transition_depth(const SoftClay& clay, const Layer& layer, double D, const Cubic& stress) {
  const Cubic excess = clay_mechanisms(clay, layer, D, stress).excess();
  double from = layer.from;
  for (const double root : roots(excess)) {
    if (root > from) {
      if (excess(0.5 * (from + root)) >= 0.0) {
        return from;
      }
      from = root;
    }
  }
  // Beyond the last root the sign stays; the layer's own strength and J > 0 let the shallow resistance win.
  return from;
}

}  // namespace snapthrough::api::soil
