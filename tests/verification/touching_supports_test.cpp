/// One-sided supports that touch a straight column without pressure: the least load over the motions that
/// they allow.
///
/// Sources. A column with a base on one side buckles away from it, at Euler's load (reference values of
/// columns on tensionless bases: "pattern F, fully off, for every k"). With springs: Green's function of a
/// pinned beam-column,
///
///   G(x, y; P) = (sin(r x) sin(r (1 - y)) / (r sin r) - x (1 - y)) / P,  x <= y,  r = sqrt(P)
///
/// (Timoshenko and Gere 1961, 1.3); springs k that act at x_i make det(I / k + G(x_i, x_j)) = 0. With bases
/// of two stiffnesses: the boundary value problem w'''' + P w'' + K_1 max(w, 0) - K_2 max(-w, 0) = 0,
/// integrated.
#include <Eigen/Dense>

#include "solver/sweep/critical_curve.h"
#include "tests/verification/columns_between_supports.h"

namespace snapthrough {
namespace {

using namespace testing;

constexpr double kEuler = kPi * kPi;
const std::vector<double> kDrawings{0.0, 37.0, 90.0, 180.0, -127.0};

TEST(TouchingSupports, OneBaseLeavesTheColumnFree) {
  for (const double K : {1.0, 100.0, 1e4, 1e8}) {
    for (const double degrees : kDrawings) {
      for (const Side side : {Side::left, Side::right}) {
        Model model = drawn_column(degrees);
        model.foundations = {side_base("m1", K, side)};
        expect_first_loads(model, kEuler, std::to_string(K) + " at " + std::to_string(degrees));
      }
    }
  }
}

TEST(TouchingSupports, AStiffBaseLeavesAClampedColumnFree) {
  for (const double degrees : kDrawings) {
    Model model = drawn_column(degrees, {0.43, 1.0}, "xyr", "yr");
    model.foundations = {side_base("m1", 1e10, Side::left), side_base("m2", 1e10, Side::left)};
    expect_first_loads(model, 4.0 * kEuler, "clamped at " + std::to_string(degrees));
  }
}

TEST(TouchingSupports, ConstantActionsCount) {
  for (const double degrees : kDrawings) {
    Model model = drawn_column(degrees);
    model.foundations = {side_base("m1", 100.0, Side::left)};
    PointLoad dead = std::get<PointLoad>(model.loads[0]);
    dead.pattern = Pattern::constant;
    for (double& component : dead.force) component *= 4.0;
    model.loads.emplace_back(dead);
    expect_first_loads(model, kEuler - 4.0, "at " + std::to_string(degrees));
  }
}

/// A base of the model's own on the free side of the others changes nothing: no motion is held by it alone.
TEST(TouchingSupports, TheSofterSideDecidesWhileTheColumnBucklesInOneHalfWave) {
  for (const double degrees : kDrawings) {
    Model model = drawn_column(degrees);
    model.foundations = {side_base("m1", 100.0, Side::left), side_base("m1", 150.0, Side::right)};
    expect_first_loads(model, pinned_on_bilateral(100.0), "at " + std::to_string(degrees));
  }
}

double green(double x, double y, double P) {
  if (x > y) std::swap(x, y);
  const double r = std::sqrt(P);
  return (std::sin(r * x) * std::sin(r * (1.0 - y)) / (r * std::sin(r)) - x * (1.0 - y)) / P;
}

struct SideSpring {
  double at;
  double sign;
};

/// I / k + G over the springs that act, whose null vector are the forces.
Eigen::MatrixXd flexibility(const std::vector<SideSpring>& acting, double k, double P) {
  const auto n = static_cast<Eigen::Index>(acting.size());
  Eigen::MatrixXd out = Eigen::MatrixXd::Identity(n, n) / k;
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index j = 0; j < n; ++j)
      out(i, j) += acting[i].sign * acting[j].sign * green(acting[i].at, acting[j].at, P);
  return out;
}

/// Whether the springs of a set push, and the others open, in its mode at a load.
bool fits(const std::vector<SideSpring>& springs, unsigned set, double k, double P) {
  std::vector<SideSpring> acting;
  for (std::size_t i = 0; i < springs.size(); ++i)
    if ((set >> i) % 2 != 0) acting.push_back(springs[i]);
  const Eigen::VectorXd force =
      flexibility(acting, k, P).jacobiSvd(Eigen::ComputeFullV).matrixV().rightCols(1);
  if ((force.array() * force[0] <= 0.0).any()) return false;
  for (std::size_t i = 0; i < springs.size(); ++i) {
    double into = 0.0;
    for (std::size_t j = 0; j < acting.size(); ++j)
      into -= springs[i].sign * acting[j].sign * green(springs[i].at, acting[j].at, P) * force[j];
    if ((set >> i) % 2 == 0 && into * force[0] > 0.0) return false;
  }
  return true;
}

/// Loads between the poles of G at which det(I / k + G) of a set of springs is zero, ascending.
std::vector<double> loads_of(const std::vector<SideSpring>& springs, unsigned set, double k) {
  std::vector<SideSpring> acting;
  for (std::size_t i = 0; i < springs.size(); ++i)
    if ((set >> i) % 2 != 0) acting.push_back(springs[i]);
  const auto is_positive = [&](double P) { return flexibility(acting, k, P).determinant() > 0.0; };
  const auto pole = [](double P) { return std::floor(std::sqrt(P) / kPi); };
  constexpr double kScan = 1e-3;
  std::vector<double> out;
  // G has a pole at the Euler load
  for (double P = kEuler + 2.0 * kScan; P < 16.0 * kEuler; P += kScan) {
    double lo = P - kScan;
    double hi = P;
    if (pole(lo) != pole(hi) || is_positive(lo) == is_positive(hi)) continue;
    for (int i = 0; i < 60; ++i)
      (is_positive(0.5 * (lo + hi)) == is_positive(hi) ? hi : lo) = 0.5 * (lo + hi);
    out.push_back(lo);
  }
  return out;
}

/// The least load of any set of springs, with forces that push and gaps that open.
double least_load(const std::vector<SideSpring>& springs, double k) {
  double least = 1e300;
  for (unsigned set = 1; set < (1U << springs.size()); ++set)
    for (const double load : loads_of(springs, set, k))
      if (load < least && fits(springs, set, k, load)) least = load;
  return least;
}

Model column_on(const std::vector<SideSpring>& springs, double k, double degrees, double sign) {
  Model model = drawn_column(degrees);
  for (const SideSpring& spring : springs)
    model.springs.push_back(
        side_spring(at_member("m1", spring.at), normal_at(degrees), sign * spring.sign, k));
  return numbered(model);
}

TEST(TouchingSupports, SpringsOnDifferentSidesOfDifferentPlaces) {
  const std::vector<std::vector<SideSpring>> cases{{{0.3, 1.0}, {0.6, -1.0}},
                                                   {{0.3, 1.0}, {0.6, -1.0}, {0.8, 1.0}},
                                                   {{0.2, -1.0}, {0.45, 1.0}, {0.5, -1.0}, {0.85, 1.0}}};
  for (const auto& springs : cases) {
    for (const double k : {50.0, 1000.0}) {
      const double expected = least_load(springs, k);
      for (const double degrees : kDrawings)
        for (const double sign : {1.0, -1.0})
          expect_first_loads(column_on(springs, k, degrees, sign), expected,
                             std::to_string(k) + " at " + std::to_string(degrees));
      EXPECT_TRUE(
          solve_soundly(column_on(springs, k, 37.0, 1.0), buckling_on(chosen_mesh(1e-3))).warnings.empty());
    }
  }
}

using State = Eigen::Vector4d;  // w, w', w'', w'''

State end_state(double P, double third, double sign, double above, double below) {
  constexpr int kSteps = 3000;
  const double h = 1.0 / kSteps;
  const auto rate = [&](const State& y) {
    return State(y[1], y[2], y[3], -P * y[2] - (y[0] > 0.0 ? above : below) * y[0]);
  };
  State y(0.0, sign, 0.0, third);
  for (int i = 0; i < kSteps; ++i) {
    const State a = rate(y);
    const State b = rate(y + 0.5 * h * a);
    const State c = rate(y + 0.5 * h * b);
    const State d = rate(y + h * c);
    y += h / 6.0 * (a + 2.0 * b + 2.0 * c + d);
  }
  return y;
}

/// Newton's method on the load and the third derivative at the start of a column that leaves towards `sign`;
/// false when it fails.
bool shoot(double sign, double above, double below, Eigen::Vector2d& at) {
  for (int i = 0; i < 20; ++i) {
    const auto miss = [&](const Eigen::Vector2d& x) {
      const State y = end_state(x[0], x[1], sign, above, below);
      return Eigen::Vector2d(y[0], y[2] / x[0]);
    };
    const Eigen::Vector2d now = miss(at);
    Eigen::Matrix2d slope;
    for (int c = 0; c < 2; ++c) {
      const double step = 1e-6 * std::abs(at[c]);
      Eigen::Vector2d beside = at;
      beside[c] += step;
      slope.col(c) = (miss(beside) - now) / step;
    }
    const Eigen::Vector2d change = slope.partialPivLu().solve(now);
    at -= change;
    if (std::abs(change[0]) < 1e-11 * std::abs(at[0])) return true;
  }
  return false;
}

/// From n half waves on equal bases, one of which becomes stiffer by and by.
double stiffened(int n, double sign, double soft, double stiff) {
  constexpr int kSteps = 12;
  const double wave = n * n * kEuler;
  Eigen::Vector2d at(wave + soft / wave, -sign * wave);
  for (int i = 1; i <= kSteps; ++i)
    if (!shoot(sign, soft, soft + (stiff - soft) * i / kSteps, at)) return 1e300;
  return at[0];
}

TEST(TouchingSupports, BasesOfTwoStiffnesses) {
  const struct {
    double soft;
    double stiff;
  } cases[] = {{1000.0, 3000.0}, {500.0, 1000.0}, {1e4, 3e4}};
  for (const auto& c : cases) {
    double expected = 1e300;
    for (int n = 1; n <= 6; ++n)
      for (const double sign : {1.0, -1.0})
        expected = std::min(expected, stiffened(n, sign, c.soft, c.stiff));
    ASSERT_GT(expected, pinned_on_bilateral(c.soft));
    ASSERT_LT(expected, pinned_on_bilateral(c.stiff));
    for (const double degrees : kDrawings) {
      for (const Side side : {Side::left, Side::right}) {
        Model model = drawn_column(degrees);
        model.foundations = {side_base("m1", c.soft, side),
                             side_base("m1", c.stiff, side == Side::left ? Side::right : Side::left)};
        expect_first_loads(model, expected, std::to_string(c.stiff) + " at " + std::to_string(degrees));
      }
    }
  }
}

/// Bases push from different sides on different parts: the load does not depend on how the column is drawn,
/// and lies between those without and with all of them.
TEST(TouchingSupports, BasesOnDifferentSidesOfDifferentParts) {
  Model model = drawn_column(0.0);
  model.foundations = {side_base("m1", 1e4, Side::left, {0.0, 0.3}),
                       side_base("m1", 1e4, Side::right, {0.3, 0.6}),
                       side_base("m1", 1e4, Side::left, {0.6, 1.0})};
  const double load = first_load(model, AnalysisType::critical, chosen_mesh(1e-6));
  EXPECT_GT(load, kEuler);
  EXPECT_LT(load, pinned_on_bilateral(1e4));
  for (const double degrees : kDrawings) {
    Model drawn = drawn_column(degrees);
    drawn.foundations = model.foundations;
    expect_first_loads(drawn, load, "at " + std::to_string(degrees));
    Model split = drawn_column(degrees, {0.3, 0.6, 1.0});
    split.foundations = {side_base("m1", 1e4, Side::left), side_base("m2", 1e4, Side::right),
                         side_base("m3", 1e4, Side::left)};
    expect_first_loads(split, load, "split at " + std::to_string(degrees));
  }
}

TEST(TouchingSupports, SayWhenTheLeastLoadIsNotCertain) {
  Model model = drawn_column(90.0);
  model.foundations = {side_base("m1", 1000.0, Side::left), side_base("m1", 3000.0, Side::right)};
  for (const AnalysisType type : {AnalysisType::critical, AnalysisType::buckling}) {
    const Result uncertain = solve_soundly(numbered(model), analysis_of(type, chosen_mesh(1e-3)));
    ASSERT_EQ(uncertain.warnings.size(), 1u);
    EXPECT_EQ(uncertain.warnings[0].code, "touching_supports");
    Model certain = model;
    certain.foundations.pop_back();
    EXPECT_TRUE(solve_soundly(numbered(certain), analysis_of(type, chosen_mesh(1e-3))).warnings.empty());
  }
}

TEST(TouchingSupports, StatesBelowTheLeastLoadAreStable) {
  const std::vector<SideSpring> springs{{0.3, 1.0}, {0.6, -1.0}};  // 30.72 with k = 1000
  for (const double degrees : kDrawings) {
    const Result result = solve_soundly(column_on(springs, 1000.0, degrees, 1.0),
                                        static_on(fixed_mesh(10, 5), Geometry::nonlinear, {20.0, 30.0}));
    for (const auto& negative : result.static_table->negative_eigenvalues)
      EXPECT_EQ(negative, 0) << "at " << degrees;
  }
}

TEST(TouchingSupports, CurvesOfSweepsHaveTheLeastLoad) {
  CriticalCurveRequest request;
  request.model = [](double K) {
    Model model = drawn_column(90.0);
    model.foundations = {side_base("m1", K, Side::left)};
    return numbered(model);
  };
  request.analysis = analysis_of(AnalysisType::critical, fixed_mesh(9, 5));
  request.values = {10.0, 100.0, 1000.0, 1e4};
  request.logarithmic = true;
  for (const CriticalCurvePoint& point : follow_critical_point(request).points) {
    ASSERT_TRUE(point.load_factor) << point.failure;
    expect_relative(*point.load_factor, kEuler, 1e-6, std::to_string(point.value));
  }
}

/// A symmetric arch does not press a spring that holds its crown sideways; it sways away from it.
TEST(TouchingSupports, ASpringBesideTheCrownLeavesTheArchFree) {
  const Model free = arch(20.0, 1e7, 1.0);
  const double expected = first_load(free, AnalysisType::critical, chosen_mesh(1e-6));
  for (const double sign : {1.0, -1.0}) {
    Model model = free;
    model.springs = {side_spring(at_member("arch", 0.5), {1.0, 0.0}, sign, 1.0)};
    expect_relative(first_load(model, AnalysisType::critical, chosen_mesh(1e-6)), expected, 1e-6, "sway");
    // and when it is held from both sides, as the softer of the two holds it
    Model both = model;
    both.springs.push_back(side_spring(at_member("arch", 0.5), {1.0, 0.0}, -sign, 1e-6));
    Model bilateral = free;
    bilateral.springs = {side_spring(at_member("arch", 0.5), {1.0, 0.0}, 1.0, 1e-6, Reaction::bilateral)};
    expect_relative(first_load(both, AnalysisType::critical, chosen_mesh(1e-6)),
                    first_load(bilateral, AnalysisType::critical, chosen_mesh(1e-6)), 2e-6, "both sides");
  }
}

}  // namespace
}  // namespace snapthrough
