#include "solver/numeric/gauss_rule.h"

#include <cmath>
#include <cstddef>
#include <memory>
#include <numbers>

namespace snapthrough {
namespace {

/// Legendre polynomials P_0 .. P_n at x = 2 xi - 1.
void legendre(int n, double xi, std::span<double> p) {
  const double x = 2.0 * xi - 1.0;
  p[0] = 1.0;
  if (n >= 1) p[1] = x;
  for (int k = 1; k < n; ++k) p[k + 1] = ((2 * k + 1) * x * p[k] - k * p[k - 1]) / (k + 1);
}

/// P_n and its derivative on [-1, 1].
std::array<double, 2> legendre_with_derivative(int n, double x) {
  double p0 = 1.0;
  double p1 = x;
  for (int k = 1; k < n; ++k) {
    const double p2 = ((2 * k + 1) * x * p1 - k * p0) / (k + 1);
    p0 = p1;
    p1 = p2;
  }
  if (n == 0) return {1.0, 0.0};
  return {p1, n * (x * p1 - p0) / (x * x - 1.0)};
}

}  // namespace

Quadrature gauss_legendre(int n) {
  Quadrature rule;
  rule.points.resize(static_cast<std::size_t>(n));
  rule.weights.resize(static_cast<std::size_t>(n));
  for (int i = 0; i < n; ++i) {
    double x = -std::cos(std::numbers::pi * (i + 0.75) / (n + 0.5));
    for (int it = 0; it < 100; ++it) {
      const auto [p, dp] = legendre_with_derivative(n, x);
      const double dx = p / dp;
      x -= dx;
      if (std::abs(dx) < 1e-16) break;
    }
    if (n % 2 == 1 && i == n / 2) x = 0.0;
    const double dp = legendre_with_derivative(n, x)[1];
    rule.points[i] = 0.5 * (1.0 + x);
    rule.weights[i] = 1.0 / ((1.0 - x * x) * dp * dp);
  }
  return rule;
}

Quadrature gauss_lobatto(int n) {
  Quadrature rule;
  rule.points.resize(static_cast<std::size_t>(n));
  rule.weights.resize(static_cast<std::size_t>(n));
  const int m = n - 1;
  for (int i = 0; i < n; ++i) {
    double x = -std::cos(std::numbers::pi * i / m);
    if (i > 0 && i < m) {  // roots of P_m' by Newton's method, with P_m'' from Legendre's equation
      for (int it = 0; it < 100; ++it) {
        const auto [p, dp] = legendre_with_derivative(m, x);
        const double ddp = (2.0 * x * dp - m * (m + 1) * p) / (1.0 - x * x);
        const double dx = dp / ddp;
        x -= dx;
        if (std::abs(dx) < 1e-16) break;
      }
      if (n % 2 == 1 && i == m / 2) x = 0.0;
    }
    const double p = (i == 0 || i == m) ? 1.0 : legendre_with_derivative(m, x)[0];
    rule.points[i] = i == 0 ? 0.0 : (i == m ? 1.0 : 0.5 * (1.0 + x));
    rule.weights[i] = 1.0 / (m * (m + 1) * p * p);
  }
  return rule;
}

CollocationRule::CollocationRule(int order) : order_(order) {
  const Quadrature gauss = gauss_legendre(order);
  std::array<double, kMaxOrder + 1> p{};
  for (int r = 0; r < order; ++r) {
    c_[r] = gauss.points[r];
    b_[r] = gauss.weights[r];
    legendre(order, c_[r], p);
    for (int k = 0; k < order; ++k) coefficient_[k][r] = b_[r] * (2 * k + 1) * p[k];
  }
  for (int q = 0; q < order; ++q) integrals_at(c_[q], std::span(a_[q]).first(order));
}

void CollocationRule::integrals_at(double xi, std::span<double> out) const {
  std::array<double, kMaxOrder + 1> p{};
  legendre(order_, xi, p);
  for (int r = 0; r < order_; ++r) out[r] = coefficient_[0][r] * xi;
  for (int k = 1; k < order_; ++k) {
    const double integral = (p[k + 1] - p[k - 1]) / (2.0 * (2 * k + 1));
    for (int r = 0; r < order_; ++r) out[r] += coefficient_[k][r] * integral;
  }
}

void CollocationRule::values_at(double xi, std::span<double> out) const {
  std::array<double, kMaxOrder + 1> p{};
  legendre(order_, xi, p);
  for (int r = 0; r < order_; ++r) out[r] = 0.0;
  for (int k = 0; k < order_; ++k)
    for (int r = 0; r < order_; ++r) out[r] += coefficient_[k][r] * p[k];
}

const CollocationRule& CollocationRule::of(int order) {
  static const std::array<std::unique_ptr<CollocationRule>, kMaxOrder> rules = []() {
    std::array<std::unique_ptr<CollocationRule>, kMaxOrder> all;
    for (int p = 1; p <= kMaxOrder; ++p) all[p - 1] = std::make_unique<CollocationRule>(p);
    return all;
  }();
  return *rules[order - 1];
}

}  // namespace snapthrough
