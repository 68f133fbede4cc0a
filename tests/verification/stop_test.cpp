/// Rigid stops in any direction against closed forms, and against the structure turned so that they lie along
/// an axis.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>

#include "tests/verification/cases.h"

namespace snapthrough {
namespace {

using namespace testing;

constexpr double kPi4 = 0.25 * kPi;

Spring stop_at(const std::string& id, const Location& at, std::array<double, 2> direction, double gap = 0.0) {
  Spring out;
  out.id = id;
  out.at = at;
  out.direction = direction;
  out.stiffness = std::numeric_limits<double>::infinity();
  out.reaction = Reaction::compression_only;
  out.gap = gap;
  return out;
}

std::array<double, 2> turned(double x, double y, double angle) {
  return {x * std::cos(angle) - y * std::sin(angle), x * std::sin(angle) + y * std::cos(angle)};
}

const SpringState& stop_of(const State& state, const std::string& id) {
  return *std::find_if(state.springs.begin(), state.springs.end(),
                       [&id](const SpringState& spring) { return spring.id == id; });
}

/// Cantilever along the angle `turn`, of length 1 and EI = 1, whose tip, or the middle of a member twice as
/// long, is loaded by (0.3, 1) along and across it and stopped along the angle `stop` from its axis.
Model stopped_cantilever(double EA, double turn, double stop, bool inside, double gap) {
  const double length = inside ? 2.0 : 1.0;
  Model model;
  const auto end = turned(length, 0.0, turn);
  model.nodes = {{"a", 0.0, 0.0}, {"b", end[0], end[1]}};
  model.sections = {{"s", EA, 1.0, {}}};
  model.members = {{"m", "a", "b", "s", LineCurve{}}};
  model.supports = {support("a", "xyr")};
  const Location at = inside ? at_member("m", 0.5) : at_node("b");
  model.springs = {stop_at("stop", at, turned(1.0, 0.0, turn + stop), gap)};
  const auto force = turned(0.3, 1.0, turn);
  model.loads = {force_at(at, force[0], force[1])};
  return model;
}

/// With the flexibilities a = L / EA and b = L^3 / 3 EI along and across the axis and the stop along (c, s),
/// its force is p = (c a f + s b t - gap) / (c^2 a + s^2 b). A stop gives way by 1e-8 of the members.
void expect_closed_form(double EA, double turn, double stop, bool inside, double gap) {
  const Model model = stopped_cantilever(EA, turn, stop, inside, gap);
  const Result result = solve_soundly(model, static_on(fixed_mesh(4, 4), Geometry::linear));
  ASSERT_EQ(result.states.size(), 1u);
  const double c = std::cos(stop);
  const double s = std::sin(stop);
  const double a = 1.0 / EA;
  const double b = 1.0 / 3.0;
  const double expected = (c * a * 0.3 + s * b - gap) / (c * c * a + s * s * b);
  const std::string what = "EA " + std::to_string(EA) + ", turned by " + std::to_string(turn);
  expect_relative(stop_of(result.states[0], "stop").force, expected, 1e-7, what);
  EXPECT_TRUE(stop_of(result.states[0], "stop").closed) << what;
}

TEST(Stop, OfACantileverHasTheForceOfTheClosedFormInAnyDirection) {
  for (const double EA : {1e2, 1e6, 1e10, 1e12})
    for (const double turn : {0.0, 0.7, 2.0})
      for (const double stop : {kPi4, 1.3, 0.5 * kPi}) {
        expect_closed_form(EA, turn, stop, false, 0.0);
        expect_closed_form(EA, turn, stop, false, 0.05);
        expect_closed_form(EA, turn, stop, true, 0.05);
      }
}

/// A column and a beam, joined rigidly, whose far end a stop holds across the column, turned by an angle.
Model stopped_frame(double EA, double turn) {
  Model model;
  const auto node = [&model, turn](const std::string& id, double x, double y) {
    const auto at = turned(x, y, turn);
    model.nodes.push_back({id, at[0], at[1]});
  };
  node("a", 0.0, 0.0);
  node("b", 0.0, 4.0);
  node("c", 4.0, 4.0);
  model.sections = {{"s", EA, 33410.0, {}}};
  model.members = {{"m0", "a", "b", "s", LineCurve{}}, {"m1", "b", "c", "s", LineCurve{}}};
  model.supports = {support("a", "xy")};
  model.springs = {stop_at("stop", at_node("c"), turned(1.0, 0.0, turn))};
  const auto load = turned(0.0, -7000.0, turn);
  const auto wind = turned(300.0, 0.0, turn);
  model.loads = {force_at(at_node("b"), load[0], load[1]),
                 DistributedLoad{"m0", wind, {0.0, 1.0}, LoadMeasure::length, Pattern::proportional}};
  return model;
}

/// Expected: cubic elements, 32 a member, with the stop as a support; the loads of 8, 16 and 32 elements,
/// 2.3416781, 2.3416356 and 2.3416329, converge to 2.3416327.
TEST(Stop, LetsAFrameBuckleAtOneLoadInAllDirections) {
  for (const double turn : {0.0, 0.65, 1.9, 3.3, 5.0}) {
    const Result result = solve_soundly(stopped_frame(208812500.0, turn), buckling_on(fixed_mesh(8, 4)));
    ASSERT_TRUE(result.summary.critical_load_factor) << turn;
    expect_relative(*result.summary.critical_load_factor, 2.3416327, 2e-6,
                    "turned by " + std::to_string(turn));
  }
}

/// The frame with large displacements: the stop along an axis acts on one unknown.
TEST(Stop, OnAPathDoesNotDependOnItsDirection) {
  const auto critical = [](double turn) {
    return *solve_soundly(stopped_frame(20881250.0, turn),
                          analysis_of(AnalysisType::critical, accurate(1e-6)))
                .summary.critical_load_factor;
  };
  const double along_x = critical(0.0);
  for (const double turn : {0.65, 1.9}) expect_relative(critical(turn), along_x, 1e-6, std::to_string(turn));
}

/// Two stops that face one another let the tip move along the line between them and across nothing: as a
/// roller along that line.
TEST(Stop, OpposedByAnotherActsAsASupport) {
  for (const double turn : {0.0, 0.9})
    for (const double load : {1.0, -1.0}) {
      Model model = stopped_cantilever(1e6, turn, 0.5 * kPi, false, 0.0);
      model.springs = {stop_at("up", at_node("b"), turned(0.0, 1.0, turn)),
                       stop_at("down", at_node("b"), turned(0.0, -1.0, turn))};
      const auto force = turned(0.0, load, turn);
      model.loads = {force_at(at_node("b"), force[0], force[1])};
      const Result result =
          solve_soundly(model, static_on(fixed_mesh(4, 4), Geometry::nonlinear, {0.5, 1.0}));
      ASSERT_EQ(result.states.size(), 2u);
      const State& state = result.states[1];
      expect_relative(stop_of(state, load > 0.0 ? "up" : "down").force, 1.0, 1e-7, "pressed");
      EXPECT_EQ(stop_of(state, load > 0.0 ? "down" : "up").force, 0.0);
    }
}

}  // namespace
}  // namespace snapthrough
