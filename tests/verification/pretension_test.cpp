/// Pretension of one-sided members, beams and springs between nodes, against closed forms.
#include <limits>

#include "tests/findings.h"
#include "tests/verification/cases.h"

namespace snapthrough {
namespace {

using namespace testing;

constexpr double kRigid = std::numeric_limits<double>::infinity();

Pretension force(double value) {
  Pretension out;
  out.force = value;
  return out;
}

Pretension unstressed(double length) {
  Pretension out;
  out.unstressed_length = length;
  return out;
}

/// A mast of height h with a guy to each side, whose feet are at the distance a. The stub on its head bends
/// and carries nothing.
struct Mast {
  double h = 4.0;
  double a = 3.0;
  double EA = 200.0;  ///< of a guy
  double mast_EI = kRigid;

  [[nodiscard]] double guy() const { return std::hypot(a, h); }
  [[nodiscard]] Model model(const Pretension& pretension) const {
    Model out;
    out.nodes = {
        {"foot", 0.0, 0.0}, {"head", 0.0, h}, {"left", -a, 0.0}, {"right", a, 0.0}, {"stub", 0.0, h + 1.0}};
    out.sections = {{"mast", kRigid, mast_EI, {}}, {"guy", EA, 1.0, {}}, {"stub", kRigid, 10.0, {}}};
    out.members = {{"mast", "foot", "head", "mast", LineCurve{}},
                   {"left", "head", "left", "guy", LineCurve{}},
                   {"right", "head", "right", "guy", LineCurve{}},
                   {"stub", "head", "stub", "stub", LineCurve{}}};
    for (Member& member : out.members) {
      if (member.section != "guy") continue;
      member.reaction = Reaction::tension_only;
      member.pretension = pretension;
    }
    out.supports = {support("foot", "xy"), support("left", "xy"), support("right", "xy")};
    return out;
  }
};

double axial(const State& state, const std::string& member) {
  return member_of(state, member).axial_force.front();
}

/// Small displacements of a hinged mast under a force H at its head. A guy of the force T, which is turned by
/// u, pulls back by k c^2 u, k = EA / l, c = a / l; the one on the loaded side is slack from u = T / (k c)
/// on.
TEST(Pretension, GuysOfAMastPullOnBothSidesUntilOneIsSlack) {
  const Mast mast;
  const double k = mast.EA / mast.guy();
  const double c = mast.a / mast.guy();
  constexpr double T = 5.0;
  Model model = mast.model(force(T));
  model.loads = {force_at(at_node("head"), 1.0, 0.0)};
  const double slack = T / (k * c);
  const double at_slack = 2.0 * k * c * c * slack;
  const Result result =
      solve_soundly(model, static_on(fixed_mesh(1, 4), Geometry::linear, {0.4 * at_slack, 1.8 * at_slack}));
  ASSERT_EQ(result.states.size(), 2U);
  const double u0 = 0.4 * slack;
  EXPECT_NEAR(member_of(result.states[0], "mast").u.back(), u0, 1e-12);
  EXPECT_NEAR(axial(result.states[0], "left"), T + k * c * u0, 1e-10);
  EXPECT_NEAR(axial(result.states[0], "right"), T - k * c * u0, 1e-10);
  const double u1 = (1.8 * at_slack / c - T) / (k * c);  // (T + k c u) c = H
  EXPECT_NEAR(member_of(result.states[1], "mast").u.back(), u1, 1e-11);
  EXPECT_NEAR(axial(result.states[1], "left"), T + k * c * u1, 1e-9);
  EXPECT_EQ(axial(result.states[1], "right"), 0.0);
}

/// The mast leans when the load P on its head exceeds what the guys resist: with the length l(t) of a guy at
/// the angle t, l'(0) = a h / l and l''(0) = -l'^2 / l, 2 (k l'^2 + T l'') = P h.
TEST(Pretension, BucklingLoadOfAGuyedMast) {
  const Mast mast;
  const double l = mast.guy();
  const double rate = mast.a * mast.h / l;
  for (const double T : {2.0, 11.0}) {
    const double k = mast.EA / l;
    const double expected = 2.0 * rate * rate * (k - T / l) / mast.h;
    Model model = mast.model(force(T));
    model.loads = {force_at(at_node("head"), 0.0, -1.0)};
    const Result result = solve_soundly(model, analysis_of(AnalysisType::critical, accurate(1e-9)));
    ASSERT_TRUE(result.summary.critical_load_factor) << T;
    EXPECT_EQ(result.summary.critical_type, CriticalType::bifurcation);
    expect_relative(*result.summary.critical_load_factor, expected, 1e-8, "path");
  }
}

/// A guy of the unstressed length Lu has the force EA (l - Lu) / Lu.
TEST(Pretension, UnstressedLengthIsThatOfTheElasticRod) {
  const Mast mast;
  const double l = mast.guy();
  const double Lu = 0.97 * l;
  Model model = mast.model(unstressed(Lu));
  model.loads = {force_at(at_node("head"), 1.0, 0.0)};
  const Result result = solve_soundly(model, static_on(accurate(1e-9), Geometry::nonlinear, {0.0, 1.0}));
  const double T = mast.EA * (l - Lu) / Lu;
  EXPECT_NEAR(axial(result.states[0], "left"), T, 1e-9 * T);
  EXPECT_NEAR(axial(result.states[0], "right"), T, 1e-9 * T);
  // the mast turns by t: the guys have the lengths l^2 +- 2 a h sin t, and H h cos t is the moment of both
  const auto moment = [&](double t) {
    double sum = 0.0;
    for (const double side : {1.0, -1.0}) {
      const double now = std::sqrt(l * l + side * 2.0 * mast.a * mast.h * std::sin(t));
      sum += side * mast.EA * (now - Lu) / Lu * mast.a * mast.h * std::cos(t) / now;
    }
    return sum - mast.h * std::cos(t);
  };
  double lo = 0.0;
  double hi = 0.1;
  for (int i = 0; i < 200; ++i) {
    const double t = 0.5 * (lo + hi);
    (moment(t) < 0.0 ? lo : hi) = t;
  }
  EXPECT_NEAR(member_of(result.states[1], "mast").u.back(), mast.h * std::sin(lo), 1e-9);
}

/// A vertical rope weighs by its unstressed length: half of the weight hangs from its upper end, the other
/// half and a load P from the lower.
TEST(Pretension, UnstressedLengthWeighs) {
  Model model;
  model.nodes = {{"top", 0.0, 0.0}, {"end", 0.0, -2.0}};
  model.sections = {{"rope", 500.0, 1.0, {}}};
  model.sections[0].mass = 3.0;
  model.members = {{"rope", "top", "end", "rope", LineCurve{}}};
  model.members[0].reaction = Reaction::tension_only;
  model.members[0].pretension = unstressed(2.5);
  model.supports = {support("top", "xy")};
  SelfWeight weight;
  weight.gravity = {0.0, -10.0};
  model.loads = {weight, force_at(at_node("end"), 0.0, -7.0)};
  const Result result = solve_soundly(model, static_on(fixed_mesh(1, 4), Geometry::nonlinear));
  const double T = 7.0 + 0.5 * 2.5 * 3.0 * 10.0;
  EXPECT_NEAR(axial(result.states.at(0), "rope"), T, 1e-9 * T);
  EXPECT_NEAR(member_of(result.states.at(0), "rope").y.back(), -2.5 * (1.0 + T / 500.0), 1e-9);
}

/// A guy that is too long by d is slack until the mast has moved by d / c.
TEST(Pretension, ALongGuyIsSlackAtFirst) {
  const Mast mast{4.0, 3.0, 200.0, 50.0};
  const double l = mast.guy();
  const double c = mast.a / l;
  const double d = 0.01;
  Model model = mast.model(unstressed(l + d));
  model.supports[0].rotation = true;
  const double bending = 3.0 * mast.mast_EI / std::pow(mast.h, 3);
  model.loads = {force_at(at_node("head"), 1.0, 0.0)};
  const double closes = bending * d / c;
  const Result result =
      solve_soundly(model, static_on(fixed_mesh(1, 4), Geometry::linear, {0.5 * closes, 3.0 * closes}));
  EXPECT_EQ(axial(result.states[0], "left"), 0.0);
  const double k = mast.EA / (l + d);
  const double u = (3.0 * closes + k * c * d) / (bending + k * c * c);
  EXPECT_NEAR(member_of(result.states[1], "mast").u.back(), u, 1e-10);
  EXPECT_NEAR(axial(result.states[1], "left"), k * (c * u - d), 1e-9);
  EXPECT_EQ(axial(result.states[1], "right"), 0.0);
}

/// Two cantilevers in one line, whose tips a spring of the stiffness k and the force T draws together: each
/// is strained by N = T / (1 + 2 k L / EA).
TEST(Pretension, SpringBetweenTwoNodes) {
  constexpr double L = 2.0;
  constexpr double EA = 30.0;
  constexpr double k = 4.0;
  constexpr double T = 0.5;
  for (const double sign : {1.0, -1.0}) {
    Model model;
    model.nodes = {{"a", 0.0, 0.0}, {"b", L, 0.0}, {"c", L + 1.0, 0.0}, {"d", 2.0 * L + 1.0, 0.0}};
    model.sections = {{"s", EA, 5.0, {}}};
    model.members = {{"one", "a", "b", "s", LineCurve{}}, {"other", "c", "d", "s", LineCurve{}}};
    model.supports = {support("a", "xyr"), support("d", "xyr")};
    Spring spring;
    spring.id = "spring";
    spring.at = at_node("b");
    spring.to = at_node("c");
    spring.direction = {sign, 0.0};
    spring.stiffness = k;
    spring.pretension = force(T);
    model.springs = {spring};
    model.loads = {force_at(at_node("b"), 0.0, 1e-3)};
    const double N = T / (1.0 + 2.0 * k * L / EA);
    const Result result = solve_soundly(model, static_on(fixed_mesh(1, 4), Geometry::linear));
    const State& state = result.states.at(0);
    EXPECT_NEAR(axial(state, "one"), N, 1e-12);
    EXPECT_NEAR(axial(state, "other"), N, 1e-12);
    EXPECT_NEAR(state.springs.at(0).force, -sign * N, 1e-12);
    EXPECT_NEAR(state.springs.at(0).displacement, sign * 2.0 * N * L / EA, 1e-12);
  }
}

/// A beam between fixed supports keeps the force of its pretension; beside a column it shortens both.
TEST(Pretension, OfABeam) {
  Model model = straight(3.0, 2.0, 40.0, "xyr", "xyr");
  model.members[0].pretension = force(1.25);
  model.loads = {force_at(at_member("m", 0.5), 0.0, -1e-3)};
  const Result result = solve_soundly(model, static_on(fixed_mesh(2, 4), Geometry::linear));
  EXPECT_NEAR(axial(result.states.at(0), "m"), 1.25, 1e-12);
  model.members[0].pretension = unstressed(2.9);
  const Result shorter = solve_soundly(model, static_on(fixed_mesh(2, 4), Geometry::linear));
  EXPECT_NEAR(axial(shorter.states.at(0), "m"), 40.0 * 0.1 / 3.0, 1e-11);
}

TEST(Pretension, FieldsThatDoNotFit) {
  const Mast mast;
  Model model = mast.model(force(1.0));
  model.loads = {force_at(at_node("head"), 1.0, 0.0)};
  const auto findings_of = [&](const Model& changed) { return check(changed, buckling_on(accurate(1e-3))); };
  const auto has = [](const std::string& pointer, const std::string& code) {
    return ::testing::Contains(is_finding(pointer, code));
  };
  Model both = model;
  both.members[1].pretension->unstressed_length = 1.0;
  EXPECT_THAT(findings_of(both), has("/model/members/1/pretension", "ambiguous"));
  Model length = model;
  length.members[1].pretension = unstressed(-1.0);
  EXPECT_THAT(findings_of(length), has("/model/members/1/pretension/unstressed_length", "out_of_range"));
  Model rigid = model;
  rigid.members[0].pretension = force(1.0);
  EXPECT_THAT(findings_of(rigid), has("/model/members/0/pretension/force", "not_supported"));
  Model ground = model;
  Spring spring;
  spring.id = "spring";
  spring.at = at_node("head");
  spring.direction = {1.0, 0.0};
  spring.stiffness = 1.0;
  spring.pretension = force(1.0);
  ground.springs = {spring};
  EXPECT_THAT(findings_of(ground), has("/model/springs/0/pretension", "not_supported"));
  spring.to = at_node("foot");
  ground.springs = {spring};
  EXPECT_THAT(findings_of(ground), has("/model/springs/0/pretension", "not_supported")) << "across the line";
}

}  // namespace
}  // namespace snapthrough
