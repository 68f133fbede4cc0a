/// Members whose sections taper, against closed forms.
///
/// Unless a test says otherwise, the member has the length 1, and its diameter falls linearly to half: with
/// z = 1 - x / 2, EI = z^4 and EA = EA0 z^2.
#include "tests/convergence/fitted_slope.h"
#include "tests/verification/balance.h"
#include "tests/verification/cases.h"
#include "tests/verification/root.h"

namespace snapthrough {
namespace {

using namespace testing;

AlongMember tapered(double from, double to, double power) {
  return AlongMember({{0.0, from}, {1.0, to}}, power);
}

Model cone(double EA, const std::string& start, const std::string& end) {
  Model model = straight(1.0, 1.0, EA, start, end);
  model.sections[0].EA = tapered(EA, 0.25 * EA, 2.0);
  model.sections[0].EI = tapered(1.0, 1.0 / 16.0, 4.0);
  return model;
}

Model pressed(Model model) {
  model.loads = {force_at(at_node("b"), -1.0, 0.0)};
  return model;
}

constexpr double kInextensible = 1e14;

void expect_load(const Model& model, double expected, const std::string& what) {
  for (const Analysis& analysis : {buckling_on(accurate(1e-9)), buckling_on(fixed_mesh(8, 6)),
                                   analysis_of(AnalysisType::critical, accurate(1e-9))}) {
    const Result result = solve_soundly(model, analysis);
    ASSERT_TRUE(result.summary.critical_load_factor) << what;
    expect_relative(*result.summary.critical_load_factor, expected, 1e-9, what);
  }
}

/// EI w'' + P w = 0 is z^4 d2w/dz2 + a^2 w = 0 with a^2 = 4 P: w = z sin(a / z - a), which is zero at z = 1/2
/// for a = pi. In general P = pi^2 sqrt(EI(0) EI(L)) / L^2.
TEST(Tapers, PinnedConeBucklesAsTheGeometricMeanOfItsEnds) {
  expect_load(pressed(cone(kInextensible, "xy", "y")), 0.25 * kPi * kPi, "thin end pressed");
  Model turned = pressed(cone(kInextensible, "xy", "y"));
  turned.sections[0].EI = tapered(1.0 / 16.0, 1.0, 4.0);
  turned.sections[0].EA = tapered(0.25 * kInextensible, kInextensible, 2.0);
  expect_load(turned, 0.25 * kPi * kPi, "thick end pressed");
}

/// w = z sin(a / z - 2 a) from the free tip; w' = 0 at the foot, z = 1: tan a = -a, P = a^2 / 4 = 1.0289646.
TEST(Tapers, ConeClampedAtItsThickEnd) {
  const double a = root([](double x) { return std::sin(x) + x * std::cos(x); }, 1.6, 2.5);
  expect_relative(0.25 * a * a, 1.0289646, 1e-7, "value by hand");
  expect_load(pressed(cone(kInextensible, "xyr", "")), 0.25 * a * a, "clamped foot");
}

/// EI = z^n of a pinned column, a^2 = 4 P. n = 2: w = sqrt(z) sin(b log z), b^2 = a^2 - 1/4. n = 1 and 3:
/// w = sqrt(z) Z1(2 a sqrt(z)) and sqrt(z) Z1(2 a / sqrt(z)), Z1 a sum of the Bessel functions J1 and Y1.
TEST(Tapers, PinnedColumnsOfEveryPower) {
  const auto cross = [](double u, double v) {
    return std::cyl_bessel_j(1.0, u) * std::cyl_neumann(1.0, v) -
           std::cyl_bessel_j(1.0, v) * std::cyl_neumann(1.0, u);
  };
  const double b = kPi / std::numbers::ln2;
  const double half = std::sqrt(0.5);
  const double a[] = {root([&](double x) { return cross(2.0 * x, 2.0 * x * half); }, 4.0, 6.5),
                      std::sqrt(b * b + 0.25),
                      root([&](double x) { return cross(2.0 * x / half, 2.0 * x); }, 3.0, 4.5)};
  for (const int n : {1, 2, 3}) {
    Model model = pressed(straight(1.0, 1.0, kInextensible, "xy", "y"));
    model.sections[0].EI = tapered(1.0, std::pow(0.5, n), n);
    expect_load(model, 0.25 * a[n - 1] * a[n - 1], "power " + std::to_string(n));
  }
}

/// Constant to the middle, from there a cone to half the diameter: with w = sin(k x) and z sin(k / z - 2 k),
/// z = 3/2 - x, equal slopes over values at the middle: k cot(k / 2) = -1 - k cot k, P = k^2.
TEST(Tapers, BeginWhereTheirFirstFractionIs) {
  const double k = root(
      [](double x) {
        return x * std::cos(0.5 * x) / std::sin(0.5 * x) + 1.0 + x * std::cos(x) / std::sin(x);
      },
      1.6, 3.0);
  Model model = pressed(straight(1.0, 1.0, kInextensible, "xy", "y"));
  model.sections[0].EI = AlongMember({{0.5, 1.0}, {1.0, 1.0 / 16.0}}, 4.0);
  expect_load(model, k * k, "half a cone");
}

/// A pinned column of two members with EI 4 and 1: tan(k / 4) / (1/2) + tan(k / 2) = 0 with P = k^2 and the
/// lower half stiffer: k1 = k / 2, k2 = k.
TEST(Tapers, StepsAreTwoMembers) {
  const double k = root(
      [](double x) {
        return 2.0 * std::sin(0.25 * x) * std::cos(0.5 * x) + std::sin(0.5 * x) * std::cos(0.25 * x);
      },
      3.2, 6.2);
  Model model = pressed(straight(1.0, 4.0, kInextensible, "xy", "y"));
  model.nodes.push_back({"middle", 0.5, 0.0});
  model.sections.push_back({"thin", kInextensible, 1.0, {}});
  model.members = {{"lower", "a", "middle", "s", LineCurve{}}, {"upper", "middle", "b", "thin", LineCurve{}}};
  expect_load(model, k * k, "step");
}

TEST(Tapers, KeepTheOrderOfConvergence) {
  const std::vector<std::vector<int>> elements = {
      {16, 32, 64, 128}, {8, 16, 32, 64}, {6, 8, 12, 16}, {16, 20, 22}, {8, 10, 12}};
  for (int order = 1; order <= 5; ++order) {
    std::vector<double> error;
    const std::vector<int>& counts = elements[static_cast<std::size_t>(order - 1)];
    for (const int n : counts) {
      const Result result =
          solve_soundly(pressed(cone(kInextensible, "xy", "y")), buckling_on(fixed_mesh(n, order)));
      error.push_back(result.summary.critical_load_factor.value_or(0.0) / (0.25 * kPi * kPi) - 1.0);
    }
    const double slope = fitted_order(counts, error);
    EXPECT_GT(slope, 2.0 * order - (order == 5 ? 1.0 : 0.4)) << "order " << order;
    if (order <= 3) {
      EXPECT_LT(slope, 2.0 * order + 0.4) << "order " << order;
    }
  }
}

/// A force F at the tip of a cantilever: F L^3 / (3 EI r) + F L / (GA r) across and F L / (EA r) along, r =
/// 1/2 the ratio of the diameters and EI, GA, EA those of the thick end.
TEST(Tapers, TipOfACantilever) {
  Model model = cone(1e3, "xyr", "");
  model.sections[0].GA = tapered(50.0, 12.5, 2.0);
  model.loads = {force_at(at_node("b"), 1.0, 1.0)};
  const Result result = solve_soundly(model, static_on(fixed_mesh(8, 5), Geometry::linear));
  const MemberState& m = result.states.at(0).members[0];
  expect_relative(m.v.back(), 2.0 / 3.0 + 2.0 / 50.0, 1e-9, "across");
  expect_relative(m.u.back(), 2.0 / 1e3, 1e-9, "along");
}

/// Mass m z^2 per length under gravity g along x: N = 2/3 m g (z^3 - 1/8), and the tip moves by
/// m g / (3 EA0).
TEST(Tapers, WeightOfAHangingCone) {
  Model model = cone(1e3, "xyr", "");
  model.sections[0].mass = tapered(3.0, 0.75, 2.0);
  model.loads = {SelfWeight{{10.0, 0.0}, Pattern::constant}};
  for (const int n : {1, 4}) {
    const State state = solve_soundly(model, static_on(fixed_mesh(n, 6), Geometry::linear)).states.at(0);
    const MemberState& m = state.members[0];
    EXPECT_NEAR(state.supports[0].fx, -30.0 * 7.0 / 12.0, 1e-9);
    for (std::size_t i = 0; i < m.s.size(); ++i)
      EXPECT_NEAR(m.axial_force[i], 20.0 * (std::pow(1.0 - 0.5 * m.s[i], 3) - 0.125), 1e-9);
    EXPECT_NEAR(m.u.back(), 30.0 / 3e3, n == 4 ? 1e-11 : 1e-6);
  }
}

/// A tapered arch: the same load when it is drawn from its other foot, and of two members with a node at a
/// quarter, where z = 7/8.
TEST(Tapers, OfAnArchDoNotDependOnHowItIsDrawn) {
  const auto load_of = [](const Model& model) {
    const Result result = solve_soundly(model, analysis_of(AnalysisType::critical, accurate(1e-9)));
    EXPECT_TRUE(result.summary.critical_load_factor);
    return result.summary.critical_load_factor.value_or(0.0);
  };
  Model model = straight(2.0, 1.0, 1e3, "xyr", "xyr");
  model.sections[0].EI = tapered(1.0, 1.0 / 16.0, 4.0);
  model.sections[0].EA = tapered(1e3, 250.0, 2.0);
  model.members[0].curve = ArcCurve{-60.0};
  model.loads = {force_at(at_member("m", 0.5), 0.0, -1.0)};
  const double load = load_of(model);
  Model turned = model;
  std::swap(turned.members[0].start, turned.members[0].end);
  turned.members[0].curve = ArcCurve{60.0};
  turned.sections[0].EI = tapered(1.0 / 16.0, 1.0, 4.0);
  turned.sections[0].EA = tapered(250.0, 1e3, 2.0);
  expect_relative(load_of(turned), load, 1e-8, "from the other foot");
  Model split = model;
  const double angle = kPi / 12.0;  // from the crown to the quarter; radius 2
  split.nodes.push_back({"q", 1.0 - 2.0 * std::sin(angle), 2.0 * (std::cos(angle) - std::cos(2.0 * angle))});
  split.sections = {
      {"s", tapered(1e3, 1e3 * 49.0 / 64.0, 2.0), tapered(1.0, std::pow(0.875, 4), 4.0), {}},
      {"t", tapered(1e3 * 49.0 / 64.0, 250.0, 2.0), tapered(std::pow(0.875, 4), 1.0 / 16.0, 4.0), {}}};
  split.members = {{"foot", "a", "q", "s", ArcCurve{-15.0}}, {"m", "q", "b", "t", ArcCurve{-45.0}}};
  split.loads = {force_at(at_member("m", 1.0 / 3.0), 0.0, -1.0)};
  expect_relative(load_of(split), load, 1e-8, "two members");
}

/// P = pi^2 sqrt(EI(0) EI(1)): the derivative by EI(1) is P / (2 EI(1)).
TEST(Tapers, SensitivityToTheThinEnd) {
  const Model model = pressed(cone(kInextensible, "xy", "y"));
  Analysis analysis = analysis_of(AnalysisType::critical, accurate(1e-9));
  Variation thin;
  thin.pointer = "/model/sections/0/EI/along/1/1";
  thin.value = 1.0 / 16.0;
  thin.size = thin.value;
  thin.model_at = [model](double EI) {
    Model changed = model;
    changed.sections[0].EI.points[1].second = EI;
    return std::optional(changed);
  };
  analysis.sensitivities = {thin};
  const Result result = solve_soundly(model, analysis);
  ASSERT_FALSE(result.critical_points.empty());
  ASSERT_EQ(result.critical_points[0].sensitivities.size(), 1U);
  expect_relative(result.critical_points[0].sensitivities[0].derivative.value_or(0.0), 2.0 * kPi * kPi, 1e-7,
                  "derivative");
}

TEST(Tapers, HaveNoEffectiveLength) {
  const Result result = solve_soundly(pressed(cone(kInextensible, "xy", "y")), buckling_on(accurate(1e-6)));
  ASSERT_TRUE(result.buckling);
  EXPECT_FALSE(result.buckling->modes.at(0).effective_lengths.at(0).length);
}

/// Large displacements of a tapered arch under its weight and a force: members and nodes balance.
TEST(Tapers, BalanceUnderLargeDisplacements) {
  Model model = straight(4.0, 1.0, 100.0, "xyr", "xy");
  model.sections[0].EI = AlongMember({{0.25, 2.0}, {0.75, 0.5}}, 3.0);
  model.sections[0].EA = AlongMember({{0.0, 100.0}, {1.0, 60.0}});
  model.sections[0].GA = tapered(40.0, 20.0, 1.0);
  model.sections[0].mass = tapered(0.1, 0.02, 2.0);
  model.members[0].curve = ArcCurve{-70.0};
  model.loads = {force_at(at_member("m", 0.25), 0.3, -1.0), SelfWeight{{0.0, -10.0}, Pattern::constant}};
  const Discretization mesh = fixed_mesh(8, 5);
  Analysis analysis = static_on(mesh, Geometry::nonlinear, {0.2});
  analysis.output.points_per_member = output_points(mesh);
  expect_balance(model, mesh, solve_soundly(model, analysis).states.at(0), 1e-9);
}

}  // namespace
}  // namespace snapthrough
