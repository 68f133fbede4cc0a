/// Supports whose reaction falls beyond a peak, against closed forms.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "tests/verification/cases.h"

namespace snapthrough {
namespace {

using namespace testing;
using Interpolation = ReactionLaw::Interpolation;
using Points = std::vector<std::array<double, 2>>;

ReactionLaw table(const Points& points, Interpolation interpolation) {
  ReactionLaw law;
  law.type = ReactionLaw::Type::table;
  law.points = points;
  law.interpolation = interpolation;
  return law;
}

/// Reaction at the displacement w by straight lines through the origin and the points of a table, constant
/// beyond the last.
double lines(const Points& points, double w) {
  std::array<double, 2> from{0.0, 0.0};
  for (const auto& to : points) {
    if (w < to[0]) return from[1] + (to[1] - from[1]) * (w - from[0]) / (to[0] - from[0]);
    from = to;
  }
  return from[1];
}

/// Cubic between a peak (w0, p0) and a valley (w1, p1): its slope vanishes at both.
double between_peak_and_valley(double w0, double p0, double w1, double p1, double w) {
  const double t = (w - w0) / (w1 - w0);
  return p0 + (p1 - p0) * t * t * (3.0 - 2.0 * t);
}

/// Largest value of f at the places of a grid, refined about the largest until rounding.
double largest(const std::function<double(double)>& f, double from, double to) {
  while (to - from > 1e-13) {
    double best = from;
    const double step = (to - from) / 200.0;
    for (int i = 0; i <= 200; ++i)
      if (f(from + i * step) > f(best)) best = from + i * step;
    from = std::max(from, best - step);
    to = std::min(to, best + step);
  }
  return f(0.5 * (from + to));
}

/// Load P down and h P sideways on the head of a bar on a rotational spring: P (sin t + h cos t) = M(t).
Model pushed_bar(const ReactionLaw& law, double h) {
  Model model = bar_on_spring(law);
  model.loads = {force_at(at_node("head"), h, -1.0)};
  model.monitors = {{"turn", at_node("foot"), Component::rotation}};
  return model;
}

/// The limit point is where the lines of the table have their corner, or before it.
TEST(FallingLaw, LimitPointOfABar) {
  const Points points{{0.1, 1.0}, {0.2, 1.4}, {0.6, 0.5}};
  for (const double h : {0.01, 0.2, 1.0}) {
    const Result result = solve_soundly(pushed_bar(table(points, Interpolation::linear), h),
                                        analysis_of(AnalysisType::critical, accurate(1e-9)));
    ASSERT_TRUE(result.summary.critical_load_factor) << h;
    EXPECT_EQ(result.summary.critical_type, CriticalType::limit_max);
    const double expected =
        largest([&](double t) { return lines(points, t) / (std::sin(t) + h * std::cos(t)); }, 0.0, 0.6);
    expect_relative(*result.summary.critical_load_factor, expected, 1e-8, "limit point");
  }
}

/// Between the peak of a cubic table and its residual reaction the path is P(t) = M(t) / (sin t + h cos t) as
/// well; it ends where asked.
TEST(FallingLaw, PathBeyondThePeak) {
  constexpr double h = 1.0;
  const Points points{{0.1, 1.0}, {0.4, 0.4}, {0.6, 0.4}};
  Analysis analysis = path_on(accurate(1e-8), 1);
  analysis.stop = {};
  analysis.stop.monitor = MonitorRange{"turn", {-0.39, 1.0}};
  analysis.stop.steps = 500;
  const Result result = solve_soundly(pushed_bar(table(points, Interpolation::monotone_cubic), h), analysis);
  ASSERT_EQ(result.branches.size(), 1U);
  const Branch& path = result.branches[0];
  EXPECT_EQ(path.termination, "monitor");
  int beyond = 0;
  for (const int row : path.computed) {
    const auto i = static_cast<std::size_t>(row);
    const double t = -path.monitors[0].values[i];
    if (t < 0.1 || t > 0.4) continue;
    ++beyond;
    EXPECT_NEAR(path.load_factor[i],
                between_peak_and_valley(0.1, 1.0, 0.4, 0.4, t) / (std::sin(t) + h * std::cos(t)), 1e-8)
        << t;
  }
  EXPECT_GT(beyond, 3);
  for (const Warning& warning : result.warnings)
    EXPECT_NE(warning.code, "unloaded_beyond_peak") << warning.detail;
  EXPECT_TRUE(result.capacity.empty()) << "a peak is no capacity that a support keeps";
}

/// A spring holds the head of a bar sideways: as the bar turns past the horizontal, the head comes back.
TEST(FallingLaw, TellsASupportThatGoesBackFromBeyondItsPeak) {
  Model model = bar_on_spring(ReactionLaw{});
  model.springs[0].law.reset();
  model.springs[0].at = at_node("head");
  model.springs[0].direction = {1.0, 0.0};
  model.springs[0].law = table({{0.2, 1.0}, {0.9, 0.3}}, Interpolation::monotone_cubic);
  model.loads = {force_at(at_node("head"), 0.05, -1.0)};
  model.monitors = {{"turn", at_node("foot"), Component::rotation}};
  const auto told = [&](double turn) {
    Analysis analysis = path_on(accurate(1e-6), 1);
    analysis.stop = {};
    analysis.stop.monitor = MonitorRange{"turn", {-turn, 1.0}};
    analysis.stop.steps = 500;
    const Result result = solve_soundly(model, analysis);
    EXPECT_EQ(result.branches.at(0).termination, "monitor") << turn;
    std::string out;
    for (const Warning& warning : result.warnings)
      if (warning.code == "unloaded_beyond_peak") out += warning.detail;
    return out;
  };
  EXPECT_EQ(told(1.5), "");
  EXPECT_NE(told(2.2).find("\"spring\" at load factor"), std::string::npos);
}

/// Half of a long beam (EI = 1) that a force Q / 2 presses at its middle into a foundation with p = k w up to
/// w1 and p = k w1 - c (w - w1) beyond. With mu^4 = c and w - w1 - k w1 / c = v, v'''' = mu^4 v up to x = a,
/// where w = w1; beyond it w = e^(-l y) (w1 cos l y + F sin l y), y = x - a, 4 l^4 = k. Four conditions at a
/// give v and F; Q(a) is largest at the limit load.
class SofteningBed {
 public:
  static constexpr double k = 4.0;
  static constexpr double c = 0.7;
  static constexpr double w1 = 1e-5;  ///< so small that the beam's rotation does not matter

