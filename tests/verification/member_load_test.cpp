/// Loads of members: varying along them, in their axes, by weight and by temperature.
///
/// Closed forms of beam theory with small displacements; the elements' order exceeds that of the moment, so
/// that the tolerance is 1e-10 of the largest value of each kind.
#include "tests/verification/balance.h"
#include "tests/verification/cases.h"

namespace snapthrough {
namespace {

using namespace testing;

constexpr double kTolerance = 1e-10;

Model beam(double length, const std::string& start, const std::string& end) {
  return straight(length, 50.0, 1e5, start, end);
}

DistributedLoad triangle(double peak) {
  DistributedLoad load;
  load.member = "m";
  load.force_along = {{0.0, {0.0, 0.0}}, {1.0, {0.0, peak}}};
  return load;
}

State linear(const Model& model, const Discretization& mesh) {
  Analysis analysis = static_on(mesh, Geometry::linear);
  analysis.output.points_per_member = 21;
  return solve_soundly(model, analysis).states.at(0);
}

/// A load that grows from 0 to q = 2 over a beam with L = 3: reactions q L / 6 and q L / 3, M = q L^2 x (1 -
/// x^2) / 6 at the fraction x.
void expect_triangle(const State& state) {
  EXPECT_NEAR(state.supports[0].fy, 1.0, kTolerance);
  EXPECT_NEAR(state.supports[1].fy, 2.0, kTolerance);
  const MemberState& m = state.members[0];
  for (std::size_t i = 0; i < m.s.size(); ++i) {
    const double x = m.s[i] / 3.0;
    EXPECT_NEAR(m.bending_moment[i], 3.0 * x * (1.0 - x * x), kTolerance) << x;
  }
}

/// Q = dM / dx.
TEST(LoadAlongAMember, TriangleHasAThirdAndTwoThirdsOfItAtTheEnds) {
  Model model = beam(3.0, "xy", "y");
  model.loads = {triangle(-2.0)};
  for (const Discretization& mesh : {fixed_mesh(1, 4), fixed_mesh(5, 5), accurate(1e-6)}) {
    const State state = linear(model, mesh);
    expect_triangle(state);
    const MemberState& m = state.members[0];
    for (std::size_t i = 0; i < m.s.size(); ++i) {
      const double x = m.s[i] / 3.0;
      EXPECT_NEAR(std::abs(m.shear_force[i]), std::abs(1.0 - 3.0 * x * x), 10.0 * kTolerance) << x;
    }
  }
}

/// Trapezoid over a range whose kinks are no element ends: a tent of height 1 from 0.2 to 0.7, peak at 0.3.
TEST(LoadAlongAMember, KinksInsideElementsLoseNoLoad) {
  Model model = beam(10.0, "xy", "y");
  DistributedLoad load;
  load.member = "m";
  load.range = {0.2, 0.7};
  load.force_along = {{0.2, {0.0, 0.0}}, {0.3, {0.0, -1.0}}, {0.7, {0.0, 0.0}}};
  model.loads = {load};
  const State state = linear(model, fixed_mesh(1, 3));
  const double total = 2.5;
  const double centre = (0.5 * (2.0 + 2.0 / 3.0) + 2.0 * (3.0 + 4.0 / 3.0)) / total;
  EXPECT_NEAR(state.supports[1].fy, total * centre / 10.0, kTolerance);
  EXPECT_NEAR(state.supports[0].fy, total * (1.0 - centre / 10.0), kTolerance);
}

/// An inclined beam under a load across it carries the moment of a horizontal one, and no axial force.
TEST(LoadInMemberAxes, ActsAcrossAnInclinedMember) {
  Model model = beam(5.0, "xy", "");
  model.nodes[1] = {"b", 3.0, 4.0};
  model.supports.push_back(support("b", "y", std::atan2(4.0, 3.0) * 180.0 / kPi));
  DistributedLoad load;
  load.member = "m";
  load.axes = LoadAxes::member;
  load.force = {0.0, -2.0};
  model.loads = {load};
  const MemberState m = linear(model, fixed_mesh(2, 4)).members[0];
  for (std::size_t i = 0; i < m.s.size(); ++i) {
    EXPECT_NEAR(m.bending_moment[i], m.s[i] * (5.0 - m.s[i]), 10.0 * kTolerance) << i;
    EXPECT_NEAR(m.axial_force[i], 0.0, 10.0 * kTolerance) << i;
  }
}

/// A half circle of radius R under a dead load q along its initial right normal: thrust q R, no bending at
/// the rollers' directions; small displacements.
TEST(LoadInMemberAxes, AcrossAHalfCircleIsCarriedByThrust) {
  Model model = beam(2.0, "", "");
  model.sections[0].EA = 1e9;
  model.nodes = {{"a", -1.0, 0.0}, {"b", 1.0, 0.0}};
  model.members[0].curve = ArcCurve{-180.0};
  model.supports = {support("a", "yr"), support("b", "yr")};
  model.springs = {{"hold", at_member("m", 0.5), std::array{1.0, 0.0}, 1.0, Reaction::bilateral, 0.0}};
  DistributedLoad load;
  load.member = "m";
  load.axes = LoadAxes::member;
  load.force = {0.0, -3.0};
  model.loads = {load};
  const MemberState m = linear(model, fixed_mesh(8, 7)).members[0];
  for (std::size_t i = 0; i < m.s.size(); ++i) {
    EXPECT_NEAR(m.axial_force[i], -3.0, 1e-6) << i;
    EXPECT_NEAR(m.bending_moment[i], 0.0, 1e-6) << i;
  }
}

/// Curvature from 0 at the clamp to k at the tip: the tip moves by int (L - s) k s / L ds = k L^2 / 6.
TEST(StrainAlongAMember, CurvatureThatGrowsMovesTheTipByASixth) {
  Model model = beam(4.0, "xyr", "");
  InitialStrain strain;
  strain.member = "m";
  strain.curvature_along = {{0.0, 0.0}, {1.0, 1e-3}};
  strain.axial_along = {{0.0, 2e-4}, {0.5, 0.0}};
  model.loads = {strain};
  const MemberState m = linear(model, fixed_mesh(2, 4)).members[0];
  EXPECT_NEAR(m.v.back(), 1e-3 * 16.0 / 6.0, 1e-13);
  EXPECT_NEAR(m.rotation.back(), 1e-3 * 2.0, 1e-13);
  EXPECT_NEAR(m.u.back(), 2e-4, 1e-13);  // 0.5 * 2e-4 * half of the length
}

Model heated(const std::string& start, const std::string& end) {
  Model model = beam(4.0, start, end);
  model.sections[0].expansion = 1.2e-5;
  TemperatureLoad load;
  load.member = "m";
  load.change = 30.0;
  load.gradient = 50.0;
  model.loads = {load};
  return model;
}

/// Free: u = a T L, v = -a g L^2 / 2 (left side warmer). Clamped: N = -EA a T, M = EI a g, straight.
TEST(Temperature, LengthensAndBendsAFreeMemberAndStrainsAClampedOne) {
  const MemberState free = linear(heated("xyr", ""), fixed_mesh(2, 3)).members[0];
  EXPECT_NEAR(free.u.back(), 1.2e-5 * 30.0 * 4.0, 1e-13);
  EXPECT_NEAR(free.v.back(), -1.2e-5 * 50.0 * 8.0, 1e-13);
  const MemberState clamped = linear(heated("xyr", "xyr"), fixed_mesh(2, 3)).members[0];
  for (std::size_t i = 0; i < clamped.s.size(); ++i) {
    EXPECT_NEAR(clamped.axial_force[i], -1e5 * 1.2e-5 * 30.0, kTolerance * 36.0);
    EXPECT_NEAR(clamped.bending_moment[i], 50.0 * 1.2e-5 * 50.0, kTolerance);
    EXPECT_NEAR(clamped.v[i], 0.0, 1e-14);
  }
}

/// The heated pinned column of the differential equation (no mesh): T = pi^2 I / (A a L^2).
TEST(Temperature, BucklesAHeldColumn) {
  Model model = heated("xy", "xy");
  std::get<TemperatureLoad>(model.loads[0]) = {"m", 1.0, 0.0, Pattern::proportional, {}, {}};
  const double expected = kPi * kPi * 50.0 / (16.0 * 1e5 * 1.2e-5);
  for (const Discretization& mesh : {accurate(1e-9), fixed_mesh(8, 6)})
    expect_relative(*solve_soundly(model, buckling_on(mesh)).summary.critical_load_factor, expected, 1e-9,
                    "change of temperature");
}

Model hanging() {
  Model model = beam(2.0, "xyr", "");
  model.nodes[1] = {"b", 0.0, -2.0};
  model.sections[0].mass = 3.0;
  model.loads = {SelfWeight{{0.0, -10.0}, Pattern::proportional}};
  return model;
}

/// N = m g (L - s); the tip sinks by m g L^2 / (2 EA).
TEST(SelfWeight, HangsOnItsSupport) {
  const State state = linear(hanging(), fixed_mesh(2, 3));
  EXPECT_NEAR(state.supports[0].fy, 60.0, 60.0 * kTolerance);
  const MemberState& m = state.members[0];
  for (std::size_t i = 0; i < m.s.size(); ++i) EXPECT_NEAR(m.axial_force[i], 30.0 * (2.0 - m.s[i]), 1e-9);
  EXPECT_NEAR(m.v.back(), -30.0 * 4.0 / 2e5, 1e-13);
}

/// Greenhill: q L^3 / EI = 9/4 j^2, j = 1.866350858873893 the first zero of the Bessel function J_-1/3.
TEST(SelfWeight, BucklesAStandingColumnAtGreenhillsLoad) {
  Model model = hanging();
  model.nodes[1] = {"b", 0.0, 2.0};
  model.sections[0].EA = 1e9;
  const double zero = 1.866350858873893;
  const double expected = 2.25 * zero * zero * 50.0 / 8.0 / 30.0;
  for (const Discretization& mesh : {accurate(1e-8), fixed_mesh(8, 6)})
    expect_relative(*solve_soundly(model, buckling_on(mesh)).summary.critical_load_factor, expected, 1e-8,
                    "gravity over 10");
}

/// Two members of different mass: each reaction carries the half of its own neighbours.
TEST(SelfWeight, ActsOnEveryMemberByItsMass) {
  Model model = beam(4.0, "xy", "y");
  model.nodes.push_back({"c", 10.0, 0.0});
  model.sections.push_back({"t", 1e5, 50.0, {}, 1.0, {}});
  model.sections[0].mass = 2.0;
  model.members.push_back({"n", "b", "c", "t", LineCurve{}, true, false});
  model.supports.push_back(support("c", "y"));
  model.loads = {SelfWeight{{0.0, -1.0}, Pattern::constant}};
  const State state = linear(model, fixed_mesh(4, 4));
  EXPECT_NEAR(state.supports[0].fy, 4.0, kTolerance);
  EXPECT_NEAR(state.supports[1].fy, 7.0, kTolerance);
  EXPECT_NEAR(state.supports[2].fy, 3.0, kTolerance);
}

/// Large displacements of a sagging pair of members: members and nodes balance, and the resultant of the
/// loads is that of their integrals.
TEST(MemberLoads, BalanceUnderLargeDisplacements) {
  Model model = beam(4.0, "xy", "");
  model.nodes = {{"a", 0.0, 0.0}, {"b", 4.0, -1.0}, {"c", 7.0, 0.0}};
  model.sections[0].EI = 2.0;
  model.sections[0].mass = 0.2;
  model.sections[0].expansion = 1e-3;
  model.members[0].curve = ArcCurve{50.0};
  model.members.push_back({"n", "b", "c", "s", ParabolaCurve{-0.4, std::array{0.3, 1.0}}, true, false});
  model.members[1].release_start_stiffness = 0.5;
  model.supports.push_back(support("c", "xyr"));
  DistributedLoad varying;
  varying.member = "m";
  varying.axes = LoadAxes::member;
  varying.range = {0.25, 1.0};
  varying.force_along = {{0.25, {1.0, -1.0}}, {0.5, {0.0, -6.0}}, {1.0, {-1.0, 0.0}}};
  DistributedLoad measured = varying;
  measured.member = "n";
  measured.range = {0.0, 1.0};
  measured.axes = LoadAxes::global;
  measured.per = LoadMeasure::horizontal;
  TemperatureLoad heat;
  heat.member = "n";
  heat.change = 10.0;
  heat.gradient_along = {{0.0, 0.0}, {0.5, 30.0}};
  model.loads = {varying, measured, heat, SelfWeight{{1.0, -10.0}, Pattern::constant}};
  const Discretization mesh = fixed_mesh(8, 7);
  for (const Geometry geometry : {Geometry::linear, Geometry::nonlinear}) {
    Analysis analysis = static_on(mesh, geometry, {1.0, 2.0});
    analysis.output.points_per_member = output_points(mesh);
    const Result result = solve_soundly(model, analysis);
    ASSERT_EQ(result.states.size(), 2u);
    double moved = 0.0;
    for (const State& state : result.states) {
      expect_balance(model, mesh, state, 1e-8, geometry);
      for (const double v : state.members[0].v) moved = std::max(moved, std::abs(v));
    }
    EXPECT_GT(moved, 0.1);
  }
}

/// With small displacements a pressure that varies is the load of a triangle.
TEST(PressureAlongAMember, OfATriangleHasItsReactions) {
  Model model = beam(3.0, "xy", "y");
  PressureLoad load;
  load.member = "m";
  load.value_along = {{0.0, 0.0}, {1.0, 2.0}};
  model.loads = {load};
  for (const Discretization& mesh : {fixed_mesh(1, 4), fixed_mesh(5, 5)}) {
    expect_triangle(linear(model, mesh));
  }
}

/// Clamped arch of `members` arcs under a pressure from 0.5 to 1.5 of a unit from left to right.
Model pressed_arch(int members, bool varying) {
  Model model;
  model.sections = {{"s", 1e5, 10.0, {}}};
  const double half = kPi / 3.0;
  for (int i = 0; i <= members; ++i) {
    const double angle = half - 2.0 * half * i / members;  // from the vertical, left positive
    model.nodes.push_back({"n" + std::to_string(i), -std::sin(angle), std::cos(angle)});
  }
  for (int i = 0; i < members; ++i) {
    const std::string id = "m" + std::to_string(i);
    model.members.push_back({id, "n" + std::to_string(i), "n" + std::to_string(i + 1), "s",
                             ArcCurve{-120.0 / members}, false, false});
    PressureLoad load;
    load.member = id;
    const double from = 0.5 + static_cast<double>(i) / members;
    const double to = 0.5 + (i + 1.0) / members;
    load.value = 0.5 * (from + to);
    if (varying) load.value_along = {{0.0, from}, {1.0, to}};
    model.loads.emplace_back(load);
  }
  model.supports = {support("n0", "xyr"), support("n" + std::to_string(members), "xyr")};
  return model;
}

/// The critical load is the limit of arches whose pressure is constant on each of many members. Their error,
/// 4e-5 with 8 members, is of fourth order in the members' length.
TEST(PressureAlongAMember, HasTheCriticalLoadOfManySteps) {
  const auto load = [](const Model& model, int elements) {
    return *solve_soundly(model, analysis_of(AnalysisType::critical, fixed_mesh(elements, 5)))
                .summary.critical_load_factor;
  };
  const double whole = load(pressed_arch(1, true), 8);
  const double coarse = load(pressed_arch(16, false), 1);
  const double fine = load(pressed_arch(32, false), 1);
  expect_relative((16.0 * fine - coarse) / 15.0, whole, 2e-8, "extrapolated");
  EXPECT_GT(std::abs(coarse - whole), 1e-6 * whole) << "the steps do not matter";
  expect_relative(load(pressed_arch(4, true), 2), whole, 1e-7, "in four members");
}

/// Large displacements: members and nodes balance, and Newton's method converges.
TEST(PressureAlongAMember, BalancesUnderLargeDisplacements) {
  Model model = beam(4.0, "xyr", "");
  PressureLoad load;
  load.member = "m";
  load.value_along = {{0.0, 2.0}, {0.5, 7.0}};
  load.side = Side::right;
  model.loads = {load};
  const Discretization mesh = fixed_mesh(8, 7);
  Analysis analysis = static_on(mesh, Geometry::nonlinear, {0.3, 1.0});
  analysis.output.points_per_member = output_points(mesh);
  const Result result = solve_soundly(model, analysis);
  ASSERT_EQ(result.states.size(), 2u);
  for (const State& state : result.states) expect_balance(model, mesh, state, 1e-9);
  EXPECT_GT(std::abs(result.states[1].members[0].rotation.back()), 0.3);
  // a third of them at places within steps, where divergence is looked for
  EXPECT_LT(result.diagnostics.iterations, 80);
}

/// Derivatives of a critical load by the mass and by the peak of a load agree with its differences.
TEST(MemberLoads, HaveSensitivities) {
  const auto arch = [](double mass, double peak) {
    Model model = beam(4.0, "xy", "xy");
    model.members[0].curve = ParabolaCurve{0.7, {}};
    model.sections[0].mass = mass;
    DistributedLoad load = triangle(peak);
    model.loads = {load, SelfWeight{{0.0, -1.0}, Pattern::constant}};
    return model;
  };
  Analysis analysis = analysis_of(AnalysisType::critical, fixed_mesh(8, 5));
  Variation by_mass;
  by_mass.pointer = "mass";
  by_mass.value = by_mass.size = 3.0;
  by_mass.model_at = [&](double mass) { return std::optional(arch(mass, -1.0)); };
  Variation by_peak;
  by_peak.pointer = "peak";
  by_peak.value = -1.0;
  by_peak.size = 1.0;
  by_peak.model_at = [&](double peak) { return std::optional(arch(3.0, peak)); };
  analysis.sensitivities = {by_mass, by_peak};
  const Result result = solve_soundly(arch(3.0, -1.0), analysis);
  ASSERT_EQ(result.critical_points.size(), 1u);
  const auto& sensitivities = result.critical_points[0].sensitivities;
  analysis.sensitivities.clear();
  const auto load = [&](double mass, double peak) {
    return *solve_soundly(arch(mass, peak), analysis).summary.critical_load_factor;
  };
  expect_relative(*sensitivities.at(0).derivative, (load(3.01, -1.0) - load(2.99, -1.0)) / 0.02, 1e-5,
                  "mass");
  // a load that is scaled alone scales its load factor
  expect_relative(*sensitivities.at(1).derivative, load(3.0, -1.0), 1e-7, "peak");
}

}  // namespace
}  // namespace snapthrough
