/// Straight columns by their differential equation: against the elements, closed forms and tables, and at the
/// extremes of length and stiffness.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "solver/accuracy/buckling_loads.h"
#include "solver/column/column_line.h"
#include "solver/column/exact_column.h"
#include "solver/discrete/build_structure.h"
#include "solver/discrete/mechanism.h"
#include "solver/resolve/resolved_model.h"
#include "tests/verification/cases.h"
#include "tests/verification/random_column.h"
#include "tests/verification/reference_table.h"

namespace snapthrough {
namespace {

using namespace testing;

/// Rounding, with a digit or two lost: what the exact solution claims.
constexpr double kRounding = 1e-12;

Analysis buckling(int modes = 1, double accuracy = 1e-3) {
  Discretization chosen;
  chosen.accuracy = accuracy;
  return buckling_on(chosen, modes);
}

bool is_exact(const Result& result) {
  return std::any_of(result.diagnostics.skipped.begin(), result.diagnostics.skipped.end(),
                     [](const std::string& text) { return text.starts_with("mesh and its refinement"); });
}

Result solve_exactly(const Model& model, const Analysis& analysis) {
  Result result = solve_soundly(model, analysis);
  EXPECT_TRUE(is_exact(result));
  return result;
}

Model column_of(const std::string& start, const std::string& end) {
  Model model = straight(1.0, 1.0, 1e6, start, end);
  model.loads = {force_at(at_node("b"), -1.0, 0.0)};
  return model;
}

double first_load(const Model& model) {
  return solve_exactly(model, buckling()).summary.critical_load_factor.value_or(NAN);
}

/// Displacements of a mode at all sampled places in one list.
std::vector<double> shape_of(const Mode& mode) {
  std::vector<double> out;
  for (const MemberMode& member : mode.members) {
    out.insert(out.end(), member.u.begin(), member.u.end());
    out.insert(out.end(), member.v.begin(), member.v.end());
  }
  return out;
}

double product(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

/// Sine of the angle between two shapes.
double angle_between(const Mode& a, const Mode& b) {
  const std::vector<double> u = shape_of(a);
  const std::vector<double> v = shape_of(b);
  const double cosine = product(u, v) / std::sqrt(product(u, u) * product(v, v));
  return std::sqrt(std::max(0.0, 1.0 - cosine * cosine));
}

/// The elements' loads with their own estimates. What they can't estimate (two meshes have different numbers
/// of loads when one of them counts a load far above all others) is compared to 1e-6.
TEST(ExactColumn, HasTheLoadsOfElementsOnRandomColumns) {
  int compared = 0;
  for (std::uint64_t seed = 1; seed <= 400; ++seed) {
    const Model model = random_column(seed);
    const Analysis analysis = buckling(1 + static_cast<int>(seed % 4), 1e-9);
    if (!check(model, analysis).empty() || can_move(resolve(model))) continue;
    const Result result = solve(model, analysis);
    ASSERT_TRUE(is_exact(result)) << "seed " << seed;
    const std::vector<double> loads = column_buckling(*column_line(resolve(model)), analysis.modes)->loads;
    const bool unstable = result.summary.termination == "unstable_at_start";
    EXPECT_EQ(result.buckling->load_factors, unstable ? std::vector<double>() : loads) << "seed " << seed;
    const Structure first = make_structure(resolve(model), analysis.discretization, Geometry::nonlinear);
    const BucklingLoads general = buckling_loads(analysis, first);
    EXPECT_EQ(general.buckling.negative_at_start > 0, unstable);
    if (loads.empty() && general.buckling.loads.empty()) continue;
    // forces that cancel leave rounding errors in the elements, and loads of the order of their inverse
    if (loads.empty() && general.buckling.loads[0] > 1e12 * general.structure->scales.load) continue;
    ASSERT_EQ(loads.size(), general.buckling.loads.size()) << "seed " << seed;
    EXPECT_EQ(result.failure.has_value(),
              !unstable && loads.size() < static_cast<std::size_t>(analysis.modes));
    for (std::size_t i = 0; i < loads.size(); ++i) {
      const double tolerance = general.errors[i] ? std::max(1e-8, *general.errors[i]) : 1e-6;
      expect_relative(loads[i], general.buckling.loads[i] / general.structure->scales.load, tolerance,
                      "seed " + std::to_string(seed) + " mode " + std::to_string(i));
      ++compared;
    }
  }
  EXPECT_GT(compared, 800);
}

/// Modes of loads a hundredth apart from their neighbours. Twelve elements of order six a member: h^6 of
/// some tenths of a half wave, and what rounding leaves.
TEST(ExactColumn, HasTheModesOfElementsOnRandomColumns) {
  constexpr double kApart = 1e-2;
  int compared = 0;
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    const Model model = random_column(seed);
    if (!check(model, buckling()).empty() || can_move(resolve(model))) continue;
    const Result result = solve(model, buckling(3));
    const int elements = 12 * static_cast<int>(model.members.size());
    const Result general = solve(model, buckling_on(fixed_mesh(elements, 6), 3));
    const std::vector<double>& loads = result.buckling->load_factors;
    if (loads.size() != 3) continue;
    for (std::size_t i = 0; i < 2; ++i) {
      const double below = i > 0 ? loads[i - 1] : 0.0;
      if (std::min(loads[i] - below, loads[i + 1] - loads[i]) < kApart * loads[i]) continue;
      EXPECT_LT(angle_between(result.buckling->modes[i], general.buckling->modes[i]), 1e-5)
          << "seed " << seed << " mode " << i;
      ++compared;
    }
  }
  EXPECT_GT(compared, 120);
}

/// Euler's cases: P L^2 / EI = (n pi)^2 by effective length; clamped-pinned, tan x = x.
TEST(ExactColumn, HasEulersLoads) {
  const double clamped_pinned = 4.493409457909064;
  const struct {
    const char* start;
    const char* end;
    double root;
  } cases[] = {
      {"xy", "y", kPi},       {"xyr", "", 0.5 * kPi},       {"xyr", "yr", 2.0 * kPi},    {"xyr", "r", kPi},
      {"xy", "r", 0.5 * kPi}, {"xyr", "y", clamped_pinned}, {"xy", "yr", clamped_pinned}};
  for (const auto& c : cases)
    expect_relative(first_load(column_of(c.start, c.end)), c.root * c.root, kRounding,
                    std::string(c.start) + " " + c.end);
}

TEST(ExactColumn, HasTheTransferMatrixValuesOfColumnsWithOneSpring) {
  constexpr double kPrinted = 1e-11;  // twelve digits
  const Table table("column_discrete_spring_gamma.csv");
  for (const TableRow& row : table.rows()) {
    const std::string ends = row.text("bc");
    Model model = column_of(ends == "PP" ? "xy" : "xyr", ends == "CF" ? "" : ends == "CC" ? "yr" : "y");
    model.springs = {{"k", at_member("m", 1.0 - row.number("c_b")), std::array{0.0, 1.0}, row.number("kx"),
                      Reaction::bilateral, 0.0}};
    expect_relative(first_load(model), kPi * kPi * row.number("Gamma"), kPrinted,
                    ends + " c_b " + row.text("c_b") + " kx " + row.text("kx"));
  }
}

/// On a Winkler base P_n = P_e (n^2 + k / n^2) (Hetenyi 1946), K = k pi^4. With k = n^2 (n + 1)^2 the loads
/// of n and of n + 1 half waves are one, and its modes are all that these two add up to.
TEST(ExactColumn, FindsTheDoubleLoadsOfPinnedColumnsOnWinklerBases) {
  for (const int n : {1, 2, 3, 5, 10, 30, 100}) {
    Model model = column_of("xy", "y");
    const double k = std::pow(n * (n + 1.0), 2);
    model.foundations = {winkler("m", k * std::pow(kPi, 4))};
    Analysis analysis = buckling(2);
    analysis.output.points_per_member = 1001;
    const Result result = solve_exactly(model, analysis);
    const std::string what = "n " + std::to_string(n);
    for (const double load : result.buckling->load_factors)
      expect_relative(load, kPi * kPi * (n * n + k / (n * n)), kRounding, what);
    EXPECT_GT(angle_between(result.buckling->modes[0], result.buckling->modes[1]), 0.1) << what;
    for (const Mode& mode : result.buckling->modes) {
      const MemberMode& m = mode.members[0];
      // sines are orthogonal on equally spaced places
      std::array<double, 2> share{};
      for (std::size_t i = 0; i < m.s.size(); ++i)
        for (int j = 0; j < 2; ++j) share[j] += 0.002 * m.v[i] * std::sin((n + j) * kPi * m.s[i]);
      for (std::size_t i = 0; i < m.s.size(); ++i)
        EXPECT_NEAR(m.v[i],
                    share[0] * std::sin(n * kPi * m.s[i]) + share[1] * std::sin((n + 1) * kPi * m.s[i]), 1e-9)
            << what;
    }
  }
}

/// All loads of one column in order, hundreds of half waves, on bases over twelve decades.
TEST(ExactColumn, HasHetenyisLoadsInOrder) {
  for (const double k : {1e-4, 1e-1, 1.0, 77.0, 1e3, 1e5, 1e8}) {
    Model model = column_of("xy", "y");
    model.foundations = {winkler("m", k * std::pow(kPi, 4))};
    std::vector<double> expected;
    for (int n = 1; n <= 1000; ++n) expected.push_back(kPi * kPi * (n * n + k / (1.0 * n * n)));
    std::sort(expected.begin(), expected.end());
    const Result result = solve_exactly(model, buckling(12));
    ASSERT_EQ(result.buckling->load_factors.size(), 12U);
    for (std::size_t i = 0; i < 12; ++i)
      expect_relative(result.buckling->load_factors[i], expected[i], kRounding, "k " + std::to_string(k));
  }
}

TEST(ExactColumn, HasTheLoadsOnTwoParameterBases) {
  constexpr double kPrinted = 2e-12;
  const Table table("column_two_parameter_foundation.csv");
  for (const TableRow& row : table.rows()) {
    const std::string ends = row.text("bc");
    Model model = column_of(ends == "PP" ? "xy" : "xyr", ends == "CC" ? "yr" : "y");
    model.foundations = {winkler("m", row.number("k1"), row.number("k2") * kPi * kPi)};
    if (row.number("k1") + row.number("k2") == 0.0) model.foundations.clear();
    expect_relative(first_load(model), row.number("lambda"), kPrinted, ends);
  }
}

/// A column with free ends buckles at sqrt(K EI) at either of them (Hetenyi 1946, a long bar), the other end
/// being exp(-x) away: two equal loads whose modes have nothing in common.
TEST(ExactColumn, LongColumnsWithFreeEndsBuckleAtBothEnds) {
  for (const double decay_lengths : {100.0, 300.0, 1000.0}) {
    Model model = column_of("", "");
    model.supports = {support("a", "x")};
    model.foundations = {winkler("m", 4.0 * std::pow(decay_lengths, 4))};
    const Result result = solve_exactly(model, buckling(3));
    const double expected = 2.0 * decay_lengths * decay_lengths;
    ASSERT_EQ(result.buckling->load_factors.size(), 3U);
    expect_relative(result.buckling->load_factors[0], expected, kRounding, "first");
    expect_relative(result.buckling->load_factors[1], expected, kRounding, "second");
    EXPECT_GT(result.buckling->load_factors[2], 1.9 * expected);
    EXPECT_GT(angle_between(result.buckling->modes[0], result.buckling->modes[1]), 0.99);
  }
}

/// Two pinned bars with a spring at the hinge between them tilt at P = k L / 4, whatever EI.
TEST(ExactColumn, BarsWithAHingeTilt) {
  for (const double EI : {1.0, 1e9}) {
    Model model = column_of("xy", "");
    model.nodes.push_back({"c", 2.0, 0.0});
    model.sections[0].EI = EI;
    model.members.push_back({"n", "c", "b", "s", LineCurve{}, false, true});
    model.supports.push_back(support("c", "y"));
    model.loads = {force_at(at_node("c"), -1.0, 0.0)};
    model.springs = {{"k", at_node("b"), std::array{0.0, 3.0}, 4.0, Reaction::bilateral, 0.0}};
    EXPECT_NEAR(first_load(model), 2.0, 2.0 * kRounding) << EI;
  }
}

TEST(ExactColumn, ForcesBetweenHeldPlacesFollowFromTheLengths) {
  // held at both ends, pushed at a quarter: three quarters of the load compress the quarter
  Model model = column_of("xyr", "xyr");
  model.loads = {force_at(at_member("m", 0.25), 1.0, 0.0)};
  const Result pushed = solve_exactly(model, buckling());
  const Result elements = solve_soundly(model, buckling_on(fixed_mesh(24, 6)));
  expect_relative(*pushed.summary.critical_load_factor, *elements.summary.critical_load_factor, 1e-9, "push");
  // heated: P = EA alpha T
  model.loads = {InitialStrain{"m", 1e-3, 0.0, Pattern::proportional}};
  expect_relative(first_load(model), 4.0 * kPi * kPi / 1e3, kRounding, "heat");
}

TEST(ExactColumn, TensionAndOverloadAreReportedAsByElements) {
  Model model = column_of("xy", "y");
  model.loads = {force_at(at_node("b"), 1.0, 0.0)};
  EXPECT_EQ(solve_exactly(model, buckling()).summary.termination, "no_buckling");
  PointLoad weight = force_at(at_node("b"), -20.0, 0.0);
  weight.pattern = Pattern::constant;
  model.loads = {force_at(at_node("b"), -1.0, 0.0), weight};
  const Result overloaded = solve_exactly(model, buckling());
  EXPECT_EQ(overloaded.summary.termination, "unstable_at_start");
  EXPECT_TRUE(overloaded.buckling->load_factors.empty()) << "the lowest beyond is that of the second mode";
}

/// Springs of 1e8 and 1e10 EI / L^3 beside free spans, and tension of thousands of Euler loads: these columns
/// once lost digits or could not be done.
TEST(ExactColumn, KeepsItsDigitsBesideStiffSpringsAndStrongTension) {
  for (const std::uint64_t seed : {213, 1240, 1283, 2530, 3181}) {
    const Result result = solve_exactly(random_column(seed), buckling(5));
    EXPECT_EQ(result.buckling->load_factors.size(), 5U) << "seed " << seed;
    EXPECT_LE(result.discretization.estimated_accuracy.value_or(1.0), kRounding) << "seed " << seed;
  }
  // the node of the second mode stays where it is, however stiff the spring
  for (const double stiffness : {1e6, 1e9, 1e12, 1e15}) {
    Model model = column_of("xy", "y");
    model.springs = {{"k", at_member("m", 0.5), std::array{0.0, 1.0}, stiffness, Reaction::bilateral, 0.0}};
    expect_relative(first_load(model), 4.0 * kPi * kPi, kRounding, std::to_string(stiffness));
  }
}

/// Whatever the equation leaves out is left to the elements.
TEST(ExactColumn, LeavesOtherStructuresToElements) {
  const Model column = column_of("xy", "y");
  const auto left = [](Model model, Analysis analysis = buckling()) {
    return !is_exact(solve_soundly(model, analysis));
  };
  EXPECT_FALSE(left(column));
  EXPECT_TRUE(left(column, buckling_on(fixed_mesh(8, 4))));
  Model other = column;
  other.sections[0].GA = 1e3;
  EXPECT_TRUE(left(other)) << "shearable";
  other = column;
  other.foundations = {one_sided("m", 10.0, Side::left)};
  EXPECT_TRUE(left(other)) << "one-sided";
  other = column;
  other.loads.push_back(
      DistributedLoad{"m", {-1.0, 0.0}, {0.0, 1.0}, LoadMeasure::length, Pattern::proportional});
  EXPECT_TRUE(left(other)) << "own weight";
  other = column;
  other.loads.push_back(force_at(at_member("m", 0.5), 0.0, 1e-3));
  EXPECT_TRUE(left(other)) << "lateral load";
  other = column;
  other.springs = {{"k", at_member("m", 0.5), std::array{1.0, 1.0}, 5.0, Reaction::bilateral, 0.0}};
  EXPECT_TRUE(left(other)) << "inclined spring";
  other = column;
  other.supports[1] = support("b", "y", 10.0);
  EXPECT_TRUE(left(other)) << "inclined support";
  other = column;
  other.imperfections = {SineImperfection{"m", 1, 1e-3}};
  EXPECT_TRUE(left(other)) << "imperfection";
  other = column;
  other.members[0].curve = ArcCurve{1.0};
  EXPECT_TRUE(left(other)) << "curved";
}

/// Springs whatever close to a node or to one another are one with them.
TEST(ExactColumn, ShortSpansLoseNoDigits) {
  for (const double gap : {1e-3, 1e-6, 1e-9, 1e-12}) {
    Model model = column_of("xy", "y");
    Model together = model;
    for (const double at : {0.5 - gap, 0.5, 0.5 + gap})
      model.springs.push_back({"k" + std::to_string(model.springs.size()), at_member("m", at),
                               std::array{0.0, 1.0}, 20.0, Reaction::bilateral, 0.0});
    together.springs = {{"k", at_member("m", 0.5), std::array{0.0, 1.0}, 60.0, Reaction::bilateral, 0.0}};
    // symmetric about the middle: the error is of the order of gap^2
    expect_relative(first_load(model), first_load(together), kRounding + 10.0 * gap * gap,
                    std::to_string(gap));
  }
}

}  // namespace
}  // namespace snapthrough
