#include "tests/stress/rod_rule.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace snapthrough::testing {
namespace {

/// Legendre polynomial of degree n on [-1, 1] and its derivative (inside the interval).
std::array<double, 2> legendre(int n, double z) {
  double before = 1.0;
  double now = z;
  for (int k = 2; k <= n; ++k) {
    const double next = ((2 * k - 1) * z * now - (k - 1) * before) / k;
    before = now;
    now = next;
  }
  return {now, n * (z * now - before) / (z * z - 1.0)};
}

}  // namespace

Rule gauss(int n) {
  Rule rule;
  for (int i = 0; i < n; ++i) {
    double z = -std::cos(std::numbers::pi * (i + 0.75) / (n + 0.5));
    if (n == 1) z = 0.0;
    for (int it = 0; it < 20 && n > 1; ++it) {
      const auto [value, slope] = legendre(n, z);
      z -= value / slope;
    }
    const double slope = n == 1 ? 1.0 : legendre(n, z)[1];
    rule.points.push_back(0.5 * (1.0 + z));
    rule.weights.push_back(1.0 / ((1.0 - z * z) * slope * slope));
  }
  return rule;
}

Rule lobatto(int n) {
  Rule rule;
  const int m = n - 1;
  for (int i = 0; i < n; ++i) {
    double z = -std::cos(std::numbers::pi * i / m);
    if (i > 0 && i < m)  // inner points are zeros of P'_m; Legendre's equation gives its derivative
      for (int it = 0; it < 50; ++it) {
        const auto [value, slope] = legendre(m, z);
        z -= slope * (1.0 - z * z) / (2.0 * z * slope - m * (m + 1) * value);
      }
    double value = i == 0 ? (m % 2 == 0 ? 1.0 : -1.0) : 1.0;
    if (i > 0 && i < m) value = m == 1 ? z : legendre(m, z)[0];
    rule.points.push_back(0.5 * (1.0 + z));
    rule.weights.push_back(1.0 / (m * (m + 1) * value * value));
  }
  return rule;
}

namespace {

/// Legendre polynomials of degree 0 to n at xi of [0, 1].
Eigen::VectorXd legendre_series(int n, double xi) {
  const double z = 2.0 * xi - 1.0;
  Eigen::VectorXd out = Eigen::VectorXd::Ones(n + 1);
  if (n > 0) out[1] = z;
  for (int k = 2; k <= n; ++k) out[k] = ((2 * k - 1) * z * out[k - 1] - (k - 1) * out[k - 2]) / k;
  return out;
}

}  // namespace

/// The Gauss points integrate the products of Lagrange and Legendre polynomials exactly, which are the
/// coefficients of the series.
Lagrange::Lagrange(int order) : rule_(gauss(order)), series_(order, order) {
  for (int q = 0; q < order; ++q) {
    const Eigen::VectorXd at = legendre_series(order - 1, rule_.points[static_cast<std::size_t>(q)]);
    for (int k = 0; k < order; ++k)
      series_(q, k) = rule_.weights[static_cast<std::size_t>(q)] * (2 * k + 1) * at[k];
  }
}

Eigen::VectorXd Lagrange::values(double xi) const { return series_ * legendre_series(order() - 1, xi); }

/// The integral of a Legendre polynomial of degree k is (P_(k+1) - P_(k-1)) / (4 k + 2) on [0, 1].
Eigen::VectorXd Lagrange::integrals(double xi) const {
  const Eigen::VectorXd at = legendre_series(order(), xi);
  Eigen::VectorXd integral(order());
  integral[0] = xi;
  for (int k = 1; k < order(); ++k) integral[k] = (at[k + 1] - at[k - 1]) / (4 * k + 2);
  return series_ * integral;
}

}  // namespace snapthrough::testing
