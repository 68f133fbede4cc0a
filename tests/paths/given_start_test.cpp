/// A path that begins with a state of another path goes along that path.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "solver/solve.h"
#include "tests/solver/structures.h"

namespace snapthrough {
namespace {

StartState start_of(const State& state) {
  StartState start;
  start.load_factor = state.load_factor;
  for (const MemberState& member : state.members)
    start.members.push_back({member.id, member.s, member.u, member.v, member.rotation, member.axial_force,
                             member.shear_force, member.bending_moment});
  return start;
}

/// The pinned arch under a point load at its crown, and its path with every state.
class GivenStart : public ::testing::Test {
 protected:
  GivenStart() {
    analysis_.type = AnalysisType::path;
    analysis_.stop.limit_points = 2;
    analysis_.output.states = StateOutput::all;
    whole_ = solve(model_, analysis_);
    analysis_.output.states = StateOutput::none;
  }

  /// A state of the path between its limit points.
  [[nodiscard]] const State& between() const {
    const double hi = limit(CriticalType::limit_max);
    const double lo = limit(CriticalType::limit_min);
    const State* out = &whole_.states.front();
    for (const State& state : whole_.states)
      if (state.load_factor > lo + 0.2 * (hi - lo) && state.load_factor < lo + 0.9 * (hi - lo)) out = &state;
    return *out;
  }
  [[nodiscard]] double limit(CriticalType type) const { return limit_of(whole_, type); }
  static double limit_of(const Result& result, CriticalType type) {
    for (const CriticalPoint& point : result.critical_points)
      if (point.type == type) return point.load_factor;
    return std::nan("");
  }

  Model model_ = testing::arch(60.0, 1e3, 1e3);
  Analysis analysis_;
  Result whole_;
};

TEST_F(GivenStart, LeadsToTheLimitPointsOnBothSides) {
  analysis_.start = start_of(between());
  analysis_.stop.limit_points = 1;
  for (const auto& [direction, type] :
       {std::pair{1.0, CriticalType::limit_max}, std::pair{-1.0, CriticalType::limit_min}}) {
    analysis_.step.direction = direction;
    const Result part = solve(model_, analysis_);
    ASSERT_FALSE(part.failure) << part.failure->detail;
    EXPECT_NEAR(part.branches.front().load_factor.front(), between().load_factor,
                1e-12 * std::abs(between().load_factor));
    // both paths' limits are confirmed to this accuracy
    EXPECT_NEAR(limit_of(part, type), limit(type), analysis_.discretization.accuracy * std::abs(limit(type)));
  }
}

TEST_F(GivenStart, IsRefusedForAnotherModel) {
  analysis_.start = start_of(between());
  model_.sections.front().EI *= 1.5;
  const Result other = solve(model_, analysis_);
  ASSERT_TRUE(other.failure);
  EXPECT_EQ(other.failure->code, "no_start");
  EXPECT_THAT(other.failure->detail, ::testing::HasSubstr("given state"));
}

}  // namespace
}  // namespace snapthrough
