/// States that are asked for by load factor are equilibria, or they are refused.
#include <cmath>
#include <limits>
#include <string>

#include "tests/paths/reference_problems.h"
#include "tests/reaction_sum.h"

namespace snapthrough {
namespace {

using namespace testing;

constexpr double kRigid = std::numeric_limits<double>::infinity();
constexpr double kBalance = 1e-9;  ///< sum of actions and reactions over the largest; rounding leaves 1e-15

/// A beam of length `length` under a load of 1 by length, above a bed with a gap.
Model beam_over_bed(double length, double EI, double EA, const std::string& start, const std::string& end,
                    double stiffness, double gap) {
  Model model = straight(length, EI, EA, start, end);
  model.foundations = {one_sided("m", stiffness, Side::right)};
  model.foundations[0].gap = gap;
  model.loads = {DistributedLoad{"m", {0.0, -1.0}, {0.0, 1.0}, LoadMeasure::length, Pattern::proportional}};
  return model;
}

Analysis rows(const std::vector<double>& load_factors) {
  Analysis analysis = static_on({}, Geometry::nonlinear);
  analysis.load_factors = load_factors;
  analysis.output.states = StateOutput::all;
  return analysis;
}

void expect_balanced_rows(const Model& model, const Result& result, std::size_t count) {
  EXPECT_FALSE(result.failure) << result.failure->detail;
  ASSERT_EQ(result.states.size(), count);
  for (const State& state : result.states)
    EXPECT_LE(reaction_sum(model, state).imbalance(), kBalance) << state.load_factor;
}

/// The first step of the path passes both loads, and Newton's method fails at the first one.
TEST(BalancedRows, CantileverAboveARigidBed) {
  const Model model = beam_over_bed(4.0, 300.0, 1e6, "xyr", "", kRigid, 0.002);
  const Result both = solve(model, rows({1.0, 10.0}));
  expect_balanced_rows(model, both, 2);
  const Result alone = solve(model, rows({1.0}));
  expect_balanced_rows(model, alone, 1);
  ASSERT_TRUE(both.summary.error_estimate && alone.summary.error_estimate);
  const double reaction = alone.states[0].foundations[0].resultant.fy;
  EXPECT_NEAR(both.states[0].foundations[0].resultant.fy, reaction,
              (*both.summary.error_estimate + *alone.summary.error_estimate) * reaction);
  EXPECT_GT(alone.states[0].foundations[0].resultant.fy, 1.0);
}

/// Gaps that are small against everything else: the path begins at load factor zero all the same.
TEST(BalancedRows, SmallGapsAboveARigidBed) {
  for (const double gap : {1e-7, 1e-6, 1e-5, 3e-5, 1e-3, 2e-2}) {
    const Model model = beam_over_bed(6.0, 600.0, 4e5, "xy", "y", kRigid, gap);
    expect_balanced_rows(model, solve(model, rows({1.0})), 1);
    Analysis path = analysis_of(AnalysisType::path, {});
    path.stop.load_factor = std::array{-1.0, 1.0};
    const Result followed = solve(model, path);
    ASSERT_FALSE(followed.branches.empty()) << gap;
    EXPECT_EQ(followed.branches[0].load_factor.front(), 0.0) << gap;
  }
}

/// Soil that carries 80 under 300: the rest is not carried by what pins motions without stiffness.
TEST(BalancedRows, FootingBeyondItsCapacity) {
  Model model = straight(2.0, 1e9, 1e10, "x", "");
  model.foundations = {one_sided("m", 20000.0, Side::right)};
  model.foundations[0].law = ReactionLaw{};
  model.foundations[0].law->type = ReactionLaw::Type::tanh;
  model.foundations[0].law->stiffness = 20000.0;
  model.foundations[0].law->capacity = 40.0;
  model.loads = {DistributedLoad{"m", {0.0, -150.0}, {0.0, 1.0}, LoadMeasure::length, Pattern::proportional}};
  const Result beyond = solve(model, rows({1.0}));
  EXPECT_TRUE(beyond.failure);
  EXPECT_TRUE(beyond.states.empty());
  const Result within = solve(model, rows({0.2}));
  expect_balanced_rows(model, within, 1);
}

}  // namespace
}  // namespace snapthrough
