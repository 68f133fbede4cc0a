/// What ends a path that loses stability again and again, and what is said of it.
///
/// A straight pinned column meets a bifurcation at P (1 - P / EA) = n^2 pi^2 EI / L^2 for each n, exact for a
/// column that is compressed and does not shear, and its middle does not move along the primary path.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "solver/solve.h"
#include "tests/solver/structures.h"

namespace snapthrough {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

constexpr double kEA = 1e6;

/// Length 1, EI 1, unit load; monitors: the middle across, the end along.
Model straight_column() {
  Model model = testing::column(1.0, 1.0, kEA, 0.0);
  model.monitors.push_back({"end", {"b", "", 0.0}, Component::x});
  return model;
}

double exact_load(int n) {
  const double euler = std::pow(n * std::numbers::pi, 2);
  return 0.5 * kEA * (1.0 - std::sqrt(1.0 - 4.0 * euler / kEA));
}

Analysis path_analysis() {
  Analysis analysis;
  analysis.type = AnalysisType::path;
  analysis.discretization = testing::fixed_mesh(24, 6);
  analysis.output.states = StateOutput::none;
  return analysis;
}

bool has_warning(const Result& result, const std::string& code) {
  return std::any_of(result.warnings.begin(), result.warnings.end(),
                     [&](const Warning& warning) { return warning.code == code; });
}

/// Ends on the bifurcation that makes `negative` eigenvalues negative, after those before it, at the exact
/// loads.
void expect_ends_with(const Result& result, int negative) {
  EXPECT_FALSE(result.failure) << result.failure->detail;
  EXPECT_EQ(result.summary.termination, "negative_eigenvalues");
  EXPECT_EQ(result.branches.at(0).termination, "negative_eigenvalues");
  EXPECT_EQ(result.branches[0].negative_eigenvalues.back(), negative);
  EXPECT_NEAR(result.branches[0].load_factor.back(), exact_load(negative), 1e-6 * exact_load(negative));
  ASSERT_EQ(result.critical_points.size(), static_cast<std::size_t>(negative));
  for (int n = 1; n <= negative; ++n)
    EXPECT_NEAR(result.critical_points[static_cast<std::size_t>(n - 1)].load_factor, exact_load(n),
                1e-6 * exact_load(n))
        << n;
}

/// It followed a hundred bifurcations, and the message spoke of the last.
TEST(StopRules, AStraightColumnIsNotFollowedForEver) {
  Analysis analysis = path_analysis();
  analysis.stop.monitor = {"mid", {-0.1, 0.1}};
  const Result result = solve(straight_column(), analysis);
  expect_ends_with(result, 11);
  ASSERT_TRUE(result.summary.critical_load_factor);
  EXPECT_NEAR(*result.summary.critical_load_factor, exact_load(1), 1e-6 * exact_load(1));
  EXPECT_THAT(result.summary.message, StartsWith("first loss of stability: bifurcation at load factor 9.86"));
  EXPECT_THAT(result.summary.message, HasSubstr("; negative eigenvalues: 10 before, 11 after"));
  EXPECT_TRUE(has_warning(result, "monitor_still"));
}

TEST(StopRules, TheBoundOfTheRequestIsTaken) {
  Analysis analysis = path_analysis();
  analysis.stop.negative_eigenvalues = 2;
  expect_ends_with(solve(straight_column(), analysis), 3);
  analysis.stop.negative_eigenvalues = 0;
  expect_ends_with(solve(straight_column(), analysis), 1);
  analysis.stop = {};
  expect_ends_with(solve(straight_column(), analysis), 11);
}

/// Each limit point that is asked for may make one eigenvalue negative.
TEST(StopRules, LimitPointsRaiseTheBound) {
  Analysis analysis = path_analysis();
  analysis.stop.limit_points = 2;
  expect_ends_with(solve(straight_column(), analysis), 13);
}

/// Fourteen bifurcations lie below 2000 EI/L^2: a request that says where to end is served.
TEST(StopRules, ARuleThatActsIsServed) {
  Analysis analysis = path_analysis();
  analysis.stop.monitor = {"end", {-2e-3, 2e-3}};
  Result result = solve(straight_column(), analysis);
  EXPECT_EQ(result.summary.termination, "monitor");
  EXPECT_EQ(result.critical_points.size(), 14U);
  EXPECT_FALSE(has_warning(result, "monitor_still"));
  analysis.stop = {};
  analysis.stop.load_factor = {{-1.0, 2000.0}};
  result = solve(straight_column(), analysis);
  EXPECT_EQ(result.summary.termination, "load_factor");
  EXPECT_EQ(result.critical_points.size(), 14U);
  analysis.stop.negative_eigenvalues = 3;
  EXPECT_EQ(solve(straight_column(), analysis).summary.termination, "negative_eigenvalues");
}

/// The middle does not move on the primary path, and does on the branches.
TEST(StopRules, AMonitorThatMovesOnABranchIsNotStill) {
  Analysis analysis = path_analysis();
  analysis.stop.monitor = {"mid", {-0.1, 0.1}};
  analysis.stop.negative_eigenvalues = 1;
  analysis.branches.follow = Follow::first;
  const Result result = solve(straight_column(), analysis);
  ASSERT_GE(result.branches.size(), 2U);
  EXPECT_EQ(result.branches[1].termination, "monitor");
  EXPECT_FALSE(has_warning(result, "monitor_still"));
}

/// It said "0 negative eigenvalues there" or "1", as rounding had it.
TEST(StopRules, AnEndOnACriticalPointTellsTheCountsOnBothSides) {
  Analysis analysis = path_analysis();
  analysis.type = AnalysisType::critical;
  EXPECT_THAT(solve(straight_column(), analysis).summary.message,
              HasSubstr(" steps; negative eigenvalues: 0 before, 1 after"));
  analysis = path_analysis();
  analysis.stop.limit_points = 1;
  const Result result = solve(testing::arch(160.0, 1e8, 1.0), analysis);
  ASSERT_EQ(result.summary.termination, "limit_points");
  const CriticalPoint& last = result.critical_points.back();
  EXPECT_THAT(result.summary.message,
              HasSubstr("; negative eigenvalues: " + std::to_string(last.negative_before) + " before, " +
                        std::to_string(last.negative_after) + " after"));
}

}  // namespace
}  // namespace snapthrough
