/// A slice of the stress test: random valid models are solved, and every returned state is checked by
/// mechanics written a second time. The long run is scripts/stress.sh; docs/stress.md says what is checked.
#include <gtest/gtest.h>

#include <map>
#include <string>

#include "api/api.h"
#include "solver/solve.h"
#include "tests/stress/broad_model.h"
#include "tests/stress/frame_model.h"
#include "tests/stress/inertia.h"
#include "tests/stress/random_model.h"
#include "tests/stress/request_text.h"
#include "tests/stress/stress_run.h"

namespace snapthrough::testing {
namespace {

TEST(StressChecker, CountsNegativeEigenvaluesOfAMatrixWithoutDiagonal) {
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(4, 4);
  a(1, 0) = a(0, 1) = 2.0;  // +2, -2
  a(2, 2) = -1.0;
  a(3, 3) = 5.0;
  a(3, 1) = a(1, 3) = 1e-3;
  EXPECT_EQ(negative_eigenvalues(a), 2);
  EXPECT_EQ(negative_eigenvalues(-a), 2);
}

/// The checker must see a point that is a little off: a residual that never fails would prove nothing.
TEST(StressChecker, SeesAFalsePoint) {
  const auto request = random_request(14);
  Analysis analysis = request.analysis;
  analysis.output.states = StateOutput::all;
  analysis.output.points_per_member = points_needed(request.model, analysis);
  Result result = solve(request.model, analysis);
  ASSERT_TRUE(check_result(request.model, analysis, result).failures.empty());
  result.states.back().load_factor *= 1.0 + 1e-6;
  EXPECT_FALSE(check_result(request.model, analysis, result).failures.empty());
}

/// How each of the twelve ends: as it does drawn mirrored, from the other end and in another order, and,
/// where an accuracy is asked for, at a tenth of it.
TEST(Stress, SliceOfRandomModels) {
  const std::map<std::uint64_t, std::string> ends{
      {28, "load_factor"},  {29, "monitor"},     {30, "load_factor"},    {31, "load_factor"},
      {32, "load_factor"},  {33, "monitor"},     {34, "load_bound"},     {35, "critical_point"},
      {36, "limit_points"}, {37, "load_factor"}, {38, "critical_point"}, {39, "load_factor"}};
  for (const auto& [seed, end] : ends) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const StressOutcome out = run_seed(Draw::broad, seed, 20.0);
    EXPECT_EQ(out.termination, end) << out.detail;
    EXPECT_TRUE(out.reached);
    EXPECT_TRUE(out.said_where);
    EXPECT_GT(out.check.points, 0) << "no state was checked";
    for (const std::string& what : out.check.failures) ADD_FAILURE() << what << "\n" << out.features;
  }
}

/// What `stress_request` writes is the request that was drawn: read as a user's document it is written the
/// same.
TEST(Stress, RequestsOfSeedsAreWrittenWhole) {
  for (std::uint64_t seed = 0; seed < 200; ++seed)
    for (const RandomRequest& drawn :
         {random_request(seed), broad_request(seed), frame_request(seed, 1e-3)}) {
      const std::string text = request_text(drawn);
      const api::ReadOutcome read = api::read_request(text);
      ASSERT_TRUE(read.request) << seed << ": " << text;
      EXPECT_EQ(request_text({read.request->model, read.request->analysis}), text) << seed;
    }
}

}  // namespace
}  // namespace snapthrough::testing
