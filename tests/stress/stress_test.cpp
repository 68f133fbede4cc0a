/// A slice of the stress test: random valid models are solved, and every returned state is checked by
/// mechanics written a second time. The long run is scripts/stress.sh; docs/stress.md says what is checked.
#include <gtest/gtest.h>

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

/// Models that once ended without a stop rule, or with a point that the checker refused: contact on bases of
/// hundreds of decay lengths, corners, tiny constant actions, zones of contact between samples and beside
/// clamped ends, axes that samples do not resolve, paths that no longer turn, residuals that are small beside
/// large forces only, thin members that buckle within gradients of 1e-6, free ends under follower pressure.
TEST(Stress, ModelsThatFailedOnce) {
  for (const std::uint64_t seed :
       {13,    75,    146,   337,   552,   564,   608,   790,   836,   982,   1073,  1122,  2073,  2091,
        2169,  2302,  2308,  2341,  2432,  3101,  3326,  3400,  136,   2144,  3260,  4353,  6003,  6011,
        8132,  9462,  9644,  8173,  8196,  8815,  9069,  9349,  9656,  20329, 20698, 21101, 21116, 21894,
        30180, 34196, 34694, 55743, 58925, 60665, 67134, 67591, 70607, 71930, 100921}) {
    const StressOutcome out = run_seed(Draw::broad, seed, 60.0);
    EXPECT_TRUE(out.reached) << "seed " << seed << ": " << out.termination << ", " << out.detail;
    for (const std::string& what : out.check.failures)
      ADD_FAILURE() << "seed " << seed << ": " << what << "\n" << out.features;
  }
}

/// Half waves so short that meshes of some hundred elements a member differ by a part of the load: said, with
/// states that are right.
TEST(Stress, HalfWavesShorterThanTheElementsAreNotConfirmed) {
  const StressOutcome out = run_seed(Draw::broad, 31064, 60.0);
  EXPECT_EQ(out.termination, "not_confirmed") << out.detail;
  for (const std::string& what : out.check.failures) ADD_FAILURE() << what << "\n" << out.features;
}

/// Bases so stiff that penetration times stiffness is known to 1e-9 of the largest force only: their
/// resultants are what equilibrium leaves. Two of them have a critical point where contact changes.
TEST(Stress, ReactionsOfStiffBasesAddUp) {
  for (const std::uint64_t seed : {200082, 200117, 200147, 351980, 353249}) {
    const StressOutcome out = run_seed(Draw::broad, seed, 60.0);
    EXPECT_GT(out.check.points, 0) << "seed " << seed;
    EXPECT_LT(out.check.imbalance, 1e-9) << "seed " << seed;
  }
}

TEST(Stress, SliceOfRandomModels) {
  constexpr int kFirst = 28;
  constexpr int kSeeds = 12;
  int reached = 0;
  for (int seed = kFirst; seed < kFirst + kSeeds; ++seed) {
    const StressOutcome out = run_seed(Draw::broad, static_cast<std::uint64_t>(seed), 20.0);
    EXPECT_TRUE(out.check.points > 0 || !out.reached) << "seed " << seed;
    EXPECT_TRUE(out.said_where) << "seed " << seed;
    for (const std::string& what : out.check.failures)
      ADD_FAILURE() << "seed " << seed << ": " << what << "\n" << out.features;
    if (out.reached) ++reached;
  }
  EXPECT_GT(reached, 0);
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
