/// Reactions and spring forces of linear structures against closed forms, to 1e-9.
///
/// Propped cantilever and beam on springs: Timoshenko and Gere, Mechanics of Materials, redundant beams.
/// Two-hinged arch: Castigliano's theorem with bending and axial strain energy, integrals of sines and
/// cosines.
#include "tests/reaction_sum.h"
#include "tests/verification/cases.h"

namespace snapthrough {
namespace {

using namespace testing;

constexpr double kTolerance = 1e-9;

const SupportState& support_of(const State& state, const std::string& node) {
  return *std::find_if(state.supports.begin(), state.supports.end(),
                       [&node](const SupportState& s) { return s.node == node; });
}

/// Uniform load q down: 5/8 q L and q L^2 / 8 at the clamped end, 3/8 q L at the prop.
TEST(Reactions, OfAProppedCantilever) {
  const double L = 3.0;
  const double q = 2.0;
  Model model = straight(L, 7.0, 1e4, "xyr", "y");
  model.loads = {DistributedLoad{"m", {0.0, -q}, {0.0, 1.0}, LoadMeasure::length, Pattern::proportional}};
  const Result result = solve_soundly(model, static_on(fixed_mesh(2, 4), Geometry::linear, {1.0, -2.0}));
  ASSERT_EQ(result.states.size(), 2u);
  for (const State& state : result.states) {
    const double load = q * state.load_factor;
    expect_relative(support_of(state, "a").fy, 5.0 / 8.0 * load * L, kTolerance, "force at the clamped end");
    expect_relative(support_of(state, "a").moment, load * L * L / 8.0, kTolerance, "clamping moment");
    expect_relative(support_of(state, "b").fy, 3.0 / 8.0 * load * L, kTolerance, "force of the prop");
    EXPECT_EQ(support_of(state, "b").fx, 0.0);
    EXPECT_EQ(support_of(state, "b").moment, 0.0);
    expect_relative(state.loads.fy, -load * L, kTolerance, "load");
    expect_relative(state.loads.moment, -load * L * L / 2.0, kTolerance, "moment of the load");
  }
}

/// The prop inclined by 30 degrees: its reaction is along its own y axis, the clamped end takes the rest.
TEST(Reactions, OfAnInclinedProp) {
  Model model = straight(3.0, 7.0, 1e4, "xyr", "");
  model.supports.push_back(support("b", "y", 30.0));
  model.loads = {force_at(at_member("m", 0.5), 0.0, -1.0)};
  const State state = solve_soundly(model, static_on(fixed_mesh(2, 4), Geometry::linear)).states.at(0);
  const SupportState& prop = support_of(state, "b");
  EXPECT_GT(prop.fy, 0.1);
  expect_relative(prop.fx, -std::tan(kPi / 6.0) * prop.fy, kTolerance, "direction of the prop");
  expect_relative(support_of(state, "a").fx, -prop.fx, kTolerance, "thrust");
}

/// Thrust H = (int M0 y / EI - int V sin cos / EA) / (int y^2 / EI + int cos^2 / EA) over one half.
TEST(Reactions, OfATwoHingedArch) {
  constexpr double kSweep = 100.0;
  const double alpha = 0.5 * kSweep * kPi / 180.0;
  const double R = 100.0;
  const double EI = 1.4e4;
  const double EA = 50.0;
  const double P = EI / 1e4;
  Model model = arch(kSweep, EA, EI);
  const State state = solve_soundly(model, static_on(fixed_mesh(8, 8), Geometry::linear)).states.at(0);
  const double sin = std::sin(alpha);
  const double cos = std::cos(alpha);
  const double squares = alpha / 2.0 + std::sin(2.0 * alpha) / 4.0;
  const double bending =
      P * R * R * R / (2.0 * EI) * (sin * sin / 2.0 - alpha * sin * cos + cos * (1.0 - cos));
  const double axial = P * R / (2.0 * EA) * sin * sin / 2.0;
  const double H = (bending - axial) /
                   (R * R * R / EI * (squares - 2.0 * sin * cos + alpha * cos * cos) + R / EA * squares);
  expect_relative(support_of(state, "a").fx, H, kTolerance, "thrust at the start");
  expect_relative(support_of(state, "b").fx, -H, kTolerance, "thrust at the end");
  expect_relative(support_of(state, "a").fy, P / 2.0, kTolerance, "half the load");
  expect_relative(support_of(state, "b").fy, P / 2.0, kTolerance, "half the load");
}

/// Beam of length 2 l on three equal springs, load in the middle: what bends lifts load off the middle one.
TEST(Reactions, OfABeamOnSprings) {
  const double length = 4.0;
  const double EI = 3.0;
  const double k = 0.9;
  const double P = 2.5;
  for (const Reaction reaction : {Reaction::bilateral, Reaction::compression_only}) {
    Model model = straight(length, EI, 1e4, "x", "");
    const double gap = reaction == Reaction::bilateral ? 0.0 : 0.125;
    for (const auto& [id, at] : {std::pair{"left", at_node("a")}, std::pair{"middle", at_member("m", 0.5)},
                                 std::pair{"right", at_node("b")}})
      model.springs.push_back({id, at, std::array{0.0, -3.0}, k, reaction, gap});
    model.loads = {force_at(at_member("m", 0.5), 0.0, -P)};
    const Result result = solve_soundly(model, static_on(fixed_mesh(2, 4), Geometry::linear));
    const State& state = result.states.at(0);
    const double flexible = 1.0 / (2.0 * k) + length * length * length / (48.0 * EI);
    const double middle = P * flexible / (1.0 / k + flexible);
    const double force[] = {0.5 * (P - middle), middle, 0.5 * (P - middle)};
    for (std::size_t i = 0; i < 3; ++i) {
      const SpringState& spring = state.springs.at(i);
      expect_relative(spring.force, force[i], kTolerance, spring.id);
      expect_relative(spring.displacement, force[i] / k + gap, kTolerance, spring.id);
      EXPECT_TRUE(spring.closed);
      expect_relative(spring.resultant.fy, force[i], kTolerance, spring.id);
    }
    expect_relative(state.springs[2].resultant.moment, length * force[2], kTolerance, "about the origin");
  }
}

/// Signs of one-sided springs: a push is positive, a pull negative, and an open one is told.
TEST(Reactions, OfOneSidedSpringsHaveTheMediumsSign) {
  Model model = straight(2.0, 1.0, 1e4, "xy", "");
  model.springs = {{"push", at_node("b"), std::array{0.0, -1.0}, 5.0, Reaction::compression_only, 0.0},
                   {"pull", at_node("b"), std::array{0.0, 1.0}, 5.0, Reaction::tension_only, 0.0},
                   {"open", at_node("b"), std::array{0.0, 1.0}, 5.0, Reaction::compression_only, 0.0},
                   {"none", at_node("b"), std::array{0.0, 1.0}, 0.0, Reaction::bilateral, 0.0},
                   {"turn", at_node("a"), {}, 4.0, Reaction::bilateral, 0.0}};
  model.loads = {force_at(at_node("b"), 0.0, -1.0)};
  const State state = solve_soundly(model, static_on(fixed_mesh(1, 3), Geometry::linear)).states.at(0);
  EXPECT_GT(state.springs[0].force, 0.1);
  expect_relative(state.springs[1].force, -state.springs[0].force, kTolerance, "pull");
  EXPECT_EQ(state.springs[2].force, 0.0);
  EXPECT_LT(state.springs[2].displacement, -0.01);
  const bool closed[] = {true, true, false, false, true};
  for (std::size_t i = 0; i < 5; ++i) EXPECT_EQ(state.springs[i].closed, closed[i]) << state.springs[i].id;
  expect_relative(state.springs[4].force, 4.0 * state.springs[4].displacement, kTolerance, "couple");
  EXPECT_LT(reaction_sum(model, state, Geometry::linear).imbalance(), 1e-12);
}

/// The base's resultant and its displacement: a rigid block of a beam on Winkler soil sinks by q / K.
TEST(Reactions, OfABaseUnderAnEvenLoad) {
  const double K = 5.0;
  const double q = 0.3;
  const double L = 2.0;
  Model model = straight(L, 1e3, 1e4, "x", "");
  Foundation soil = one_sided("m", K, Side::right);
  soil.gap = 0.01;
  model.foundations = {soil};
  model.loads = {DistributedLoad{"m", {0.0, -q}, {0.0, 1.0}, LoadMeasure::length, Pattern::proportional}};
  const State state = solve_soundly(model, static_on(fixed_mesh(2, 2), Geometry::linear)).states.at(0);
  const FoundationState& base = state.foundations.at(0);
  for (const double w : base.displacement) expect_relative(w, q / K + soil.gap, kTolerance, "sinks");
  for (const double r : base.reaction) expect_relative(r, q, kTolerance, "reaction");
  expect_relative(base.resultant.fy, q * L, kTolerance, "resultant");
  expect_relative(base.resultant.moment, q * L * L / 2.0, kTolerance, "its moment");
}

/// Far from the origin, moments are about the origin all the same.
TEST(Reactions, AreAboutTheOriginOfTheAxes) {
  Model model = straight(3.0, 7.0, 1e4, "xyr", "");
  for (Node& node : model.nodes) {
    node.x += 20.0;
    node.y -= 30.0;
  }
  model.loads = {force_at(at_node("b"), 0.5, -1.0, 0.25)};
  const State state = solve_soundly(model, static_on(fixed_mesh(2, 4), Geometry::linear)).states.at(0);
  expect_relative(state.loads.moment, 23.0 * -1.0 + 30.0 * 0.5 + 0.25, kTolerance, "about the origin");
  expect_relative(support_of(state, "a").moment, 3.0 - 0.25, kTolerance, "about the node");
  EXPECT_LT(reaction_sum(model, state, Geometry::linear).imbalance(), 1e-12);
}

}  // namespace
}  // namespace snapthrough
