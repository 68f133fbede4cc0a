/// Ground that moves under springs and foundations.
///
/// Sources: closed forms of the linear theory, derived at each test; a motion of the whole ground and of all
/// supports, which changes no force; equal states of growing and of constant displacements.
#include <cmath>
#include <string>
#include <vector>

#include "tests/solver/structures.h"
#include "tests/verification/cases.h"

namespace snapthrough {
namespace {

using namespace testing;

Analysis static_at(std::vector<double> factors, Discretization mesh, int points) {
  Analysis analysis = analysis_of(AnalysisType::static_, std::move(mesh));
  analysis.load_factors = std::move(factors);
  analysis.output.states = StateOutput::all;
  analysis.output.points_per_member = points;
  return analysis;
}

/// Half a beam on ground at rest, the other half on ground that rose by D: with b = (K / 4 EI)^(1/4), beside
/// a long fault, w = D/2 (1 + sign(x) (1 - exp(-b|x|) cos bx)) and M = -sign(x) D b^2 EI exp(-b|x|) sin b|x|.
TEST(FaultUnderABeam, BendsItAsTheClosedFormSays) {
  constexpr double kD = 1e-6;
  constexpr double kLength = 40.0;
  constexpr double kb = 1.0;  // K = 4 EI
  Model model = straight(kLength, 1.0, 1e4, "x", "");
  Foundation still = winkler("m", 4.0);
  still.range = {0.0, 0.5};
  Foundation risen = winkler("m", 4.0);
  risen.id = "risen";
  risen.range = {0.5, 1.0};
  risen.displacement = GroundDisplacement{0.0, kD, Pattern::proportional};
  model.foundations = {still, risen};
  const Result result = solve_soundly(model, static_at({1.0}, fixed_mesh(160, 5), 81));
  const MemberState& m = result.states.back().members[0];
  for (std::size_t i = 0; i < m.s.size(); ++i) {
    const double x = m.s[i] - 0.5 * kLength;
    const double size = std::abs(x);
    const double sign = x < 0.0 ? -1.0 : 1.0;
    const double w = 0.5 * kD * (1.0 + sign * (1.0 - std::exp(-kb * size) * std::cos(kb * size)));
    const double moment = -sign * kD * kb * kb * std::exp(-kb * size) * std::sin(kb * size);
    EXPECT_NEAR(m.v[i], w, 1e-7 * kD) << x;
    EXPECT_NEAR(m.bending_moment[i], moment, 1e-7 * kD) << x;
  }
}

/// Pile in ground that settles by g at its head and not at its tip: EA u'' = k (u - g s / L), both ends free,
/// has the largest axial force EA g / L (1 - 1 / cosh(n L / 2)) in the middle, n^2 = k / EA.
TEST(Downdrag, PressesAPileAsTheClosedFormSays) {
  constexpr double kEA = 50.0;
  constexpr double kStiffness = 200.0;
  constexpr double kLength = 2.0;
  constexpr double kg = 1e-7;
  Model model = straight(kLength, 1.0, kEA, "", "");
  model.supports = {support("a", "y"), support("b", "y")};
  Foundation friction = winkler("m", kStiffness);
  friction.component = FoundationComponent::tangent;
  friction.displacement =
      GroundDisplacement{AlongMember({{0.0, 0.0}, {1.0, kg}}), 0.0, Pattern::proportional};
  model.foundations = {friction};
  const Result result = solve_soundly(model, static_at({1.0}, fixed_mesh(16, 5), 3));
  const double n = std::sqrt(kStiffness / kEA);
  const double expected = kEA * kg / kLength * (1.0 - 1.0 / std::cosh(0.5 * n * kLength));
  const MemberState& m = result.states.back().members[0];
  expect_relative(m.axial_force[1], expected, 1e-6, "axial force in the middle");
  EXPECT_NEAR(m.axial_force[0], 0.0, 1e-9 * expected);
}

/// An arch in soil with each kind of support that the ground can move.
Model arch_in_soil(bool outlined, ReactionLaw::Type type) {
  Model model;
  model.nodes = {{"a", -3.0, 0.0}, {"b", 3.0, 0.0}};
  model.sections = {{"s", 1e5, 50.0, {}}};
  model.members = {{"m", "a", "b", "s", ArcCurve{-100.0}, false, false}};
  model.supports = {support("a", "xy"), support("b", "xy")};
  Foundation soil = one_sided("m", 40.0, Side::left);
  if (type != ReactionLaw::Type::linear) {
    soil.law.emplace();
    soil.law->type = type;
    soil.law->stiffness = 40.0;
    soil.law->capacity = 4.0;
    soil.law->points = {{0.05, 2.0}, {0.2, 4.0}, {1.0, 5.0}};
  }
  const double radius = 3.0 / std::sin(50.0 * kPi / 180.0);
  if (outlined)
    soil.outline = CircleOutline{{0.0, -radius * std::cos(50.0 * kPi / 180.0)}, 1.001 * radius, false};
  Spring stop;
  stop.id = "stop";
  stop.at = at_member("m", 0.3);
  stop.direction = {1.0, 0.5};
  stop.stiffness = 20.0;
  stop.reaction = Reaction::compression_only;
  stop.gap = 0.01;
  Spring prop = stop;
  prop.id = "prop";
  prop.at = at_node("a");
  model.foundations = {soil};
  model.springs = {stop, prop};
  model.loads = {force_at(at_member("m", 0.45), 0.0, -10.0)};
  return model;
}

/// Moves the ground and all supports of a model by the same displacement.
Model moved(Model model, double x, double y) {
  const PrescribedDisplacement shift{x, y, 0.0, Pattern::constant};
  for (Support& one : model.supports) one.displacement = shift;
  for (Spring& one : model.springs) one.displacement = shift;
  for (Foundation& one : model.foundations)
    one.displacement = GroundDisplacement{x, AlongMember({{0.0, y}, {1.0, y}}), Pattern::constant};
  return model;
}

TEST(GroundThatMovesWithAllSupports, ChangesNoCriticalLoad) {
  for (const bool outlined : {false, true}) {
    for (const auto type : {ReactionLaw::Type::linear, ReactionLaw::Type::tanh, ReactionLaw::Type::table}) {
      const Model model = arch_in_soil(outlined, type);
      const Analysis analysis = analysis_of(AnalysisType::critical, fixed_mesh(24, 4));
      const Result still = solve_soundly(model, analysis);
      const Result shifted = solve_soundly(moved(model, 0.3, -0.2), analysis);
      ASSERT_TRUE(still.summary.critical_load_factor && shifted.summary.critical_load_factor) << outlined;
      // rounding of displacements that are larger by a shift of 0.4
      expect_relative(*shifted.summary.critical_load_factor, *still.summary.critical_load_factor, 1e-9,
                      std::string(outlined ? "outline " : "plain ") + std::to_string(static_cast<int>(type)));
      // zones that touch without pressure do not change from step to step, which would cut the steps
      EXPECT_LE(shifted.diagnostics.steps, 2 * still.diagnostics.steps) << outlined;
    }
  }
}

TEST(GroundThatMovesWithAllSupports, ChangesNoBucklingLoad) {
  Model model = arch_in_soil(false, ReactionLaw::Type::linear);
  model.foundations[0].reaction = Reaction::bilateral;
  model.springs.clear();
  const Result still = solve_soundly(model, buckling_on(fixed_mesh(24, 4), 3));
  const Result shifted = solve_soundly(moved(model, 1e-3, -2e-3), buckling_on(fixed_mesh(24, 4), 3));
  ASSERT_TRUE(still.buckling && shifted.buckling);
  ASSERT_EQ(still.buckling->load_factors.size(), 3u);
  ASSERT_EQ(shifted.buckling->load_factors.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i)
    expect_relative(shifted.buckling->load_factors[i], still.buckling->load_factors[i], 1e-9, "mode");
}

/// A beam under its weight on one-sided ground, of which a part settles.
Model beam_over_trough(double settlement, Pattern pattern) {
  Model model = straight(20.0, 1.0, 1e4, "x", "");
  Foundation bed = winkler("m", 4.0);
  bed.reaction = Reaction::compression_only;
  bed.direction = {0.0, -1.0};
  bed.displacement = GroundDisplacement{
      0.0, AlongMember({{0.3, 0.0}, {0.4, -settlement}, {0.7, -settlement}, {0.8, 0.0}}), pattern};
  model.foundations = {bed};
  DistributedLoad weight;
  weight.member = "m";
  weight.force = {0.0, -0.5};
  weight.pattern = Pattern::constant;
  model.loads = {weight};
  return model;
}

TEST(TroughUnderABeam, ThatGrowsAndOneThatIsThereGiveTheSameState) {
  const Discretization mesh = fixed_mesh(40, 4);
  const Result grown =
      solve_soundly(beam_over_trough(1.0, Pattern::proportional), static_at({0.5, 2.0}, mesh, 21));
  ASSERT_EQ(grown.states.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    const double settlement = i == 0 ? 0.5 : 2.0;
    const Result there =
        solve_soundly(beam_over_trough(settlement, Pattern::constant), static_at({0.0}, mesh, 21));
    const MemberState& one = grown.states[i].members[0];
    const MemberState& other = there.states.back().members[0];
    for (std::size_t k = 0; k < one.s.size(); ++k) {
      EXPECT_NEAR(one.v[k], other.v[k], 1e-9 * settlement) << settlement << " " << one.s[k];
      EXPECT_NEAR(one.bending_moment[k], other.bending_moment[k], 1e-8) << settlement << " " << one.s[k];
    }
    if (i == 1) {
      EXPECT_GE(grown.states[i].foundations[0].contact.size(), 2u) << "the beam bridges its slopes";
    }
  }
}

/// Without proportional loads, and with no section force, residuals are relative to the constant loads.
TEST(WeightOnAUniformBed, SinksByItsPressureOverTheStiffness) {
  Model model = beam_over_trough(0.0, Pattern::constant);
  model.foundations[0].displacement = std::nullopt;
  const Result result = solve_soundly(model, static_at({0.0}, fixed_mesh(8, 4), 5));
  for (const double v : result.states.back().members[0].v) EXPECT_NEAR(v, -0.125, 1e-12);
}

/// A cantilever whose tip a spring pulls by the ground's displacement d: F = d / (1 / k + L^3 / 3 EI), and
/// its rotational twin M = d / (1 / k + L / EI).
TEST(GroundUnderASpring, LoadsACantilever) {
  for (const bool at_a_node : {true, false}) {
    Model model = straight(2.0, 5.0, 1e6, "xyr", "");
    Spring spring;
    spring.id = "k";
    spring.at = at_a_node ? at_node("b") : at_member("m", 1.0);
    spring.direction = {0.0, 1.0};
    spring.stiffness = 3.0;
    spring.displacement = PrescribedDisplacement{0.0, 1e-7, 0.0, Pattern::proportional};
    model.springs = {spring};
    const Result pulled = solve_soundly(model, static_at({1.0}, fixed_mesh(2, 4), 2));
    expect_relative(pulled.states.back().springs[0].force, -1e-7 / (1.0 / 3.0 + 8.0 / 15.0), 1e-9, "force");
    model.springs[0].direction = std::nullopt;
    model.springs[0].displacement = PrescribedDisplacement{0.0, 0.0, 1e-7, Pattern::proportional};
    const Result turned = solve_soundly(model, static_at({1.0}, fixed_mesh(2, 4), 2));
    expect_relative(turned.states.back().springs[0].force, -1e-7 / (1.0 / 3.0 + 2.0 / 5.0), 1e-9, "moment");
  }
}

}  // namespace
}  // namespace snapthrough
