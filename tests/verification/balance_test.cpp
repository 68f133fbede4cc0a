/// Global balance of structures with everything on them, and of work and energy along paths of dead loads.
///
/// No outside source: statics. Members are free bodies under end forces, loads and base reactions rebuilt
/// from positions (tests/verification/balance.h); nodes are in balance with supports, springs and loads.
/// Tolerance 1e-9 of the largest force on meshes whose quadrature error is below it. The work of a dead load,
/// int lambda d(delta), equals the energy of members (N^2 / 2EA + Q^2 / 2GA + M^2 / 2EI) and bases (r^2 /
/// 2K), by Simpson's rule over samples: its error limits the tolerance.
#include "tests/verification/balance.h"
#include "tests/reaction_sum.h"
#include "tests/verification/cases.h"
#include "tests/verification/turning_points.h"

namespace snapthrough {
namespace {

using namespace testing;

/// Three members at a node, a hinge, an inclined support, loads of all kinds, springs and bases of all kinds.
Model crowded_frame(bool with_one_sided, bool with_pressure = true) {
  Model model;
  model.nodes = {{"a", 0.0, 0.0}, {"b", 4.0, 3.0}, {"c", 9.0, 2.0}, {"d", 4.5, -2.0}};
  model.sections = {{"s", 4e3, 60.0, 1.5e3}, {"t", 9e3, 30.0, {}}};
  model.members = {{"left", "a", "b", "s", ArcCurve{-50.0}, false, false},
                   {"right", "b", "c", "t", LineCurve{}, true, false},
                   {"post", "d", "b", "t", ArcCurve{20.0}, false, false}};
  model.supports = {support("a", "xyr"), support("c", "y", 70.0), support("d", "xy")};
  model.springs = {
      {"p", at_node("b"), std::array{1.0, 0.5}, 6.0, Reaction::bilateral, 0.0},
      {"q", at_node("b"), {}, 9.0, Reaction::bilateral, 0.0},
      {"r", at_member("left", 0.5), std::array{0.2, -1.0}, 4.0, Reaction::compression_only, 0.001}};
  Foundation shear = winkler("left", 3.0, 2.0);
  shear.id = "shear";
  Foundation fixed = winkler("right", 2.0, 1.0);
  fixed.id = "fixed";
  fixed.direction = std::array{-0.3, 1.0};
  fixed.range = {0.25, 1.0};
  model.foundations = {shear, fixed};
  if (with_one_sided) {
    Foundation soil = one_sided("right", 5.0, Side::right);
    soil.gap = 0.01;
    model.foundations.push_back(soil);
  }
  model.loads = {
      force_at(at_member("left", 0.25), 0.3, -2.0, 0.4),
      force_at(at_node("b"), 0.5, -1.0, 0.7),
      DistributedLoad{"left", {0.1, -0.4}, {0.25, 0.75}, LoadMeasure::horizontal, Pattern::proportional},
      DistributedLoad{"post", {0.3, 0.1}, {0.0, 1.0}, LoadMeasure::vertical, Pattern::constant},
      DistributedLoad{"right", {0.0, -0.3}, {0.0, 0.5}, LoadMeasure::length, Pattern::proportional},
  };
  if (with_pressure) {
    model.loads.push_back(PressureLoad{"post", 0.2, Side::left, Pattern::proportional});
    model.loads.push_back(PressureLoad{"left", 0.1, Side::left, Pattern::constant});
  }
  return model;
}

class CrowdedFrame : public ::testing::TestWithParam<std::tuple<bool, bool, Geometry>> {};

TEST_P(CrowdedFrame, IsInBalance) {
  const auto [one_sided_base, pressure, geometry] = GetParam();
  const Model model = crowded_frame(one_sided_base, pressure);
  const Discretization mesh = fixed_mesh(16, 6);
  Analysis analysis = static_on(mesh, geometry, {0.4, 1.0});
  analysis.output.points_per_member = output_points(mesh);
  const Result result = solve_soundly(model, analysis);
  ASSERT_EQ(result.states.size(), 2u);
  for (const State& state : result.states) {
    expect_balance(model, mesh, state, 1e-9, geometry);
    // the hinge carries no moment, and the members do
    EXPECT_NEAR(member_of(state, "right").bending_moment.front(), 0.0, 1e-9);
    EXPECT_GT(std::abs(member_of(state, "left").bending_moment.back()), 0.1);
  }
}

INSTANTIATE_TEST_SUITE_P(BasesAndPressure, CrowdedFrame,
                         ::testing::Combine(::testing::Bool(), ::testing::Bool(),
                                            ::testing::Values(Geometry::nonlinear, Geometry::linear)));

/// A support that is moved, inclined, and shares its node with two members, a spring and a load.
TEST(Balance, HoldsAtADisplacedInclinedSupport) {
  for (const Geometry geometry : {Geometry::nonlinear, Geometry::linear}) {
    Model model = crowded_frame(true);
    model.nodes.push_back({"e", 12.0, 4.0});
    model.members.push_back({"far", "c", "e", "s", LineCurve{}, false, true});
    model.supports[1].displacement = PrescribedDisplacement{0.0, -0.05, 0.0, Pattern::proportional};
    model.supports.push_back(support("e", "xy", -30.0));
    model.supports.back().displacement = PrescribedDisplacement{0.02, 0.01, 0.0, Pattern::constant};
    model.springs.push_back({"t", at_node("c"), std::array{0.3, 1.0}, 8.0, Reaction::tension_only, 0.001});
    model.loads.push_back(force_at(at_node("c"), 0.4, -0.6, 0.2));
    model.loads.push_back(InitialStrain{"far", 1e-3, 2e-2, Pattern::proportional});
    const Discretization mesh = fixed_mesh(16, 6);
    Analysis analysis = static_on(mesh, geometry, {0.5, 1.0});
    analysis.output.points_per_member = output_points(mesh);
    const Result result = solve_soundly(model, analysis);
    ASSERT_EQ(result.states.size(), 2u);
    for (const State& state : result.states) expect_balance(model, mesh, state, 1e-9, geometry);
  }
}

/// What is summed is zero to rounding on any mesh, also where springs act inside elements, axes are not
/// resolved and the base is lumped.
TEST(Balance, OfReactionsIsExactOnCoarseMeshes) {
  for (const Geometry geometry : {Geometry::nonlinear, Geometry::linear}) {
    for (const FoundationRule rule : {FoundationRule::consistent, FoundationRule::lumped}) {
      Discretization mesh = fixed_mesh(2, 1);
      mesh.foundation = rule;
      const Model model = crowded_frame(true);
      const Result result = solve_soundly(model, static_on(mesh, geometry, {0.4, 0.7}));
      ASSERT_EQ(result.states.size(), 2u);
      for (const State& state : result.states) {
        const ReactionSum sum = reaction_sum(model, state, geometry);
        EXPECT_LT(sum.imbalance(), 1e-12);
        EXPECT_GT(sum.largest_force, 0.1);
      }
    }
  }
}

/// The checker sees what is wrong: a state of another load, or one with a force changed by 1e-6.
TEST(Balance, IsBrokenByAWrongState) {
  const Model model = crowded_frame(false, false);
  const Discretization mesh = fixed_mesh(16, 6);
  Analysis analysis = static_on(mesh, Geometry::nonlinear, {1.0});
  analysis.output.points_per_member = output_points(mesh);
  State state = solve_soundly(model, analysis).states.at(0);
  state.members[0].axial_force.front() *= 1.0 + 1e-6;
  EXPECT_GT(imbalance_of(model, mesh, state).member_force, 1e-8);
  state.members[0].axial_force.front() /= 1.0 + 1e-6;
  state.load_factor = 1.001;
  EXPECT_GT(imbalance_of(model, mesh, state).member_force, 1e-5);
  state.load_factor = 1.0;
  state.members[2].bending_moment.back() += 1e-5;
  EXPECT_GT(imbalance_of(model, mesh, state).node_moment, 1e-8);
  state.members[2].bending_moment.back() -= 1e-5;
  state.supports[2].fx *= 1.0 + 1e-6;
  EXPECT_GT(imbalance_of(model, mesh, state).supports, 1e-8);
  EXPECT_GT(imbalance_of(model, mesh, state).sum, 1e-8);
  state.foundations[0].resultant.moment += 1e-4;
  EXPECT_GT(imbalance_of(model, mesh, state).foundations, 1e-8);
  state.springs[2].resultant.fy += 1e-5;
  EXPECT_GT(imbalance_of(model, mesh, state).springs, 1e-8);
  state.loads.fy += 1e-5;
  EXPECT_GT(imbalance_of(model, mesh, state).loads, 1e-8);
}

/// Simpson's rule over equally spaced samples, an odd number of them.
template <class F>
double simpson(const std::vector<double>& s, F f) {
  double sum = 0.0;
  for (std::size_t i = 0; i + 2 < s.size(); i += 2)
    sum += (s[i + 2] - s[i]) / 6.0 * (f(i) + 4.0 * f(i + 1) + f(i + 2));
  return sum;
}

double energy_of(const Model& model, const State& state) {
  const Section& section = model.sections[0];
  double energy = 0.0;
  for (const MemberState& m : state.members)
    energy += simpson(m.s, [&](std::size_t i) {
      const double N = m.axial_force[i];
      const double Q = m.shear_force[i];
      const double M = m.bending_moment[i];
      return 0.5 * (N * N / section.EA.constant + (section.GA ? Q * Q / section.GA->constant : 0.0) +
                    M * M / section.EI.constant);
    });
  for (std::size_t f = 0; f < state.foundations.size(); ++f) {
    const FoundationState& base = state.foundations[f];
    energy += simpson(base.s, [&](std::size_t i) {
      return 0.5 * base.reaction[i] * base.reaction[i] / model.foundations[f].stiffness;
    });
  }
  return energy;
}

/// int lambda d(delta) up to each point of a branch, by polynomials through eight points and Gauss's rule.
std::vector<double> work_along(const Branch& branch, std::size_t monitor, double force) {
  constexpr std::size_t kPoints = 8;
  const double gauss[] = {0.5 - std::sqrt(15.0) / 10.0, 0.5, 0.5 + std::sqrt(15.0) / 10.0};
  const double weight[] = {5.0 / 18.0, 8.0 / 18.0, 5.0 / 18.0};
  const std::vector<double>& s = branch.arc_length;
  std::vector<double> work(s.size(), 0.0);
  for (std::size_t i = 0; i + 1 < s.size(); ++i) {
    const std::size_t from = std::min(i > kPoints / 2 ? i - kPoints / 2 : 0, s.size() - kPoints);
    const NewtonPolynomial load(s, branch.load_factor, from, kPoints);
    const NewtonPolynomial way(s, branch.monitors[monitor].values, from, kPoints);
    work[i + 1] = work[i];
    for (int g = 0; g < 3; ++g) {
      const double at = s[i] + gauss[g] * (s[i + 1] - s[i]);
      work[i + 1] += weight[g] * (s[i + 1] - s[i]) * force * load.value(at) * way.slope(at);
    }
  }
  return work;
}

/// The rows of a branch whose load factors states have, in their order.
Branch rows_of(const Branch& branch, const std::vector<const State*>& states) {
  Branch rows;
  rows.monitors.push_back({branch.monitors[0].id, {}});
  std::size_t row = 0;
  for (const State* state : states) {
    while (row < branch.load_factor.size() && branch.load_factor[row] != state->load_factor) ++row;
    if (row == branch.load_factor.size()) break;
    rows.load_factor.push_back(branch.load_factor[row]);
    rows.arc_length.push_back(branch.arc_length[row]);
    rows.monitors[0].values.push_back(branch.monitors[0].values[row]);
  }
  return rows;
}

void expect_work_is_energy(const Model& model, Analysis analysis, double force, double tolerance) {
  analysis.output.states = StateOutput::all;
  analysis.output.points_per_member = 48 * analysis.discretization.elements + 1;
  const Result result = solve_soundly(model, analysis);
  std::vector<const State*> states;  // those of the points, without those of critical points
  for (const State& state : result.states) {
    bool critical = false;
    for (const CriticalPoint& point : result.critical_points)
      critical =
          critical || (point.state && &result.states[static_cast<std::size_t>(*point.state)] == &state);
    if (!critical) states.push_back(&state);
  }
  const Branch branch = rows_of(result.branches[0], states);
  ASSERT_EQ(states.size(), branch.load_factor.size());
  ASSERT_GT(states.size(), 40u);
  const std::vector<double> work = work_along(branch, 0, force);
  double largest = 0.0;
  for (const double w : work) largest = std::max(largest, std::abs(w));
  for (std::size_t i = 0; i < work.size(); ++i)
    EXPECT_NEAR(work[i], energy_of(model, *states[i]), tolerance * largest) << "point " << i;
}

/// Shallow arch through both its limit points: the load turns round and takes energy back.
TEST(Energy, IsTheWorkOfTheLoadThroughSnapThrough) {
  Analysis analysis = path_on(fixed_mesh(12, 6), 2);
  analysis.step.max = 0.12;
  expect_work_is_energy(arch(20.0, 420.0, 1.4), analysis, -1.4e-4, 1e-8);
}

/// The one-sided base gives back what it took: its zone of contact moves along the path. r^2 has a kink in
/// its second derivative where contact ends.
TEST(Energy, IsTheWorkOfTheLoadWithMovingContact) {
  Model model = arch(20.0, 420.0, 1.4);
  add_soil(model, 1e5);
  Analysis analysis = path_on(fixed_mesh(12, 6), 2);
  analysis.step.max = 0.12;
  expect_work_is_energy(model, analysis, -1.4e-4, 1e-6);
}

}  // namespace
}  // namespace snapthrough
