/// Euler's elastica.
///
/// Sources: elastica_cantilever_tip_load.csv (elliptic integrals, 30 digits; cf. Mattiasson, IJNME 17, 1981)
/// and elastica_postbuckling.csv (P / P_cr = (2 K(k) / pi)^2, k = sin(alpha / 2); 12 digits). Tolerance 1e-8
/// of the length and of the load; EA L^2 / EI = 1e14 stands for the inextensible axis and leaves P / EA =
/// 6e-13.
#include "tests/verification/balance.h"
#include "tests/verification/cases.h"
#include "tests/verification/reference_table.h"

namespace snapthrough {
namespace {

using namespace testing;

TEST(ElasticaCantilever, FollowsTheEllipticIntegrals) {
  const Table table("elastica_cantilever_tip_load.csv");
  Model model = straight(1.0, 1.0, 1e14, "xyr", "");
  model.loads = {force_at(at_node("b"), 0.0, -1.0)};
  std::vector<double> loads;
  for (const TableRow& row : table.rows()) loads.push_back(row.number("a"));
  const Discretization mesh = fixed_mesh(16, 6);
  Analysis analysis = static_on(mesh, Geometry::nonlinear, loads);
  analysis.output.points_per_member = output_points(mesh);
  const Result result = solve_soundly(model, analysis);
  ASSERT_EQ(result.states.size(), loads.size());
  for (std::size_t i = 0; i < loads.size(); ++i) {
    const TableRow row = table.rows()[i];
    const MemberState& m = result.states[i].members[0];
    EXPECT_NEAR(1.0 - m.x.back(), row.number("u_over_L"), 1e-8) << "load " << loads[i];
    EXPECT_NEAR(-m.y.back(), row.number("w_over_L"), 1e-8) << "load " << loads[i];
    EXPECT_NEAR(-m.rotation.back(), row.number("theta"), 1e-8) << "load " << loads[i];
    // the clamped end carries the load and its moment about the end
    EXPECT_NEAR(m.bending_moment.front(), -loads[i] * m.x.back(), 1e-8 * loads[i]);
    EXPECT_NEAR(m.shear_force.front(), -loads[i], 1e-8 * loads[i]);
    expect_balance(model, mesh, result.states[i], 1e-9);
  }
}

/// Angle at the pinned end against load and deflection: the perfect column is left by an offset a = 1e-12 of
/// the length, which changes the loads by a / w of themselves (docs/decisions/0002).
Result elastica_path(const std::vector<double>& loads) {
  Model model = straight(1.0, 1.0, 1e14, "xy", "y");
  model.loads = {force_at(at_node("b"), -kPi * kPi, 0.0)};
  model.imperfections = {SineImperfection{"m", 1, 1e-12}};
  Analysis analysis = analysis_of(AnalysisType::path, fixed_mesh(20, 6));
  analysis.stop.load_factor = std::array{-1.0, 6.0};
  analysis.output.states = StateOutput::at_load_factors;
  analysis.output.at_load_factors = loads;
  return solve_soundly(model, analysis);
}

TEST(ElasticaColumn, PostBucklingFollowsTheEllipticIntegrals) {
  const Table table("elastica_postbuckling.csv");
  std::vector<double> loads;
  std::vector<TableRow> rows;
  for (const TableRow& row : table.rows()) {
    if (row.number("alpha_deg") < 10.0) continue;  // there the offset shows
    loads.push_back(row.number("P_over_Pcr"));
    rows.push_back(row);
  }
  const Result result = elastica_path(loads);
  ASSERT_EQ(result.states.size(), loads.size());
  for (std::size_t i = 0; i < loads.size(); ++i) {
    const MemberState& m = result.states[i].members[0];
    const double alpha = rows[i].number("alpha_deg");
    EXPECT_NEAR(m.rotation.front() * 180.0 / kPi, alpha, 1e-6) << alpha;
    EXPECT_NEAR(1.0 - m.x.back(), rows[i].number("d_over_L"), 1e-8) << alpha;
    EXPECT_NEAR(m.y[m.y.size() / 2], rows[i].number("w_over_L"), 1e-8) << alpha;
  }
}

}  // namespace
}  // namespace snapthrough
