/// What a result says of stability: the stiffness ratio along a path, the softest point before the critical
/// load, and static analyses whose path loses stability before an asked load factor.
///
/// Sources. A straight pinned column whose members neither stretch nor shear: the motion sin(pi x / L) has
/// the stiffness EI pi^2 / L^2 - P in the metric of displacement gradients (the integral of w'^2), so the
/// ratio is 1 - P / P_E. A crooked one, slope s0 at its ends: with P = P_E (1 + s^2 / 8) along the elastica
/// (s its slope at the ends; Timoshenko and Gere, Theory of Elastic Stability, 2.7) Koiter's expansion gives
/// the stiffness s0 / s + s^2 / 4, least at s^3 = 2 s0, where P = P_E (1 - 3 s^2 / 8) and the ratio is 3 s^2
/// / 4; its error is of the order s^2 of what it is compared with. Frames: loads of their linearised
/// buckling.
#include "tests/verification/cases.h"

namespace snapthrough {
namespace {

using namespace testing;

constexpr double kInextensible = 1e9;

/// L = 1, EI = 1, load factor P / P_E.
Model column(double slope) {
  Model model = straight(1.0, 1.0, kInextensible, "xy", "y");
  model.loads = {force_at(at_node("b"), -kPi * kPi, 0.0)};
  if (slope != 0.0) model.imperfections = {SineImperfection{"m", 1, slope / kPi}};
  return model;
}

Analysis path_to(double load_factor) {
  Analysis analysis = analysis_of(AnalysisType::path, accurate(1e-6));
  analysis.stop.load_factor = {{-1.0, load_factor}};
  analysis.output.states = StateOutput::critical;
  return analysis;
}

bool has_warning(const Result& result, const std::string& code) {
  return std::any_of(result.warnings.begin(), result.warnings.end(),
                     [&](const Warning& warning) { return warning.code == code; });
}

/// Stiffnesses along a path come from one inverse iteration a step, from the motions of the step before.
constexpr double kOfOneIteration = 1e-4;

TEST(StiffnessRatio, OfAStraightColumnFallsLinearlyToItsEulerLoad) {
  const Result result = solve(column(0.0), path_to(0.95));
  const Branch& path = result.branches.at(0);
  ASSERT_GT(path.load_factor.size(), 2U);
  for (const int row : path.computed) {
    const auto i = static_cast<std::size_t>(row);
    ASSERT_TRUE(path.stiffness_ratio.at(i).has_value()) << i;
    EXPECT_NEAR(*path.stiffness_ratio[i], 1.0 - path.load_factor[i], kOfOneIteration) << path.load_factor[i];
  }
  EXPECT_FALSE(has_warning(result, "nearly_unstable"));
}

class CrookedColumn : public ::testing::TestWithParam<double> {};

TEST_P(CrookedColumn, IsSoftestWhereKoitersExpansionHasIt) {
  const double slope = GetParam();
  const double s2 = std::cbrt(2.0 * slope) * std::cbrt(2.0 * slope);
  const Result result = solve(column(slope), path_to(1.05));
  ASSERT_TRUE(result.summary.softest.has_value());
  // the search ends where the least stiffness is known to one per cent
  const double tolerance = s2 * s2 + 0.01 * s2;
  EXPECT_NEAR(result.summary.softest->load_factor, 1.0 - 0.375 * s2, tolerance);
  EXPECT_NEAR(result.summary.softest->stiffness_ratio, 0.75 * s2, tolerance);
  EXPECT_TRUE(has_warning(result, "nearly_unstable"));
  EXPECT_EQ(result.summary.message.rfind("nearly unstable", 0), 0U) << result.summary.message;
  ASSERT_TRUE(result.summary.softest->mode.has_value());
  EXPECT_NEAR(std::abs(result.summary.softest->mode->members.at(0).v.at(50)), 1.0, s2);
}

INSTANTIATE_TEST_SUITE_P(Slopes, CrookedColumn, ::testing::Values(1e-5, 1e-4, 1e-3, 4e-3));

/// Pinned shallow arch of rise 0.05 under a load at its crown: a limit point, without a bifurcation before.
TEST(SoftestPoint, OfAnArchThatSnapsIsItsLimitPoint) {
  Model model = straight(1.0, 1.0, 3e3, "xy", "xy");
  model.members[0].curve = SineCurve{0.05, 1};
  model.loads = {force_at(at_member("m", 0.5), 0.0, -1.0)};
  const Result result = solve(model, analysis_of(AnalysisType::critical, accurate(1e-3)));
  ASSERT_TRUE(result.summary.critical_load_factor.has_value());
  EXPECT_EQ(result.summary.critical_type, CriticalType::limit_max);
  ASSERT_TRUE(result.summary.softest.has_value());
  EXPECT_EQ(result.summary.softest->load_factor, *result.summary.critical_load_factor);
  EXPECT_EQ(result.summary.softest->stiffness_ratio, 0.0);
  EXPECT_FALSE(has_warning(result, "nearly_unstable"));
  ASSERT_TRUE(result.summary.at_critical.has_value());
  EXPECT_GT(result.summary.at_critical->displacement, 0.0);
  EXPECT_LT(result.summary.at_critical->displacement, 0.05);
  EXPECT_GT(result.summary.at_critical->strain, 0.0);
}

/// Three bays of width 1, 1 + a, 1 + 2a on pinned feet, height 1, EI 1, EA 1e4, beams loaded by 1 per length.
Model bays(double a) {
  Model model;
  model.sections = {{"s", 1e4, 1.0, {}}};
  const double x[] = {0.0, 1.0, 2.0 + a, 3.0 + 3.0 * a};
  for (int i = 0; i < 4; ++i) {
    const std::string n = std::to_string(i);
    model.nodes.push_back({"f" + n, x[i], 0.0});
    model.nodes.push_back({"t" + n, x[i], 1.0});
    model.members.push_back({"c" + n, "f" + n, "t" + n, "s", LineCurve{}, false, false});
    model.supports.push_back(support("f" + n, "xy"));
  }
  for (int i = 0; i < 3; ++i) {
    const std::string id = "b" + std::to_string(i);
    model.members.push_back(
        {id, "t" + std::to_string(i), "t" + std::to_string(i + 1), "s", LineCurve{}, false, false});
    model.loads.emplace_back(DistributedLoad{id, {0.0, -1.0}, {0.0, 1.0}, LoadMeasure::length, {}});
  }
  return model;
}

TEST(SoftestPoint, OfAFrameMovesWithItsLackOfSymmetryAndStaysNearTheLinearisedLoad) {
  double last = 0.0;
  for (const double a : {0.0, 0.006, 0.012, 0.018, 0.024, 0.03}) {
    const Result result = solve(bays(a), analysis_of(AnalysisType::critical, accurate(1e-3)));
    ASSERT_TRUE(result.summary.softest.has_value()) << a;
    const double load = result.summary.softest->load_factor;
    if (last > 0.0) {
      EXPECT_LT(std::abs(load / last - 1.0), 0.02) << a;
    }
    last = load;
    EXPECT_EQ(has_warning(result, "nearly_unstable"), a > 0.0) << a;
    const Result linear = solve(bays(a), analysis_of(AnalysisType::buckling, accurate(1e-3)));
    EXPECT_NEAR(load / linear.buckling->load_factors.at(0), 1.0, 0.15) << a;
  }
}

Analysis asked(std::vector<double> factors) {
  Analysis analysis = static_on(accurate(1e-3), Geometry::nonlinear, std::move(factors));
  analysis.output.states = StateOutput::none;
  return analysis;
}

TEST(StaticStability, AColumnBeyondItsEulerLoadIsRefusedFromThereOn) {
  const Result result = solve(column(0.0), asked({0.5, 0.9, 2.0}));
  ASSERT_TRUE(result.failure.has_value());
  EXPECT_EQ(result.failure->code, "beyond_critical_point");
  EXPECT_NE(result.failure->detail.find("member \"m\" buckles"), std::string::npos) << result.failure->detail;
  ASSERT_EQ(result.critical_points.size(), 1U);
  EXPECT_NEAR(result.critical_points[0].load_factor, 1.0, 1e-6);
  EXPECT_EQ(result.critical_points[0].member, "m");
  EXPECT_EQ(result.static_table->load_factor, (std::vector<double>{0.5, 0.9}));
  EXPECT_EQ(result.not_reached, std::vector<double>{2.0});
}

TEST(StaticStability, AColumnBeyondItsEulerLoadIsFollowedWhereThatIsAsked) {
  Analysis analysis = asked({0.5, 2.0, 5.0});
  analysis.unstable = Unstable::follow;
  const Result result = solve(column(0.0), analysis);
  ASSERT_FALSE(result.failure.has_value()) << result.failure->detail;
  ASSERT_EQ(result.static_table->negative_eigenvalues.size(), 3U);
  EXPECT_EQ(result.static_table->negative_eigenvalues[0], 0);
  EXPECT_EQ(result.static_table->negative_eigenvalues[1], 1);
  EXPECT_EQ(result.static_table->negative_eigenvalues[2], 2);
  EXPECT_TRUE(has_warning(result, "unstable"));
}

TEST(StaticStability, RowsBelowTheEulerLoadAreSaidToBeStable) {
  const Result result = solve(column(0.0), asked({0.5, 0.9}));
  ASSERT_FALSE(result.failure.has_value());
  EXPECT_NE(result.summary.message.find("every one stable"), std::string::npos) << result.summary.message;
}

/// A stiff frame, pinned to its columns' heads, with two crossed rods: the one that the sway shortens
/// buckles.
TEST(StaticStability, NamesTheRodThatBuckles) {
  Model model;
  model.nodes = {{"A", 0.0, 0.0}, {"B", 0.0, 4.0}, {"C", 6.0, 4.0}, {"D", 6.0, 0.0}};
  model.sections = {{"f", 2e6, 2e4, {}}, {"rod", 4e4, 1.0, {}}};
  model.members = {{"cl", "A", "B", "f", LineCurve{}, false, false},
                   {"g", "B", "C", "f", LineCurve{}, true, true},
                   {"cr", "D", "C", "f", LineCurve{}, false, false},
                   {"b1", "A", "C", "rod", LineCurve{}, true, true},
                   {"b2", "B", "D", "rod", LineCurve{}, true, true}};
  model.supports = {support("A", "xy"), support("D", "xy")};
  model.loads = {force_at(at_node("B"), 50.0, 0.0)};
  const Result low = solve(model, static_on(accurate(1e-3), Geometry::nonlinear, {0.001}));
  ASSERT_FALSE(low.failure.has_value());
  const double force = -low.states.at(0).members.at(4).axial_force.front() / 0.001;  // by unit load factor
  const double euler = kPi * kPi * 1.0 / 52.0;
  const Result result = solve(model, asked({0.01, 1.0}));
  ASSERT_TRUE(result.failure.has_value());
  EXPECT_EQ(result.failure->code, "beyond_critical_point");
  ASSERT_EQ(result.critical_points.size(), 1U);
  EXPECT_EQ(result.critical_points[0].member, "b2");
  EXPECT_NEAR(result.critical_points[0].load_factor, euler / force, 1e-3 * euler / force);
}

}  // namespace
}  // namespace snapthrough