  [[nodiscard]] static double force(double a) {
    const double mu = std::sqrt(std::sqrt(c));
    const double l = std::sqrt(std::sqrt(k / 4.0));
    // v = A cosh(mu x) + B (sinh(mu x) - sin(mu x)) + C cos(mu x), whose slope is zero at x = 0
    const double ch = std::cosh(mu * a), sh = std::sinh(mu * a), co = std::cos(mu * a), si = std::sin(mu * a);
    Eigen::Matrix4d M;
    M << ch, sh - si, co, 0.0,                                          //
        mu * sh, mu * (ch - co), -mu * si, -l,                          //
        mu * mu * ch, mu * mu * (sh + si), -mu * mu * co, 2.0 * l * l,  //
        mu * mu * mu * sh, mu * mu * mu * (ch + co), mu * mu * mu * si, -2.0 * l * l * l;
    const Eigen::Vector4d right(-k * w1 / c, -l * w1, 0.0, 2.0 * l * l * l * w1);
    return 4.0 * mu * mu * mu * M.fullPivLu().solve(right)[1];
  }
};

TEST(FallingLaw, LimitLoadOfABeamThatAForcePressesIntoItsBed) {
  constexpr double w1 = SofteningBed::w1;
  constexpr double reach = 4.0;  // in w1: further than the beam goes at its limit load
  Model model = straight(20.0, 1.0, 1e6, "xr", "");
  Foundation bed = winkler("m", 0.0);
  bed.law = table(
      {{w1, SofteningBed::k * w1}, {reach * w1, (SofteningBed::k - SofteningBed::c * (reach - 1.0)) * w1}},
      Interpolation::linear);
  model.foundations = {bed};
  model.loads = {force_at(at_node("a"), 0.0, 0.5)};
  const Result result = solve_soundly(model, analysis_of(AnalysisType::critical, accurate(1e-9)));
  ASSERT_TRUE(result.summary.critical_load_factor);
  EXPECT_EQ(result.summary.critical_type, CriticalType::limit_max);
  const double expected = largest(SofteningBed::force, 1e-3, 3.0);
  expect_relative(*result.summary.critical_load_factor, expected, 1e-8, "limit load");
}

}  // namespace
}  // namespace snapthrough
