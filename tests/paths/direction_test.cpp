/// A path that begins with a falling load factor under the opposite load is the same path: each load factor
/// has the other sign.
#include <gtest/gtest.h>

#include <string>
#include <variant>

#include "solver/solve.h"
#include "tests/solver/structures.h"

namespace snapthrough {
namespace {

Model with_opposite_loads(Model model) {
  for (Load& load : model.loads) {
    auto& point = std::get<PointLoad>(load);
    for (double& component : point.force) component = -component;
    point.moment = -point.moment;
  }
  return model;
}

CriticalType mirrored(CriticalType type) {
  if (type == CriticalType::limit_max) return CriticalType::limit_min;
  return type == CriticalType::limit_min ? CriticalType::limit_max : type;
}

void expect_mirrored(const Branch& falling, const Branch& growing, const std::string& what) {
  constexpr double kRounding = 1e-9;  // beside 1; steps of both paths are the same to rounding
  EXPECT_EQ(falling.termination, growing.termination) << what;
  EXPECT_EQ(falling.negative_eigenvalues, growing.negative_eigenvalues) << what;
  ASSERT_EQ(falling.load_factor.size(), growing.load_factor.size()) << what;
  for (std::size_t i = 0; i < falling.load_factor.size(); ++i) {
    EXPECT_NEAR(falling.load_factor[i], -growing.load_factor[i],
                kRounding * std::abs(growing.load_factor[i]));
    for (std::size_t m = 0; m < growing.monitors.size(); ++m)
      EXPECT_NEAR(falling.monitors[m].values[i], growing.monitors[m].values[i], kRounding);
  }
}

/// Both paths, and that they are mirrored. @return the one with falling load
Result expect_mirrored_paths(const Model& model, Analysis analysis, const std::string& what) {
  const Result growing = solve(model, analysis);
  EXPECT_FALSE(growing.failure) << what;
  analysis.step.direction = -1.0;
  const Model opposite = with_opposite_loads(model);
  if (analysis.stop.load_factor) {
    const auto [lo, hi] = *analysis.stop.load_factor;
    analysis.stop.load_factor = {{-hi, -lo}};
  }
  Result falling = solve(opposite, analysis);
  EXPECT_EQ(falling.failure.has_value(), growing.failure.has_value()) << what;
  EXPECT_EQ(falling.summary.termination, growing.summary.termination) << what;
  EXPECT_EQ(falling.summary.critical_load_factor.has_value(),
            growing.summary.critical_load_factor.has_value());
  const double critical = growing.summary.critical_load_factor.value_or(0.0);
  EXPECT_NEAR(falling.summary.critical_load_factor.value_or(0.0), -critical, 1e-8 * critical);
  EXPECT_EQ(falling.critical_points.size(), growing.critical_points.size()) << what;
  for (std::size_t i = 0; i < std::min(falling.critical_points.size(), growing.critical_points.size()); ++i) {
    EXPECT_EQ(falling.critical_points[i].type, mirrored(growing.critical_points[i].type)) << what;
    EXPECT_EQ(falling.critical_points[i].confirmed, growing.critical_points[i].confirmed) << what;
    EXPECT_NEAR(falling.critical_points[i].load_factor, -growing.critical_points[i].load_factor,
                1e-8 * std::abs(growing.critical_points[i].load_factor));
  }
  EXPECT_EQ(falling.branches.size(), growing.branches.size()) << what;
  for (std::size_t i = 0; i < std::min(falling.branches.size(), growing.branches.size()); ++i)
    expect_mirrored(falling.branches[i], growing.branches[i], what);
  return falling;
}

Analysis path_analysis() {
  Analysis analysis;
  analysis.type = AnalysisType::path;
  analysis.output.states = StateOutput::none;
  return analysis;
}

/// Over a bifurcation and two limit points, on a mesh that is chosen.
TEST(Direction, AnArchUnderTheOppositeLoadHasTheMirroredPath) {
  Analysis analysis = path_analysis();
  analysis.stop.limit_points = 2;
  Model model = testing::arch(20.0, 420.0, 1.4);
  const Result falling = expect_mirrored_paths(model, analysis, "pinned");
  ASSERT_EQ(falling.critical_points.size(), 4U);
  EXPECT_EQ(falling.critical_points[0].type, CriticalType::bifurcation);
  EXPECT_LT(falling.critical_points[0].load_factor, 0.0);
  testing::add_soil(model, 10.0);
  static_cast<void>(expect_mirrored_paths(model, analysis, "on a one-sided base"));
}

TEST(Direction, AColumnUnderTheOppositeLoadHasTheMirroredBranches) {
  Analysis analysis = path_analysis();
  analysis.discretization = testing::fixed_mesh(8, 4);
  analysis.stop.load_factor = {{-1.0, 60.0}};
  analysis.branches.follow = Follow::first;
  const Result falling = expect_mirrored_paths(testing::column(1.0, 1.0, 1e6, 0.0), analysis, "column");
  EXPECT_EQ(falling.branches.size(), 3U);
  EXPECT_LT(falling.summary.critical_load_factor.value_or(0.0), 0.0);
}

/// Under constant actions the path starts where they act, and goes the other way from there.
TEST(Direction, AStartUnderConstantActionsIsLeftTheOtherWay) {
  Model model = testing::arch(20.0, 420.0, 1.4);
  PointLoad weight = std::get<PointLoad>(model.loads[0]);
  weight.at.fraction = 0.25;
  weight.force[1] *= 0.5;
  weight.pattern = Pattern::constant;
  Analysis analysis = path_analysis();
  analysis.discretization = testing::fixed_mesh(8, 4);
  analysis.stop.limit_points = 1;
  model.loads.push_back(weight);
  const Result growing = solve(model, analysis);
  std::get<PointLoad>(model.loads[0]).force[1] *= -1.0;
  analysis.step.direction = -1.0;
  const Result falling = solve(model, analysis);
  ASSERT_EQ(falling.branches.size(), 1U);
  expect_mirrored(falling.branches[0], growing.branches[0], "constant");
}

/// A pulled column is stable: nothing is lost the other way.
TEST(Direction, ACompressedColumnIsPulledTheOtherWay) {
  Analysis analysis = path_analysis();
  analysis.discretization = testing::fixed_mesh(8, 4);
  analysis.stop.load_factor = {{-60.0, 60.0}};
  analysis.step.direction = -1.0;
  const Result pulled = solve(testing::column(1.0, 1.0, 1e6, 0.0), analysis);
  EXPECT_EQ(pulled.summary.termination, "load_factor");
  EXPECT_NEAR(pulled.branches.at(0).load_factor.back(), -60.0, 1e-9);
  EXPECT_TRUE(pulled.critical_points.empty());
}

}  // namespace
}  // namespace snapthrough
