/// What a result says beside its states: points of paths, rows of static analyses, extremes, what was not
/// reached, warnings. Expectations are other outputs of the same analysis, or closed forms.
#include "tests/verification/cases.h"

namespace snapthrough {
namespace {

using namespace testing;

double max_gap(const std::vector<double>& values) {
  double gap = 0.0;
  for (std::size_t i = 0; i + 1 < values.size(); ++i) gap = std::max(gap, values[i + 1] - values[i]);
  return gap;
}

/// At least as many as asked, none further apart than that, all that the plain path has among them, and on
/// the path: a finer path's points interpolated between.
TEST(PathPoints, AreEvenlyAlongTheArcAndOnThePath) {
  for (const bool soil : {false, true}) {
    Model model = arch(20.0, 420.0, 1.4);
    if (soil) add_soil(model, 1e5);
    Analysis analysis = path_on(fixed_mesh(8, 4), 2);
    analysis.output.path_points = 2;
    const Result plain = solve_soundly(model, analysis);
    for (const int count : {2, 50, 400}) {
      analysis.output.path_points = count;
      const Result result = solve_soundly(model, analysis);
      EXPECT_TRUE(result.warnings.empty());
      const Branch& branch = result.branches.at(0);
      const std::vector<double>& arc = branch.arc_length;
      ASSERT_GE(arc.size(), static_cast<std::size_t>(count));
      EXPECT_EQ(branch.monitors[0].values.size(), arc.size());
      EXPECT_EQ(branch.negative_eigenvalues.size(), arc.size());
      const double length = arc.back() - arc.front();
      EXPECT_LE(max_gap(arc), length / (count - 1) * (1.0 + 1e-12));
      for (std::size_t i = 0; i + 1 < arc.size(); ++i) EXPECT_LT(arc[i], arc[i + 1]);
      for (const double s : plain.branches.at(0).arc_length)
        EXPECT_TRUE(std::find(arc.begin(), arc.end(), s) != arc.end()) << s;
      for (const CriticalPoint& point : result.critical_points) {
        const auto at = std::min_element(arc.begin(), arc.end(), [&point](double a, double b) {
          return std::abs(a - point.arc_length) < std::abs(b - point.arc_length);
        });
        EXPECT_NEAR(*at, point.arc_length, 1e-9 * length);
        EXPECT_NEAR(branch.load_factor[static_cast<std::size_t>(at - arc.begin())], point.load_factor,
                    1e-6 * std::abs(point.load_factor));
      }
    }
  }
}

/// The points between are equilibria: static analyses at their loads give their monitor.
TEST(PathPoints, AreEquilibria) {
  const Model model = arch(20.0, 420.0, 1.4);
  Analysis path = path_on(fixed_mesh(8, 4), 1);
  path.output.path_points = 60;
  const Result result = solve_soundly(model, path);
  const Branch& branch = result.branches.at(0);
  std::vector<double> loads;
  std::vector<double> crown;
  for (std::size_t i = 1; i + 1 < branch.load_factor.size(); ++i) {
    if (branch.load_factor[i] > 0.9 * branch.load_factor.back()) continue;
    loads.push_back(branch.load_factor[i]);
    crown.push_back(branch.monitors[0].values[i]);
  }
  ASSERT_GT(loads.size(), 20u);
  Analysis beyond_bifurcation = static_on(fixed_mesh(8, 4), Geometry::nonlinear, loads);
  beyond_bifurcation.unstable = Unstable::follow;
  const Result rows = solve_soundly(model, beyond_bifurcation);
  ASSERT_TRUE(rows.static_table);
  EXPECT_EQ(rows.static_table->load_factor, loads);
  for (std::size_t i = 0; i < loads.size(); ++i)
    expect_relative(rows.static_table->monitors.at(0).values[i], crown[i], 1e-7, std::to_string(loads[i]));
}

/// The stability count changes at critical points and nowhere else.
TEST(PathPoints, CountNegativeEigenvaluesAsThePathDoes) {
  Analysis analysis = path_on(fixed_mesh(8, 4), 2);
  analysis.output.path_points = 300;
  const Result result = solve_soundly(arch(20.0, 420.0, 1.4), analysis);
  const Branch& branch = result.branches.at(0);
  for (std::size_t i = 0; i < branch.arc_length.size(); ++i) {
    int count = 0;
    bool here = false;
    for (const CriticalPoint& point : result.critical_points) {
      here = here || std::abs(point.arc_length - branch.arc_length[i]) < 1e-9;
      if (point.arc_length <= branch.arc_length[i]) count = point.negative_after;
    }
    if (here) continue;
    EXPECT_EQ(branch.negative_eigenvalues[i], count) << i;
  }
}

TEST(PathPoints, OfBranchesToo) {
  Analysis analysis = path_on(fixed_mesh(8, 4), 2);
  analysis.branches.follow = Follow::first;
  analysis.output.path_points = 80;
  const Result result = solve_soundly(arch(20.0, 420.0, 1.4), analysis);
  ASSERT_EQ(result.branches.size(), 3u);
  for (const Branch& branch : result.branches) {
    EXPECT_GE(branch.arc_length.size(), 80u) << branch.id;
    EXPECT_LE(max_gap(branch.arc_length), branch.arc_length.back() / 79.0 * (1.0 + 1e-12)) << branch.id;
  }
}

/// Linear: the deflection of a cantilever's tip is P l^3 / 3 EI, in the order asked.
TEST(StaticTable, HasARowForEachLoadFactorInTheirOrder) {
  Model model = straight(2.0, 5.0, 1e4, "xyr", "");
  model.loads = {force_at(at_node("b"), 0.0, 1.0)};
  model.monitors = {{"tip", at_node("b"), Component::y}};
  model.foundations = {winkler("m", 0.0)};
  const std::vector<double> factors{1.0, -0.5, 0.0, 2.0};
  const Result linear = solve_soundly(model, static_on(fixed_mesh(2, 3), Geometry::linear, factors));
  ASSERT_TRUE(linear.static_table);
  EXPECT_EQ(linear.static_table->load_factor, factors);
  for (std::size_t i = 0; i < factors.size(); ++i) {
    EXPECT_NEAR(linear.static_table->monitors.at(0).values[i], factors[i] * 8.0 / 15.0, 1e-12);
    ASSERT_EQ(linear.static_table->state[i], static_cast<int>(i));
    EXPECT_EQ(linear.states[i].load_factor, factors[i]);
    EXPECT_EQ(linear.static_table->negative_eigenvalues[i], 0);
  }
  EXPECT_EQ(linear.static_table->contact_fraction.at(0).values.size(), factors.size());
  EXPECT_TRUE(linear.not_reached.empty());
  const Result bent = solve_soundly(model, static_on(fixed_mesh(2, 3), Geometry::nonlinear, factors));
  ASSERT_TRUE(bent.static_table);
  EXPECT_EQ(bent.static_table->load_factor, factors);
  EXPECT_LT(bent.static_table->monitors.at(0).values[0], 8.0 / 15.0);
  for (const auto& count : bent.static_table->negative_eigenvalues) EXPECT_EQ(count, 0);
}

TEST(StaticTable, ReturnsTheStatesAskedFor) {
  Model model = straight(2.0, 5.0, 1e4, "xyr", "");
  model.loads = {force_at(at_node("b"), 0.0, 1.0)};
  Analysis analysis = static_on(fixed_mesh(2, 3), Geometry::linear, {1.0, 2.0, 3.0, 4.0});
  using Index = std::optional<int>;
  analysis.output.states = StateOutput::every;
  analysis.output.every = 3;
  EXPECT_EQ(solve_soundly(model, analysis).static_table->state, (std::vector<Index>{0, {}, {}, 1}));
  analysis.output.states = StateOutput::at_load_factors;
  analysis.output.at_load_factors = {3.0};
  EXPECT_EQ(solve_soundly(model, analysis).static_table->state, (std::vector<Index>{{}, {}, 0, {}}));
  analysis.output.states = StateOutput::none;
  const Result result = solve_soundly(model, analysis);
  EXPECT_EQ(result.static_table->state, (std::vector<Index>(4)));
  EXPECT_TRUE(result.states.empty());
}

/// The arch turns back at its limit load: what lies beyond is listed, and the rest is there.
TEST(NotReached, ListsLoadFactorsBeyondALimitPoint) {
  const Model model = arch(20.0, 420.0, 1.4);
  Analysis analysis = static_on(fixed_mesh(8, 4), Geometry::nonlinear, {200.0, 20.0, 100.0, 40.0});
  EXPECT_EQ(solve(model, analysis).failure.value_or(Failure{}).code, "beyond_critical_point");
  analysis.unstable = Unstable::follow;  // the bifurcation at 66.26
  const Result result = solve(model, analysis);
  ASSERT_TRUE(result.failure);
  EXPECT_EQ(result.failure->code, "beyond_limit_point");
  EXPECT_EQ(result.not_reached, (std::vector<double>{200.0, 100.0}));
  EXPECT_EQ(result.static_table->load_factor, (std::vector<double>{20.0, 40.0}));
  EXPECT_EQ(result.states.size(), 2u);
}

TEST(NotReached, ListsStatesThatThePathDidNotMeet) {
  Analysis analysis = path_on(fixed_mesh(8, 4), 1);
  analysis.output.states = StateOutput::at_load_factors;
  analysis.output.at_load_factors = {90.0, 30.0, 0.0, -1.0};
  const Result result = solve_soundly(arch(20.0, 420.0, 1.4), analysis);
  EXPECT_EQ(result.not_reached, (std::vector<double>{90.0, -1.0}));
  ASSERT_EQ(result.states.size(), 2u);
  EXPECT_EQ(result.states[0].load_factor, 0.0);
  EXPECT_NEAR(result.states[1].load_factor, 30.0, 1e-9);
  EXPECT_NE(result.summary.message.find("2 of 4 load factors were not reached"), std::string::npos)
      << result.summary.message;
}

/// An imperfection names a mode that does not exist: nothing was reached.
TEST(NotReached, ListsAllWhereTheAnalysisCannotBegin) {
  Model model = straight(2.0, 5.0, 1e4, "xyr", "");
  model.loads = {force_at(at_node("b"), 1.0, 0.0)};
  model.imperfections = {ModeImperfection{1, 0.01}};
  const Result result = solve(model, static_on(fixed_mesh(2, 3), Geometry::nonlinear, {0.5, 1.0}));
  ASSERT_TRUE(result.failure);
  EXPECT_EQ(result.failure->code, "no_buckling_mode");
  EXPECT_EQ(result.not_reached, (std::vector<double>{0.5, 1.0}));
}

/// A cantilever under a tip force: N, Q and M of every state are known, and so are their extremes.
TEST(Extremes, AreThoseOfACantilever) {
  Model model = straight(2.0, 5.0, 1e4, "xyr", "");
  model.loads = {force_at(at_node("b"), -3.0, 1.0)};
  Analysis analysis = static_on(fixed_mesh(2, 3), Geometry::linear, {1.0, -0.5, 2.0});
  for (const StateOutput states : {StateOutput::all, StateOutput::none}) {
    analysis.output.states = states;
    analysis.output.extremes = true;
    const Result result = solve_soundly(model, analysis);
    ASSERT_TRUE(result.extremes);
    const MemberExtremes& m = result.extremes->at(0);
    EXPECT_EQ(m.id, "m");
    EXPECT_NEAR(m.axial_force.min.value, -6.0, 1e-12);
    EXPECT_NEAR(m.axial_force.max.value, 1.5, 1e-12);
    EXPECT_NEAR(m.shear_force.max.value, 2.0, 1e-12);
    EXPECT_NEAR(m.bending_moment.max.value, 4.0, 1e-11);
    EXPECT_EQ(m.bending_moment.max.s, 0.0);
    EXPECT_EQ(m.bending_moment.max.load_factor, 2.0);
    EXPECT_NEAR(m.bending_moment.min.value, -1.0, 1e-11);
    EXPECT_EQ(m.bending_moment.min.load_factor, -0.5);
    EXPECT_NEAR(m.displacement.value, std::hypot(2.0 * 8.0 / 15.0, 2.0 * 3.0 * 2.0 / 1e4), 1e-9);
    EXPECT_EQ(m.displacement.s, 2.0);
  }
}

/// A beam with a span load and a force at a third: M and Q between and beside the four places of the lists.
/// Its shear is q (L/2 - x) + 2 F / 3 before the force and F less beyond; M is largest where it is zero, or
/// at F.
TEST(Extremes, AreBetweenTheListedPlaces) {
  constexpr double kSpan = 3.0;
  constexpr double kLoad = 2.0;
  for (const double force : {0.0, 0.9, 9.0}) {
    Model model = straight(kSpan, 5.0, 1e4, "xy", "y");
    model.loads = {DistributedLoad{"m", {0.0, -kLoad}}, force_at({"", "m", 1.0 / 3.0}, 0.0, -force)};
    Analysis analysis = static_on(fixed_mesh(2, 4), Geometry::linear, {1.0});
    analysis.output.states = StateOutput::all;
    analysis.output.points_per_member = 4;
    const Result result = solve_soundly(model, analysis);
    const MemberPeaks& peaks = result.states.at(0).members.at(0).extremes;
    const double left = kLoad * kSpan / 2.0 + 2.0 * force / 3.0;
    const double right = left - force;
    const double zero = right > kLoad * kSpan / 3.0 ? right / kLoad : std::min(left / kLoad, kSpan / 3.0);
    const double moment = right > kLoad * kSpan / 3.0
                              ? force * kSpan / 3.0 + right * zero - kLoad * zero * zero / 2.0
                              : left * zero - kLoad * zero * zero / 2.0;
    EXPECT_NEAR(std::max(peaks.bending_moment.max.value, -peaks.bending_moment.min.value), moment,
                1e-6 * moment)
        << force;
    const double shear = std::max(left, kLoad * kSpan - right);
    EXPECT_NEAR(std::max(peaks.shear_force.max.value, -peaks.shear_force.min.value), shear, 1e-6 * shear);
  }
}

/// Up to the first critical load: those of a path that goes on are those of the one that ends there.
TEST(Extremes, EndAtTheFirstCriticalLoad) {
  const Model model = arch(20.0, 420.0, 1.4);
  Analysis analysis = path_on(fixed_mesh(8, 4), 2);
  analysis.output.extremes = true;
  const Result beyond = solve_soundly(model, analysis);
  ASSERT_TRUE(beyond.extremes);
  const Extreme& moved = beyond.extremes->at(0).displacement;
  const double critical = *beyond.summary.critical_load_factor;
  expect_relative(moved.load_factor, critical, 1e-6, "largest displacement at the critical load");
  EXPECT_EQ(moved.branch, 0);
  analysis.output.states = StateOutput::all;
  const Result all = solve_soundly(model, analysis);
  double largest = 0.0;
  for (const State& state : all.states)
    largest = std::max(largest, state.members[0].extremes.displacement.value);
  EXPECT_EQ(all.extremes->at(0).displacement.value, largest) << "of returned states, wherever they are";
  EXPECT_GT(largest, 1.5 * moved.value);
  analysis.output.extremes = false;
  EXPECT_FALSE(solve_soundly(model, analysis).extremes);
}

/// A bar pressed to a strain of P / EA beyond 0.05 says so, with the place and the load; below it doesn't.
TEST(Warnings, TellOfLargeStrains) {
  Model model = straight(1.0, 100.0, 10.0, "xyr", "yr");
  model.loads = {force_at(at_node("b"), 1.0, 0.0)};
  Result result = solve_soundly(model, static_on(fixed_mesh(2, 3), Geometry::linear, {0.4, 0.49}));
  EXPECT_TRUE(result.warnings.empty());
  result = solve_soundly(model, static_on(fixed_mesh(2, 3), Geometry::linear, {0.4, 0.8}));
  ASSERT_EQ(result.warnings.size(), 1u);
  EXPECT_EQ(result.warnings[0].code, "large_strain");
  EXPECT_NE(result.warnings[0].detail.find("0.08 in member \"m\""), std::string::npos)
      << result.warnings[0].detail;
  EXPECT_NE(result.warnings[0].detail.find("load factor 0.8"), std::string::npos);
}

/// Bending: a fibre at the radius of gyration is strained by M / EI sqrt(EI / EA), here 0.09 at the clamp.
TEST(Warnings, TellOfLargeBendingStrains) {
  Model model = straight(1.0, 1.0, 100.0, "xyr", "");
  model.loads = {force_at(at_node("b"), 0.0, 0.0, 0.9)};
  const Result result = solve_soundly(model, static_on(fixed_mesh(2, 3), Geometry::linear));
  ASSERT_EQ(result.warnings.size(), 1u);
  EXPECT_NE(result.warnings[0].detail.find("0.09 in member"), std::string::npos) << result.warnings[0].detail;
}

}  // namespace
}  // namespace snapthrough
