/// An analysis that is asked to stop is no success, wherever it was.
#include <gtest/gtest.h>

#include <stop_token>
#include <vector>

#include "solver/discrete/build_structure.h"
#include "solver/numeric/cancelled.h"
#include "solver/problem/structural_problem.h"
#include "solver/resolve/resolved_model.h"
#include "solver/solve.h"
#include "solver/sweep/critical_curve.h"
#include "tests/solver/structures.h"

namespace snapthrough {
namespace {

/// The stop comes when the path has ended, and finer meshes are still to tell the load's error.
TEST(StoppedAnalysis, LoadsThatWereNotCheckedAreNoSuccess) {
  std::stop_source stop;
  Hooks hooks;
  hooks.stop = stop.get_token();
  hooks.on_critical = [&](const CriticalPoint&) { stop.request_stop(); };
  const Result result = solve(testing::arch(20.0, 1e8, 1e6), {}, hooks);
  ASSERT_TRUE(result.failure);
  EXPECT_EQ(result.failure->code, "cancelled");
  EXPECT_EQ(result.critical_points.size(), 1U) << "what was found is kept";
}

TEST(StoppedAnalysis, APathKeepsThePointsBeforeTheStop) {
  std::stop_source stop;
  Hooks hooks;
  hooks.stop = stop.get_token();
  hooks.on_progress = [&](const Progress& progress) {
    if (progress.step == 3) stop.request_stop();
  };
  Analysis analysis;
  analysis.type = AnalysisType::path;
  const Result result = solve(testing::arch(20.0, 1e8, 1e6), analysis, hooks);
  ASSERT_TRUE(result.failure);
  EXPECT_EQ(result.failure->code, "cancelled");
  ASSERT_EQ(result.branches.size(), 1U);
  EXPECT_EQ(result.branches[0].computed.size(), 4U);
}

/// A pinned column, whose buckling is solved by its differential equation unless a mesh is asked for.
Model column() {
  Model model;
  model.nodes = {{"a", 0.0, 0.0}, {"b", 1.0, 0.0}};
  model.sections = {{"s", 1e6, 1.0, {}}};
  model.members = {{"m", "a", "b", "s", LineCurve{}, false, false}};
  model.supports = {{"a", true, true, false, 0.0, {}}, {"b", false, true, false, 0.0, {}}};
  model.loads = {PointLoad{{"b", "", 0.0}, {-1.0, 0.0}, 0.0, Pattern::proportional}};
  return model;
}

/// Whatever is computed looks at the token before its first factorisation.
TEST(StoppedAnalysis, EveryAnalysisEndsBeforeItsFirstFactorisation) {
  std::stop_source stop;
  stop.request_stop();
  Hooks hooks;
  hooks.stop = stop.get_token();
  for (const AnalysisType type :
       {AnalysisType::critical, AnalysisType::path, AnalysisType::static_, AnalysisType::buckling}) {
    for (const bool fixed_mesh : {false, true}) {
      SCOPED_TRACE(static_cast<int>(type));
      Analysis analysis;
      analysis.type = type;
      analysis.load_factors = {1.0, 2.0};
      analysis.discretization.fixed_mesh = fixed_mesh;
      analysis.discretization.elements = 4;
      const Result result = solve(column(), analysis, hooks);
      ASSERT_TRUE(result.failure);
      EXPECT_EQ(result.failure->code, "cancelled");
      EXPECT_EQ(result.diagnostics.factorizations, 0);
      EXPECT_TRUE(result.critical_points.empty());
      EXPECT_EQ(result.not_reached.size(), type == AnalysisType::static_ ? 2U : 0U);
    }
  }
}

/// Linear statics has no path whose steps could look at the token.
TEST(StoppedAnalysis, LinearStaticsEndsToo) {
  std::stop_source stop;
  stop.request_stop();
  Hooks hooks;
  hooks.stop = stop.get_token();
  Analysis analysis;
  analysis.type = AnalysisType::static_;
  analysis.geometry = Geometry::linear;
  analysis.load_factors = {1.0, 2.0};
  const Result result = solve(column(), analysis, hooks);
  ASSERT_TRUE(result.failure);
  EXPECT_EQ(result.failure->code, "cancelled");
  EXPECT_EQ(result.not_reached.size(), 2U);
}

/// The request is heard once, so that what was reached can be evaluated.
TEST(StoppedAnalysis, AProblemTellsOnce) {
  std::stop_source stop;
  Structure structure = make_structure(resolve(column()), {}, Geometry::nonlinear);
  structure.stop = stop.get_token();
  StructuralProblem problem(structure);
  Eigen::VectorXd y = Eigen::VectorXd::Zero(problem.size());
  Eigen::VectorXd f;
  problem.linearise(y, 0.0, f);
  stop.request_stop();
  EXPECT_THROW(problem.linearise(y, 0.0, f), Cancelled);
  EXPECT_EQ(problem.linearise(y, 0.0, f).negative, 0);
}

}  // namespace
}  // namespace snapthrough
