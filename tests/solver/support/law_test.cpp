/// One law of support: what it says of itself agrees, and what is made of a model has the model's sense.
#include "solver/support/law.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

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

ReactionLaw law_with(ReactionLaw::Type type, double stiffness, double capacity) {
  ReactionLaw law;
  law.type = type;
  law.stiffness.constant = stiffness;
  law.capacity.constant = capacity;
  law.reference = 0.5;
  law.exponent = 0.4;
  return law;
}

ReactionLaw table_of(const std::vector<std::array<double, 2>>& points) {
  ReactionLaw law;
  law.type = ReactionLaw::Type::table;
  law.points = points;
  return law;
}

/// Points of a law that falls from a peak to a residual reaction.
ReactionLaw falling(ReactionLaw::Interpolation interpolation) {
  ReactionLaw law = table_of({{0.1, 1.0}, {0.25, 2.5}, {0.4, 1.6}, {0.7, 1.2}, {1.0, 1.2}});
  law.interpolation = interpolation;
  return law;
}

/// A law of each kind. The line of the fourth one reaches the capacity before the power.
std::vector<ReactionLaw> laws() {
  using Type = ReactionLaw::Type;
  ReactionLaw table = table_of({{0.1, 1.0}, {0.25, 2.5}, {0.4, 2.6}, {0.7, 4.0}});
  table.factor.constant = 2.0;
  return {
      law_with(Type::tanh, 30.0, 4.0),
      law_with(Type::hyperbolic, 30.0, 4.0),
      law_with(Type::power, 200.0, 4.0),
      law_with(Type::power, 6.0, 4.0),
      table,
      falling(ReactionLaw::Interpolation::monotone_cubic),
      falling(ReactionLaw::Interpolation::linear),
  };
}

SpringLaw spring_with(const ReactionLaw& law, Reaction reaction = Reaction::bilateral) {
  Spring spring;
  spring.direction = {1.0, 0.0};
  spring.law = law;
  spring.reaction = reaction;
  return law_of(spring, Scales{});
}

/// The reactions by their formulas in the documents.
TEST(ReactionLaw, IsItsFormula) {
  for (const double w : {0.003, 0.02, 0.3, 0.9}) {
    const auto reaction = [&](int i) {
      return spring_with(laws()[static_cast<std::size_t>(i)]).law.reaction(w);
    };
    EXPECT_NEAR(reaction(0), 4.0 * std::tanh(7.5 * w), 1e-14);
    EXPECT_NEAR(reaction(1), w / (1.0 / 30.0 + w / 4.0), 1e-14);
    EXPECT_NEAR(reaction(2), std::min({200.0 * w, 4.0 * std::pow(w / 0.5, 0.4), 4.0}), 1e-13);
    EXPECT_NEAR(reaction(3), std::min({6.0 * w, 4.0 * std::pow(w / 0.5, 0.4), 4.0}), 1e-13);
  }
  const ReactionLaw given = laws()[4];
  const SpringLaw table = spring_with(given);
  for (const auto& [w, p] : given.points) EXPECT_NEAR(table.law.reaction(w), 2.0 * p, 1e-14) << w;
  EXPECT_DOUBLE_EQ(table.law.reaction(5.0), 8.0);
}

