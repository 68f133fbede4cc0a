/// Columns on bonded bases.
///
/// Sources. Pinned on Winkler: P_n = P_e (n^2 + k / n^2), k = K L^4 / (pi^4 EI) (Hetenyi 1946; thesis tables
/// 4.1 to 4.3, column_winkler_pinned.csv). Two-parameter: EI w'''' + (P - G) w'' + K w = 0, so P = P_Winkler
/// + G (column_two_parameter_foundation.csv, 13 digits). Reissner column: P (1 - P/EA + P/GA) = P_e
/// (column_geometrically_exact_buckling.csv).
#include "tests/verification/cases.h"
#include "tests/verification/reference_table.h"

namespace snapthrough {
namespace {

using namespace testing;

constexpr double kInextensible = 1e14;

Model pinned_on_winkler(double k) {
  Model model = straight(1.0, 1.0, kInextensible, "xy", "y");
  model.loads = {force_at(at_node("b"), -kPi * kPi, 0.0)};
  if (k > 0.0) model.foundations = {winkler("m", k * std::pow(kPi, 4))};
  return model;
}

/// All modes n = 1 .. 8 are among the lowest loads for these k. Sorted, they are sorted P_n. (20 elements: on
/// 16, two a half wave, a single element held at one end buckles at the eighth load, where digits are lost:
/// docs/decisions/0001.)
TEST(PinnedColumnOnWinkler, HasTheClosedFormsOfTheFirstEightModes) {
  for (const double k : {0.0, 0.64162389091777, 1.0, 10.0, 16.014932317308, 100.0}) {
    std::vector<double> expected;
    for (int n = 1; n <= 30; ++n) expected.push_back(n * n + k / (n * n));
    std::sort(expected.begin(), expected.end());
    const Result result = solve_soundly(pinned_on_winkler(k), buckling_on(fixed_mesh(20, 6), 8));
    ASSERT_TRUE(result.buckling);
    ASSERT_EQ(result.buckling->load_factors.size(), 8u);
    for (int i = 0; i < 8; ++i)
      expect_relative(result.buckling->load_factors[i], expected[i], 1e-8, "k " + std::to_string(k));
  }
}

/// From soft to stiff: the lowest load belongs to n = 1 .. 32 half waves.
TEST(PinnedColumnOnWinkler, HasTheClosedFormUpToStiffBases) {
  for (const double k : {1e-6, 1e-3, 3.9, 4.1, 1e2, 1e3, 1e4, 1e5, 1e6}) {
    double expected = 1e300;
    for (int n = 1; n <= 60; ++n) expected = std::min(expected, n * n + k / (n * n));
    const Result result = solve_soundly(pinned_on_winkler(k), buckling_on(fixed_mesh(64, 6)));
    ASSERT_TRUE(result.summary.critical_load_factor);
    expect_relative(*result.summary.critical_load_factor, expected, 1e-8, "k " + std::to_string(k));
  }
}

/// Half waves of the lowest mode: zeros of the mode inside the span.
TEST(PinnedColumnOnWinkler, BucklesInTheExpectedNumberOfHalfWaves) {
  const struct {
    double k;
    int half_waves;
  } cases[] = {{0.0, 1},   {3.9, 1},   {4.1, 2},   {35.9, 2},  {36.1, 3},
               {143.9, 3}, {144.1, 4}, {399.9, 4}, {1000.0, 6}};
  for (const auto& c : cases) {
    const Result result = solve_soundly(pinned_on_winkler(c.k), buckling_on(fixed_mesh(16, 5)));
    ASSERT_TRUE(result.buckling);
    const std::vector<double>& w = result.buckling->modes[0].members[0].v;
    int changes = 0;
    for (std::size_t i = 2; i + 1 < w.size(); ++i) changes += (w[i] > 0.0) != (w[i - 1] > 0.0) ? 1 : 0;
    EXPECT_EQ(changes + 1, c.half_waves) << "k " << c.k;
  }
}

/// The thesis' columns in their own units, by half waves n: each is a buckling load of the column.
TEST(PinnedColumnOnWinkler, HasTheLoadsOfTheThesisTables) {
  const Table table("column_winkler_pinned.csv");
  for (const TableRow& row : table.rows()) {
    Model model = straight(row.number("L"), row.number("EI"), 1e15, "xy", "y");
    model.loads = {force_at(at_node("b"), -1.0, 0.0)};
    model.foundations = {winkler("m", row.number("K"))};
    const Result result = solve_soundly(model, buckling_on(fixed_mesh(10, 6), 7));
    ASSERT_TRUE(result.buckling);
    double nearest = 1e300;
    for (const double load : result.buckling->load_factors)
      if (std::abs(load - row.number("P_exact")) < std::abs(nearest - row.number("P_exact"))) nearest = load;
    expect_relative(nearest, row.number("P_exact"), 1e-8, row.text("table") + " n " + row.text("n"));
  }
}

/// The same loads found on the nonlinear path, where the bifurcation is an event.
TEST(PinnedColumnOnWinkler, BifurcatesOnThePathAtTheClosedForm) {
  for (const double k : {0.0, 1.0, 10.0, 100.0}) {
    double expected = 1e300;
    for (int n = 1; n <= 60; ++n) expected = std::min(expected, n * n + k / (n * n));
    const Result result =
        solve_soundly(pinned_on_winkler(k), analysis_of(AnalysisType::critical, fixed_mesh(16, 6)));
    ASSERT_TRUE(result.summary.critical_load_factor);
    expect_relative(*result.summary.critical_load_factor, expected, 1e-8, "k " + std::to_string(k));
  }
}

/// After buckling: load against mid deflection of the column L = 5, EI = 100, K = 10, EA = 1e6 (converged
/// high-order values, 6 decimals). An offset of 1e-12 takes the path off the straight one and changes the
/// load by 1e-12 / w of itself.
TEST(PinnedColumnOnWinkler, PostBucklingLoadsAreTheConvergedOnes) {
  const struct {
    double w;
    double load;
  } cases[] = {{0.1, 64.791614}, {0.5, 64.359947}, {1.0, 63.029126}};
  for (const auto& c : cases) {
    Model model = column(5.0, 100.0, 1e6, 10.0);
    model.imperfections = {SineImperfection{"column", 1, 1e-12}};
    Analysis analysis = analysis_of(AnalysisType::path, fixed_mesh(12, 6));
    analysis.stop.monitor = MonitorRange{"mid", {-c.w, c.w}};
    const Result result = solve_soundly(model, analysis);
    EXPECT_EQ(result.summary.termination, "monitor");
    EXPECT_NEAR(result.branches[0].load_factor.back(), c.load, 1e-6) << "deflection " << c.w;
  }
  const Result result =
      solve_soundly(column(5.0, 100.0, 1e6, 10.0), analysis_of(AnalysisType::critical, fixed_mesh(12, 6)));
  ASSERT_TRUE(result.summary.critical_load_factor);
  EXPECT_NEAR(*result.summary.critical_load_factor, 64.809630615, 1e-8 * 64.8);
}

TEST(ColumnOnTwoParameterBase, BucklesAtTheExactValues) {
  const Table table("column_two_parameter_foundation.csv");
  int values = 0;
  for (const TableRow& row : table.rows()) {
    const std::string ends = row.text("bc");
    Model model = straight(1.0, 1.0, kInextensible, ends == "PP" ? "xy" : "xyr", ends == "CC" ? "yr" : "y");
    model.loads = {force_at(at_node("b"), -1.0, 0.0)};
    if (row.number("k1") > 0.0 || row.number("k2") > 0.0)
      model.foundations = {winkler("m", row.number("k1"), row.number("k2") * kPi * kPi)};
    const Result result = solve_soundly(model, buckling_on(fixed_mesh(24, 6)));
    ASSERT_TRUE(result.summary.critical_load_factor);
    expect_relative(*result.summary.critical_load_factor, row.number("lambda"), 1e-8,
                    ends + " k1 " + row.text("k1") + " k2 " + row.text("k2"));
    ++values;
  }
  EXPECT_EQ(values, 120);
}

/// Axial and shear flexibility with Reissner's strains: the bifurcation on the path (linearised buckling
/// keeps the undeformed length and gives another value).
TEST(ReissnerColumn, BifurcatesAtTheClosedForm) {
  const Table table("column_geometrically_exact_buckling.csv");
  for (const TableRow& row : table.rows()) {
    const double EA = row.number("EA_L2_over_EI");
    const double GA = row.number("GA_L2_over_EI");
    Model model = straight(1.0, 1.0, std::isinf(EA) ? kInextensible : EA, "xy", "y");
    if (!std::isinf(GA)) model.sections[0].GA = GA;
    model.loads = {force_at(at_node("b"), -kPi * kPi, 0.0)};
    const Result result = solve_soundly(model, analysis_of(AnalysisType::critical, fixed_mesh(10, 6)));
    ASSERT_TRUE(result.summary.critical_load_factor);
    EXPECT_EQ(*result.summary.critical_type, CriticalType::bifurcation);
    expect_relative(*result.summary.critical_load_factor, row.number("Pcr_over_Pe"), 1e-9,
                    "EA " + row.text("EA_L2_over_EI") + " GA " + row.text("GA_L2_over_EI"));
  }
}

}  // namespace
}  // namespace snapthrough
