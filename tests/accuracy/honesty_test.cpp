/// The error estimate against the error, on problems with known loads, at several accuracies.
///
/// Asked of every load: error <= accuracy. Asked of all, and of those with one-sided contact alone:
/// error <= estimate in 95 % of them, and a median ratio of estimate to error below 5.
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

/// Counts over the loads of one accuracy, or over those with contact.
struct Score {
  int loads = 0;
  int above_estimate = 0;
  std::vector<double> ratios;  ///< estimate to error, where the known value has digits enough to tell
};

void count(double error, double estimate, double digits, Score& score) {
  ++score.loads;
  if (error > estimate + digits) ++score.above_estimate;
  if (error > 3.0 * digits) score.ratios.push_back(estimate / error);
}

void judge(const KnownLoads& problem, double accuracy, const Result& result, Score& all, Score& contact) {
  for (const KnownLoads::Load& load : problem.loads) {
    const CriticalPoint* point = point_of(result, load);
    if (point == nullptr) {
      ADD_FAILURE() << problem.name << " at " << accuracy << ": a critical point is missing; "
                    << result.summary.message;
      continue;
    }
    if (!point->error_estimate) {
      ADD_FAILURE() << problem.name << " at " << accuracy << " has no estimate; " << result.summary.message;
      continue;
    }
    const double error = std::abs(point->load_factor / load.value - 1.0);
    EXPECT_LE(error, accuracy) << problem.name;
    count(error, *point->error_estimate, problem.digits, all);
    if (problem.contact) count(error, *point->error_estimate, problem.digits, contact);
    record_figure("load_" + std::to_string(all.loads), problem.name, ", load ", load.number, ": error ",
                  error, ", estimate ", *point->error_estimate, ", ", result.discretization.elements,
                  " elements of order ", result.discretization.order);
  }
}

/// Expects what is asked of many loads, and records it under names that begin with `which`.
void expect_honest(Score& score, int least_loads, const std::string& which) {
  SCOPED_TRACE(which);
  ASSERT_GE(score.loads, least_loads);
  EXPECT_LE(score.above_estimate, score.loads / 20) << "of " << score.loads;
  ASSERT_GE(score.ratios.size(), static_cast<std::size_t>(least_loads) / 2);
  const auto middle = score.ratios.begin() + static_cast<std::ptrdiff_t>(score.ratios.size() / 2);
  std::nth_element(score.ratios.begin(), middle, score.ratios.end());
  EXPECT_LT(*middle, 5.0);
  record_figure(which + "_loads", score.loads);
  record_figure(which + "_above_estimate", score.above_estimate);
  record_figure(which + "_median_of_estimate_to_error", *middle, " of ", score.ratios.size());
}

class Honesty : public ::testing::TestWithParam<double> {};

TEST_P(Honesty, OfTheEstimate) {
  const double accuracy = GetParam();
  Score all;
  Score contact;
  for (KnownLoads& problem : known_loads()) {
    problem.analysis.discretization.accuracy = accuracy;
    judge(problem, accuracy, solve(problem.model, problem.analysis), all, contact);
  }
  expect_honest(all, 200, "all");
  expect_honest(contact, 80, "contact");
}

INSTANTIATE_TEST_SUITE_P(Accuracies, Honesty, ::testing::Values(1e-2, 1e-3, 1e-4, 1e-6));

}  // namespace
}  // namespace snapthrough
