/// Stress over strength, first yield of paths and mobilised resistance, against closed forms and quadrature.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "solver/numeric/gauss_rule.h"
#include "tests/verification/cases.h"
#include "tests/verification/root.h"

namespace snapthrough {
namespace {

using namespace testing;

constexpr double kRigid = std::numeric_limits<double>::infinity();

bool has_warning(const Result& result, const std::string& code) {
  return std::any_of(result.warnings.begin(), result.warnings.end(),
                     [&](const Warning& warning) { return warning.code == code; });
}

/// Pinned column of length 1 and EI = 1 with a load at the eccentricity e, which is its end moments P e.
Model eccentric_column(double e, const Strength& strength) {
  Model model = straight(1.0, 1.0, kRigid, "xy", "y");
  model.sections[0].strength = strength;
  model.loads = {force_at(at_node("a"), 0.0, 0.0, e), force_at(at_node("b"), -1.0, 0.0, -e)};
  return model;
}

/// Moment in the middle of that column under the load P, by the elastica: with the angle t of the axis
/// M^2 = (P e)^2 + 2 P (cos t - cos t0), and the length of its half is the integral of dt / M from 0 to t0.
double moment_in_the_middle(double P, double e) {
  const auto moment = [&](double t, double t0) {
    return std::sqrt(P * P * e * e + 4.0 * P * std::sin(0.5 * (t0 + t)) * std::sin(0.5 * (t0 - t)));
  };
  const auto half = [&](double t0) {
    // t = t0 (1 - x^2) takes the steep end away
    static const Quadrature rule = gauss_legendre(40);
    double sum = 0.0;
    for (std::size_t q = 0; q < rule.points.size(); ++q) {
      const double x = rule.points[q];
      sum += rule.weights[q] * 2.0 * t0 * x / moment(t0 * (1.0 - x * x), t0);
    }
    return sum;
  };
  const double t0 = root([&](double t) { return half(t) - 0.5; }, 1e-9, 2.5);
  return moment(0.0, t0);
}

/// Load at which the fibre with the larger compression, or that with tension, reaches its strength.
double yield_load(double e, double force, double moment, double most) {
  return root([&](double P) { return moment_in_the_middle(P, e) / moment + P / force - 1.0; }, 1e-6, most);
}

/// A column with an eccentric load yields by compression, in the middle, on the side to which it bends. The
/// expected load is that of the elastica, whose limit for small displacements is the secant formula.
TEST(FirstYield, OfAColumnWithEccentricLoad) {
  constexpr double e = 0.02;
  const Strength strength{40.0, 0.5};
  const double expected = yield_load(e, 40.0, 0.5, 9.8);
  for (const AnalysisType type : {AnalysisType::critical, AnalysisType::path})
    for (const double accuracy : {1e-3, 1e-6, 1e-9}) {
      Analysis analysis = analysis_of(type, accurate(accuracy));
      analysis.stop.load_factor = std::array{0.0, 9.7};
      const Result result = solve_soundly(eccentric_column(e, strength), analysis);
      ASSERT_TRUE(result.first_yield) << accuracy;
      const FirstYield& yield = *result.first_yield;
      expect_relative(yield.load_factor, expected, std::max(accuracy, 2e-9), "load at first yield");
      ASSERT_TRUE(yield.error_estimate);
      EXPECT_LE(*yield.error_estimate, 2.0 * accuracy);
      EXPECT_LE(std::abs(yield.load_factor - expected), *yield.error_estimate * expected + 1e-9);
      EXPECT_EQ(yield.member, "m");
      EXPECT_NEAR(yield.place.s, 0.5, 1e-3);
      EXPECT_EQ(yield.place.value, -1.0);
      // the moments at the ends bend the column to its right
      EXPECT_EQ(yield.place.fibre, Fibre::right);
      EXPECT_TRUE(has_warning(result, "beyond_yield"));
    }
}

/// A material that bears a fifth in tension of what it bears in compression: the outer side yields.
TEST(FirstYield, OfAMaterialThatIsWeakInTension) {
  constexpr double e = 0.02;
  const double expected = yield_load(e, -20.0, 0.25, 9.8);  // M / (f W) - P / (f A) = 1
  Analysis analysis = analysis_of(AnalysisType::critical, accurate(1e-9));
  analysis.stop.load_factor = std::array{0.0, 9.7};
  const Result result = solve_soundly(eccentric_column(e, {20.0, 0.25, 5.0}), analysis);
  ASSERT_TRUE(result.first_yield);
  expect_relative(result.first_yield->load_factor, expected, 2e-9, "load at first yield");
  EXPECT_EQ(result.first_yield->place.value, 1.0);
  EXPECT_EQ(result.first_yield->place.fibre, Fibre::left);
}

/// A path that stays below the strength has no first yield, and says nothing of it.
TEST(FirstYield, IsNotMetBelowTheStrength) {
  Analysis analysis = analysis_of(AnalysisType::path, accurate(1e-6));
  const Strength strength{40.0, 0.5};
  const double load = yield_load(0.02, 40.0, 0.5, 9.8);
  analysis.stop.load_factor = std::array{0.0, load * (1.0 - 1e-4)};
  const Result below = solve_soundly(eccentric_column(0.02, strength), analysis);
  EXPECT_FALSE(below.first_yield);
  EXPECT_FALSE(has_warning(below, "beyond_yield"));
  analysis.stop.load_factor = std::array{0.0, load * (1.0 + 1e-4)};
  const Result beyond = solve_soundly(eccentric_column(0.02, strength), analysis);
  ASSERT_TRUE(beyond.first_yield);
  expect_relative(beyond.first_yield->load_factor, load, 1e-6, "load at first yield");
}

/// Constant loads that yield the structure before the path begins: the warning tells, no event does.
TEST(FirstYield, IsBeforeAPathThatBeginsBeyondIt) {
  Model model = straight(1.0, 1.0, kRigid, "xyr", "");
  model.sections[0].strength = Strength{1.0, 0.1};
  PointLoad aside = force_at(at_node("b"), 0.0, 0.2);
  aside.pattern = Pattern::constant;
  model.loads = {aside, force_at(at_node("b"), 0.0, 1.0)};
  Analysis analysis = analysis_of(AnalysisType::path, accurate(1e-6));
  analysis.stop.load_factor = std::array{0.0, 1.0};
  const Result result = solve_soundly(model, analysis);
  EXPECT_FALSE(result.first_yield);
  EXPECT_TRUE(has_warning(result, "beyond_yield"));
}

/// The stress may pass the strength within a step and come back: a bar that a moment bends one way, and a
/// greater one in the other sense later, is met at its first passage.
TEST(FirstYield, IsTheFirstOfSeveralPassages) {
  // a cantilever under a force that follows its end: the moment at the clamp rises, falls, and rises again
  Model model = straight(1.0, 1.0, kRigid, "xyr", "");
  PointLoad follower = force_at(at_node("b"), 0.0, 1.0);
  follower.follows = true;
  model.loads = {follower};
  Analysis analysis = analysis_of(AnalysisType::path, accurate(1e-6));
  analysis.stop.load_factor = std::array{0.0, 30.0};
  analysis.output.extremes = true;
  const Result free = solve_soundly(model, analysis);
  const double most = free.extremes->at(0).bending_moment.max.value;
  model.sections[0].strength = Strength{1e9, 0.999 * most};
  const Result result = solve_soundly(model, analysis);
  ASSERT_TRUE(result.first_yield);
  // the moment at first yield is that of a state asked for at its load
  Analysis asked = static_on(accurate(1e-8), Geometry::nonlinear, {result.first_yield->load_factor});
  const Result state = solve_soundly(model, asked);
  EXPECT_NEAR(std::abs(state.states.at(0).members[0].extremes.utilisation->value), 1.0, 1e-5);
}

/// A beam under a triangular load: the moment is largest at 1/sqrt(3) of its length, q l^2 / (9 sqrt 3).
TEST(Utilisation, IsLargestBetweenThePlacesOfTheLists) {
  Model model = straight(2.0, 1.0, 1e3, "xy", "y");
  DistributedLoad load;
  load.member = "m";
  load.force_along = {{0.0, {0.0, 0.0}}, {1.0, {0.0, -3.0}}};
  model.loads = {load};
  model.sections[0].strength = Strength{7.0, 1.6};
  const Result result = solve_soundly(model, static_on(accurate(1e-9), Geometry::linear, {0.5}));
  const Utilisation most = result.states.at(0).members.at(0).extremes.utilisation.value();
  const double moment = 0.5 * 3.0 * 4.0 / (9.0 * std::sqrt(3.0));
  EXPECT_NEAR(std::abs(most.value), moment / 1.6, 1e-9);
  EXPECT_NEAR(most.s, 2.0 / std::sqrt(3.0), 1e-4);
  const MemberState& member = result.states[0].members[0];
  for (std::size_t i = 0; i < member.s.size(); ++i) {
    const double x = member.s[i] / 2.0;
    const double M = 0.5 * 3.0 * 4.0 / 6.0 * (x - x * x * x);  // sagging: the lower, right side is in tension
    EXPECT_NEAR(member.utilisation_right[i], M / 1.6, 1e-9);
    EXPECT_NEAR(member.utilisation_left[i], -M / 1.6, 1e-9);
  }
}

/// N and M together, with a strength in compression that is twice that in tension, and a taper.
TEST(Utilisation, AddsAxialForceAndMoment) {
  Model model = straight(1.0, 1.0, 1e3, "xyr", "");
  model.sections[0].strength = Strength{AlongMember(Along<double>{{0.0, 10.0}, {1.0, 5.0}}), 4.0, 2.0};
  model.loads = {force_at(at_node("b"), 3.0, 2.0)};
  const Result result = solve_soundly(model, static_on(accurate(1e-9), Geometry::linear));
  const MemberState& member = result.states.at(0).members.at(0);
  for (std::size_t i = 0; i < member.s.size(); ++i) {
    const double axial = 3.0 / (10.0 - 5.0 * member.s[i]);
    const double bent = 2.0 * (1.0 - member.s[i]) / 4.0;  // bends the member to its left
    const auto over_strength = [](double value) { return value < 0.0 ? 0.5 * value : value; };
    EXPECT_NEAR(member.utilisation_left[i], over_strength(axial - bent), 1e-9);
    EXPECT_NEAR(member.utilisation_right[i], over_strength(axial + bent), 1e-9);
  }
  EXPECT_NEAR(member.extremes.utilisation->value, 0.8, 1e-9);
  EXPECT_EQ(member.extremes.utilisation->s, 0.0);
}

/// Two rods of 45 degrees and a load down on their joint; one is the weaker.
TEST(Utilisation, OfRodsIsThatOfTheirForce) {
  Model model;
  model.nodes = {{"a", -1.0, 1.0}, {"b", 1.0, 1.0}, {"c", 0.0, 0.0}, {"d", 0.0, -1.0}};
  model.sections = {{"strong", 1e4, 1.0, {}}, {"weak", 1e4, 1.0, {}}, {"post", 1e4, 1e3, {}}};
  model.sections[0].strength = Strength{4.0, 1.0};
  model.sections[1].strength = Strength{2.5, 1.0};
  model.members = {{"post", "d", "c", "post", LineCurve{}, false, false},
                   {"left", "a", "c", "strong", LineCurve{}, false, false},
                   {"right", "b", "c", "weak", LineCurve{}, false, false}};
  model.members[1].reaction = model.members[2].reaction = Reaction::tension_only;
  model.supports = {support("a", "xyr"), support("b", "xyr")};
  model.loads = {force_at(at_node("d"), 0.0, -1.0)};
  Analysis analysis = static_on(accurate(1e-8), Geometry::linear, {2.0});
  const Result result = solve_soundly(model, analysis);
  const double force = 2.0 / std::sqrt(2.0);
  EXPECT_NEAR(member_of(result.states.at(0), "left").extremes.utilisation->value, force / 4.0, 1e-9);
  EXPECT_NEAR(member_of(result.states.at(0), "right").extremes.utilisation->value, force / 2.5, 1e-9);
  EXPECT_FALSE(member_of(result.states.at(0), "post").extremes.utilisation);
  Analysis path = analysis_of(AnalysisType::path, accurate(1e-8));
  path.stop.load_factor = std::array{0.0, 5.0};
  const Result traced = solve_soundly(model, path);
  ASSERT_TRUE(traced.first_yield);
  EXPECT_EQ(traced.first_yield->member, "right");
  // the joint sinks by about P / EA, which turns the rods by 1e-4
  expect_relative(traced.first_yield->load_factor, 2.5 * std::sqrt(2.0), 1e-3, "load at first yield");
}

/// A spring and a foundation under a rigid bar: the share of the capacity is the law's.
TEST(Mobilised, IsTheReactionOverTheCapacity) {
  Model model = straight(2.0, 1e6, 1e6, "x", "");
  ReactionLaw law;
  law.type = ReactionLaw::Type::tanh;
  law.stiffness = 50.0;
  law.capacity = 10.0;
  Foundation base = winkler("m", 0.0);
  base.law = law;
  ReactionLaw falling;
  falling.type = ReactionLaw::Type::table;
  falling.interpolation = Interpolation::linear;
  falling.points = {{0.1, 4.0}, {0.5, 2.0}};
  Spring spring;
  spring.id = "spring";
  spring.at = at_member("m", 0.5);
  spring.direction = std::array{0.0, -1.0};
  spring.law = falling;
  Spring linear = spring;
  linear.id = "linear";
  linear.law.reset();
  linear.stiffness = 1.0;
  model.foundations = {base};
  model.springs = {spring, linear};
  model.loads = {force_at(at_member("m", 0.5), 0.0, -1.0)};
  const double w = 0.3;
  const double force = 2.0 * 10.0 * std::tanh(50.0 * w / 10.0) + 3.0 + w;
  const Result result = solve_soundly(model, static_on(accurate(1e-8), Geometry::linear, {force}));
  const State& state = result.states.at(0);
  EXPECT_NEAR(state.springs.at(0).mobilised.value(), 3.0 / 4.0, 1e-6);
  EXPECT_FALSE(state.springs.at(1).mobilised);
  const FoundationState& soil = state.foundations.at(0);
  ASSERT_EQ(soil.mobilised.size(), soil.s.size());
  for (const double share : soil.mobilised) EXPECT_NEAR(share, std::tanh(5.0 * w), 1e-5);
  // a foundation without a law has no capacity
  model.foundations[0].law.reset();
  model.foundations[0].stiffness = 50.0;
  const Result plain = solve_soundly(model, static_on(accurate(1e-8), Geometry::linear, {1.0}));
  EXPECT_TRUE(plain.states.at(0).foundations.at(0).mobilised.empty());
}

}  // namespace
}  // namespace snapthrough
