/// Loads without a potential beside what they do not act on, where members have no mass, after constant
/// actions, and on one-sided supports.
///
/// Sources: Beck (1952), flutter of a cantilever of uniform mass at P = 20.0509536 EI / L^2. Without mass but
/// at the tip, P = 20.1907286 EI / L^2, where tan k = k, P = k^2 EI / L^2: the freedoms without mass are
/// those of a column that is clamped and pinned at its tip. The symmetric part of Beck's column is not
/// positive from P = (3 pi / 2)^2 EI / L^2 = 22.2 on, and the column has no load at which it diverges.
#include <cstddef>
#include <string>
#include <vector>

#include "tests/verification/cases.h"

namespace snapthrough {
namespace {

using namespace testing;

constexpr double kBeck = 20.05095363;
constexpr double kClampedPinned = 20.19072856;

/// Adds an upright cantilever of length one at x, with nodes "a" and "b" and a member "m" followed by `id`.
void add_cantilever(double x, const std::string& id, double EI, double mass, Model& model) {
  model.nodes.insert(model.nodes.end(), {{"a" + id, x, 0.0}, {"b" + id, x, 1.0}});
  model.sections.push_back({"s" + id, 1e8 * EI, EI, {}});
  if (mass > 0.0) model.sections.back().mass = mass;
  model.members.push_back({"m" + id, "a" + id, "b" + id, "s" + id, LineCurve{}, false, false});
  model.supports.push_back(support("a" + id, "xyr"));
}

void add_following(const std::string& id, double force, Pattern pattern, Model& model) {
  PointLoad load = force_at(at_node("b" + id), 0.0, -force);
  load.follows = true;
  load.pattern = pattern;
  model.loads.emplace_back(load);
}

Model becks_column(double mass = 1.0) {
  Model model;
  add_cantilever(0.0, "0", 1.0, mass, model);
  add_following("0", 1.0, Pattern::proportional, model);
  return model;
}

Analysis critical(double accuracy) { return analysis_of(AnalysisType::critical, accurate(accuracy)); }

void expect_flutter(const Model& model, double load) {
  const Result result = solve(model, critical(1e-5));
  ASSERT_FALSE(result.failure) << result.failure->detail;
  EXPECT_EQ(result.summary.critical_type, CriticalType::flutter);
  expect_relative(result.summary.critical_load_factor.value_or(0.0), load, 1e-6, "load");
}

TEST(FollowingLoads, FlutterIsFoundBesideSoftMembersThatTheyDoNotReach) {
  for (const int soft : {1, 2, 12}) {
    Model model = becks_column();
    for (int i = 1; i <= soft; ++i)
      add_cantilever(2.0 * i, std::to_string(i), 1e-3 * (1.0 + 0.03 * i), 1.0, model);
    expect_flutter(model, kBeck);
  }
}

TEST(FollowingLoads, EqualColumnsFlutterAtOneLoad) {
  for (const int count : {3, 8}) {
    Model model = becks_column();
    for (int i = 1; i < count; ++i) {
      add_cantilever(2.0 * i, std::to_string(i), 1.0, 1.0, model);
      add_following(std::to_string(i), 1.0, Pattern::proportional, model);
    }
    expect_flutter(model, kBeck);
  }
}

TEST(FollowingLoads, FreedomsWithoutMassLoseTheirStability) {
  Model model = becks_column(0.0);
  model.masses = {{at_node("b0"), 1.0, 0.0}};
  const Result result = solve(model, critical(1e-6));
  ASSERT_FALSE(result.failure) << result.failure->detail;
  EXPECT_EQ(result.summary.critical_type, CriticalType::bifurcation);
  expect_relative(result.summary.critical_load_factor.value_or(0.0), kClampedPinned, 1e-6, "load");
  EXPECT_EQ(result.critical_points.back().cause, CriticalCause::massless);
  EXPECT_TRUE(result.critical_points.back().confirmed);
  // small masses along the member: flutter nearby is what replaces it
  Model heavy = becks_column(1e-3);
  heavy.masses = model.masses;
  const Result nearby = solve(heavy, critical(1e-4));
  EXPECT_EQ(nearby.summary.critical_type, CriticalType::flutter);
  expect_relative(nearby.summary.critical_load_factor.value_or(0.0), kClampedPinned, 0.02, "load");
}

TEST(FollowingLoads, ConstantOnesHandTheirStabilityOn) {
  const auto with_constant = [](double constant) {
    Model model = becks_column();
    add_following("0", constant, Pattern::constant, model);
    return model;
  };
  expect_flutter(with_constant(15.0), kBeck - 15.0);
  const Result result = solve(with_constant(21.0), critical(1e-4));
  EXPECT_EQ(result.summary.termination, "unstable_at_start");
  EXPECT_FALSE(result.summary.critical_load_factor);
  ASSERT_EQ(result.warnings.size(), 1U);
  EXPECT_EQ(result.warnings[0].code, "unstable");
  Analysis path = analysis_of(AnalysisType::path, accurate(1e-4));
  path.stop.load_factor = {{0.0, 40.0}};
  EXPECT_FALSE(solve(with_constant(21.0), path).summary.critical_load_factor);
  for (const double factor : {0.0, 1.0}) {
    const Result refused =
        solve(with_constant(21.0), static_on(accurate(1e-3), Geometry::nonlinear, {factor}));
    ASSERT_TRUE(refused.failure);
    EXPECT_EQ(refused.failure->code, "beyond_critical_point");
  }
}

TEST(FollowingLoads, AColumnHoldsBeyondWhatItsSymmetricPartHolds) {
  Model model = becks_column(0.0);
  add_following("0", 25.0, Pattern::constant, model);
  const Result result = solve(model, static_on(accurate(1e-3), Geometry::nonlinear));
  EXPECT_FALSE(result.failure) << result.failure->detail;
  EXPECT_EQ(result.static_table->negative_eigenvalues.at(0), 0);
}

/// A wall before soil under a pressure that its free end follows. Masses change no equilibrium.
TEST(FollowingLoads, OneSidedSupportsActFromTheFirstLoadOn) {
  Model model;
  model.nodes = {{"toe", 0.0, 0.0}, {"top", 0.0, 8.0}};
  model.sections = {{"s", 3e6, 1e4, {}}};
  model.members = {{"wall", "toe", "top", "s", LineCurve{}, false, false}};
  model.supports = {support("toe", "xyr")};
  model.foundations = {one_sided("wall", 200.0, Side::right)};
  model.loads = {PressureLoad{"wall", 2.0, Side::left}};
  const Analysis analysis = static_on(accurate(1e-4), Geometry::nonlinear, {0.0, 0.5, 1.0});
  const Result without = solve_soundly(model, analysis);
  model.sections[0].mass = 0.2;
  const Result with = solve_soundly(model, analysis);
  ASSERT_EQ(with.states.size(), 3U);
  for (std::size_t row = 0; row < 3; ++row)
    EXPECT_NEAR(member_of(with.states[row], "wall").u.back(), member_of(without.states[row], "wall").u.back(),
                1e-9);
  // the pressure over the stiffness of the soil, but for the clamped toe
  EXPECT_GT(member_of(with.states[2], "wall").u.back(), 2.0 / 200.0);
}

}  // namespace
}  // namespace snapthrough
