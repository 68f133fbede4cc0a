/// Structures with a motion that nothing resists: held by the least norm and told, or refused with a code.
#include <array>
#include <cmath>
#include <string>

#include "tests/paths/reference_problems.h"

namespace snapthrough {
namespace {

using namespace testing;

constexpr double kEI = 2142.8571428571427;
constexpr double kRadius = 0.5;

/// A plastic pipe under pressure 1000 from outside in ground that only pushes, which it leaves as it shrinks.
/// @param crown, invert what is fixed there
/// @param ground stiffness, 0 for none
Model pipe(const std::string& crown, const std::string& invert, double ground) {
  Model model;
  model.nodes = {{"bottom", 0.0, -kRadius}, {"top", 0.0, kRadius}};
  model.sections = {{"wall", 28571428.57142857, kEI, {}}};
  model.members = {{"right", "bottom", "top", "wall", ArcCurve{180.0}, false, false},
                   {"left", "top", "bottom", "wall", ArcCurve{180.0}, false, false}};
  if (!crown.empty()) model.supports.push_back(support("top", crown));
  if (!invert.empty()) model.supports.push_back(support("bottom", invert));
  for (const char* member : {"right", "left"}) {
    if (ground > 0.0) {
      model.foundations.push_back(one_sided(member, ground, Side::right));
      model.foundations.back().id = member;
    }
    model.loads.push_back(PressureLoad{member, 1000.0, Side::right, Pattern::proportional});
  }
  return model;
}

Analysis critical_at(double accuracy) {
  Analysis analysis = analysis_of(AnalysisType::critical, {});
  analysis.discretization.accuracy = accuracy;
  return analysis;
}

/// The same pipe clamped at its invert, on a fine mesh: nothing is neutral there.
double clamped_pipe() {
  const Result result = solve_soundly(pipe("x", "xyr", 2e7), critical_at(1e-8));
  EXPECT_TRUE(result.neutral_motion.empty());
  return result.summary.critical_load_factor.value_or(0.0);
}

const NodeMotion* node_of(const NeutralMotion& motion, const std::string& node) {
  for (const NodeMotion& one : motion.nodes)
    if (one.node == node) return &one;
  return nullptr;
}

void expect_translation(const NeutralMotion& motion, double u, double v, const std::vector<Node>& nodes) {
  ASSERT_EQ(motion.nodes.size(), nodes.size());
  for (const Node& node : nodes) {
    const NodeMotion* moved = node_of(motion, node.id);
    ASSERT_NE(moved, nullptr) << node.id;
    EXPECT_NEAR(moved->u, u, 1e-9) << node.id;
    EXPECT_NEAR(moved->v, v, 1e-9) << node.id;
    EXPECT_NEAR(moved->rotation, 0.0, 1e-9) << node.id;
  }
}

/// Vertical translation is free until the ring buckles: it stands off the ground by its shortening.
TEST(NeutralMotion, PipeThatLeavesItsGroundBucklesAsIfHeld) {
  const double held = clamped_pipe();
  EXPECT_NEAR(held, 51.506, 1e-3);
  for (const double accuracy : {1e-2, 1e-3, 1e-6}) {
    const Result result = solve_soundly(pipe("x", "x", 2e7), critical_at(accuracy));
    ASSERT_TRUE(result.summary.critical_load_factor);
    expect_relative(*result.summary.critical_load_factor, held, accuracy, "loose pipe");
    ASSERT_EQ(result.neutral_motion.size(), 1u);
    EXPECT_EQ(result.neutral_motion[0].from, 0.0);
    EXPECT_FALSE(result.neutral_motion[0].to);
    expect_translation(result.neutral_motion[0], 0.0, 1.0, pipe("", "", 0.0).nodes);
  }
}

TEST(NeutralMotion, PipeOnFixedMeshesHasOneAnswer) {
  const double held = clamped_pipe();
  constexpr std::array<std::array<int, 2>, 6> kMeshes{
      {{20, 2}, {20, 5}, {40, 3}, {80, 4}, {80, 5}, {160, 2}}};
  for (const auto& [elements, order] : kMeshes) {
    Analysis analysis = critical_at(1e-3);
    analysis.discretization.fixed_mesh = true;
    analysis.discretization.elements = elements;
    analysis.discretization.order = order;
    const Result result = solve_soundly(pipe("x", "x", 2e7), analysis);
    ASSERT_TRUE(result.summary.critical_load_factor) << elements << " of order " << order;
    expect_relative(*result.summary.critical_load_factor, held, 1e-3, std::to_string(elements));
    EXPECT_EQ(result.neutral_motion.size(), 1u);
  }
}

/// Without any support all three rigid motions are free.
TEST(NeutralMotion, FreeRingInARoundHole) {
  const double held = clamped_pipe();
  for (const double ground : {2e7, 0.0}) {
    const Result result = solve_soundly(pipe("", "", ground), critical_at(1e-6));
    ASSERT_TRUE(result.summary.critical_load_factor) << ground;
    expect_relative(*result.summary.critical_load_factor, held, 1e-6, "free ring");
    ASSERT_EQ(result.neutral_motion.size(), 3u);
    expect_translation(result.neutral_motion[0], 1.0, 0.0, pipe("", "", 0.0).nodes);
    expect_translation(result.neutral_motion[1], 0.0, 1.0, pipe("", "", 0.0).nodes);
  }
}

/// Constant pressure from inside presses the ring on its ground; the growing one from outside lifts it off
/// all round when both are equal, and from there on it is free to move up and down. The pressures' difference
/// buckles it as before.
TEST(NeutralMotion, BeginsWhereTheGroundLetsGo) {
  const double held = clamped_pipe();
  constexpr double kInside = 5000.0;
  Model model = pipe("x", "x", 2e7);
  for (const char* member : {"right", "left"})
    model.loads.push_back(PressureLoad{member, kInside, Side::left, Pattern::constant});
  const Result result = solve_soundly(model, critical_at(1e-4));
  ASSERT_TRUE(result.summary.critical_load_factor);
  expect_relative(*result.summary.critical_load_factor, held + kInside / 1000.0, 1e-4, "difference");
  ASSERT_EQ(result.neutral_motion.size(), 1u);
  EXPECT_GE(result.neutral_motion[0].from, kInside / 1000.0 * (1.0 - 1e-9));
  EXPECT_LT(result.neutral_motion[0].from, held);
  EXPECT_FALSE(result.neutral_motion[0].to);
}

/// A block on a bed settles by q / K and may slide.
TEST(NeutralMotion, BlockOnABedSettlesAndMaySlide) {
  Model model = straight(2.0, 1e6, 1e9, "", "");
  model.foundations = {one_sided("m", 50.0, Side::right)};
  model.loads = {DistributedLoad{"m", {0.0, -3.0}, {0.0, 1.0}, LoadMeasure::length, Pattern::proportional}};
  model.monitors = {{"w", at_member("m", 0.5), Component::y}};
  for (const Geometry geometry : {Geometry::linear, Geometry::nonlinear}) {
    Analysis analysis = static_on({}, geometry);
    analysis.output.states = StateOutput::all;
    const Result result = solve_soundly(model, analysis);
    ASSERT_EQ(result.states.size(), 1u);
    for (const double v : result.states[0].members[0].v) EXPECT_NEAR(v, -0.06, 1e-9);
    for (const double u : result.states[0].members[0].u) EXPECT_NEAR(u, 0.0, 1e-12);
    ASSERT_EQ(result.neutral_motion.size(), 1u);
    expect_translation(result.neutral_motion[0], 1.0, 0.0, model.nodes);
  }
}

/// Two rollers and a pair of forces along the axis: Euler's column, which may slide.
TEST(NeutralMotion, ColumnBetweenRollersBucklesAtEulersLoad) {
  Model model = straight(1.0, 1.0, 1e12, "y", "y");
  model.loads = {force_at(at_node("a"), 1.0, 0.0), force_at(at_node("b"), -1.0, 0.0)};
  const Result path = solve_soundly(model, critical_at(1e-6));
  ASSERT_TRUE(path.summary.critical_load_factor);
  expect_relative(*path.summary.critical_load_factor, kPi * kPi, 1e-6, "path");
  ASSERT_EQ(path.neutral_motion.size(), 1u);
  expect_translation(path.neutral_motion[0], 1.0, 0.0, model.nodes);
  Discretization mesh;
  mesh.fixed_mesh = true;
  mesh.elements = 6;
  mesh.order = 4;
  const Result linearised = solve_soundly(model, buckling_on(mesh));
  ASSERT_TRUE(linearised.summary.critical_load_factor);
  expect_relative(*linearised.summary.critical_load_factor, kPi * kPi, 1e-8, "linearised");
  EXPECT_EQ(linearised.neutral_motion.size(), 1u);
}

/// The same with an offset in the shape of its buckling mode: the mode is found although the column may
/// slide.
TEST(NeutralMotion, ModeOfAColumnThatMaySlideIsAnImperfection) {
  Model model = straight(1.0, 1.0, 1e6, "y", "y");
  model.loads = {force_at(at_node("a"), 1.0, 0.0), force_at(at_node("b"), -1.0, 0.0)};
  model.imperfections = {ModeImperfection{1, 1e-3}};
  model.monitors = {{"w", at_member("m", 0.5), Component::y}};
  const Result result = solve_soundly(model, static_on({}, Geometry::nonlinear, {0.5 * kPi * kPi}));
  ASSERT_TRUE(result.static_table);
  // w grows to w_0 / (1 - P / P_E), less w_0, to the first order of w_0
  expect_relative(std::abs(result.static_table->monitors[0].values[0]), 1e-3, 1e-3, "offset");
}

/// A free rod between two dead forces that press on it turns over at once; one that they pull is held by
/// them, and may only be shifted.
TEST(NeutralMotion, FreeRodIsTurnedOverByDeadCompressionAndHeldByTension) {
  for (const double pull : {-1.0, 1.0}) {
    Model model = straight(1.0, 1.0, 1e6, "", "");
    model.loads = {force_at(at_node("a"), -pull, 0.0), force_at(at_node("b"), pull, 0.0)};
    const Result result = solve_soundly(model, critical_at(1e-3));
    EXPECT_FALSE(result.summary.critical_load_factor);
    EXPECT_EQ(result.summary.termination, pull > 0.0 ? "load_bound" : "unstable_at_start");
    int shifts = 0;
    for (const NeutralMotion& motion : result.neutral_motion) shifts += motion.to ? 0 : 1;
    EXPECT_EQ(shifts, 2);
  }
}

/// A portal on feet that only press and slide: buckles as one whose left foot is held along the ground.
TEST(NeutralMotion, PortalOnSlidingFeet) {
  const auto portal = [](bool slides) {
    Model model;
    model.nodes = {{"a", 0.0, 0.0}, {"b", 0.0, 1.0}, {"c", 1.0, 1.0}, {"d", 1.0, 0.0}};
    model.sections = {{"s", 1e6, 1.0, {}}};
    model.members = {{"l", "a", "b", "s", LineCurve{}, false, false},
                     {"t", "b", "c", "s", LineCurve{}, false, false},
                     {"r", "c", "d", "s", LineCurve{}, false, false}};
    model.supports = {support("a", slides ? "yr" : "xyr"), support("d", "yr")};
    model.loads = {force_at(at_node("b"), 0.0, -1.0), force_at(at_node("c"), 0.0, -1.0)};
    return model;
  };
  const Result held = solve_soundly(portal(false), critical_at(1e-6));
  const Result slides = solve_soundly(portal(true), critical_at(1e-6));
  ASSERT_TRUE(held.summary.critical_load_factor && slides.summary.critical_load_factor);
  expect_relative(*slides.summary.critical_load_factor, *held.summary.critical_load_factor, 1e-6, "portal");
  EXPECT_TRUE(held.neutral_motion.empty());
  ASSERT_EQ(slides.neutral_motion.size(), 1u);
  expect_translation(slides.neutral_motion[0], 1.0, 0.0, portal(true).nodes);
}

/// What loads drive has no equilibrium: refused before anything is computed.
TEST(NeutralMotion, DrivenMotionIsAMechanism) {
  Model slides = straight(1.0, 1.0, 1e6, "", "");
  slides.foundations = {one_sided("m", 50.0, Side::right)};
  slides.loads = {force_at(at_node("b"), 1e-3, -1.0)};
  Model falls = straight(1.0, 1.0, 1e6, "x", "");
  falls.loads = {force_at(at_node("b"), 0.0, -1.0)};
  for (const Model& model : {slides, falls}) {
    const auto findings = check(model, critical_at(1e-3));
    ASSERT_EQ(findings.size(), 1u);
    EXPECT_EQ(findings[0].code, "mechanism");
  }
}

/// A beam that a load lifts off its bed has no equilibrium, whatever its bed could press.
TEST(NeutralMotion, BeamLiftedOffItsBedFailsWithACode) {
  Model model = straight(1.0, 1.0, 1e6, "x", "");
  model.foundations = {one_sided("m", 50.0, Side::right)};
  model.loads = {DistributedLoad{"m", {0.0, 3.0}, {0.0, 1.0}, LoadMeasure::length, Pattern::proportional}};
  ASSERT_TRUE(check(model, critical_at(1e-3)).empty());
  const Result result = solve(model, critical_at(1e-3));
  ASSERT_TRUE(result.failure);
  EXPECT_EQ(result.failure->code, "not_held") << result.failure->detail;
  EXPECT_FALSE(result.summary.critical_load_factor);
}

}  // namespace
}  // namespace snapthrough
