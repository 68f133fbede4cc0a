/// Lee's frame and Williams' toggle frame: limit points, and turning points of the load point's
/// displacements.
///
/// Source: frames_limit_points.csv (Gauss collocation of the boundary-value problem, 12 digits converged; P
/// in EI / L^2, displacements over L for Lee's frame, model units for Williams'). Cases: S. L. Lee, Manuel
/// and Rossow 1968; Williams 1964. Tolerance 1e-8 for loads at limit points. Where a quantity is stationary
/// the place is known less well than the quantity: 1e-6 of L for the displacements at limit points (5e-6 of
/// the apex drop for the shallow toggle), 1e-7 for the loads at turning points.
#include "tests/verification/balance.h"
#include "tests/verification/cases.h"
#include "tests/verification/reference_table.h"
#include "tests/verification/turning_points.h"

namespace snapthrough {
namespace {

using namespace testing;

/// Lee's frame with the displacements of the loaded point.
Model watched_frame(double EA, std::optional<double> GA) {
  Model model = lee_frame(EA, GA);
  model.monitors = {{"u", at_member("beam", 0.2), Component::x}, {"v", at_member("beam", 0.2), Component::y}};
  return model;
}

Model lee_frame_of(const std::string& name) {
  if (name == "inextensible") return watched_frame(4.32e17, {});
  if (name == "EA L2/EI=43200 GA=EA/3.12") return watched_frame(4.32e7, 4.32e7 / 3.12);
  return watched_frame(4.32e7, {});
}

struct Reference {
  std::string type;
  double load, u, v;
};

std::vector<Reference> rows_of(const std::string& frame, const std::string& model) {
  const Table table("frames_limit_points.csv");
  std::vector<Reference> out;
  for (const TableRow& row : table.rows())
    if (row.text("case") == frame && row.text("model") == model)
      out.push_back(
          {row.text("type"), row.number("P"), row.has("u") ? row.number("u") : 0.0, row.number("v")});
  return out;
}

class LeeFrame : public ::testing::TestWithParam<const char*> {};

TEST_P(LeeFrame, HasTheConvergedLimitPoints) {
  const Discretization mesh = fixed_mesh(10, 6);
  const Model model = lee_frame_of(GetParam());
  Analysis analysis = path_on(mesh, 2);
  analysis.output.states = StateOutput::critical;
  analysis.output.points_per_member = output_points(mesh);
  const Result result = solve_soundly(model, analysis);
  const auto limits = limits_of(result);
  ASSERT_EQ(limits.size(), 2u);
  EXPECT_TRUE(bifurcations_of(result).empty());
  std::size_t i = 0;
  for (const Reference& row : rows_of("lee", GetParam())) {
    if (row.type != "limit") continue;
    const CriticalPoint& point = limits[i++];
    expect_relative(point.load_factor, row.load, 1e-8, "load");
    EXPECT_NEAR(point.monitors[0].value / 120.0, row.u, 1e-6);
    EXPECT_NEAR(-point.monitors[1].value / 120.0, row.v, 1e-6);
    EXPECT_EQ(point.type, i == 1 ? CriticalType::limit_max : CriticalType::limit_min);
    expect_balance(model, mesh, result.states[*point.state], 1e-9);
  }
  ASSERT_EQ(i, 2u);
}

/// Turning points of u and v along the path, in the order met.
TEST_P(LeeFrame, HasTheConvergedTurningPoints) {
  const Model model = lee_frame_of(GetParam());
  Analysis analysis = analysis_of(AnalysisType::path, fixed_mesh(10, 6));
  analysis.step.max = 0.02;
  analysis.stop.load_factor = std::array{-12.0, 25.0};
  const Result result = solve_soundly(model, analysis);
  for (const std::string id : {"u", "v"}) {
    const std::size_t monitor = id == "u" ? 0 : 1;
    const auto turns = turning_points(result.branches[0], monitor);
    std::size_t i = 0;
    for (const Reference& row : rows_of("lee", GetParam())) {
      if (row.type != "turn_" + id) continue;
      ASSERT_LT(i, turns.size());
      expect_relative(turns[i].load_factor, row.load, 1e-7, row.type);
      EXPECT_NEAR(std::abs(turns[i].value) / 120.0, id == "u" ? row.u : row.v, 1e-9) << row.type;
      ++i;
    }
    EXPECT_EQ(i, turns.size()) << "turning points of " << id;
    EXPECT_EQ(i, 2u);
  }
}

INSTANTIATE_TEST_SUITE_P(Stiffness, LeeFrame,
                         ::testing::Values("inextensible", "EA L2/EI=43200", "EA L2/EI=43200 GA=EA/3.12"));

/// Displacement control ends where the controlled displacement turns: the first turning points are exact
/// events.
TEST(LeeFrameControl, EndsAtTheFirstTurningPoints) {
  for (const std::string id : {"u", "v"}) {
    for (const Reference& row : rows_of("lee", "EA L2/EI=43200")) {
      if (row.type != "turn_" + id) continue;
      Analysis analysis = analysis_of(AnalysisType::path, fixed_mesh(10, 6));
      analysis.control = {ControlType::displacement, id};
      const Result result = solve_soundly(watched_frame(4.32e7, {}), analysis);
      EXPECT_EQ(result.summary.termination, "monitor_turned");
      expect_relative(result.branches[0].load_factor.back(), row.load, 1e-7, "turn of " + id);
      const double value = std::abs(result.branches[0].monitors[id == "u" ? 0 : 1].values.back()) / 120.0;
      EXPECT_NEAR(value, id == "u" ? row.u : row.v, 1e-9);
      break;
    }
  }
}

Model williams_frame(std::optional<double> GA) {
  Model model;
  model.nodes = {{"a", -12.943, 0.0}, {"apex", 0.0, 0.386}, {"b", 12.943, 0.0}};
  model.sections = {{"s", 1.885e6, 9.27e3, GA}};
  model.members = {{"left", "a", "apex", "s", LineCurve{}, false, false},
                   {"right", "apex", "b", "s", LineCurve{}, false, false}};
  model.supports = {support("a", "xyr"), support("b", "xyr")};
  model.loads = {force_at(at_node("apex"), 0.0, -1.0)};
  model.monitors = {{"v", at_node("apex"), Component::y}};
  return model;
}

TEST(WilliamsToggleFrame, HasTheConvergedLimitPoints) {
  const struct {
    const char* name;
    std::optional<double> GA;
  } cases[] = {{"EA=1.885e6 EI=9.27e3 GA=inf", {}}, {"EA=1.885e6 EI=9.27e3 GA=EA/3.12", 1.885e6 / 3.12}};
  for (const auto& c : cases) {
    const Model model = williams_frame(c.GA);
    const Discretization mesh = fixed_mesh(6, 6);
    Analysis analysis = path_on(mesh, 2);
    analysis.output.states = StateOutput::critical;
    analysis.output.points_per_member = output_points(mesh);
    const Result result = solve_soundly(model, analysis);
    const auto limits = limits_of(result);
    const auto rows = rows_of("williams", c.name);
    ASSERT_EQ(limits.size(), 2u);
    ASSERT_EQ(rows.size(), 2u);
    for (std::size_t i = 0; i < 2; ++i) {
      expect_relative(limits[i].load_factor, rows[i].load, 1e-8, c.name);
      EXPECT_NEAR(-limits[i].monitors[0].value, rows[i].v, 5e-6 * rows[i].v) << c.name;
      expect_balance(model, mesh, result.states[*limits[i].state], 1e-9);
    }
  }
}

}  // namespace
}  // namespace snapthrough
