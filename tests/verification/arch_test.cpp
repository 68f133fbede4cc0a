/// Arches without bases: the 215-degree arch and shallow arches, their limit, turning and bifurcation points.
///
/// Sources. arch_clamped_hinged_reference.csv: DaDeppo and Schmidt's arch (J. Appl. Mech. 42, 1975), Gauss
/// collocation of the boundary-value problem, 12 digits, for several axial and shear stiffnesses. Shallow
/// arches R = 100, EI = 1.4, EA = 420: converged high-order values with 6 decimals. Tolerance 1e-8 for loads
/// (6 decimals where no more are printed), 1e-7 of R for displacements at limit points, 2e-7 for loads at
/// turning points.
#include "tests/verification/balance.h"
#include "tests/verification/cases.h"
#include "tests/verification/reference_table.h"
#include "tests/verification/turning_points.h"

namespace snapthrough {
namespace {

using namespace testing;

constexpr double kEI = 1e6;
constexpr double kRadius = 100.0;

double stiffness_of(const std::string& text, double EA) {
  constexpr double kUnit = kEI / (kRadius * kRadius);
  if (text == "EA/3.12") return EA / 3.12;
  return text == "inf" ? 1e9 * kEI : kUnit * std::stod(text);
}

Model deep_arch(const TableRow& row) {
  const double EA = stiffness_of(row.text("EA"), 0.0);
  Model model = arch(row.number("angle_deg"), EA, kEI, true);
  if (row.text("GA") != "inf") model.sections[0].GA = stiffness_of(row.text("GA"), EA);
  model.monitors.push_back({"u", at_member("arch", 0.5), Component::x});
  return model;
}

/// Rows of one arch: consecutive rows with the same angle, EA and GA.
std::vector<std::vector<TableRow>> arches(const Table& table) {
  std::vector<std::vector<TableRow>> out;
  for (const TableRow& row : table.rows()) {
    const auto same = [&row](const TableRow& other) {
      return row.text("angle_deg") == other.text("angle_deg") && row.text("EA") == other.text("EA") &&
             row.text("GA") == other.text("GA");
    };
    if (out.empty() || !same(out.back().front())) out.emplace_back();
    out.back().push_back(row);
  }
  return out;
}

std::string name_of(const TableRow& row) {
  return row.text("angle_deg") + " degrees, EA " + row.text("EA") + ", GA " + row.text("GA");
}

TEST(DeepArchReference, HasTheConvergedLimitPoints) {
  const Table table("arch_clamped_hinged_reference.csv");
  const auto all = arches(table);
  ASSERT_EQ(all.size(), 7u);
  for (const auto& rows : all) {
    const Model model = deep_arch(rows.front());
    const Discretization mesh = fixed_mesh(20, 6);
    Analysis analysis = path_on(mesh, 2);
    analysis.output.states = StateOutput::critical;
    analysis.output.points_per_member = output_points(mesh);
    const Result result = solve_soundly(model, analysis);
    const auto limits = limits_of(result);
    ASSERT_EQ(limits.size(), 2u) << name_of(rows.front());
    for (std::size_t i = 0; i < 2; ++i) {
      ASSERT_EQ(rows[i].text("type"), "limit");
      expect_relative(limits[i].load_factor, rows[i].number("Lam"), 1e-8, name_of(rows[i]));
      EXPECT_NEAR(-limits[i].monitors[0].value / kRadius, rows[i].number("v_over_R"), 1e-7);
      EXPECT_NEAR(std::abs(limits[i].monitors[1].value) / kRadius, rows[i].number("u_over_R"), 1e-7);
      expect_balance(model, mesh, result.states[*limits[i].state], 1e-9);
    }
  }
}

TEST(DeepArchReference, HasTheConvergedTurningPoints) {
  const Table table("arch_clamped_hinged_reference.csv");
  for (const auto& rows : arches(table)) {
    Analysis analysis = path_on(fixed_mesh(14, 6), 2);
    analysis.step.max = 0.04;
    analysis.stop.limit_points = {};
    analysis.stop.load_factor = std::array{-0.8, 9.5};
    analysis.stop.steps = 3000;
    const Result result = solve_soundly(deep_arch(rows.front()), analysis);
    std::size_t next_turn[2] = {0, 0};
    for (const TableRow& row : rows) {
      if (row.text("type") == "limit") continue;
      const std::size_t monitor = row.text("type") == "turn_v" ? 0 : 1;
      const auto turns = turning_points(result.branches[0], monitor);
      const std::size_t i = next_turn[monitor]++;
      ASSERT_LT(i, turns.size()) << name_of(row) << " " << row.text("type");
      expect_relative(turns[i].load_factor, row.number("Lam"), 2e-7, name_of(row) + " " + row.text("type"));
      const double expected = row.number(monitor == 0 ? "v_over_R" : "u_over_R");
      EXPECT_NEAR(std::abs(turns[i].value) / kRadius, expected, 1e-8)
          << name_of(row) << " " << row.text("type");
    }
  }
}

struct ShallowCase {
  const char* name;
  double degrees;
  bool clamped;
  std::vector<double> limits;
  std::vector<double> bifurcations;
};

class ShallowArchReference : public ::testing::TestWithParam<ShallowCase> {};

TEST_P(ShallowArchReference, HasTheConvergedCriticalPoints) {
  const ShallowCase& c = GetParam();
  Model model = arch(c.degrees, 420.0, 1.4);
  if (c.clamped) model.supports = {support("a", "xyr"), support("b", "xyr")};
  const Discretization mesh = fixed_mesh(16, 6);
  Analysis analysis = path_on(mesh, static_cast<int>(c.limits.size()));
  analysis.output.states = StateOutput::critical;
  analysis.output.points_per_member = output_points(mesh);
  const Result result = solve_soundly(model, analysis);
  const auto limits = limits_of(result);
  ASSERT_EQ(limits.size(), c.limits.size());
  for (std::size_t i = 0; i < limits.size(); ++i) {
    EXPECT_NEAR(limits[i].load_factor, c.limits[i], 1e-6);
    expect_balance(model, mesh, result.states[*limits[i].state], 1e-9);
  }
  const auto bifurcations = bifurcations_of(result);
  ASSERT_GE(bifurcations.size(), c.bifurcations.size());
  for (std::size_t i = 0; i < c.bifurcations.size(); ++i)
    EXPECT_NEAR(bifurcations[i].load_factor, c.bifurcations[i], 1e-6);
}

INSTANTIATE_TEST_SUITE_P(
    Arches, ShallowArchReference,
    ::testing::Values(ShallowCase{"clamped 20", 20.0, true, {82.507741, 32.165243}, {72.281583, 43.291929}},
                      ShallowCase{"pinned 10", 10.0, false, {117.326597, -105.122029}, {112.530759}},
                      ShallowCase{"clamped 10", 10.0, true, {118.558033, 107.928754}, {}}),
    [](const auto& instance) { return std::string("Case") + std::to_string(instance.index); });

}  // namespace
}  // namespace snapthrough
