/// Paths and static analyses that meet the capacity of supports, against limit loads by hand.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "tests/verification/cases.h"

namespace snapthrough {
namespace {

using namespace testing;
using Type = ReactionLaw::Type;

/// Share of a limit load at which paths end; docs/results.md.
constexpr double kReached = 1e-3;

/// Short stiff pile of the length 4 in soil of the strength 50, pushed at its head: the limit is
/// (sqrt 2 - 1) 50 4 = 82.8427.
Model short_pile(Type type) {
  Model model = straight(4.0, 1e6, 1e6, "", "");
  model.nodes = {{"a", 0.0, 0.0}, {"b", 0.0, -4.0}};
  model.supports = {support("b", "y")};
  model.foundations = {winkler("m", 0.0)};
  ReactionLaw law;
  law.type = type;
  law.stiffness = type == Type::power ? 5e4 : 5e3;
  law.capacity = 50.0;
  law.reference = 0.01;
  law.exponent = 0.33;
  law.points = {{{0.01, 50.0}}};
  model.foundations[0].law = law;
  model.loads = {force_at(at_node("a"), 1.0, 0.0)};
  return model;
}

const double kPileLimit = (std::sqrt(2.0) - 1.0) * 200.0;

class ShortPile : public ::testing::TestWithParam<Type> {};

/// Before, the pile was said to buckle at a negative load factor. The hyperbolic law approaches its capacity
/// within the displacements of the pile to 1 % only, where the path loses its stiffness.
TEST_P(ShortPile, AnalysesAgreeOnTheLimitAndGiveNothingBeyond) {
  const double below = GetParam() == Type::hyperbolic ? 1e-2 : kReached;
  const Model model = short_pile(GetParam());
  for (const Geometry geometry : {Geometry::linear, Geometry::nonlinear}) {
    const Result rows = solve(model, static_on({}, geometry, {60.0, 80.0, 120.0, -83.0}));
    ASSERT_TRUE(rows.failure);
    EXPECT_EQ(rows.failure->code, "capacity") << rows.failure->detail;
    EXPECT_EQ(rows.not_reached, (std::vector{120.0, -83.0}));
    ASSERT_EQ(rows.capacity.size(), 2U);
    EXPECT_LE(rows.capacity[0].load_factor, kPileLimit * (1.0 + 1e-6));
    EXPECT_GE(rows.capacity[0].load_factor, kPileLimit * (1.0 - below));
    EXPECT_EQ(rows.capacity[0].supports, std::vector<std::string>{"soil"});
    EXPECT_NEAR(rows.capacity[1].load_factor, -rows.capacity[0].load_factor, 1e-6 * kPileLimit);
  }
  for (const AnalysisType type : {AnalysisType::critical, AnalysisType::path}) {
    const Result result = solve(model, analysis_of(type, {}));
    EXPECT_FALSE(result.failure);
    EXPECT_EQ(result.summary.termination, "capacity") << result.summary.message;
    EXPECT_EQ(result.summary.critical_type, CriticalType::capacity);
    ASSERT_TRUE(result.summary.critical_load_factor);
    EXPECT_LE(*result.summary.critical_load_factor, kPileLimit * (1.0 + 1e-6));
    EXPECT_GE(*result.summary.critical_load_factor, kPileLimit * (1.0 - below));
    ASSERT_EQ(result.capacity.size(), 1U);
    for (const Branch& branch : result.branches)
      for (const double load : branch.load_factor) EXPECT_LE(std::abs(load), kPileLimit);
  }
}

INSTANTIATE_TEST_SUITE_P(Laws, ShortPile,
                         ::testing::Values(Type::tanh, Type::hyperbolic, Type::power, Type::table));

/// A wall on a spring that slides at 400, on members of EA = EI = 1e9: forces of 409 were "equilibrium".
TEST(Capacity, StiffMembersDoNotHideTheCapacity) {
  for (const double stiffness : {1e5, 1e9, 1e12}) {
    Model model = straight(3.0, stiffness, stiffness, "y", "y");
    Spring slide;
    slide.id = "slide";
    slide.at = at_node("a");
    slide.direction = {1.0, 0.0};
    slide.law = ReactionLaw{};
    slide.law->type = Type::tanh;
    slide.law->stiffness = 4e4;
    slide.law->capacity = 400.0;
    model.springs = {slide};
    model.loads = {force_at(at_node("b"), 1.0, 0.0)};
    const Result result = solve(model, static_on({}, Geometry::nonlinear, {399.0, 409.0}));
    ASSERT_TRUE(result.failure);
    EXPECT_EQ(result.failure->code, "capacity") << result.failure->detail;
    EXPECT_EQ(result.not_reached, std::vector{409.0});
    ASSERT_EQ(result.capacity.size(), 1U);
    expect_relative(result.capacity[0].load_factor, 400.0, 1e-7, "limit");
    PointLoad constant = force_at(at_node("b"), 401.0, 0.0);
    constant.pattern = Pattern::constant;
    model.loads.push_back(constant);
    EXPECT_EQ(solve(model, static_on({}, Geometry::nonlinear)).failure->code, "capacity");
  }
}

/// Where other supports hold the motion, a law at its capacity is no limit.
TEST(Capacity, MembersThatCarryTheRestGoOn) {
  Model model = short_pile(Type::table);
  model.supports = {support("b", "xyr")};
  const Result result = solve(model, static_on({}, Geometry::linear, {500.0}));
  EXPECT_FALSE(result.failure);
  EXPECT_TRUE(result.capacity.empty());
}

}  // namespace
}  // namespace snapthrough