/// Each derivative is that of the one before; a bilateral law is odd, a one-sided one pushes only.
TEST(ReactionLaw, DerivativesBelongTogether) {
  constexpr double kStep = 1e-6;
  for (const ReactionLaw& given : laws()) {
    const SpringLaw spring = spring_with(given);
    const Law& law = spring.law;
    for (const double w : {-0.6, -0.13, -0.002, 0.004, 0.05, 0.18, 0.3, 0.6, 2.0}) {
      const auto slope = [&](const auto& f) { return (f(w + kStep) - f(w - kStep)) / (2.0 * kStep); };
      EXPECT_NEAR(slope([&](double x) { return law.energy_at(x); }), law.force_at(w), 1e-7) << w;
      EXPECT_NEAR(slope([&](double x) { return law.force_at(x); }), law.stiffness_at(w), 1e-4) << w;
      EXPECT_NEAR(slope([&](double x) { return law.stiffness_at(x); }), law.response_at(w).rate,
                  1e-4 * (1.0 + std::abs(law.response_at(w).rate)))
          << w;
      EXPECT_DOUBLE_EQ(law.force_at(-w), -law.force_at(w));
      if (!(law.peak() <= 1.0)) {
        EXPECT_GE(law.stiffness_at(w), 0.0);
      }
    }
    EXPECT_DOUBLE_EQ(law.stiffness_at(0.0), initial_stiffness([&] {
                       Spring same;
                       same.law = given;
                       return same;
                     }()));
    EXPECT_EQ(spring_with(given, Reaction::compression_only).law.reaction(-0.3), 0.0);
    for (int i = 0; i < law.curve->knot_count(); ++i) {
      const auto knot = law.curve->knot(i, law.shape);
      if (i + 1 < law.curve->knot_count() && knot.x == law.curve->knot(i + 1, law.shape).x) continue;
      const double w = knot.x * law.capacity / law.stiffness;
      EXPECT_NEAR(law.stiffness_at(w * (1.0 + 1e-9) + 1e-12) - law.stiffness_at(w * (1.0 - 1e-9) - 1e-12),
                  law.stiffness * knot.slope_change, 1e-4 * law.stiffness)
          << i;
    }
  }
}

/// A table of straight lines is its points' own lines; a cubic table has its peaks at its points, and is
/// monotone between them.
TEST(ReactionLaw, FallsBeyondAPeak) {
  using Interpolation = ReactionLaw::Interpolation;
  const SpringLaw of_lines = spring_with(falling(Interpolation::linear));
  const Law& lines = of_lines.law;
  EXPECT_NEAR(lines.reaction(0.05), 0.5, 1e-14);
  EXPECT_NEAR(lines.reaction(0.25), 2.5, 1e-14);
  EXPECT_NEAR(lines.reaction(0.325), 2.05, 1e-14);
  EXPECT_NEAR(lines.reaction(-0.55), -1.4, 1e-14);
  EXPECT_NEAR(lines.reaction(3.0), 1.2, 1e-14);
  // the area under the lines
  EXPECT_NEAR(lines.energy(2.0), 0.05 + 0.2625 + 0.3075 + 0.42 + 1.3 * 1.2, 1e-13);
  const SpringLaw of_cubic = spring_with(falling(Interpolation::monotone_cubic));
  const Law& cubic = of_cubic.law;
  for (double w = 0.0; w < 1.2; w += 0.01)
    EXPECT_GE(cubic.reaction(w + 0.01) * (w < 0.245 ? 1.0 : -1.0) + 1e-12,
              cubic.reaction(w) * (w < 0.245 ? 1.0 : -1.0))
        << w;
  EXPECT_NEAR(cubic.stiffness_at(0.25), 0.0, 1e-13);
  for (const Law& law : {lines, cubic}) EXPECT_NEAR(law.peak(), 0.25, 1e-15);
  const SpringLaw rising = spring_with(laws()[4]);
  EXPECT_EQ(rising.law.peak(), std::numeric_limits<double>::infinity());
}

/// A table on a line is that line.
TEST(ReactionLaw, TableOnALineIsLinear) {
  const ReactionLaw law = table_of({{0.0, 0.0}, {0.1, 3.0}, {0.4, 12.0}});
  for (const double w : {-0.3, 0.05, 0.17, 0.39})
    EXPECT_NEAR(spring_with(law).law.reaction(w), 30.0 * w, 1e-13);
}

/// Stiffness and capacity at a fraction of the member; where a law has no capacity it has no reaction.
TEST(FoundationLaw, VariesAlongItsMember) {
  Foundation base;
  base.law = law_with(ReactionLaw::Type::tanh, 0.0, 0.0);
  base.law->stiffness.points = {{0.2, 0.0}, {1.0, 80.0}};
  base.law->capacity.points = {{0.2, 0.0}, {0.6, 4.0}};
  const FoundationLaw law = law_of(base, Scales{});
  EXPECT_NEAR(law.at(0.4).reaction(0.1), 2.0 * std::tanh(20.0 * 0.1 / 2.0), 1e-14);
  EXPECT_NEAR(law.at(0.9).reaction(0.1), 4.0 * std::tanh(70.0 * 0.1 / 4.0), 1e-14);
  EXPECT_EQ(law.at(0.1).reaction(0.1), 0.0);
  EXPECT_EQ(initial_stiffness(base), 80.0);
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
