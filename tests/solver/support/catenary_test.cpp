/// Elastic catenaries against Gauss quadrature of their differential equation.
#include "solver/support/catenary.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "solver/numeric/gauss_rule.h"

namespace snapthrough {
namespace {

using Eigen::Vector2d;

/// End of the integral of  T/|T| (1 + z/L) + T/EA  over the length from the start, with T = F - q t, by Gauss
/// quadrature on pieces that halve towards the place of least force.
Vector2d integrated(double EA, double L, const Vector2d& q, const Vector2d& F, double z, double s) {
  const double least = std::clamp(F.dot(q) / q.squaredNorm() + 0.5 * L, 0.0, s);
  const Quadrature rule = gauss_legendre(16);
  Vector2d sum = Vector2d::Zero();
  const auto add = [&](double from, double to) {
    for (std::size_t i = 0; i < rule.points.size(); ++i) {
      const Vector2d T = F - q * (from + (to - from) * rule.points[i] - 0.5 * L);
      sum += (to - from) * rule.weights[i] * (T.normalized() * (1.0 + z / L) + T / EA);
    }
  };
  for (const double end : {0.0, s}) {
    double from = end;
    for (int k = 0; k < 60; ++k) {
      const double to = k == 59 ? least : 0.5 * (from + least);
      end == 0.0 ? add(from, to) : add(to, from);
      from = to;
    }
  }
  return sum;
}

struct Drawn {
  double EA;
  double L;
  Vector2d q;
  Vector2d chord;
  double z;

  [[nodiscard]] Catenary cable() const { return {EA, L, q}; }
  /// Force in the middle of the cable.
  [[nodiscard]] Vector2d force() const { return cable().pull({chord, z}).force; }
};

class RandomCables {
 public:
  Drawn next() {
    const double angle = between(0.0, 6.3);
    const double weight = std::pow(10.0, between(-4.0, 1.0));
    const double L = std::pow(10.0, between(-2.0, 3.0));
    // a third is about as long as its chord, and a fifth hangs straight down
    const double length = L * (between(0.0, 1.0) < 0.3 ? between(0.999, 1.001) : between(0.01, 1.2));
    const double to = between(0.0, 1.0) < 0.2 ? angle : between(0.0, 6.3);
    return {std::pow(10.0, between(0.0, 8.0)), L, weight * Vector2d(std::cos(angle), std::sin(angle)),
            length * Vector2d(std::cos(to), std::sin(to)), L * between(-1e-3, 1e-3)};
  }

 private:
  double between(double a, double b) { return std::uniform_real_distribution(a, b)(random_); }
  std::mt19937 random_{11};
};

TEST(Catenary, PlacesAreThoseOfTheIntegral) {
  RandomCables cables;
  for (int i = 0; i < 500; ++i) {
    const Drawn one = cables.next();
    const Vector2d force = one.force();
    for (const double share : {0.3, 0.5, 1.0}) {
      const double s = share * one.L;
      const Vector2d expected = integrated(one.EA, one.L, one.q, force, one.z, s);
      EXPECT_LT((one.cable().place_at(force, one.z, s) - expected).norm(),
                1e-13 * one.L + 1e-13 * expected.norm())
          << "cable " << i << " at " << share;
    }
  }
}

/// The force is found to the rounding of the chord, for slack and taut, light and heavy cables.
TEST(Catenary, TheForceHasTheChordGiven) {
  RandomCables cables;
  for (int i = 0; i < 50000; ++i) {
    const Drawn one = cables.next();
    EXPECT_LT((one.cable().place_at(one.force(), one.z, one.L) - one.chord).norm(), 1e-12 * one.L)
        << "cable " << i;
  }
}

TEST(Catenary, DerivativesAreThoseOfDifferences) {
  const Catenary cable(40.0, 1.1, {0.1, -1.3});
  const Catenary::Ends ends{{0.9, 0.25}, 0.01};
  const Catenary::Ends a{{0.3, -0.2}, 0.4};
  const Catenary::Ends b{{-0.1, 0.5}, -0.3};
  const auto force = [&](double x, double y) {
    return cable
        .pull({ends.chord + x * a.chord + y * b.chord,
               ends.lengthening + x * a.lengthening + y * b.lengthening})
        .force;
  };
  const Catenary::Pull pull = cable.pull(ends);
  constexpr double h = 1e-5;  // the error of a central difference is h^2 and 1e-16 / h
  const Vector2d first = (force(h, 0.0) - force(-h, 0.0)) / (2.0 * h);
  EXPECT_LT((pull.stiffness * a.chord + pull.by_lengthening * a.lengthening - first).norm(),
            1e-8 * first.norm());
  constexpr double H = 3e-4;
  const Vector2d second = (force(H, H) - force(H, -H) - force(-H, H) + force(-H, -H)) / (4.0 * H * H);
  EXPECT_LT((cable.second(ends, a, b) - second).norm(), 1e-5 * second.norm());
  const double s = 0.4;
  const Vector2d change{0.2, 0.3};
  const Vector2d place = (cable.place_at(pull.force + h * change, ends.lengthening, s) -
                          cable.place_at(pull.force - h * change, ends.lengthening, s)) /
                         (2.0 * h);
  EXPECT_LT((cable.place_by_force(pull.force, ends.lengthening, s) * change - place).norm(),
            1e-8 * place.norm());
}

/// A cable that hangs beside itself has no force across its weight.
TEST(Catenary, HangsStraightDown) {
  const Catenary cable(1e6, 10.0, {0.0, -2.0});
  const auto pull = cable.pull({{0.0, -4.0}, 0.0});
  EXPECT_NEAR(pull.force[0], 0.0, 1e-9);
  // 3 m hang from the lower end and 7 m from the upper one
  EXPECT_NEAR(cable.force_at(pull.force, 0.0).norm(), 14.0, 1e-4);
  EXPECT_NEAR(cable.force_at(pull.force, 10.0).norm(), 6.0, 1e-4);
}

}  // namespace
}  // namespace snapthrough
