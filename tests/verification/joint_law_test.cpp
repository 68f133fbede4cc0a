/// Joints whose moment follows a law of the rotation, against closed forms and an elastica of this file.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "tests/verification/cases.h"
#include "tests/verification/root.h"

namespace snapthrough {
namespace {

using namespace testing;
using Type = ReactionLaw::Type;
using Points = std::vector<std::array<double, 2>>;

ReactionLaw law_with(Type type, double stiffness, double capacity) {
  ReactionLaw law;
  law.type = type;
  law.stiffness.constant = stiffness;
  law.capacity.constant = capacity;
  law.reference = 0.8;
  law.exponent = 1.0 / 3.0;
  return law;
}

ReactionLaw lines_through(const Points& points) {
  ReactionLaw law;
  law.type = Type::table;
  law.points = points;
  law.interpolation = ReactionLaw::Interpolation::linear;
  return law;
}

/// Moment at the rotation w by straight lines through the origin and the points of a table.
double lines(const Points& points, double w) {
  std::array<double, 2> from{0.0, 0.0};
  for (const auto& to : points) {
    if (w < to[0]) return from[1] + (to[1] - from[1]) * (w - from[0]) / (to[0] - from[0]);
    from = to;
  }
  return from[1];
}

void join_start(Member& member, const ReactionLaw& law) {
  member.release_start_rotation = true;
  member.release_start_law = law;
}
void join_end(Member& member, const ReactionLaw& law) {
  member.release_end_rotation = true;
  member.release_end_law = law;
}

/// Largest value of f at the places of a grid, refined about the largest until rounding.
double largest(const std::function<double(double)>& f, double from, double to) {
  while (to - from > 1e-13) {
    double best = from;
    const double step = (to - from) / 200.0;
    for (int i = 0; i <= 200; ++i)
      if (f(from + i * step) > f(best)) best = from + i * step;
    from = std::max(from, best - step);
    to = std::min(to, best + step);
  }
  return f(0.5 * (from + to));
}

/// An upright bar of length 1, almost rigid, on a clamp that it is joined to by a law, with a load P down and
/// h P sideways on its head: P (sin t + h cos t) = M(t).
Model bar_on_joint(const ReactionLaw& law, double h) {
  Model model = bar_on_spring(law);
  model.springs.clear();
  model.supports = {support("foot", "xyr")};
  join_start(model.members[0], law);
  model.loads = {force_at(at_node("head"), h, -1.0)};
  model.monitors = {{"push", at_node("head"), Component::x}};
  return model;
}

/// The limit point is the maximum of P(t).
TEST(JointLaw, LimitPointOfABar) {
  constexpr double k = 10.0;
  constexpr double C = 1.0;
  constexpr double h = 0.05;
  const Points points{{0.1, 1.0}, {0.2, 1.4}, {0.6, 0.5}};
  struct Case {
    ReactionLaw law;
    std::function<double(double)> moment;
  };
  const Case cases[] = {{law_with(Type::tanh, k, C), [](double t) { return C * std::tanh(k * t / C); }},
                        {law_with(Type::hyperbolic, k, C), [](double t) { return t / (1.0 / k + t / C); }},
                        {law_with(Type::power, k, C),
                         [](double t) {
                           return std::min({k * t, C * std::cbrt(t / 0.8), C});
                         }},
                        {lines_through(points), [&](double t) { return lines(points, t); }}};
  for (const Case& one : cases) {
    const Result result =
        solve_soundly(bar_on_joint(one.law, h), analysis_of(AnalysisType::critical, accurate(1e-9)));
    const int type = static_cast<int>(one.law.type);
    ASSERT_TRUE(result.summary.critical_load_factor) << type;
    EXPECT_EQ(result.summary.critical_type, CriticalType::limit_max) << type;
    EXPECT_TRUE(result.capacity.empty()) << "a joint is no support";
    const double expected =
        largest([&](double t) { return one.moment(t) / (std::sin(t) + h * std::cos(t)); }, 0.0, 1.5);
    expect_relative(*result.summary.critical_load_factor, expected, 1e-8, std::to_string(type));
  }
}

/// P_max(C) of the bar with the tanh law: its derivative by the capacity C.
TEST(JointLaw, ItsCapacityHasASensitivity) {
  constexpr double k = 10.0;
  constexpr double h = 0.05;
  const auto limit = [](double C) {
    return largest([C](double t) { return C * std::tanh(k * t / C) / (std::sin(t) + h * std::cos(t)); }, 0.0,
                   1.5);
  };
  const auto model_at = [](double C) { return bar_on_joint(law_with(Type::tanh, k, C), h); };
  Analysis analysis = analysis_of(AnalysisType::critical, accurate(1e-8));
  Variation variation;
  variation.pointer = "capacity";
  variation.value = variation.size = 1.0;
  variation.model_at = [&](double C) { return std::optional(model_at(C)); };
  analysis.sensitivities = {variation};
  const Result result = solve_soundly(model_at(1.0), analysis);
  ASSERT_EQ(result.critical_points.size(), 1u);
  ASSERT_EQ(result.critical_points[0].sensitivities.size(), 1u);
  const double expected = (limit(1.0 + 1e-4) - limit(1.0 - 1e-4)) / 2e-4;
  expect_relative(*result.critical_points[0].sensitivities[0].derivative, expected, 1e-6, "dP / dC");
}

/// Upright elastic column (EI = 1, length 1) on a joint of the law M(t), with the loads P down and H
/// sideways on its head; t is the angle from the vertical, M the moment of the loads about a section:
/// t' = M, M' = -(P sin t + H cos t), M(0) = law(t(0)), M(1) = 0. Runge and Kutta's method of order 4 along
/// the column, and halving of the angle at the foot.
struct Elastica {
  double foot = 0.0;    ///< t(0)
  double moment = 0.0;  ///< M(0)
  double x = 0.0;       ///< displacement of the head, sideways
  double y = 0.0;       ///< height of the head
  double turn = 0.0;    ///< t(1)
};

using Column = std::array<double, 4>;  ///< t, M, x, y

Column rates(const Column& at, double P, double H) {
  const double s = std::sin(at[0]);
  const double c = std::cos(at[0]);
  return {at[1], -(P * s + H * c), s, c};
}

Column along_column(double foot, double moment, double P, double H) {
  constexpr int steps = 4000;
  constexpr double step = 1.0 / steps;
  const auto moved = [](Column at, const Column& rate, double by) {
    for (std::size_t c = 0; c < 4; ++c) at[c] += by * rate[c];
    return at;
  };
  Column at{foot, moment, 0.0, 0.0};
  for (int i = 0; i < steps; ++i) {
    const Column a = rates(at, P, H);
    const Column b = rates(moved(at, a, 0.5 * step), P, H);
    const Column c = rates(moved(at, b, 0.5 * step), P, H);
    const Column d = rates(moved(at, c, step), P, H);
    for (std::size_t k = 0; k < 4; ++k) at[k] += step / 6.0 * (a[k] + 2.0 * b[k] + 2.0 * c[k] + d[k]);
  }
  return at;
}

/// @param most an angle at the foot beyond that of the equilibrium, and below that of the next one
Elastica elastica(const std::function<double(double)>& law, double P, double H, double most) {
  const auto left = [&](double foot) { return along_column(foot, law(foot), P, H)[1]; };
  Elastica out;
  out.foot = root(left, 0.0, most);
  out.moment = law(out.foot);
  const Column head = along_column(out.foot, out.moment, P, H);
  out.turn = head[0];
  out.x = head[2];
  out.y = head[3];
  return out;
}

/// Column of the elastica above, whose axial stiffness is 1e11 of its Euler load.
Model column_on_joint(const ReactionLaw& law) {
  Model model;
  model.nodes = {{"foot", 0.0, 0.0}, {"head", 0.0, 1.0}};
  model.sections = {{"s", 1e11, 1.0, {}}};
  model.members = {{"m", "foot", "head", "s", LineCurve{}, false, false}};
  model.supports = {support("foot", "xyr")};
  join_start(model.members[0], law);
  return model;
}

TEST(JointLaw, ElasticaOnAJointThatYields) {
  constexpr double k = 3.0;
  constexpr double C = 0.4;
  const auto law = [](double t) { return C * std::tanh(k * t / C); };
  Model model = column_on_joint(law_with(Type::tanh, k, C));
  model.loads = {force_at(at_node("head"), 0.3, -0.1)};
  const Result result =
      solve_soundly(model, static_on(fixed_mesh(8, 7), Geometry::nonlinear, {0.5, 0.9, 1.1}));
  ASSERT_EQ(result.states.size(), 3u);
  for (const State& state : result.states) {
    const double load = state.load_factor;
    const Elastica expected = elastica(law, 0.1 * load, 0.3 * load, 0.6);
    EXPECT_GT(expected.foot, 0.04) << "the law has bent";
    const MemberState& m = state.members.at(0);
    EXPECT_NEAR(-m.rotation.front(), expected.foot, 1e-8) << load;
    EXPECT_NEAR(-m.rotation.back(), expected.turn, 1e-8) << load;
    EXPECT_NEAR(m.u.back(), expected.x, 1e-8) << load;
    EXPECT_NEAR(m.v.back(), expected.y - 1.0, 1e-8) << load;
    EXPECT_NEAR(std::abs(m.bending_moment.front()), expected.moment, 1e-8) << load;
    EXPECT_NEAR(std::abs(state.supports.at(0).moment), expected.moment, 1e-8) << load;
  }
}

/// The straight column is at the origin of the law, so that its slope k there gives the load at which it
/// buckles: sqrt(P) tan(sqrt(P)) = k with EI = 1, length 1.
TEST(JointLaw, BucklingLoadIsThatOfItsFirstSlope) {
  for (const double k : {0.5, 3.0, 40.0}) {
    const double a = root([k](double x) { return x * std::tan(x) - k; }, 1e-6, 0.5 * kPi - 1e-9);
    for (const Type type : {Type::tanh, Type::hyperbolic}) {
      Model model = column_on_joint(law_with(type, k, 0.2));
      model.loads = {force_at(at_node("head"), 0.0, -1.0)};
      const Result buckling = solve_soundly(model, buckling_on(fixed_mesh(8, 7)));
      expect_relative(*buckling.summary.critical_load_factor, a * a, 1e-8, "linearised");
      const Result path = solve_soundly(model, analysis_of(AnalysisType::critical, accurate(1e-8)));
      EXPECT_EQ(path.summary.critical_type, CriticalType::bifurcation);
      expect_relative(*path.summary.critical_load_factor, a * a, 1e-8, "path");
      for (const Warning& warning : buckling.warnings) EXPECT_NE(warning.code, "laws_change");
    }
  }
}

/// Beam of the length 4 (EI = 100) between clamps, with the same law m at both ends, under a load q: the
/// joints turn by t = q L^3 / (24 EI) - m(t) L / (2 EI), in opposite senses.
TEST(JointLaw, EndMomentsOfABeamBetweenClamps) {
  constexpr double k = 80.0;
  constexpr double C = 3.0;
  const auto moment = [](double t) { return C * std::tanh(k * t / C); };
  Model model = straight(4.0, 100.0, 1e6, "xyr", "xyr");
  join_start(model.members[0], law_with(Type::tanh, k, C));
  join_end(model.members[0], law_with(Type::tanh, k, C));
  DistributedLoad load;
  load.member = "m";
  load.force = {0.0, -1.0};
  model.loads = {load};
  const Result result = solve_soundly(model, static_on(fixed_mesh(2, 5), Geometry::linear, {0.5, 3.0, 20.0}));
  ASSERT_EQ(result.states.size(), 3u);
  for (const State& state : result.states) {
    const double q = state.load_factor;
    const double t =
        root([&](double at) { return at - q * 64.0 / 2400.0 + moment(at) * 4.0 / 200.0; }, 0.0, 10.0);
    const MemberState& m = state.members.at(0);
    EXPECT_NEAR(m.bending_moment.front(), -moment(t), 1e-8) << q;
    EXPECT_NEAR(m.bending_moment.back(), -moment(t), 1e-8) << q;
    EXPECT_NEAR(m.rotation.front(), -t, 1e-8) << q;
    EXPECT_NEAR(m.rotation.back(), t, 1e-8) << q;
  }
}

/// A node may have nothing but joints with laws. With the load F on the tip of a cantilever of two members,
/// both joints at the middle node carry F L / 2, and each turns by the inverse of its law.
TEST(JointLaw, OfAllMembersOfANode) {
  Model model = straight(2.0, 10.0, 1e6, "xyr", "");
  model.nodes.push_back({"c", 4.0, 0.0});
  model.members.push_back({"n", "b", "c", "s", LineCurve{}, false, false});
  join_end(model.members[0], law_with(Type::tanh, 7.0, 0.5));
  join_start(model.members[1], law_with(Type::hyperbolic, 5.0, 0.6));
  model.loads = {force_at(at_node("c"), 0.0, -1.0)};
  const double F = 0.2;
  const Result result = solve_soundly(model, static_on(fixed_mesh(2, 4), Geometry::linear, {F}));
  const double M = 2.0 * F;
  const double turned = 0.5 / 7.0 * std::atanh(M / 0.5) + M / (5.0 * (1.0 - M / 0.6));
  EXPECT_NEAR(result.states.at(0).members.at(1).v.back(), -(F * 64.0 / 30.0 + 2.0 * turned), 1e-8);
}

/// With small displacements a determinate bar has no equilibrium beyond the capacity of its joint.
TEST(JointLaw, SaysThatAJointMayCarryNoMore) {
  Model model = bar_on_joint(law_with(Type::tanh, 10.0, 1.0), 0.0);
  model.loads = {force_at(at_node("head"), 1.0, 0.0)};
  const Result result = solve(model, static_on(fixed_mesh(2, 4), Geometry::linear, {0.9, 2.0}));
  ASSERT_EQ(result.states.size(), 1u);
  EXPECT_NEAR(result.states[0].members.at(0).rotation.front(), -0.1 * std::atanh(0.9), 1e-8);
  ASSERT_TRUE(result.failure);
  EXPECT_EQ(result.failure->code, "no_convergence");
  EXPECT_NE(result.failure->detail.find("joints with laws may carry no larger moment"), std::string::npos);
}

/// A constant force turns the joint of a bar beyond its peak, beside a spring; the growing load turns it
/// back.
TEST(JointLaw, TellsAJointThatGoesBackFromBeyondItsPeak) {
  Model model = bar_on_joint(lines_through({{0.1, 1.0}, {0.3, 0.4}}), 1.0);
  Spring spring;
  spring.id = "spring";
  spring.at = at_node("head");
  spring.direction = {1.0, 0.0};
  spring.stiffness = 20.0;
  model.springs = {spring};
  PointLoad turning = force_at(at_node("head"), 4.0, 0.0);
  turning.pattern = Pattern::constant;
  model.loads = {turning, force_at(at_node("head"), -1.0, 0.0)};
  const auto told = [&](double back) {
    Analysis analysis = path_on(accurate(1e-6), 5);
    analysis.stop = {};
    analysis.stop.load_factor = std::array{-1.0, back};
    analysis.stop.steps = 500;
    const Result result = solve_soundly(model, analysis);
    std::string out;
    for (const Warning& warning : result.warnings)
      if (warning.code == "unloaded_beyond_peak") out += warning.detail;
    return out;
  };
  EXPECT_NE(told(2.0).find("the joint at the start of \"m\" at load factor"), std::string::npos) << told(2.0);
  model.members[0].release_start_law = law_with(Type::tanh, 10.0, 1.0);
  EXPECT_EQ(told(2.0), "");
}

/// Limit analysis moves rigid members with rigid joints: where a joint has a law, the limit load of supports
/// would be a bound alone, and is not told.
TEST(JointLaw, LeavesLimitLoadsOfSupportsOut) {
  Model model = bar_on_spring(law_with(Type::tanh, 10.0, 1.0));
  model.loads = {force_at(at_node("head"), 1.0, 0.0)};
  const Analysis analysis = path_on(accurate(1e-6), 1);
  EXPECT_FALSE(solve_soundly(model, analysis).capacity.empty());
  Model jointed = bar_on_spring(law_with(Type::tanh, 10.0, 1.0));
  jointed.nodes[1].y = 0.5;
  jointed.nodes.push_back({"top", 0.0, 1.0});
  jointed.members.push_back({"n", "head", "top", "s", LineCurve{}, false, false});
  join_start(jointed.members[1], law_with(Type::tanh, 10.0, 0.7));
  jointed.loads = {force_at(at_node("top"), 1.0, 0.0)};
  Analysis few = analysis;
  few.stop.steps = 60;
  EXPECT_TRUE(solve_soundly(jointed, few).capacity.empty());
}

}  // namespace
}  // namespace snapthrough
