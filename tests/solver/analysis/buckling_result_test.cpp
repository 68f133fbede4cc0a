/// What a linearised analysis reports of loads of both senses, and under constant actions beyond buckling.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "solver/solve.h"
#include "tests/solver/structures.h"

namespace snapthrough {
namespace {

using ::testing::HasSubstr;

constexpr double kPi = std::numbers::pi;

Analysis buckling(int modes, bool reversed) {
  Analysis analysis;
  analysis.type = AnalysisType::buckling;
  analysis.modes = modes;
  analysis.reversed = reversed;
  analysis.discretization.accuracy = 1e-6;
  return analysis;
}

/// A braced frame: loads at its corners press one diagonal and pull the other.
Model braced_frame() {
  Model model;
  model.nodes = {{"a", 0.0, 0.0}, {"b", 0.0, 3.0}, {"c", 4.0, 3.0}, {"d", 4.0, 0.0}};
  model.sections = {{"s", 500.0, 1.0, {}}};
  for (const auto& [id, start, end] : {std::array{"left", "a", "b"}, std::array{"beam", "b", "c"},
                                       std::array{"right", "c", "d"}, std::array{"brace", "a", "c"}})
    model.members.push_back({id, start, end, "s", LineCurve{}, false, false});
  model.supports = {{"a", true, true, false, 0.0, {}}, {"d", true, true, true, 0.0, {}}};
  model.loads = {
      PointLoad{{"b", "", 0.0}, {1.0, -0.3}, 0.2, Pattern::proportional},
      DistributedLoad{"beam", {0.0, -0.1}, {0.0, 1.0}, LoadMeasure::length, Pattern::proportional}};
  return model;
}

Model with_opposite_loads(Model model) {
  for (double& component : std::get<PointLoad>(model.loads[0]).force) component = -component;
  std::get<PointLoad>(model.loads[0]).moment *= -1.0;
  for (double& component : std::get<DistributedLoad>(model.loads[1]).force) component = -component;
  return model;
}

TEST(Buckling, ReversedLoadsAreThoseOfTheOppositeActionsWithAMinus) {
  constexpr int kModes = 3;
  const Model model = braced_frame();
  const Result both = solve(model, buckling(kModes, true));
  const Result given = solve(model, buckling(kModes, false));
  const Result opposite = solve(with_opposite_loads(model), buckling(kModes, false));
  ASSERT_FALSE(both.failure) << both.failure->detail;
  std::vector<double> expected = given.buckling->load_factors;
  for (const double load : opposite.buckling->load_factors) expected.push_back(-load);
  std::sort(expected.begin(), expected.end(), [](double l, double r) { return std::abs(l) < std::abs(r); });
  const BucklingResult& buckling = *both.buckling;
  ASSERT_EQ(buckling.load_factors.size(), 2U * kModes);
  ASSERT_EQ(buckling.modes.size(), 2U * kModes);
  ASSERT_EQ(buckling.error_estimates.size(), 2U * kModes);
  for (std::size_t i = 0; i < expected.size(); ++i)
    EXPECT_NEAR(buckling.load_factors[i], expected[i], 1e-9 * std::abs(expected[i])) << i;
  EXPECT_EQ(both.summary.critical_load_factor, given.summary.critical_load_factor);
  EXPECT_THAT(both.summary.message, HasSubstr("the opposite actions make it buckle at load factor -"));
}

/// Pinned, pushed at a third of its length: two thirds are pressed one way, one third the other. The column's
/// equation and elements agree.
TEST(Buckling, ReversedLoadsOfAColumnAreThoseOfElements) {
  Model model = testing::column(3.0, 1.0, 1e7, 2.0);
  model.loads = {PointLoad{{"", "column", 1.0 / 3.0}, {-1.0, 0.0}, 0.0, Pattern::proportional}};
  model.supports[1].x = true;
  const Result exact = solve(model, buckling(2, true));
  ASSERT_FALSE(exact.failure) << exact.failure->detail;
  EXPECT_THAT(exact.diagnostics.skipped, ::testing::Contains(HasSubstr("differential equation")));
  Analysis on_mesh = buckling(2, true);
  on_mesh.discretization = testing::fixed_mesh(12, 6);
  const Result elements = solve(model, on_mesh);
  ASSERT_EQ(exact.buckling->load_factors.size(), 4U);
  ASSERT_EQ(elements.buckling->load_factors.size(), 4U);
  for (std::size_t i = 0; i < 4; ++i)
    EXPECT_NEAR(elements.buckling->load_factors[i], exact.buckling->load_factors[i],
                1e-6 * std::abs(exact.buckling->load_factors[i]));
}

/// A pulled column buckles under the opposite load only, at Euler's load.
TEST(Buckling, APulledColumnHasNegativeLoadsOnly) {
  Model model = testing::column(1.0, 1.0, 1e6, 0.0);
  std::get<PointLoad>(model.loads[0]).force[0] = 1.0;
  for (const bool exact : {true, false}) {
    Analysis analysis = buckling(2, true);
    if (!exact) analysis.discretization = testing::fixed_mesh(8, 6);
    const Result result = solve(model, analysis);
    EXPECT_FALSE(result.failure);
    EXPECT_EQ(result.summary.termination, "no_buckling");
    EXPECT_FALSE(result.summary.critical_load_factor);
    ASSERT_EQ(result.buckling->load_factors.size(), 2U);
    EXPECT_NEAR(result.buckling->load_factors[0], -kPi * kPi, 1e-6 * kPi * kPi);
    EXPECT_NEAR(result.buckling->load_factors[1], -4.0 * kPi * kPi, 4e-6 * kPi * kPi);
  }
}

/// A pressed column has no negative load, and says so.
TEST(Buckling, APressedColumnHasNoNegativeLoads) {
  const Result result = solve(testing::column(1.0, 1.0, 1e6, 0.0), buckling(1, true));
  EXPECT_EQ(result.buckling->load_factors.size(), 1U);
  EXPECT_THAT(result.summary.message, HasSubstr("no negative load factor makes the structure buckle"));
}

/// The list began with the load of the second mode.
TEST(Buckling, NoLoadsAreGivenWhereTheConstantActionsExceedSome) {
  Model model = testing::column(1.0, 1.0, 1e6, 0.0);
  PointLoad weight = std::get<PointLoad>(model.loads[0]);
  weight.force[0] = -20.0;  // twice Euler's load
  weight.pattern = Pattern::constant;
  model.loads.push_back(weight);
  for (const bool exact : {true, false}) {
    Analysis analysis = buckling(2, true);
    if (!exact) analysis.discretization = testing::fixed_mesh(8, 6);
    const Result result = solve(model, analysis);
    EXPECT_FALSE(result.failure);
    EXPECT_EQ(result.summary.termination, "unstable_at_start");
    EXPECT_THAT(result.summary.message, HasSubstr("the constant actions alone exceed 1 buckling loads"));
    EXPECT_FALSE(result.summary.critical_load_factor);
    ASSERT_TRUE(result.buckling);
    EXPECT_TRUE(result.buckling->load_factors.empty());
    EXPECT_TRUE(result.buckling->error_estimates.empty());
    EXPECT_TRUE(result.buckling->modes.empty());
  }
}

}  // namespace
}  // namespace snapthrough
