/// The error estimate against the error, on problems with known loads, at several accuracies.
///
/// Asked of every load: error <= accuracy. Asked of all: error <= estimate in 95 % of them, and a median
/// ratio of estimate to error below 10.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "solver/solve.h"
#include "tests/accuracy/known_loads.h"
#include "tests/recorded.h"

namespace snapthrough {
namespace {

using namespace testing;

/// Counts over the loads of one accuracy.
struct Score {
  int loads = 0;
  int unknown = 0;
  int missed = 0;
  int above_accuracy = 0;
  int above_estimate = 0;
  std::vector<double> ratios;  ///< estimate to error, where the known value has digits enough to tell
};

void judge(const KnownLoads& problem, double accuracy, const Result& result, Score& score) {
  for (const KnownLoads::Load& load : problem.loads) {
    ++score.loads;
    const CriticalPoint* point = point_of(result, load);
    if (point == nullptr) {
      ++score.missed;
      ADD_FAILURE() << problem.name << " at " << accuracy << ": a critical point is missing; "
                    << result.summary.message;
      continue;
    }
    const double error = std::abs(point->load_factor / load.value - 1.0);
    const double estimate = point->error_estimate.value_or(-1.0);
    record_figure("load_" + std::to_string(score.loads), problem.name, ", load ", load.number, ": error ",
                  error, ", estimate ", estimate, ", ", result.discretization.elements, " elements of order ",
                  result.discretization.order);
    if (!point->error_estimate) {
      ++score.unknown;
      ADD_FAILURE() << problem.name << " at " << accuracy << " has no estimate; " << result.summary.message;
      continue;
    }
    if (error > accuracy) {
      ++score.above_accuracy;
      ADD_FAILURE() << problem.name << ": error " << error << " at accuracy " << accuracy;
    }
    if (error > estimate + problem.digits) ++score.above_estimate;
    if (error > 3.0 * problem.digits) score.ratios.push_back(estimate / error);
  }
}

class Honesty : public ::testing::TestWithParam<double> {};

TEST_P(Honesty, OfTheEstimate) {
  const double accuracy = GetParam();
  Score score;
  for (KnownLoads& problem : known_loads()) {
    problem.analysis.discretization.accuracy = accuracy;
    judge(problem, accuracy, solve(problem.model, problem.analysis), score);
  }
  ASSERT_GE(score.loads, 60);
  EXPECT_EQ(score.missed + score.unknown + score.above_accuracy, 0);
  EXPECT_LE(score.above_estimate, score.loads / 20) << "of " << score.loads;
  ASSERT_GE(static_cast<int>(score.ratios.size()), 20);
  const auto middle = score.ratios.begin() + static_cast<std::ptrdiff_t>(score.ratios.size() / 2);
  std::nth_element(score.ratios.begin(), middle, score.ratios.end());
  EXPECT_LT(*middle, 10.0);
  record_figure("loads", score.loads);
  record_figure("above_estimate", score.above_estimate);
  record_figure("median_of_estimate_to_error", *middle, " of ", score.ratios.size());
}

INSTANTIATE_TEST_SUITE_P(Accuracies, Honesty, ::testing::Values(1e-2, 1e-3, 1e-4, 1e-6));

}  // namespace
}  // namespace snapthrough
