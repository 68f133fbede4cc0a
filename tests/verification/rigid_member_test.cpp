/// Members of rigid sections against closed forms.
#include <limits>

#include "tests/findings.h"
#include "tests/verification/cases.h"

namespace snapthrough {
namespace {

using namespace testing;

constexpr double kRigid = std::numeric_limits<double>::infinity();

/// A hinged column: rigid pieces of length a at both ends of a flexible one of length b.
Model column_with_rigid_ends(double a, double b, double EI) {
  Model model;
  model.nodes = {{"foot", 0.0, 0.0}, {"low", 0.0, a}, {"high", 0.0, a + b}, {"head", 0.0, 2.0 * a + b}};
  model.sections = {{"rigid", kRigid, kRigid, {}}, {"flexible", kRigid, EI, {}}};
  model.members = {{"first", "foot", "low", "rigid", LineCurve{}},
                   {"middle", "low", "high", "flexible", LineCurve{}},
                   {"last", "high", "head", "rigid", LineCurve{}}};
  model.supports = {support("foot", "xy"), support("head", "x")};
  model.loads = {force_at(at_node("head"), 0.0, -1.0)};
  return model;
}

/// With k^2 = P / EI the symmetric mode has k a tan(k b / 2) = 1.
TEST(RigidMember, BucklingLoadOfAColumnWithRigidEnds) {
  for (const double a : {0.1, 1.0, 10.0}) {
    constexpr double b = 2.0;
    constexpr double EI = 3.0;
    double lo = 0.0;
    double hi = kPi / b;
    for (int i = 0; i < 100; ++i) {
      const double k = 0.5 * (lo + hi);
      (k * a * std::tan(0.5 * k * b) < 1.0 ? lo : hi) = k;
    }
    const Model model = column_with_rigid_ends(a, b, EI);
    const Result linear = solve_soundly(model, buckling_on(accurate(1e-10)));
    ASSERT_TRUE(linear.summary.critical_load_factor) << a;
    expect_relative(*linear.summary.critical_load_factor, EI * lo * lo, 1e-9, "linearised");
    const Result path = solve_soundly(model, analysis_of(AnalysisType::critical, accurate(1e-10)));
    ASSERT_TRUE(path.summary.critical_load_factor) << a;
    expect_relative(*path.summary.critical_load_factor, EI * lo * lo, 1e-9, "path");
  }
}

/// A flexible cantilever of length L with a rigid arm of length c, which is turned by a right angle: the
/// force P at the arm's end, along the cantilever, bends it by the moment P c.
TEST(RigidMember, ForcesOfARigidArm) {
  constexpr double L = 2.0;
  constexpr double c = 0.7;
  constexpr double EI = 5.0;
  constexpr double P = 0.3;
  Model model;
  model.nodes = {{"a", 0.0, 0.0}, {"b", L, 0.0}, {"c", L, c}};
  model.sections = {{"flexible", 1e3, EI, {}}, {"rigid", kRigid, kRigid, {}}};
  model.members = {{"beam", "a", "b", "flexible", LineCurve{}}, {"arm", "b", "c", "rigid", LineCurve{}}};
  model.supports = {support("a", "xyr")};
  model.loads = {force_at(at_node("c"), P, 0.0)};
  const Result result = solve_soundly(model, static_on(fixed_mesh(1, 5), Geometry::linear));
  const State& state = result.states.at(0);
  const MemberState& beam = member_of(state, "beam");
  const MemberState& arm = member_of(state, "arm");
  EXPECT_NEAR(beam.rotation.back(), -P * c * L / EI, 1e-13);
  EXPECT_NEAR(beam.v.back(), -P * c * L * L / (2.0 * EI), 1e-13);
  EXPECT_NEAR(beam.axial_force.front(), P, 1e-13);
  EXPECT_NEAR(std::abs(arm.bending_moment.front()), P * c, 1e-13);
  EXPECT_NEAR(arm.bending_moment.back(), 0.0, 1e-13);
  EXPECT_NEAR(arm.rotation.back(), beam.rotation.back(), 1e-14);
  EXPECT_NEAR(arm.u.back(), P * L / 1e3 + c * P * c * L / EI, 1e-13);
}

TEST(RigidMember, SomethingMustBend) {
  Model model = column_with_rigid_ends(1.0, 1.0, kRigid);
  const auto findings = check(model, buckling_on(accurate(1e-3)));
  EXPECT_THAT(findings, ::testing::Contains(is_finding("/model/members", "empty")));
}

/// A rigid mast of height h on a hinge between two guys of the force T: with l'(0) = a h / l it leans at
/// P = 2 l'^2 (EA / l - T / l) / h, although no member bends.
TEST(RigidMember, GuysAloneGiveWay) {
  constexpr double h = 4.0;
  constexpr double a = 3.0;
  constexpr double EA = 200.0;
  constexpr double T = 3.0;
  const double l = std::hypot(a, h);
  Model model;
  model.nodes = {{"foot", 0.0, 0.0}, {"head", 0.0, h}, {"left", -a, 0.0}, {"right", a, 0.0}};
  model.sections = {{"mast", kRigid, kRigid, {}}, {"guy", EA, 1.0, {}}};
  model.members = {{"mast", "foot", "head", "mast", LineCurve{}}};
  for (const char* foot : {"left", "right"}) {
    Member guy{foot, "head", foot, "guy", LineCurve{}};
    guy.reaction = Reaction::tension_only;
    guy.pretension.emplace();
    guy.pretension->force = T;
    model.members.push_back(guy);
    model.supports.push_back(support(foot, "xy"));
  }
  model.supports.push_back(support("foot", "xy"));
  model.loads = {force_at(at_node("head"), 0.0, -1.0)};
  const double rate = a * h / l;
  const Result result = solve_soundly(model, analysis_of(AnalysisType::critical, accurate(1e-9)));
  ASSERT_TRUE(result.summary.critical_load_factor);
  expect_relative(*result.summary.critical_load_factor, 2.0 * rate * rate * (EA - T) / (l * h), 1e-8, "path");
}

TEST(RigidMember, ARigidObstacleNeedsAMemberThatBends) {
  Model model = column_with_rigid_ends(1.0, 1.0, 1.0);
  Foundation wall = one_sided("first", kRigid, Side::left);
  model.foundations = {wall};
  EXPECT_THAT(check(model, buckling_on(accurate(1e-3))),
              ::testing::Contains(is_finding("/model/foundations/0/stiffness", "not_supported")));
}

TEST(RigidMember, AOneSidedMemberHasAFiniteAxialStiffness) {
  Model model = column_with_rigid_ends(1.0, 1.0, 1.0);
  Member rod{"rod", "foot", "high", "flexible", LineCurve{}};
  rod.reaction = Reaction::tension_only;
  model.members.push_back(rod);
  EXPECT_THAT(check(model, buckling_on(accurate(1e-3))),
              ::testing::Contains(is_finding("/model/members/3/section", "not_supported")));
}

}  // namespace
}  // namespace snapthrough
