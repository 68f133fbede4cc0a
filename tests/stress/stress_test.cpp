/// Random valid models: nothing crashes, no number is not finite, paths are contiguous, the same request
/// gives the same bits, and an analysis that cannot be completed says so.
///
/// STRESS_SEEDS=n runs n seeds (default 120), STRESS_FIRST=s starts at seed s.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <string>

#include "solver/solve.h"
#include "tests/stress/random_model.h"

namespace snapthrough {
namespace {

int from_environment(const char* name, int otherwise) {
  const char* text = std::getenv(name);
  return text == nullptr ? otherwise : std::atoi(text);
}

void expect_sound_branch(const Branch& branch, int seed) {
  ASSERT_EQ(branch.load_factor.size(), branch.arc_length.size()) << "seed " << seed;
  ASSERT_EQ(branch.load_factor.size(), branch.negative_eigenvalues.size()) << "seed " << seed;
  for (std::size_t i = 0; i < branch.load_factor.size(); ++i) {
    EXPECT_TRUE(std::isfinite(branch.load_factor[i])) << "seed " << seed;
    EXPECT_GE(branch.negative_eigenvalues[i], 0) << "seed " << seed;
    for (const NamedSeries& contact : branch.contact_fraction) {
      EXPECT_GE(contact.values[i], 0.0) << "seed " << seed;
      EXPECT_LE(contact.values[i], 1.0) << "seed " << seed;
    }
    if (i == 0) continue;
    EXPECT_GT(branch.arc_length[i], branch.arc_length[i - 1]) << "seed " << seed << ", point " << i;
  }
}

void expect_same(const Result& a, const Result& b, int seed) {
  EXPECT_EQ(a.summary.critical_load_factor, b.summary.critical_load_factor) << "seed " << seed;
  EXPECT_EQ(a.diagnostics.factorizations, b.diagnostics.factorizations) << "seed " << seed;
  ASSERT_EQ(a.branches.size(), b.branches.size()) << "seed " << seed;
  for (std::size_t i = 0; i < a.branches.size(); ++i)
    EXPECT_EQ(a.branches[i].load_factor, b.branches[i].load_factor);
}

TEST(Stress, RandomModelsAreAnswered) {
  const int first = from_environment("STRESS_FIRST", 0);
  const int count = from_environment("STRESS_SEEDS", 120);
  int failed = 0;
  std::string codes;
  for (int seed = first; seed < first + count; ++seed) {
    const auto request = testing::random_request(static_cast<std::uint64_t>(seed));
    ASSERT_TRUE(check(request.model, request.analysis).empty()) << "seed " << seed << " is no valid model";
    const Result result = solve(request.model, request.analysis);
    EXPECT_FALSE(result.summary.termination.empty()) << "seed " << seed;
    if (result.failure) {
      ++failed;
      codes += " " + std::to_string(seed) + ":" + result.failure->code;
    }
    for (const Branch& branch : result.branches) expect_sound_branch(branch, seed);
    for (const CriticalPoint& point : result.critical_points)
      EXPECT_TRUE(std::isfinite(point.load_factor)) << "seed " << seed;
    if (seed % 10 == 0) expect_same(result, solve(request.model, request.analysis), seed);
  }
  // 5 of 300 at the time of writing (two of them mechanisms until a gap closes); none may be silent
  EXPECT_LE(failed, 2 + count / 50) << "failed seeds:" << codes;
}

}  // namespace
}  // namespace snapthrough
