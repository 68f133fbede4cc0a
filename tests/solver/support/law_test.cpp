/// One law of support: what it says of itself agrees, and what is made of a model has the model's sense.
#include "solver/support/law.h"

#include <gtest/gtest.h>

#include <cmath>

namespace snapthrough {
namespace {

/// The tangent is the reaction's derivative and the reaction the energy's; none of them jumps but the
/// tangent.
TEST(Law, IsTheDerivativeOfItsEnergy) {
  constexpr double kStep = 1e-6;
  for (const Law& law : {Law{3.0, 0.0, false}, Law{3.0, 0.2, true}}) {
    for (const double w : {-0.7, 0.1, 0.3, 1.1}) {
      // central differences of a quadratic are exact but for rounding over the step
      EXPECT_NEAR((law.energy(w + kStep) - law.energy(w - kStep)) / (2.0 * kStep), law.reaction(w), 1e-8)
          << w;
      EXPECT_NEAR((law.reaction(w + kStep) - law.reaction(w - kStep)) / (2.0 * kStep), law.tangent(w), 1e-8)
          << w;
      EXPECT_EQ(law.acts(w), law.reaction(w) != 0.0) << w;
    }
  }
  const Law touching{3.0, 0.2, true};
  EXPECT_EQ(touching.reaction(0.2), 0.0);
  EXPECT_FALSE(touching.acts(0.2));
}

/// A medium on the left of an axis lies along its left normal; one that only pulls resists the other way.
TEST(Direction, TurnsWithTheAxis) {
  Foundation base;
  base.reaction = Reaction::compression_only;
  const double angle = 0.4;
  const auto left = direction_of(base).at(angle);
  EXPECT_DOUBLE_EQ(left[0], -std::sin(angle));
  EXPECT_DOUBLE_EQ(left[1], std::cos(angle));
  base.reaction = Reaction::tension_only;
  EXPECT_DOUBLE_EQ(direction_of(base).at(angle)[0], std::sin(angle));
  base.side = Side::right;
  EXPECT_DOUBLE_EQ(direction_of(base).at(angle)[0], -std::sin(angle));
  constexpr double kCurvature = 2.5;
  constexpr double kStep = 1e-6;
  const Direction turning = direction_of(base);
  const auto rate = turning.rate(angle, kCurvature);
  for (int c = 0; c < 2; ++c) {
    const double ahead = turning.at(angle + kStep * kCurvature)[c];
    const double behind = turning.at(angle - kStep * kCurvature)[c];
    EXPECT_NEAR(rate[c], (ahead - behind) / (2.0 * kStep), 1e-8) << c;
  }
  base.direction = {3.0, 4.0};
  EXPECT_DOUBLE_EQ(direction_of(base).at(angle)[1], -0.8) << "it pulls";
  EXPECT_EQ(direction_of(base).rate(angle, kCurvature)[0], 0.0);
}

/// Force k u of a spring with k = 50 N/m, u = 0.2 m beyond a gap of 0.1 m, whatever the units computed in.
TEST(SpringLaw, IsTheModelsSpringInOtherUnits) {
  const Scales scales{4.0, 8.0, 1.0};
  Spring spring;
  spring.direction = {0.0, -2.0};
  spring.stiffness = 50.0;
  spring.reaction = Reaction::tension_only;
  spring.gap = 0.1;
  const SpringLaw law = law_of(spring, scales);
  EXPECT_DOUBLE_EQ(law.row[1], 1.0) << "it resists displacements against its direction";
  EXPECT_NEAR(scales.force * law.law.reaction((0.1 + 0.2) / scales.length), 50.0 * 0.2, 1e-13);
  EXPECT_EQ(in_users_sense(law.sense, 3.0), -3.0);
  EXPECT_FALSE(std::signbit(in_users_sense(law.sense, 0.0)));
}

}  // namespace
}  // namespace snapthrough
