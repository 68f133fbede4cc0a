/// Rigid obstacles, and media whose surface is fixed in the plane.
///
/// Sources. Half a ring under its weight in a circular cavity: limit points by collocation of the free
/// boundary problem (data/thesis_4_5_ring_winkler.csv describes the problem; the values for a medium with a
/// true circular surface and for a rigid cavity were computed with the same program).
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "tests/solver/structures.h"
#include "tests/verification/cases.h"

namespace snapthrough {
namespace {

using namespace testing;

constexpr double kRigid = std::numeric_limits<double>::infinity();

Model ring_in_cavity(double k) {
  Model model = half_ring_in_medium(k, 36e6);
  model.foundations[0].outline = CircleOutline{{0.0, 0.0}, 10.0, false};
  return model;
}

Result critical_to(const Model& model, double accuracy) {
  return solve_soundly(model, analysis_of(AnalysisType::critical, accurate(accuracy)));
}

TEST(RingInACavity, LosesStabilityAtTheLoadsOfCollocation) {
  for (const auto& [k, expected] : {std::pair{1200.0, 14.126938}, {1e6, 77.645944}, {1e8, 81.504968}}) {
    const Result result = critical_to(ring_in_cavity(k), 1e-6);
    ASSERT_TRUE(result.summary.critical_load_factor) << k << ": " << result.summary.message;
    expect_relative(*result.summary.critical_load_factor, expected, 1e-6, "k " + std::to_string(k));
  }
}

TEST(RingInACavity, ReachesTheLoadOfARigidCavity) {
  for (const double accuracy : {1e-3, 1e-4, 1e-5}) {
    const Result result = critical_to(ring_in_cavity(kRigid), accuracy);
    ASSERT_TRUE(result.summary.critical_load_factor) << accuracy << ": " << result.summary.message;
    ASSERT_TRUE(result.summary.error_estimate) << accuracy;
    EXPECT_LE(*result.summary.error_estimate, accuracy);
    expect_relative(*result.summary.critical_load_factor, 81.5574276, *result.summary.error_estimate,
                    "rigid");
  }
}

/// Half of a ring, R = EI = 1, D/t = 50, in a rigid host that a small force at the crown lifts it off; the
/// limit load on a host of 1e12 EI/R^4, on 741 elements that resolve the contact, is 35.0768836
/// (docs/decisions/0017), and hosts that are stiffer still change it by less than 1e-6.
TEST(EncasedRing, InARigidHostIsThatInTheStiffestOne) {
  constexpr double kEA = 3.0 * 50.0 * 50.0;
  Model model;
  model.nodes = {{"bottom", 0.0, -1.0}, {"crown", 0.0, 1.0}};
  model.sections = {{"s", kEA, 1.0, {}}};
  model.members = {{"ring", "bottom", "crown", "s", ArcCurve{180.0}, false, false}};
  model.supports = {support("bottom", "xr"), support("crown", "xr")};
  model.foundations = {one_sided("ring", kRigid, Side::right)};
  PointLoad lift = force_at(at_node("crown"), 0.0, -1e-3 * std::pow(kEA, 0.4) / 30.0);
  lift.pattern = Pattern::constant;
  model.loads = {PressureLoad{"ring", 1.0, Side::right, Pattern::proportional}, lift};
  for (const double accuracy : {1e-3, 1e-4}) {
    const Result result = solve_soundly(model, path_on(accurate(accuracy), 1));
    const auto limits = limits_of(result);
    ASSERT_EQ(limits.size(), 1u) << accuracy;
    ASSERT_TRUE(limits[0].error_estimate) << accuracy;
    EXPECT_LE(*limits[0].error_estimate, accuracy);
    expect_relative(limits[0].load_factor, 35.0768836, *limits[0].error_estimate + 1e-6, "rigid host");
  }
}

/// Half of a liner that stands 1/3000 of its radius off a rigid round host: reactions have the rounding of
/// coordinates, which exceeds that of displacements by 3000. Meshes agree within their estimates.
TEST(LinerWithASmallGap, HasOneLimitLoadOnAllMeshes) {
  constexpr double kRadius = 0.3;
  Model model;
  model.nodes = {{"invert", 0.0, -kRadius}, {"crown", 0.0, kRadius}};
  model.sections = {{"wall", 5683.516483516483, 0.01705054945054945, {}}};
  model.members = {{"liner", "invert", "crown", "wall", ArcCurve{180.0}, false, false}};
  model.supports = {support("invert", "xr"), support("crown", "xr")};
  model.foundations = {one_sided("liner", kRigid, Side::right)};
  model.foundations[0].outline = CircleOutline{{0.0, 0.0}, kRadius + 1e-4, false};
  PointLoad lift = force_at(at_node("crown"), 0.0, -3.9e-4);
  lift.pattern = Pattern::constant;
  model.loads = {PressureLoad{"liner", 1.0, Side::right, Pattern::proportional}, lift};
  std::vector<CriticalPoint> found;
  for (const double accuracy : {1e-2, 1e-3, 1e-4}) {
    const auto limits = limits_of(solve_soundly(model, path_on(accurate(accuracy), 1)));
    ASSERT_EQ(limits.size(), 1u) << accuracy;
    ASSERT_TRUE(limits[0].error_estimate) << accuracy;
    found.push_back(limits[0]);
  }
  for (const CriticalPoint& one : found)
    expect_relative(one.load_factor, found.back().load_factor,
                    *one.error_estimate + *found.back().error_estimate, "limit load");
}

/// A cantilever of length 2 whose tip meets a stop 0.1 below it: the stop takes what the beam does not carry
/// at that deflection, R = P - 3 EI gap / L^3. A stop gives way by 1e-8 of the beam.
TEST(Stop, TakesTheForceThatABeamDoesNotCarry) {
  Model model = straight(2.0, 5.0, 1e6, "xyr", "");
  Spring stop;
  stop.id = "stop";
  stop.at = at_node("b");
  stop.direction = {0.0, -1.0};
  stop.stiffness = kRigid;
  stop.reaction = Reaction::compression_only;
  stop.gap = 0.1;
  model.springs = {stop};
  model.loads = {force_at(at_node("b"), 0.0, -1.0)};
  const Result result = solve_soundly(model, static_on(fixed_mesh(4, 4), Geometry::linear, {0.1, 1.0}));
  ASSERT_EQ(result.states.size(), 2u);
  EXPECT_FALSE(result.states[0].springs[0].closed);
  EXPECT_TRUE(result.states[1].springs[0].closed);
  expect_relative(result.states[1].springs[0].force, 1.0 - 3.0 * 5.0 * 0.1 / 8.0, 1e-7, "force");
  expect_relative(result.states[1].springs[0].displacement, 0.1, 1e-7, "displacement");
}

/// A foundation without stiffness is reported with the beam's displacement and no reaction.
TEST(AbsentFoundation, HasFiniteResults) {
  Model model = straight(1.0, 1.0, 1e6, "xyr", "yr");
  model.foundations = {one_sided("m", 0.0, Side::right)};
  model.loads = {DistributedLoad{"m", {0.0, -1.0}, {0.0, 1.0}, LoadMeasure::length, Pattern::proportional}};
  const Result result = solve_soundly(model, static_on(fixed_mesh(4, 4), Geometry::linear, {1.0}));
  const FoundationState& state = result.states.at(0).foundations.at(0);
  for (std::size_t i = 0; i < state.s.size(); ++i) {
    EXPECT_EQ(state.reaction[i], 0.0);
    EXPECT_TRUE(std::isfinite(state.displacement[i])) << state.s[i];
  }
}

/// A heavy beam over a rigid floor whose distance grows along it lies on the floor where the gap is small:
/// the resultant of the floor and the supports carry the weight, and no point is below the floor by more than
/// the pressure over the stiffness that the element resolves.
TEST(RigidFloor, CarriesABeamWhereItsGapIsSmall) {
  Model model = straight(1.0, 1.0, 1e6, "xyr", "yr");
  Foundation floor = one_sided("m", kRigid, Side::right);
  floor.gap_along = {{0.0, 0.0}, {0.5, 1e-4}, {1.0, 0.0}};
  model.foundations = {floor};
  model.loads = {DistributedLoad{"m", {0.0, -1.0}, {0.0, 1.0}, LoadMeasure::length, Pattern::proportional}};
  const Result result = solve_soundly(model, static_on(accurate(1e-3), Geometry::linear, {1.0}));
  ASSERT_EQ(result.states.size(), 1u);
  const FoundationState& state = result.states[0].foundations[0];
  EXPECT_GT(state.contact.size(), 0u);
  const MemberState& member = member_of(result.states[0], "m");
  for (std::size_t i = 0; i < member.s.size(); ++i) {
    const double gap = 2e-4 * std::min(member.s[i], 1.0 - member.s[i]);
    EXPECT_GE(member.v[i], -gap - 1e-6) << member.s[i];
  }
}

}  // namespace
}  // namespace snapthrough
