/// Statically determinate structures that are strained or settled only: no forces, and displacements that
/// kinematics alone gives. The expectations are closed forms: a bar of constant curvature is a circular arc,
/// a structure whose support sinks turns as a rigid body.
#include "tests/verification/cases.h"

namespace snapthrough {
namespace {

using namespace testing;

/// Simply supported, of two members, warmer below than above: length 10, curvature 6e-4 at load factor 1.
Model beam_with_gradient(Pattern pattern) {
  Model model;
  model.nodes = {{"A", 0.0, 0.0}, {"M", 5.0, 0.0}, {"B", 10.0, 0.0}};
  model.sections = {{"s", 4e6, 6e4, {}}};
  model.members = {{"l", "A", "M", "s", LineCurve{}, false, false},
                   {"r", "M", "B", "s", LineCurve{}, false, false}};
  model.supports = {support("A", "xy"), support("B", "y")};
  model.loads = {InitialStrain{"l", 0.0, 6e-4, pattern}, InitialStrain{"r", 0.0, 6e-4, pattern}};
  model.monitors = {{"mid", at_node("M"), Component::y}, {"end", at_node("B"), Component::x}};
  return model;
}

/// Clamped at "A", of two members: length 2, curvatures 1 and 2, elongation 0.01.
Model cantilever() {
  Model model;
  model.nodes = {{"A", 0.0, 0.0}, {"M", 1.0, 0.0}, {"B", 2.0, 0.0}};
  model.sections = {{"s", 1e6, 1.0, {}}};
  model.members = {{"l", "A", "M", "s", LineCurve{}, false, false},
                   {"r", "M", "B", "s", LineCurve{}, false, false}};
  model.supports = {support("A", "xyr")};
  model.loads = {InitialStrain{"l", 0.01, 1.0, Pattern::proportional},
                 InitialStrain{"r", 0.01, 2.0, Pattern::proportional}};
  model.monitors = {{"u", at_node("B"), Component::x},
                    {"v", at_node("B"), Component::y},
                    {"turn", at_node("B"), Component::rotation}};
  return model;
}

/// Portal of height 4 and width 6 whose roller sinks.
Model portal(double settlement, Pattern pattern) {
  Model model;
  model.nodes = {{"A", 0.0, 0.0}, {"B", 0.0, 4.0}, {"C", 6.0, 4.0}, {"D", 6.0, 0.0}};
  model.sections = {{"s", 1e6, 1e4, {}}};
  model.members = {{"1", "A", "B", "s", LineCurve{}, false, false},
                   {"2", "B", "C", "s", LineCurve{}, false, false},
                   {"3", "C", "D", "s", LineCurve{}, false, false}};
  model.supports = {support("A", "xy"), support("D", "y")};
  model.supports[1].displacement = PrescribedDisplacement{0.0, -settlement, 0.0, pattern};
  model.monitors = {{"roller", at_node("D"), Component::x},
                    {"beam", at_node("B"), Component::x},
                    {"turn", at_node("C"), Component::rotation}};
  return model;
}

Analysis equilibrium(Geometry geometry, std::vector<double> load_factors) {
  Analysis analysis;
  analysis.type = AnalysisType::static_;
  analysis.geometry = geometry;
  analysis.load_factors = std::move(load_factors);
  analysis.output.states = StateOutput::all;
  return analysis;
}

double largest(const std::vector<double>& values) {
  double out = 0.0;
  for (const double value : values) out = std::max(out, std::abs(value));
  return out;
}

/// @param scale force that counts
void expect_no_forces(const Result& result, double scale) {
  ASSERT_FALSE(result.states.empty());
  for (const State& state : result.states) {
    for (const MemberState& member : state.members) {
      EXPECT_LT(largest(member.axial_force), 1e-9 * scale);
      EXPECT_LT(largest(member.shear_force), 1e-9 * scale);
      EXPECT_LT(largest(member.bending_moment), 1e-9 * scale);
    }
    for (const SupportState& reaction : state.supports)
      EXPECT_LT(largest({reaction.fx, reaction.fy, reaction.moment}), 1e-9 * scale);
  }
}

double at_monitor(const Result& result, std::size_t monitor, std::size_t row) {
  return result.static_table->monitors.at(monitor).values.at(row);
}

TEST(Determinate, BeamWithATemperatureGradientIsAnArc) {
  for (const Pattern pattern : {Pattern::proportional, Pattern::constant}) {
    const Result result =
        solve(beam_with_gradient(pattern), equilibrium(Geometry::nonlinear, {0.0, 0.5, 1.0, 40.0}));
    ASSERT_FALSE(result.failure) << result.failure->detail;
    expect_no_forces(result, 6e4 * 6e-4);
    const std::vector<double> factors{0.0, 0.5, 1.0, 40.0};
    for (std::size_t i = 0; i < factors.size(); ++i) {
      const double k = 6e-4 * (pattern == Pattern::constant ? 1.0 : factors[i]);
      // the middle of the arc hangs below its chord, as a positive curvature turns to the left
      const double mid = k == 0.0 ? 0.0 : -(1.0 - std::cos(5.0 * k)) / k;
      const double end = k == 0.0 ? 0.0 : 2.0 * std::sin(5.0 * k) / k - 10.0;
      EXPECT_NEAR(at_monitor(result, 0, i), mid, 1e-10 * std::max(10.0 * k, 1e-3)) << factors[i];
      // of second order in the curvature: equilibrium is corrected to some 1e-13 of the length, 10
      EXPECT_NEAR(at_monitor(result, 1, i), end, 1e-10 * 10.0) << factors[i];
    }
  }
}

TEST(Determinate, CantileverIsARowOfArcs) {
  Analysis analysis = equilibrium(Geometry::nonlinear, {0.1, 1.0, 2.0});
  analysis.discretization = fixed_mesh(8, 8);
  const Result result = solve(cantilever(), analysis);
  ASSERT_FALSE(result.failure) << result.failure->detail;
  expect_no_forces(result, 1.0);
  for (std::size_t i = 0; i < analysis.load_factors.size(); ++i) {
    const double t = analysis.load_factors[i];
    const double stretch = 1.0 + 0.01 * t;
    const double u = stretch * (std::sin(t) / t + (std::sin(3.0 * t) - std::sin(t)) / (2.0 * t)) - 2.0;
    const double v = stretch * ((1.0 - std::cos(t)) / t + (std::cos(t) - std::cos(3.0 * t)) / (2.0 * t));
    EXPECT_NEAR(at_monitor(result, 0, i), u, 1e-10);
    EXPECT_NEAR(at_monitor(result, 1, i), v, 1e-10);
    EXPECT_NEAR(at_monitor(result, 2, i), 3.0 * t, 1e-10);
  }
}

TEST(Determinate, SmallDisplacementsOfACantileverAreTheIntegralOfItsCurvature) {
  const Result result = solve(cantilever(), equilibrium(Geometry::linear, {1.0}));
  ASSERT_FALSE(result.failure) << result.failure->detail;
  expect_no_forces(result, 1.0);
  EXPECT_NEAR(at_monitor(result, 0, 0), 0.02, 1e-12);
  EXPECT_NEAR(at_monitor(result, 1, 0), 1.0 * 1.5 + 2.0 * 0.5, 1e-12);
  EXPECT_NEAR(at_monitor(result, 2, 0), 3.0, 1e-12);
}

TEST(Determinate, PortalTurnsAsItsRollerSinks) {
  for (const Pattern pattern : {Pattern::proportional, Pattern::constant}) {
    for (const double settlement : {1e-9, 0.02, 3.0}) {
      const Result result = solve(portal(settlement, pattern), equilibrium(Geometry::nonlinear, {1.0}));
      ASSERT_FALSE(result.failure) << result.failure->detail;
      expect_no_forces(result, 1e4 / 36.0 * settlement / 6.0);
      const double turn = -std::asin(settlement / 6.0);
      const double half = std::sin(0.5 * turn);
      EXPECT_NEAR(at_monitor(result, 0, 0), -12.0 * half * half, 1e-10 * settlement);
      EXPECT_NEAR(at_monitor(result, 1, 0), -4.0 * std::sin(turn), 1e-10 * settlement);
      EXPECT_NEAR(at_monitor(result, 2, 0), turn, 1e-10 * settlement);
    }
  }
  const Result small = solve(portal(0.02, Pattern::proportional), equilibrium(Geometry::linear, {1.0}));
  ASSERT_FALSE(small.failure) << small.failure->detail;
  EXPECT_NEAR(at_monitor(small, 1, 0), 4.0 * 0.02 / 6.0, 1e-12);
}

/// Its tip moves by P L^3 / 3 EI from where it is without the load, however little that is.
TEST(Determinate, ALoadOfAnySizeMovesTheSettledStructureInProportion) {
  Model model = straight(2.0, 1.0, 1e6, "xyr", "");
  model.supports[0].displacement = PrescribedDisplacement{0.0, 0.125, 0.0, Pattern::constant};
  model.monitors = {{"tip", at_node("b"), Component::y}};
  for (const double load : {1e-15, 1e-12, 1e-9, 1e-6, 1e-4}) {
    model.loads = {force_at(at_node("b"), 0.0, load)};
    const Result result = solve(model, equilibrium(Geometry::nonlinear, {0.5, 1.0}));
    ASSERT_FALSE(result.failure) << load << ": " << result.failure->detail;
    const double moved = at_monitor(result, 0, 1) - 0.125;
    EXPECT_NEAR(moved, load * 8.0 / 3.0, 1e-15 + 1e-5 * load * 8.0 / 3.0) << load;
  }
}

TEST(Determinate, NoLoadIsCriticalWithoutForces) {
  for (const Model& model : {cantilever(), beam_with_gradient(Pattern::proportional)}) {
    Analysis analysis;
    analysis.type = AnalysisType::critical;
    const Result critical = solve(model, analysis);
    ASSERT_FALSE(critical.failure) << critical.failure->detail;
    EXPECT_EQ(critical.summary.termination, "displacement_bound");
    EXPECT_FALSE(critical.summary.critical_load_factor);
    analysis.type = AnalysisType::buckling;
    const Result buckling = solve(model, analysis);
    ASSERT_FALSE(buckling.failure) << buckling.failure->detail;
    EXPECT_EQ(buckling.summary.termination, "no_buckling");
  }
}

}  // namespace
}  // namespace snapthrough
