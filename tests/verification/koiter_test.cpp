/// Koiter's coefficients of bifurcations against closed forms.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/verification/cases.h"

namespace snapthrough {
namespace {

using namespace testing;

CriticalPoint first_point(const Model& model, double accuracy) {
  Analysis analysis = analysis_of(AnalysisType::critical, {});
  analysis.discretization.accuracy = accuracy;
  analysis.output.states = StateOutput::critical;
  analysis.koiter = true;
  const Result result = solve_soundly(model, analysis);
  if (result.critical_points.empty()) {
    ADD_FAILURE() << result.summary.message;
    return {};
  }
  return result.critical_points.front();
}

/// A pinned column with one half wave w = s sin(k x), inextensible: energy to the fourth order in s gives
/// P = (EI k^4 + K + EI s^2 k^6 / 2) / (k^2 + 3/8 s^2 k^4); without a base that is 1 + (s k)^2 / 8, the slope
/// at the ends being s k.
TEST(Koiter, OfAColumnOnABaseIsTheClosedForm) {
  constexpr double L = 3.0;
  constexpr double EI = 5.0;
  constexpr double k = kPi / L;
  for (const double K : {0.0, 1.0, 4.0, 10.0}) {
    Model model = straight(L, EI, 1e13, "xy", "y");
    model.loads = {force_at(at_node("b"), -1.0, 0.0)};
    if (K > 0.0) model.foundations = {winkler("m", K)};
    const CriticalPoint point = first_point(model, 1e-10);
    const double load = EI * k * k + K / (k * k);
    EXPECT_NEAR(point.load_factor, load, 1e-8 * load);
    const double expected = k * k * (0.5 * EI * k * k / load - 0.375);
    ASSERT_TRUE(point.koiter && point.koiter->b) << K;
    EXPECT_EQ(point.koiter->a, 0.0);
    EXPECT_NEAR(*point.koiter->b, expected, 1e-6 * std::abs(expected)) << K;
    EXPECT_EQ(point.koiter->kind,
              expected > 0.0 ? BifurcationKind::stable_symmetric : BifurcationKind::unstable_symmetric);
  }
}

/// Roorda's frame: a column and a beam of one length, hinged at their feet, the load on the corner. With the
/// corner turned by one, w_c = A (sin k x - x sin k) and w_b = (x^3 - x) / 2; the moment there is 3, the
/// shears of both are 3, and the corner's displacements by the bars' shortening I / 2 = integral of w'^2 / 2
/// give the cubic energy V3 = 3/2 (I_c + I_b), and P = P_c (1 -+ 3 V3 / (I_c k^2)) by the corner's rotation:
/// 0.3805 (Koiter 1966).
TEST(Koiter, OfRoordasFrameIsTheClosedForm) {
  const auto balance = [](double k) { return 3.0 * (k * std::cos(k) - std::sin(k)) - k * k * std::sin(k); };
  double low = 3.2;
  double high = 4.3;
  for (int i = 0; i < 100; ++i) {
    const double k = 0.5 * (low + high);
    ((balance(k) > 0.0) == (balance(low) > 0.0) ? low : high) = k;
  }
  const double k = low;
  const double amplitude = 1.0 / (k * std::cos(k) - std::sin(k));
  // integrals of (A (k cos kx - sin k))^2 and ((3 x^2 - 1) / 2)^2 over the bars
  const double s = std::sin(k);
  const double column =
      amplitude * amplitude * (k * k * (0.5 + std::sin(2.0 * k) / (4.0 * k)) - 2.0 * s * s + s * s);
  const double beam = 0.2;
  const double expected = 4.5 * (column + beam) / (column * k * k);
  EXPECT_NEAR(expected, 0.3805, 5e-5);
  Model model;
  model.nodes = {{"foot", 0.0, 0.0}, {"corner", 0.0, 1.0}, {"far", 1.0, 1.0}};
  model.sections = {{"s", 1e12, 1.0, {}}};
  model.members = {{"column", "foot", "corner", "s", LineCurve{}, false, false},
                   {"beam", "corner", "far", "s", LineCurve{}, false, false}};
  model.supports = {support("foot", "xy"), support("far", "xy")};
  model.loads = {force_at(at_node("corner"), 0.0, -1.0)};
  const CriticalPoint point = first_point(model, 1e-9);
  EXPECT_NEAR(point.load_factor, k * k, 1e-8 * k * k);
  ASSERT_TRUE(point.koiter && point.mode);
  const double rotation = point.mode->members.at(0).rotation.back();
  EXPECT_EQ(point.koiter->kind, BifurcationKind::asymmetric);
  EXPECT_FALSE(point.koiter->b);
  EXPECT_NEAR(std::abs(point.koiter->a / rotation), expected, 1e-6 * expected);
}

/// A limit point has none, and neither has a bifurcation of several motions.
TEST(Koiter, IsOfSimpleBifurcationsOnly) {
  Model askew = arch(20.0, 420.0, 1.4);
  askew.loads = {force_at(at_member("arch", 0.45), 0.0, -1.4e-4)};
  const CriticalPoint limit = first_point(askew, 1e-6);
  EXPECT_EQ(limit.type, CriticalType::limit_max);
  EXPECT_FALSE(limit.koiter);
}

}  // namespace
}  // namespace snapthrough
