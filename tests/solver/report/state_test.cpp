/// What a state says of a structure in equilibrium: section forces by statics, reactions, contact, extremes.
#include "solver/report/state.h"

#include <gtest/gtest.h>

#include <cmath>

#include "solver/discrete/build_structure.h"
#include "solver/newton/contact_state.h"
#include "solver/problem/structural_problem.h"
#include "solver/report/contact.h"
#include "solver/report/extremes.h"
#include "solver/report/mode.h"
#include "solver/resolve/resolved_model.h"
#include "tests/solver/structures.h"

namespace snapthrough {
namespace {

OutputOptions with_points(int points) {
  OutputOptions out;
  out.points_per_member = points;
  return out;
}

/// The state at a load factor of the model, in equilibrium to rounding.
struct Solved {
  Structure structure;
  Eigen::VectorXd y;
  double lambda = 0.0;
};

Solved solve_at(const Model& model, const Discretization& mesh, double load_factor) {
  Solved out{make_structure(resolve(model), mesh, Geometry::nonlinear), {}, 0.0};
  StructuralProblem problem(out.structure);
  const PathMetric metric{&problem.metric(), 0.0};
  Workspace work;
  int factorisations = 0;
  out.y = Eigen::VectorXd::Zero(problem.size());
  // by steps, so that large displacements are reached
  constexpr int kSteps = 20;
  for (int i = 1; i <= kSteps; ++i) {
    out.lambda = load_factor * out.structure.scales.load * i / kSteps;
    const auto state = find_contact_state(problem, metric, out.lambda, work, factorisations, &out.y);
    EXPECT_TRUE(state);
    if (state) out.y = state->y;
  }
  CorrectorOptions exact;
  exact.max_iterations = 30;
  const auto outcome = correct(problem, metric, {}, 1.0, exact, out.y, out.lambda, work);
  EXPECT_EQ(outcome.status, CorrectorStatus::converged);
  return out;
}

/// Cantilever along x, bent far round by a force and a moment at its tip, a force inside and a dead load.
Model cantilever() {
  Model model;
  model.nodes = {{"a", 0.0, 0.0}, {"b", 2.0, 0.0}};
  model.sections = {{"s", 300.0, 1.5, 80.0}};
  model.members = {{"m", "a", "b", "s", LineCurve{}, false, false}};
  model.supports = {{"a", true, true, true, 0.0, {}}};
  model.loads = {PointLoad{{"b", "", 0.0}, {-0.5, 1.1}, 0.4, Pattern::proportional},
                 PointLoad{{"", "m", 0.5}, {0.2, 0.7}, -0.3, Pattern::proportional},
                 DistributedLoad{"m", {0.1, 0.6}, {0.0, 1.0}, LoadMeasure::length, Pattern::proportional}};
  return model;
}

/// The part beyond each section is in equilibrium: what acts on it is known, and where is in the state. The
/// dead load's moment is a trapezoidal sum over 400 intervals.
class SectionForcesOn : public ::testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Elements, SectionForcesOn,
                         ::testing::Values(1, 8));  // the force inside one, or between

TEST_P(SectionForcesOn, BalanceTheLoadsBeyondEachSection) {
  constexpr int kPoints = 401;
  constexpr double kTrapezoid = 1e-5;
  const Model model = cantilever();
  const Solved at = solve_at(model, testing::fixed_mesh(GetParam(), 6), 1.0);
  const State state = make_state(at.structure, at.y, at.lambda, with_points(kPoints));
  const MemberState& m = state.members[0];
  EXPECT_GT(m.rotation.back(), 0.6) << "displacements are large";
  const double h = 2.0 / (kPoints - 1);
  for (std::size_t i = 0; i < kPoints; i += 20) {
    if (i == 200) continue;  // two values where the force acts
    double fx = -0.5;
    double fy = 1.1;
    double moment = 0.4 + fy * (m.x[400] - m.x[i]) - fx * (m.y[400] - m.y[i]);
    if (i < 200) {
      fx += 0.2;
      fy += 0.7;
      moment += -0.3 + 0.7 * (m.x[200] - m.x[i]) - 0.2 * (m.y[200] - m.y[i]);
    }
    for (std::size_t j = i; j < kPoints; ++j) {
      const double part = (j == i || j == 400 ? 0.5 : 1.0) * (i == 400 ? 0.0 : h);
      fx += 0.1 * part;
      fy += 0.6 * part;
      moment += part * (0.6 * (m.x[j] - m.x[i]) - 0.1 * (m.y[j] - m.y[i]));
    }
    const double c = std::cos(m.rotation[i]);
    const double s = std::sin(m.rotation[i]);
    EXPECT_NEAR(m.axial_force[i], c * fx + s * fy, 1e-9) << m.s[i];
    EXPECT_NEAR(m.shear_force[i], -s * fx + c * fy, 1e-9) << m.s[i];
    EXPECT_NEAR(m.bending_moment[i], moment, kTrapezoid) << m.s[i];
  }
}

TEST(State, HasReactionsThatBalanceTheLoads) {
  const Model model = cantilever();
  const Solved at = solve_at(model, testing::fixed_mesh(8, 6), 1.0);
  const State state = make_state(at.structure, at.y, at.lambda, with_points(11));
  ASSERT_EQ(state.supports.size(), 1U);
  EXPECT_NEAR(state.supports[0].fx, 0.5 - 0.2 - 0.2, 1e-9);
  EXPECT_NEAR(state.supports[0].fy, -1.1 - 0.7 - 1.2, 1e-9);
  EXPECT_NEAR(state.supports[0].moment, -state.loads.moment, 1e-9);
  EXPECT_NEAR(state.supports[0].moment, -state.members[0].bending_moment.front(), 1e-9);
  EXPECT_NEAR(state.load_factor, 1.0, 1e-15);
}

/// A section force is the strain of its section: (x', y') = (1 + N/EA) t + (Q/GA) n by five-point
/// differences.
TEST(State, HasTheStrainsOfItsSectionForces) {
  constexpr int kPoints = 401;
  const Model model = cantilever();
  const Solved at = solve_at(model, testing::fixed_mesh(8, 6), 1.0);
  const MemberState m = make_state(at.structure, at.y, at.lambda, with_points(kPoints)).members[0];
  const double h = 2.0 / (kPoints - 1);
  const auto slope = [h](const std::vector<double>& f, std::size_t i) {
    return (f[i - 2] - 8.0 * f[i - 1] + 8.0 * f[i + 1] - f[i + 2]) / (12.0 * h);
  };
  for (std::size_t i = 25; i < kPoints; i += 50) {  // the middles of the elements
    const double c = std::cos(m.rotation[i]);
    const double s = std::sin(m.rotation[i]);
    const double stretch = 1.0 + m.axial_force[i] / 300.0;
    const double shear = m.shear_force[i] / 80.0;
    EXPECT_NEAR(slope(m.x, i), stretch * c - shear * s, 1e-7) << i;
    EXPECT_NEAR(slope(m.y, i), stretch * s + shear * c, 1e-7) << i;
    EXPECT_NEAR(slope(m.rotation, i), m.bending_moment[i] / 1.5, 1e-6) << i;
  }
}

/// Beam on ground that can only push, pressed in the middle: its ends lift off.
Model on_ground() {
  Model model;
  model.nodes = {{"a", 0.0, 0.0}, {"b", 1.0, 0.0}};
  model.sections = {{"s", 1e7, 1.0, {}}};
  model.members = {{"m", "a", "b", "s", LineCurve{}, false, false}};
  model.supports = {{"a", true, false, false, 0.0, {}}};
  Foundation soil{"soil", "m", 4e6, 0.0, Reaction::compression_only, Side::right, {0.0, 1.0}, 0.0, {}};
  model.foundations = {soil};
  model.loads = {PointLoad{{"", "m", 0.5}, {0.0, -1.0}, 0.0, Pattern::proportional}};
  return model;
}

TEST(State, HasContactWhereItsReactionIs) {
  const Model model = on_ground();
  const Solved at = solve_at(model, testing::fixed_mesh(20, 6), 1.0);
  const State state = make_state(at.structure, at.y, at.lambda, with_points(2001));
  const FoundationState& soil = state.foundations[0];
  ASSERT_EQ(soil.contact.size(), 1U);
  const auto [from, to] = soil.contact[0];
  EXPECT_NEAR(from + to, 1.0, 1e-6) << "symmetric";
  EXPECT_LT(to - from, 0.5);
  double sum = 0.0;
  for (std::size_t i = 0; i < soil.s.size(); ++i) {
    const bool inside = soil.s[i] > from && soil.s[i] < to;
    EXPECT_EQ(soil.reaction[i] > 0.0, inside) << soil.s[i];
    EXPECT_EQ(soil.displacement[i] > 0.0, inside) << soil.s[i];
    sum += soil.reaction[i] / 2000.0;
  }
  EXPECT_NEAR(sum, 1.0, 1e-3) << "the ground carries the load";
  EXPECT_NEAR(soil.resultant.fy, 1.0, 1e-9);
  EXPECT_NEAR(contact_fractions(at.structure, at.y)[0], to - from, 1e-12);
  // a penetration that is taken for none shortens it
  const double deepest = *std::ranges::max_element(soil.displacement);
  const auto deep = contact_intervals(at.structure, at.y, 0, 0.5 * deepest / at.structure.scales.length);
  ASSERT_EQ(deep.size(), 1U);
  EXPECT_LT(deep[0][1] - deep[0][0], 0.8 * (to - from));
  std::vector<int> zones;
  const ResolvedModel resolved = resolve(model);
  const ContactZones counter(at.structure);
  counter.count(at.y, zones);
  EXPECT_EQ(zones, std::vector<int>{1});
  counter.count(-at.y, zones);
  EXPECT_EQ(zones, std::vector<int>{2}) << "both ends press when the middle is lifted";
}

MemberState sampled(std::vector<double> moment) {
  MemberState m;
  m.id = "m";
  for (std::size_t i = 0; i < moment.size(); ++i) {
    m.s.push_back(static_cast<double>(i));
    m.axial_force.push_back(-moment[i]);
    m.shear_force.push_back(0.0);
    m.u.push_back(3.0 * moment[i]);
    m.v.push_back(4.0 * moment[i]);
  }
  const auto [least, most] = std::ranges::minmax_element(moment);
  const auto peak = [&](auto at, double factor) {
    return Peak{factor * *at, static_cast<double>(at - moment.begin())};
  };
  const auto far = std::abs(*least) > std::abs(*most) ? least : most;
  m.extremes = {{peak(most, -1.0), peak(least, -1.0)},
                {},
                {peak(least, 1.0), peak(most, 1.0)},
                {5.0 * std::abs(*far), static_cast<double>(far - moment.begin())}};
  m.bending_moment = std::move(moment);
  return m;
}

TEST(Extremes, AreOfAllStatesWithTheirPlaces) {
  std::vector<MemberExtremes> extremes;
  widen_extremes({sampled({0.0, 2.0, -1.0})}, 0, 0.5, extremes);
  widen_extremes({sampled({1.0, 1.5, -4.0})}, 2, 0.7, extremes);
  ASSERT_EQ(extremes.size(), 1U);
  const ExtremeRange& moment = extremes[0].bending_moment;
  EXPECT_EQ(moment.max.value, 2.0);
  EXPECT_EQ(moment.max.s, 1.0);
  EXPECT_EQ(moment.max.branch, 0);
  EXPECT_EQ(moment.max.load_factor, 0.5);
  EXPECT_EQ(moment.min.value, -4.0);
  EXPECT_EQ(moment.min.s, 2.0);
  EXPECT_EQ(moment.min.branch, 2);
  EXPECT_EQ(moment.min.load_factor, 0.7);
  EXPECT_EQ(extremes[0].axial_force.max.value, 4.0);
  EXPECT_EQ(extremes[0].displacement.value, 20.0);
}

TEST(Mode, IsScaledToItsLargestDisplacement) {
  Mode mode{{{"m", {0.0, 1.0, 2.0}, {0.0, 3.0, 0.0}, {0.0, -4.0, 1.0}, {1.0, -10.0, 0.5}}}};
  scale_to_largest(mode);
  const MemberMode& m = mode.members[0];
  EXPECT_DOUBLE_EQ(std::hypot(m.u[1], m.v[1]), 1.0);
  EXPECT_DOUBLE_EQ(std::abs(m.u[1]), 0.6);
  EXPECT_DOUBLE_EQ(std::abs(m.rotation[1]), 2.0);
  EXPECT_LT(m.u[1] * m.v[1], 0.0) << "its shape stays";
  Mode turned{{{"m", {0.0, 1.0}, {0.0, 0.0}, {0.0, 0.0}, {0.5, -0.25}}}};
  scale_to_largest(turned);
  EXPECT_DOUBLE_EQ(turned.members[0].rotation[0], 1.0) << "one that only turns, by its rotation";
  EXPECT_DOUBLE_EQ(turned.members[0].rotation[1], -0.5);
}

}  // namespace
}  // namespace snapthrough
