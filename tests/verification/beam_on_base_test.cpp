/// Beams on bonded Winkler bases: small displacements against closed forms, and large ones.
///
/// Sources. Hetenyi, Beams on Elastic Foundation, 1946 (formulas below and hetenyi_closed_forms.csv, 12
/// digits); thesis 4.2: beam_winkler_uniform_linear_4_2.csv (closed form, 13 digits) and
/// beam_winkler_uniform_nonlinear_4_2.csv (sliding support, inextensible, boundary-value solution, 10 to 11
/// decimals are printed). Tolerance 1e-8 of the largest value of each kind.
#include "tests/verification/balance.h"
#include "tests/verification/cases.h"
#include "tests/verification/reference_table.h"

namespace snapthrough {
namespace {

using namespace testing;

constexpr double kTolerance = 1e-8;
constexpr int kPoints = 401;

/// beta = (K / 4 EI)^(1/4) = 1, K = 1. The medium lies below: deflections and reactions downwards are
/// positive.
Model free_beam(double length) {
  Model model = straight(length, 0.25, 1e6, "x", "");
  model.foundations = {winkler("m", 1.0)};
  model.foundations[0].side = Side::right;
  return model;
}

State linear_state(const Model& model, const Discretization& mesh, int points = kPoints) {
  Analysis analysis = static_on(mesh, Geometry::linear);
  analysis.output.points_per_member = points;
  Result result = solve_soundly(model, analysis);
  return result.states.at(0);
}

/// w = P beta / 2K e^-x (cos x + sin x), M = P / 4 beta e^-x (cos x - sin x), |Q| = P / 2 e^-x cos x, r = K
/// w. The ends of the beam are e^-31 away.
TEST(HetenyiInfiniteBeam, HasTheClosedFormsAlongTheBeam) {
  const double length = 20.0 * kPi;
  Model model = free_beam(length);
  model.loads = {force_at(at_member("m", 0.5), 0.0, -1.0)};
  const Discretization mesh = fixed_mesh(200, 6);
  const State state = linear_state(model, mesh);
  const MemberState& m = state.members[0];
  for (int i = kPoints / 2; i < kPoints; ++i) {
    const double x = m.s[i] - 0.5 * length;
    const double decay = std::exp(-x);
    EXPECT_NEAR(-m.y[i], 0.5 * decay * (std::cos(x) + std::sin(x)), kTolerance) << x;
    EXPECT_NEAR(m.rotation[i], decay * std::sin(x), kTolerance) << x;
    EXPECT_NEAR(m.bending_moment[i], 0.25 * decay * (std::cos(x) - std::sin(x)), kTolerance) << x;
    if (x > 0.0) {
      EXPECT_NEAR(m.shear_force[i], 0.5 * decay * std::cos(x), kTolerance) << x;
    }
    EXPECT_NEAR(state.foundations[0].reaction[i], -m.y[i], kTolerance) << x;
  }
  const int middle = kPoints / 2;
  EXPECT_NEAR(-m.y[middle], 0.5, kTolerance);
  EXPECT_NEAR(m.bending_moment[middle], 0.25, kTolerance);
  EXPECT_NEAR(m.y[middle + 15], 0.0, kTolerance) << "first zero, at 3 pi / 4";
  EXPECT_NEAR(-m.y[middle + 20], -0.02160695913189, kTolerance) << "least deflection, at pi";
  expect_balance(model, mesh, linear_state(model, mesh, output_points(mesh)), 1e-9, Geometry::linear);
}

/// w = 2 P beta / K e^-x cos x, M = -P / beta e^-x sin x (in its size), |Q| = P e^-x (cos x - sin x).
TEST(HetenyiSemiInfiniteBeam, HasTheClosedFormsAlongTheBeam) {
  const double length = 10.0 * kPi;
  Model model = free_beam(length);
  model.loads = {force_at(at_node("a"), 0.0, -1.0)};
  const Discretization mesh = fixed_mesh(100, 6);
  const State state = linear_state(model, mesh);
  const MemberState& m = state.members[0];
  for (int i = 0; i < kPoints; ++i) {
    const double x = m.s[i];
    const double decay = std::exp(-x);
    EXPECT_NEAR(-m.y[i], 2.0 * decay * std::cos(x), kTolerance) << x;
    EXPECT_NEAR(-m.bending_moment[i], decay * std::sin(x), kTolerance) << x;
    EXPECT_NEAR(m.shear_force[i], decay * (std::cos(x) - std::sin(x)), kTolerance) << x;
  }
  EXPECT_NEAR(-m.bending_moment[10], 0.3223969419448, kTolerance) << "largest moment, at pi / 4";
  expect_balance(model, mesh, linear_state(model, mesh, output_points(mesh)), 1e-9, Geometry::linear);
}

TEST(HetenyiFiniteBeam, HasTheTabulatedValues) {
  const Table table("hetenyi_closed_forms.csv");
  int values = 0;
  for (const TableRow& row : table.rows()) {
    const std::string& name = row.text("case");
    const std::string start = "finite free-free central P betaL=";
    if (name.compare(0, start.size(), start) != 0) continue;
    const std::string number = name.substr(start.size());
    const double length = number == "3.14159" ? kPi : std::stod(number);
    Model model = free_beam(length);
    model.loads = {force_at(at_member("m", 0.5), 0.0, -1.0)};
    const Discretization mesh = fixed_mesh(20, 5);
    const State state = linear_state(model, mesh);
    const MemberState& m = state.members[0];
    const std::string& quantity = row.text("quantity");
    const double value = quantity.starts_with("w_mid")   ? -m.y[kPoints / 2]
                         : quantity.starts_with("w_end") ? -m.y.back()
                                                         : m.bending_moment[kPoints / 2];
    EXPECT_NEAR(value, row.number("value"), kTolerance) << name << " " << quantity;
    expect_balance(model, mesh, state, 1e-9, Geometry::linear);
    ++values;
  }
  EXPECT_EQ(values, 15);
}

TEST(ThesisBeam, SmallDisplacementsAreTheClosedForm) {
  const Table table("beam_winkler_uniform_linear_4_2.csv");
  for (const TableRow& row : table.rows()) {
    const double K = row.number("K");
    Model model = straight(10.0, 100.0, 1e6, "xy", "y");
    if (K > 0.0) {
      model.foundations = {winkler("m", K)};
      model.foundations[0].side = Side::right;
    }
    model.loads = {DistributedLoad{"m", {0.0, -1.0}, {0.0, 1.0}, LoadMeasure::length, Pattern::proportional}};
    const Discretization mesh = fixed_mesh(20, 5);
    const State state = linear_state(model, mesh);
    const MemberState& m = state.members[0];
    const int middle = kPoints / 2;
    const std::string at = "K " + row.text("K");
    expect_relative(-m.y[middle], row.number("w_mid_per_q"), kTolerance, at);
    expect_relative(-m.rotation.front(), row.number("slope_end_per_q"), kTolerance, at);
    EXPECT_NEAR(m.bending_moment[middle], row.number("M_mid_per_q"), 12.5 * kTolerance) << at;
    expect_relative(-m.shear_force.front(), row.number("R_end_per_q"), kTolerance, at);
    if (K > 0.0)
      expect_relative(state.foundations[0].reaction[middle], row.number("r_mid_per_q"), kTolerance, at);
    expect_balance(model, mesh, state, 1e-9, Geometry::linear);
    // the foundation carries what the supports do not
    const double supports = imbalance_of(model, mesh, state, Geometry::linear).reactions[1];
    EXPECT_NEAR(10.0 - supports, row.number("F_found_per_q"), 10.0 * kTolerance) << at;
  }
}

/// EA L^2 / EI = 1e14 stands for the inextensible axis.
TEST(ThesisBeam, LargeDisplacementsAreThoseOfTheBoundaryValueProblem) {
  const Table table("beam_winkler_uniform_nonlinear_4_2.csv");
  int values = 0;
  for (const TableRow& row : table.rows()) {
    const double k = 100.0 * row.number("K");
    Model model = straight(1.0, 1.0, 1e14, "xy", "y");
    if (k > 0.0) {
      model.foundations = {winkler("m", k)};
      model.foundations[0].direction = std::array{0.0, -1.0};
    }
    model.loads = {DistributedLoad{"m", {0.0, -1.0}, {0.0, 1.0}, LoadMeasure::length, Pattern::proportional}};
    const Discretization mesh = fixed_mesh(20, 5);
    Analysis analysis = static_on(mesh, Geometry::nonlinear, {row.number("Lam")});
    analysis.output.points_per_member = kPoints;
    const Result result = solve_soundly(model, analysis);
    ASSERT_EQ(result.states.size(), 1u);
    const MemberState& m = result.states[0].members[0];
    const int middle = kPoints / 2;
    const std::string at = "K " + row.text("K") + " Lambda " + row.text("Lam");
    EXPECT_NEAR(-m.y[middle], row.number("wmid_over_L"), kTolerance) << at;
    EXPECT_NEAR(1.0 - m.x.back(), row.number("u_over_L"), kTolerance) << at;
    EXPECT_NEAR(-m.rotation.front(), row.number("theta_end"), kTolerance) << at;
    const double load = row.number("Lam");
    EXPECT_NEAR(m.bending_moment[middle], row.number("M_mid"), kTolerance * std::max(1.0, load)) << at;
    const double reaction = imbalance_of(model, mesh, result.states[0]).reactions[1];
    EXPECT_NEAR(0.5 * reaction, row.number("R_left"), kTolerance * std::max(1.0, load)) << at;
    if (k > 0.0) {
      EXPECT_NEAR(result.states[0].foundations[0].reaction[middle], row.number("k_wmid"), kTolerance * load)
          << at;
    }
    expect_balance(model, mesh, result.states[0], 1e-9);
    ++values;
  }
  EXPECT_EQ(values, 40);
}

}  // namespace
}  // namespace snapthrough
