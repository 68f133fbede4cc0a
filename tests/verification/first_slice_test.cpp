/// Critical loads and paths of the first models that were solved end to end, against converged and
/// closed-form values.
///
/// Sources. Arches: L. Camelo Santos, master thesis, UFOP 2016, section 4.4.1 (R = 100, 20 degrees in all,
/// pinned, EI = 1.4, EA = 420); the converged values come from collocation of the boundary-value problem with
/// the contact edge as an unknown. Deep arch: DaDeppo and Schmidt's 215 degrees, clamped and hinged,
/// converged 8.97294947594 (EA R^2/EI = 1e6). Column: annex A of the thesis, P_cr = (pi^2 EI / L^2)(1 + k), k
/// = K L^4 / (pi^4 EI).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "solver/solve.h"
#include "tests/solver/structures.h"

namespace snapthrough {
namespace {

using testing::fixed_mesh;

Analysis critical() {
  Analysis analysis;
  analysis.output.states = StateOutput::none;
  analysis.discretization.accuracy = 1e-4;
  return analysis;
}

Analysis path_of_limit_points(int n) {
  Analysis analysis = critical();
  analysis.type = AnalysisType::path;
  analysis.stop.limit_points = n;
  return analysis;
}

struct ArchCase {
  double k;
  CriticalType type;
  double load;
};

class ShallowArch : public ::testing::TestWithParam<ArchCase> {};

TEST_P(ShallowArch, LosesStabilityAtTheConvergedLoad) {
  Model model = testing::arch(20.0, 420.0, 1.4);
  if (GetParam().k > 0.0) testing::add_soil(model, GetParam().k);
  const Result result = solve(model, critical());
  ASSERT_TRUE(result.summary.critical_load_factor);
  EXPECT_EQ(*result.summary.critical_type, GetParam().type);
  EXPECT_NEAR(*result.summary.critical_load_factor, GetParam().load, 1e-4 * GetParam().load);
  ASSERT_TRUE(result.summary.error_estimate);
  EXPECT_LE(*result.summary.error_estimate, 1e-4);
}

INSTANTIATE_TEST_SUITE_P(Thesis441, ShallowArch,
                         ::testing::Values(ArchCase{0.0, CriticalType::bifurcation, 66.2628147402},
                                           ArchCase{1e5, CriticalType::bifurcation, 75.6646754064},
                                           ArchCase{1e6, CriticalType::limit_max, 74.9673},
                                           ArchCase{1e7, CriticalType::limit_max, 93.1178142194},
                                           ArchCase{1e8, CriticalType::limit_max, 101.5530},
                                           ArchCase{1e9, CriticalType::limit_max, 102.9341234421},
                                           ArchCase{1e10, CriticalType::limit_max, 103.151},
                                           ArchCase{1e11, CriticalType::limit_max, 103.186}));

TEST(ShallowArchPath, ReportsBifurcationsAndLimitPointsInOrder) {
  const Result result = solve(testing::arch(20.0, 420.0, 1.4), path_of_limit_points(2));
  ASSERT_EQ(result.critical_points.size(), 4u);
  const double loads[] = {66.2628147402, 76.1493461733, -200.043, -214.66203};
  const CriticalType types[] = {CriticalType::bifurcation, CriticalType::limit_max, CriticalType::bifurcation,
                                CriticalType::limit_min};
  for (int i = 0; i < 4; ++i) {
    EXPECT_EQ(result.critical_points[i].type, types[i]) << i;
    EXPECT_NEAR(result.critical_points[i].load_factor, loads[i], 1e-4 * std::abs(loads[i])) << i;
    EXPECT_EQ(result.critical_points[i].negative_after, i + 1);
  }
  // crown displacement at the first limit point, over the rise R (1 - cos 10 deg): 0.47462370
  const double rise = 100.0 * (1.0 - std::cos(std::numbers::pi / 18.0));
  EXPECT_NEAR(-result.critical_points[1].monitors[0].value / rise, 0.47462370, 1e-4);
}

/// The path through the bifurcation at 66.2628 leaves the symmetric shapes, crosses them once more upside
/// down, and comes back to where it began: one closed path, the two ways round it mirror images.
TEST(ShallowArchPath, SecondaryPathRejoins) {
  Analysis analysis = path_of_limit_points(2);
  analysis.branches.follow = Follow::first;
  const Result result = solve(testing::arch(20.0, 420.0, 1.4), analysis);
  ASSERT_EQ(result.branches.size(), 3u);
  for (const int id : {1, 2}) {
    const Branch& branch = result.branches[id];
    EXPECT_EQ(branch.parent, 0);
    EXPECT_NEAR(branch.load_factor.front(), 66.2628147402, 1e-4 * 66.26);
    EXPECT_NEAR(branch.load_factor.back(), 66.2628147402, 1e-4 * 66.26);
    int crossings = 0;
    for (const CriticalPoint& point : result.critical_points) {
      if (point.branch != id) continue;
      EXPECT_EQ(point.type, CriticalType::bifurcation);
      EXPECT_EQ(point.negative_before, point.negative_after);
      ++crossings;
    }
    EXPECT_EQ(crossings, 1);
  }
  EXPECT_NEAR(*result.summary.critical_load_factor, 66.2628147402, 1e-4 * 66.26) << "of the primary path";
}

/// Base inside: thesis 4.4.2, converged maximum, bifurcation and minimum.
TEST(ShallowArchPath, OnABaseInsideHasItsMaximumAndMinimum) {
  Model model = testing::arch(20.0, 420.0, 1.4);
  testing::add_soil(model, 2.5e4, Side::right);
  const Result result = solve(model, path_of_limit_points(2));
  ASSERT_EQ(result.critical_points.size(), 3u);
  EXPECT_NEAR(result.critical_points[0].load_factor, 83.443711, 1e-4 * 83.4);
  EXPECT_NEAR(result.critical_points[1].load_factor, 98.264666, 1e-4 * 98.3);
  EXPECT_NEAR(result.critical_points[2].load_factor, 67.625206, 1e-4 * 67.6);
  EXPECT_EQ(result.critical_points[2].type, CriticalType::limit_min);
}

TEST(DeepArch, LimitLoadOnSixteenElementsOfOrderThree) {
  Analysis analysis = path_of_limit_points(1);
  analysis.discretization = fixed_mesh(16, 3);
  const Result result = solve(testing::arch(215.0, 1e8, 1e6, true), analysis);
  ASSERT_TRUE(result.summary.critical_load_factor);
  EXPECT_NEAR(*result.summary.critical_load_factor, 8.97294947594, 1e-4 * 8.97);
  EXPECT_EQ(result.discretization.unknowns, 142) << "3 (16 * 3 - 1) nodal unknowns and one hinge rotation";
}

constexpr double kEuler = std::numbers::pi * std::numbers::pi * 100.0 / 25.0;

/// The perfect column bifurcates at the closed form; EA = 1e12 is the inextensible limit, EA L^2 / EI
/// = 2.5e11.
TEST(ColumnOnWinklerBase, PerfectColumnBifurcatesAtTheClosedForm) {
  const double k = 10.0 * std::pow(5.0, 4) / (std::pow(std::numbers::pi, 4) * 100.0);
  Analysis analysis = critical();
  analysis.discretization = fixed_mesh(8, 5);
  const Result result = solve(testing::column(5.0, 100.0, 1e12, 10.0), analysis);
  ASSERT_TRUE(result.summary.critical_load_factor);
  EXPECT_EQ(*result.summary.critical_type, CriticalType::bifurcation);
  EXPECT_NEAR(*result.summary.critical_load_factor, kEuler * (1.0 + k), 1e-8 * 64.8);
}

struct Deflection {
  double amplitude;
  double w;
  double load;       ///< of the perfect column at that deflection
  double tolerance;  ///< relative
};

/// Post-buckling loads of the perfect column at mid deflections 0.5 and 1.0: 64.3590 and 63.0281. A
/// stress-free offset a lowers them by the factor w / (w + a) to leading order (the bending moment grows by P
/// a, the resistance does not).
class ColumnPath : public ::testing::TestWithParam<Deflection> {};

TEST_P(ColumnPath, PassesTheDeflectionAtItsLoad) {
  const Deflection c = GetParam();
  Model model = testing::column(5.0, 100.0, 1e12, 10.0);
  model.imperfections = {SineImperfection{"column", 1, c.amplitude}};
  Analysis analysis = critical();
  analysis.type = AnalysisType::path;
  analysis.stop.monitor = MonitorRange{"mid", {-c.w, c.w}};
  const Result result = solve(model, analysis);
  ASSERT_EQ(result.summary.termination, "monitor");
  const Branch& branch = result.branches.front();
  EXPECT_NEAR(branch.monitors[0].values.back(), c.w, 1e-9);
  const double expected = c.load * c.w / (c.w + c.amplitude);
  EXPECT_NEAR(branch.load_factor.back(), expected, c.tolerance * expected);
  for (const CriticalPoint& point : result.critical_points)
    EXPECT_NE(point.type, CriticalType::bifurcation) << "an imperfect column has none";
  // levels off: the maximum is Koiter's, below the closed form by no more than the offset explains
  const auto limit = std::find_if(result.critical_points.begin(), result.critical_points.end(),
                                  [](const CriticalPoint& point) { return is_limit(point.type); });
  ASSERT_NE(limit, result.critical_points.end());
  EXPECT_EQ(limit->type, CriticalType::limit_max);
  EXPECT_LT(limit->load_factor, 64.808714);
}

INSTANTIATE_TEST_SUITE_P(
    Amplitudes, ColumnPath,
    ::testing::Values(Deflection{1e-4, 0.5, 64.3590, 1e-5}, Deflection{1e-4, 1.0, 63.0281, 1e-5},
                      Deflection{1e-6, 0.5, 64.3590, 5e-6}, Deflection{1e-6, 1.0, 63.0281, 5e-6},
                      Deflection{1e-9, 0.5, 64.3590, 5e-6}, Deflection{1e-12, 1.0, 63.0281, 5e-6}));

/// Levels off at 64.8087 within 1e-3 relative for amplitudes up to 5e-5 (at 1e-4 Koiter's knock-down
/// is 1.23e-3).
TEST(ColumnOnWinklerBase, ImperfectPathLevelsOffAtTheClosedForm) {
  Model model = testing::column(5.0, 100.0, 1e12, 10.0);
  for (const double amplitude : {5e-5, 1e-6}) {
    model.imperfections = {SineImperfection{"column", 1, amplitude}};
    const Result result = solve(model, path_of_limit_points(1));
    ASSERT_TRUE(result.summary.critical_load_factor);
    EXPECT_NEAR(*result.summary.critical_load_factor, 64.8087, 1e-3 * 64.8087) << amplitude;
  }
}

}  // namespace
}  // namespace snapthrough
