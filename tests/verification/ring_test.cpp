/// Rings under hydrostatic pressure.
///
/// Sources: ring_closed_forms.csv (inextensible: q R^3 / EI = (n^2 - 1) + k / (n^2 - 1); Levy 1884,
/// Timoshenko and Gere), ring_free_buckling_numeric.csv (axially flexible, 12 digits), and converged values
/// for EA R^2 / EI = 1.2e5 with 7 to 10 digits. Pressure is per deformed length. Tolerance 1e-8, or the
/// digits printed.
#include "tests/verification/cases.h"
#include "tests/verification/reference_table.h"

namespace snapthrough {
namespace {

using namespace testing;

/// Ring of two half circles, R = EI = 1, pressed from outside. `half`: only the right half, with symmetry.
Model ring(double EA, double k, bool half) {
  Model model;
  model.nodes = {{"bottom", 0.0, -1.0}, {"top", 0.0, 1.0}};
  model.sections = {{"s", EA, 1.0, {}}};
  model.members = {{"right", "bottom", "top", "s", ArcCurve{180.0}, false, false}};
  if (!half) model.members.push_back({"left", "top", "bottom", "s", ArcCurve{180.0}, false, false});
  model.supports = half ? std::vector{support("bottom", "xyr"), support("top", "xr")}
                        : std::vector{support("bottom", "xy"), support("top", "x")};
  for (const Member& member : model.members) {
    model.loads.push_back(PressureLoad{member.id, 1.0, Side::right, Pattern::proportional});
    if (k > 0.0) {
      model.foundations.push_back(winkler(member.id, k));
      model.foundations.back().id = "soil " + member.id;
    }
  }
  if (k > 0.0 && half) model.supports = {support("bottom", "xr"), support("top", "xr")};
  return model;
}

TEST(RingUnderPressure, BifurcatesAtTheClosedForms) {
  const Table table("ring_closed_forms.csv");
  const std::string start = "hydrostatic + radial";
  int values = 0;
  for (const TableRow& row : table.rows()) {
    if (row.text("case").compare(0, start.size(), start) != 0) continue;
    const std::string& parameter = row.text("parameter");
    const double k = std::stod(parameter.substr(parameter.find('=') + 1));
    for (const AnalysisType type : {AnalysisType::critical, AnalysisType::buckling}) {
      const Result result = solve_soundly(ring(1e14, k, true), analysis_of(type, fixed_mesh(40, 6)));
      ASSERT_TRUE(result.summary.critical_load_factor) << parameter;
      expect_relative(*result.summary.critical_load_factor, row.number("value"), 1e-8, parameter);
    }
    ++values;
  }
  EXPECT_EQ(values, 10);
}

TEST(RingUnderPressure, BifurcatesAtTheNumericValuesWithAxialFlexibility) {
  const Table table("ring_free_buckling_numeric.csv");
  int values = 0;
  for (const TableRow& row : table.rows()) {
    // other loads aren't in the contract; at k = 50 another n than the row's comes first
    if (row.text("load") != "hydro" || row.number("k") > 10.0) continue;
    const double EA = row.text("EA_R2_over_EI") == "inf" ? 1e14 : row.number("EA_R2_over_EI");
    const Result result = solve_soundly(ring(EA, row.number("k"), true),
                                        analysis_of(AnalysisType::critical, fixed_mesh(16, 6)));
    ASSERT_TRUE(result.summary.critical_load_factor);
    expect_relative(*result.summary.critical_load_factor, row.number("q_cr"), 1e-8,
                    row.text("EA_R2_over_EI"));
    ++values;
  }
  EXPECT_EQ(values, 5);
}

/// Later bifurcations of the same path, by multiplicity.
std::vector<double> bifurcation_loads(const Model& model, double stop) {
  Analysis analysis = analysis_of(AnalysisType::path, fixed_mesh(24, 6));
  analysis.stop.load_factor = std::array{-1.0, stop};
  const Result result = solve_soundly(model, analysis);
  std::vector<double> loads;
  for (const CriticalPoint& point : result.critical_points) {
    EXPECT_EQ(point.type, CriticalType::bifurcation);
    for (int i = 0; i < point.multiplicity; ++i) loads.push_back(point.load_factor);
  }
  EXPECT_EQ(result.branches[0].negative_eigenvalues.back(), static_cast<int>(loads.size()));
  return loads;
}

/// n = 2, 3, 4. The ring is whole, so each load is there twice: one point of multiplicity two, or two within
/// the tolerance of a path's events.
TEST(RingUnderPressure, WholeRingHasDoubleBifurcations) {
  const auto loads = bifurcation_loads(ring(1.2e5, 0.0, false), 16.0);
  const double expected[] = {3.000125006, 3.000125006, 8.001000152, 8.001000152, 15.003626, 15.003626};
  ASSERT_EQ(loads.size(), 6u);
  for (std::size_t i = 0; i < 6; ++i) EXPECT_NEAR(loads[i], expected[i], 1e-6);
}

/// n = 6, 7, 5 with bonded springs k = 1200: half a ring, because springs along fixed directions hold a ring
/// against rotation a little, which parts the two modes of each n.
TEST(RingUnderPressure, RingOnSpringsHasItsFirstThreeBifurcations) {
  const auto loads = bifurcation_loads(ring(1.2e5, 1200.0, true), 75.0);
  const double expected[] = {69.999665, 73.773564, 74.739795};
  ASSERT_EQ(loads.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(loads[i], expected[i], 1e-6);
}

/// The same from linearised buckling, whose eigenvalues come in pairs.
TEST(RingUnderPressure, LinearisedBucklingSeparatesRepeatedEigenvalues) {
  const Result result = solve_soundly(ring(1e14, 0.0, false), buckling_on(fixed_mesh(20, 6), 6));
  ASSERT_TRUE(result.buckling);
  const double expected[] = {3.0, 3.0, 8.0, 8.0, 15.0, 15.0};
  ASSERT_EQ(result.buckling->load_factors.size(), 6u);
  for (int i = 0; i < 6; ++i) expect_relative(result.buckling->load_factors[i], expected[i], 1e-8, "mode");
}

}  // namespace
}  // namespace snapthrough
