/// Beams on one-sided Winkler bases, small displacements: where they lift off.
///
/// Source: tensionless_beams_linear.csv (Weitsman, IEEE Trans. Nuclear Science / J. Appl. Mech. 37, 1970, for
/// the weightless beam; heavy beam: exact solution piece by piece, 13 digits). Beams are infinite: their ends
/// here are e^-30 away. Tolerance 1e-8.
#include "tests/verification/balance.h"
#include "tests/verification/cases.h"
#include "tests/verification/reference_table.h"

namespace snapthrough {
namespace {

using namespace testing;

/// beta = 1, K = 1, the medium below.
Model beam_on_ground(double length) {
  Model model = straight(length, 0.25, 1e6, "x", "");
  model.foundations = {one_sided("m", 1.0, Side::right)};
  model.loads = {force_at(at_member("m", 0.5), 0.0, -1.0)};
  return model;
}

State linear_state(const Model& model, const Discretization& mesh) {
  Analysis analysis = static_on(mesh, Geometry::linear);
  analysis.output.points_per_member = 10 * mesh.elements * mesh.order + 1;
  Result result = solve_soundly(model, analysis);
  return result.states.at(0);
}

TEST(WeightlessBeamOnGround, TouchesOverHalfAWaveLength) {
  const Model model = beam_on_ground(6.0);
  const Discretization mesh = fixed_mesh(24, 6);
  const State state = linear_state(model, mesh);
  ASSERT_EQ(state.foundations[0].contact.size(), 1u);
  EXPECT_NEAR(state.foundations[0].contact[0][0], 3.0 - 1.570796326795, 1e-8);
  EXPECT_NEAR(state.foundations[0].contact[0][1], 3.0 + 1.570796326795, 1e-8);
  const std::size_t middle = state.members[0].s.size() / 2;
  EXPECT_NEAR(-state.members[0].y[middle], 0.5451657053637, 1e-8);
  EXPECT_NEAR(state.members[0].bending_moment[middle], 0.2725828526818, 1e-8);
  expect_balance(model, mesh, state, 1e-9, Geometry::linear);
}

struct HeavyBeam {
  const char* ratio;
  double from, to, centre, uplift;
};

std::vector<HeavyBeam> heavy_beams(const Table& table) {
  std::vector<HeavyBeam> out;
  for (const char* ratio : {"1.02", "1.1", "1.5", "2", "3", "5", "10"}) {
    HeavyBeam beam{ratio, 0.0, 0.0, 0.0, 0.0};
    for (const TableRow& row : table.rows()) {
      if (row.text("parameter") != std::string("P/P_sep=") + ratio) continue;
      const std::string& quantity = row.text("quantity");
      if (quantity == "lift-off start beta*x1") beam.from = row.number("value");
      if (quantity == "lift-off end beta*x2") beam.to = row.number("value");
      if (quantity == "w(0) K/q") beam.centre = row.number("value");
      if (quantity == "max uplift w K/q") beam.uplift = row.number("value");
    }
    out.push_back(beam);
  }
  return out;
}

/// Top of the parabola through the highest sample and its neighbours.
double highest_of(const std::vector<double>& y) {
  const auto i = static_cast<std::size_t>(std::max_element(y.begin(), y.end()) - y.begin());
  const double a = y[i - 1];
  const double b = y[i + 1];
  return y[i] - (a - b) * (a - b) / (8.0 * (a - 2.0 * y[i] + b));
}

TEST(HeavyBeamOnGround, LiftsOffWhereTheExactSolutionDoes) {
  constexpr double kHalf = 40.0;
  constexpr double kSeparation = 46.28138526556;  // P beta / q
  const Table table("tensionless_beams_linear.csv");
  for (const HeavyBeam& beam : heavy_beams(table)) {
    Model model = beam_on_ground(2.0 * kHalf);
    model.loads = {force_at(at_member("m", 0.5), 0.0, -kSeparation * std::stod(beam.ratio)),
                   DistributedLoad{"m", {0.0, -1.0}, {0.0, 1.0}, LoadMeasure::length, Pattern::proportional}};
    const Discretization mesh = fixed_mesh(240, 6);
    const State state = linear_state(model, mesh);
    const auto& contact = state.foundations[0].contact;
    ASSERT_EQ(contact.size(), 3u) << beam.ratio;
    EXPECT_NEAR(contact[0][1], kHalf - beam.to, 1e-7) << beam.ratio;
    EXPECT_NEAR(contact[1][0], kHalf - beam.from, 1e-7) << beam.ratio;
    EXPECT_NEAR(contact[1][1], kHalf + beam.from, 1e-7) << beam.ratio;
    EXPECT_NEAR(contact[2][0], kHalf + beam.to, 1e-7) << beam.ratio;
    const std::vector<double>& y = state.members[0].y;
    expect_relative(-y[y.size() / 2], beam.centre, 1e-8, beam.ratio);
    EXPECT_NEAR(-highest_of(y), beam.uplift, 1e-8 * beam.centre) << beam.ratio;
    expect_balance(model, mesh, state, 1e-9, Geometry::linear);
  }
}

TEST(HeavyBeamOnGround, StaysOnTheGroundBelowTheSeparationLoad) {
  for (const bool above : {false, true}) {
    Model model = beam_on_ground(80.0);
    const double P = 46.28138526556 * (above ? 1.0 + 1e-4 : 1.0 - 1e-4);
    model.loads = {force_at(at_member("m", 0.5), 0.0, -P),
                   DistributedLoad{"m", {0.0, -1.0}, {0.0, 1.0}, LoadMeasure::length, Pattern::proportional}};
    const State state = linear_state(model, fixed_mesh(160, 6));
    EXPECT_EQ(state.foundations[0].contact.size(), above ? 3u : 1u);
    if (above) {
      EXPECT_NEAR(state.foundations[0].contact[0][1], 40.0 - kPi, 0.05) << "at beta x = pi";
    }
  }
}

}  // namespace
}  // namespace snapthrough
