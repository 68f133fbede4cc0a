/// The benchmark problems at the default settings: every path completes, has the known limit loads within the
/// accuracy asked for (1e-3 by default), and takes few Newton corrections a step whatever the slenderness.
///
/// Sources: thesis.md's converged values as reference_problems.h gives them; Lee's frame from
/// frames_limit_points.csv (12 digits).
#include <array>

#include "tests/paths/reference_problems.h"
#include "tests/recorded.h"

namespace snapthrough {
namespace {

using namespace testing;

constexpr double kDefaultAccuracy = 1e-3;

TEST(BenchmarkPaths, CompleteWithDefaultSettings) {
  for (const ReferenceProblem& problem : benchmark_problems()) {
    SCOPED_TRACE(problem.name);
    const Result result = solve_soundly(problem.model, problem.analysis);
    const StopRules& stop = problem.analysis.stop;
    const char* wanted = stop.limit_points ? "limit_points" : (stop.monitor ? "monitor" : "load_factor");
    EXPECT_EQ(result.summary.termination, wanted) << result.summary.message;
    if (!problem.first_limit) continue;
    const auto limits = limits_of(result);
    ASSERT_FALSE(limits.empty());
    expect_relative(limits[0].load_factor, *problem.first_limit, kDefaultAccuracy + problem.digits,
                    "first limit");
  }
}

/// A column on a base that only pushes can always leave it: whatever K, the load stays at Euler's while this
/// one does, P (1 - P / EA) = pi^2 EI / L^2 (39.49401 with EA = 1e5; thesis.md 4.3.3, which calls the plateau
/// a limit point; the published path stepped over it). Koiter: it rises by (w pi / L)^2 / 8 of itself, 1e-5
/// at w = 0.015.
TEST(BenchmarkPaths, OneSidedColumnsLeaveTheirBaseAtEulersLoad) {
  for (const double K : {10.0, 50.0, 75.0, 500.0, 1000.0}) {
    const ReferenceProblem problem = one_sided_column(K);
    const Result result = solve_soundly(problem.model, problem.analysis);
    const Branch& path = result.branches[0];
    int on_plateau = 0;
    for (std::size_t i = 0; i < path.load_factor.size(); ++i) {
      const double w = std::abs(path.monitors[0].values[i]);
      if (w < 2e-4 || w > 0.015) continue;
      expect_relative(path.load_factor[i], 39.49401, 2e-5, problem.name);
      EXPECT_EQ(path.contact_fraction[0].values[i], 0.0);
      ++on_plateau;
    }
    EXPECT_GE(on_plateau, 2) << problem.name;
  }
}

/// Crooked columns of the thesis' figure 4.14, followed far beyond their bifurcation to a deflection of a
/// tenth of their length by bounded steps, as the example asks for: within the thousand that a path has by
/// default. (A load weighed anew on the way shortens such steps.) (K L^4 / (pi^4 EI) = 16.0:
/// the lowest load 2 sqrt(K EI) = 78.99 is that of n = 2, and n = 4 has n^2 + 16 / n^2 = 17 times
/// Euler's 9.8696.)
TEST(BenchmarkPaths, CrookedColumnsAreFollowedFarWithinTheDefaultSteps) {
  for (const int waves : {1, 2, 3, 4}) {
    Model model = straight(10.0, 100.0, 1e9, "xy", "y");
    model.foundations = {winkler("m", 15.6)};
    model.loads = {force_at(at_node("b"), -1.0, 0.0)};
    SineImperfection sine;
    sine.member = "m";
    sine.half_waves = waves;
    sine.amplitude = 1e-4;
    model.imperfections = {sine};
    model.monitors = {{"crest", at_member("m", 0.5 / waves), Component::y}};
    Analysis analysis = analysis_of(AnalysisType::path, {});
    analysis.discretization.accuracy = 1e-5;
    analysis.step.max = 1.0;
    analysis.stop.monitor = MonitorRange{"crest", {-1.0, 1.0}};
    const Result result = solve_soundly(model, analysis);
    EXPECT_EQ(result.summary.termination, "monitor") << waves << " half-waves: " << result.summary.message;
  }
}

/// Corrections a step, over the problems whose slenderness can be chosen.
class Corrections : public ::testing::TestWithParam<double> {};

int percentile(const std::array<int, 32>& histogram, double share) {
  int all = 0;
  for (const int count : histogram) all += count;
  int sum = 0;
  for (std::size_t i = 0; i < histogram.size(); ++i) {
    sum += histogram[i];
    if (sum >= share * all) return static_cast<int>(i);
  }
  return static_cast<int>(histogram.size());
}

TEST_P(Corrections, AreFewWhateverTheSlenderness) {
  const double slenderness = GetParam();
  std::vector<ReferenceProblem> problems;
  for (const double k : {0.0, 1e5, 1e7, 1e9, 1e11})
    problems.push_back(shallow_arch(k, Side::left, {}, slenderness));
  for (const double k : {1e4, 2.5e4}) problems.push_back(shallow_arch(k, Side::right, {}, slenderness));
  for (const double k : {0.0, 1e2, 1e4, 1e6})
    for (const double degrees : {215.0, 235.0}) problems.push_back(deep_arch(degrees, k, 0.0, slenderness));
  for (const double k : {300.0, 1200.0, 1e4, 1.8e5, 1e7, 1e9})
    problems.push_back(ring_in_medium(k, {}, 0.0, slenderness));
  problems.push_back(lee_frame_path({}, slenderness));
  for (const double K : {10.0, 1000.0}) problems.push_back(one_sided_column(K, slenderness));
  std::array<int, 32> histogram{};
  for (ReferenceProblem& problem : problems) {
    // at EA L^2 / EI = 1e3 an arch this shallow has no limit point at all: the load bounds the path
    problem.analysis.stop.load_factor = std::array{-1e3, 1e3};
    const Result result = solve_soundly(problem.model, problem.analysis);
    for (std::size_t i = 0; i < histogram.size(); ++i) histogram[i] += result.diagnostics.corrections[i];
  }
  const int median = percentile(histogram, 0.5);
  const int p95 = percentile(histogram, 0.95);
  int steps = 0;
  for (const int count : histogram) steps += count;
  record_figure("steps", steps);
  record_figure("corrections", "median ", median, ", 95 % ", p95, ", most ", percentile(histogram, 1.0));
  EXPECT_LE(median, 4);
  EXPECT_LE(p95, 7);
}

INSTANTIATE_TEST_SUITE_P(Slenderness, Corrections,
                         ::testing::Values(1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10));

}  // namespace
}  // namespace snapthrough
