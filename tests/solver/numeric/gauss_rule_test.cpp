#include "solver/numeric/gauss_rule.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <span>

namespace snapthrough {
namespace {

double integrate(const Quadrature& rule, int power) {
  double sum = 0.0;
  for (std::size_t i = 0; i < rule.points.size(); ++i)
    sum += rule.weights[i] * std::pow(rule.points[i], power);
  return sum;
}

TEST(GaussRule, LegendreIsExactToDegreeTwoNMinusOneAndNoFurther) {
  for (int n = 1; n <= 12; ++n) {
    for (int k = 0; k <= 2 * n - 1; ++k)
      EXPECT_NEAR(integrate(gauss_legendre(n), k), 1.0 / (k + 1), 1e-14) << n << " " << k;
    if (n > 6) continue;
    EXPECT_GT(std::abs(integrate(gauss_legendre(n), 2 * n) - 1.0 / (2 * n + 1)), 1e-9) << n;
  }
}

TEST(GaussRule, LobattoIsExactToDegreeTwoNMinusThreeAndHasBothEnds) {
  for (int n = 2; n <= 9; ++n) {
    const Quadrature rule = gauss_lobatto(n);
    EXPECT_EQ(rule.points.front(), 0.0);
    EXPECT_EQ(rule.points.back(), 1.0);
    for (int k = 0; k <= 2 * n - 3; ++k)
      EXPECT_NEAR(integrate(rule, k), 1.0 / (k + 1), 1e-14) << n << " " << k;
  }
}

/// The stages integrate polynomials of degree P - 1 exactly from 0 to any place (the definition of
/// collocation).
TEST(GaussRule, CollocationIntegratesPolynomials) {
  for (int p = 1; p <= kMaxOrder; ++p) {
    const CollocationRule& rule = CollocationRule::of(p);
    for (const double xi : {0.0, 0.137, 0.5, 0.9, 1.0}) {
      std::array<double, kMaxOrder> a{};
      std::array<double, kMaxOrder> l{};
      rule.integrals_at(xi, std::span(a).first(p));
      rule.values_at(xi, std::span(l).first(p));
      for (int k = 0; k < p; ++k) {
        double integral = 0.0;
        double value = 0.0;
        for (int r = 0; r < p; ++r) {
          integral += a[r] * std::pow(rule.point(r), k);
          value += l[r] * std::pow(rule.point(r), k);
        }
        EXPECT_NEAR(integral, std::pow(xi, k + 1) / (k + 1), 1e-14);
        EXPECT_NEAR(value, std::pow(xi, k), 1e-13);
      }
    }
    for (int q = 0; q < p; ++q) {
      std::array<double, kMaxOrder> a{};
      rule.integrals_at(1.0, std::span(a).first(p));
      EXPECT_NEAR(a[q], rule.weight(q), 1e-15);
    }
  }
}

}  // namespace
}  // namespace snapthrough
