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

Eigen::VectorXd Lagrange::values(double xi) const {
  const auto& x = rule_.points;
  Eigen::VectorXd out = Eigen::VectorXd::Ones(order());
  for (std::size_t q = 0; q < x.size(); ++q)
    for (std::size_t r = 0; r < x.size(); ++r)
      if (r != q) out[static_cast<Eigen::Index>(q)] *= (xi - x[r]) / (x[q] - x[r]);
  return out;
}

Eigen::VectorXd Lagrange::integrals(double xi) const {
  Eigen::VectorXd out = Eigen::VectorXd::Zero(order());
  for (int i = 0; i < order(); ++i) out += xi * rule_.weights[i] * values(xi * rule_.points[i]);
  return out;
}

}  // namespace snapthrough::testing
