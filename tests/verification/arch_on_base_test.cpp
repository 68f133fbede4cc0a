/// Arches and rings on one-sided bases: critical loads, displacements and the ends of the contact.
///
/// Sources: thesis_4_4_arches_tensionless.csv, thesis_4_4_3_arch_tensionless.csv, thesis_4_5_ring_winkler.csv
/// (L. Camelo Santos' examples; collocation of the boundary-value problem with the contact ends as unknowns,
/// 10 to 12 digits). Tolerance 1e-8 for loads: the kink of the curvature at a contact end lies inside an
/// element (the split integral keeps the order, the meshes bring it below that). Contact ends at folds 1e-5
/// of the half length.
#include "tests/verification/balance.h"
#include "tests/verification/cases.h"
#include "tests/verification/reference_table.h"

namespace snapthrough {
namespace {

using namespace testing;

/// Expects an end of a contact interval at s.
void expect_edge_at(const State& state, double s, double tolerance, const std::string& what) {
  double nearest = 1e300;
  for (const auto& interval : state.foundations[0].contact)
    for (const double end : interval)
      if (std::abs(end - s) < std::abs(nearest - s)) nearest = end;
  EXPECT_NEAR(nearest, s, tolerance) << what;
}

TEST(ShallowArchOnBase, HasTheConvergedCriticalPointsAndContactEnds) {
  const Table table("thesis_4_4_arches_tensionless.csv");
  for (const TableRow& row : table.rows()) {
    const double k = row.number("k");
    if (k == 0.0) continue;
    Model model = arch(20.0, 420.0, 1.4);
    add_soil(model, k, row.text("side") == "out" ? Side::left : Side::right);
    const Discretization mesh = fixed_mesh(32, 6);
    Analysis analysis = path_on(mesh, 1);
    analysis.output.states = StateOutput::critical;
    analysis.output.points_per_member = output_points(mesh);
    const Result result = solve_soundly(model, analysis);
    const auto points = row.text("type") == "bif" ? bifurcations_of(result) : limits_of(result);
    const std::string at = row.text("side") + " k " + row.text("k") + " " + row.text("type");
    ASSERT_FALSE(points.empty()) << at;
    const CriticalPoint& point = points[0];
    expect_relative(point.load_factor, row.number("Lam"), 1e-8, at);
    const double rise = 100.0 * (1.0 - std::cos(kPi / 18.0));
    EXPECT_NEAR(-point.monitors[0].value / rise, row.number("v0_over_rise"), 1e-5) << at;
    const State& state = result.states[*point.state];
    const double half = 100.0 * kPi / 18.0;
    for (const double sign : {-1.0, 1.0})
      expect_edge_at(state, half * (1.0 + sign * row.number("a_over_Theta")), 1e-5 * half, at);
    expect_balance(model, mesh, state, 1e-9);
  }
}

/// The thesis' arch of 4.4.3: clamped on the left, hinged on the right, EA R^2 / EI = 1.2e5.
TEST(DeepArchOnBase, HasTheConvergedLimitPointsAndContactEnds) {
  const Table table("thesis_4_4_3_arch_tensionless.csv");
  const auto rows = table.rows();
  int values = 0;
  for (std::size_t first = 0; first < rows.size();) {
    std::size_t last = first + 1;
    while (last < rows.size() && rows[last].text("k") == rows[first].text("k") &&
           rows[last].text("deg") == rows[first].text("deg"))
      ++last;
    const double degrees = rows[first].number("deg");
    Model model = arch(degrees, 1200.0, 100.0, true);
    add_soil(model, rows[first].number("k"));
    // boundary layers of length R k^(-1/4) want elements of their own length
    const Discretization mesh = fixed_mesh(rows[first].number("k") > 1e5 ? 160 : 64, 5);
    Analysis analysis = path_on(mesh, static_cast<int>(last - first));
    analysis.output.states = StateOutput::critical;
    analysis.output.points_per_member = output_points(mesh);
    const Result result = solve_soundly(model, analysis);
    const auto limits = limits_of(result);
    const std::string at = rows[first].text("deg") + " degrees, k " + rows[first].text("k");
    ASSERT_EQ(limits.size(), last - first) << at;
    const double half = 100.0 * degrees * kPi / 360.0;
    for (std::size_t i = 0; i < limits.size(); ++i, ++values) {
      const TableRow& row = rows[first + i];
      expect_relative(limits[i].load_factor, row.number("Lam"), 1e-8, at);
      EXPECT_NEAR(-limits[i].monitors[0].value / 100.0, row.number("v_over_R"), 1e-5) << at;
      const State& state = result.states[*limits[i].state];
      expect_edge_at(state, half * (1.0 + row.number("a1")), 1e-5 * half, at);
      expect_edge_at(state, half * (1.0 + row.number("a2")), 1e-5 * half, at);
      expect_balance(model, mesh, state, 1e-9);
    }
    first = last;
  }
  EXPECT_EQ(values, 24);
}

/// Half a ring from its bottom to its top, symmetric, in a medium outside; nothing but contact holds it
/// vertically.
TEST(RingInMedium, HasTheConvergedLimitLoadAndDetachedAngle) {
  constexpr double kRadius = 10.0;
  constexpr double kEI = 30e3;
  const Table table("thesis_4_5_ring_winkler.csv");
  for (const TableRow& row : table.rows()) {
    Model model;
    model.nodes = {{"bottom", 0.0, -kRadius}, {"top", 0.0, kRadius}};
    model.sections = {{"s", 36e6, kEI, {}}};
    model.members = {{"m", "bottom", "top", "s", ArcCurve{180.0}, false, false}};
    model.supports = {support("bottom", "xr"), support("top", "xr")};
    model.foundations = {one_sided("m", row.number("k") * kEI / std::pow(kRadius, 4), Side::right)};
    model.loads = {DistributedLoad{
        "m", {0.0, -kEI / std::pow(kRadius, 3)}, {0.0, 1.0}, LoadMeasure::length, Pattern::proportional}};
    model.monitors = {{"top", at_node("top"), Component::y}};
    const Discretization mesh = fixed_mesh(80, 5);
    Analysis analysis = path_on(mesh, 1);
    analysis.output.states = StateOutput::critical;
    analysis.output.points_per_member = output_points(mesh);
    const Result result = solve_soundly(model, analysis);
    const auto limits = limits_of(result);
    const std::string at = "k " + row.text("k");
    ASSERT_EQ(limits.size(), 1u) << at;
    expect_relative(limits[0].load_factor, row.number("Lam_limit"), 1e-8, at);
    EXPECT_NEAR(-limits[0].monitors[0].value / kRadius, row.number("v0"), 1e-5) << at;
    const State& state = result.states[*limits[0].state];
    expect_edge_at(state, kRadius * (kPi - row.number("sd")), 1e-5 * kRadius, at);
    expect_balance(model, mesh, state, 1e-9);
  }
}

}  // namespace
}  // namespace snapthrough
