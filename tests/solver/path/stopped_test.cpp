/// An analysis that is asked to stop is no success, wherever it was.
#include <gtest/gtest.h>

#include <stop_token>

#include "solver/solve.h"
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
  EXPECT_EQ(result.branches[0].load_factor.size(), 4U);
}

}  // namespace
}  // namespace snapthrough
