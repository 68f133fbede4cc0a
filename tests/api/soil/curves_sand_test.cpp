/// Curves of sand and weak rock against the papers' formulas in another form, and readings of figures by
/// others.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/api/soil/reaction.h"

namespace snapthrough::api::soil {
namespace {

using snapthrough::testing::kFine;
using snapthrough::testing::peak_of;
using snapthrough::testing::reaction_at;

/// Sand of the size of the tests at Mustang Island: D = 0.61, phi = 39 degrees, unit weight 10.4, k = 34 000.
constexpr double kD = 0.61;
constexpr double kK = 34'000.0;
ReeseSand mustang() { return {39.0, kK}; }
Place at(double relative_depth, Loading loading) {
  const double X = relative_depth * kD;
  return {X, 10.4 * X, kD, 21.0, 0.0, loading};
}

/// The smaller of the resistances of wedge and flow, term by term as Reese, Cox and Koop write them.
double resistance(double phi_degrees, double X, double s, double D) {
  const double phi = phi_degrees * std::numbers::pi / 180.0;
  const double a = phi / 2.0;
  const double b = std::numbers::pi / 4.0 + phi / 2.0;
  const double Ka = std::pow(std::tan(std::numbers::pi / 4.0 - phi / 2.0), 2);
  const double K0 = 0.4;
  const double wedge = s * (K0 * X * std::tan(phi) * std::sin(b) / (std::tan(b - phi) * std::cos(a)) +
                            std::tan(b) / std::tan(b - phi) * (D + X * std::tan(b) * std::tan(a)) +
                            K0 * X * std::tan(b) * (std::tan(phi) * std::sin(b) - std::tan(a)) - Ka * D);
  const double flow =
      Ka * D * s * (std::pow(std::tan(b), 8) - 1.0) + K0 * D * s * std::tan(phi) * std::pow(std::tan(b), 4);
  return std::min(wedge, flow);
}

/// Reads of the figures of FHWA-SA-91-048 by the public program GeotechStaffEngineer 5.10: X/D, A and B under
/// static loads, A and B under cyclic loads.
constexpr double kFigures[][5] = {
    {0.5, 2.54, 1.85, 0.91, 0.71}, {1.0, 2.13, 1.56, 1.06, 0.84}, {1.5, 1.77, 1.26, 1.08, 0.86},
    {2.0, 1.48, 1.05, 1.01, 0.82}, {2.5, 1.24, 0.88, 0.97, 0.78}, {3.0, 1.04, 0.70, 0.93, 0.69},
    {4.0, 0.88, 0.54, 0.88, 0.56}, {5.0, 0.88, 0.50, 0.88, 0.55}, {12.0, 0.88, 0.50, 0.88, 0.55}};

/// Compares a curve with the paper's construction from A and B.
void expect_construction(const Curve& curve, const Place& place, double A, double B) {
  const double ps = resistance(39.0, place.depth, place.stress, kD);
  const double y_m = kD / 60.0;
  const double y_u = 3.0 * kD / 80.0;
  EXPECT_NEAR(curve.points.back()[0], y_u, 1e-12);
  EXPECT_NEAR(curve.points.back()[1], A * ps, 1e-9 * ps);
  const double m = (A - B) * ps / (y_u - y_m);
  const double n = B * ps / (m * y_m);
  const double C = B * ps / std::pow(y_m, 1.0 / n);
  const double y_k = std::pow(C / (kK * place.depth), n / (n - 1.0));
  EXPECT_NEAR(curve.points[1][1], kK * place.depth * curve.points[1][0], 1e-9 * ps) << "first line";
  if (y_k < y_m) {
    EXPECT_NEAR(curve.points[1][0], y_k, 1e-9) << "end of the first line by the paper's formula";
    EXPECT_NEAR(reaction_at(curve, y_m), B * ps, 1e-9 * ps);
    const double y = 0.5 * (y_k + y_m);
    EXPECT_NEAR(reaction_at(curve, y), C * std::pow(y, 1.0 / n), 1.1 * kFine * A * ps) << "parabola";
  }
}

TEST(ReeseSandTest, CurveIsTheConstructionOfThePaper) {
  for (const auto& [depth, A_static, B_static, A_cyclic, B_cyclic] : kFigures) {
    SCOPED_TRACE(depth);
    const Place still = at(depth, Loading::static_);
    expect_construction(curve_of(mustang(), still, kFine), still, A_static, B_static);
    const Place cyclic = at(depth, Loading::cyclic);
    expect_construction(curve_of(mustang(), cyclic, kFine), cyclic, A_cyclic, B_cyclic);
  }
}

TEST(ReeseSandTest, FactorsAreThoseThatOthersReadInTheFigures) {
  // straight lines by which a graphical interface of OpenSees reads the static figures
  const auto A_read = [](double x) {
    return x >= 4.0 ? 0.88 : x >= 3.0 ? 1.0 : x >= 2.0 ? 1.5 - 0.5 * (x - 2.0) : 2.8 - 0.65 * x;
  };
  const auto B_read = [](double x) {
    return x >= 4.0 ? 0.5 : x >= 1.5 ? 1.25 - 0.3 * (x - 1.5) : 2.25 - 0.6667 * x;
  };
  for (const double depth : {0.25, 0.5, 1.0, 1.5, 1.75, 2.0, 2.5, 3.0, 4.0, 6.0}) {
    const Place place = at(depth, Loading::static_);
    const double ps = resistance(39.0, place.depth, place.stress, kD);
    const Curve curve = curve_of(ReeseSand{39.0, 1e9}, place, kFine);
    EXPECT_NEAR(curve.points.back()[1] / ps, A_read(depth), 0.11) << depth;
    EXPECT_NEAR(reaction_at(curve, kD / 60.0) / ps, B_read(depth), 0.11) << depth;
  }
}

TEST(ReeseSandTest, SmallModulusLeavesTheFirstLineAndThePlateau) {
  const Place place = at(2.0, Loading::static_);
  const double pu = 1.48 * resistance(39.0, place.depth, place.stress, kD);
  const Curve curve = curve_of(ReeseSand{39.0, 100.0}, place, kFine);
  ASSERT_EQ(curve.points.size(), 2U);
  EXPECT_NEAR(curve.points[1][1], pu, 1e-9 * pu);
  EXPECT_NEAR(curve.points[1][0], pu / (100.0 * place.depth), 1e-9);
}

TEST(ReeseSandTest, SurfaceHasNoResistance) {
  EXPECT_FALSE(curve_of(mustang(), at(0.0, Loading::static_), kFine).has_resistance());
}

/// Forces of Rollins' formulas in kN/m at displacements in mm, computed in Python from the text of the
/// formulas.
TEST(LiquefiedSandTest, CurveHasTheValuesOfTheFormulas) {
  const LiquefiedSand metres{1.0, 1.0};
  const Curve two = curve_of(metres, {2.0, 0.0, 0.6, 10.0, 0.0, Loading::static_}, kFine);
  EXPECT_NEAR(reaction_at(two, 0.010), 0.4471759186214538, 1.1 * kFine * 54.8);
  EXPECT_NEAR(reaction_at(two, 0.050), 8.320078719859554, 1.1 * kFine * 54.8);
  EXPECT_NEAR(reaction_at(two, 0.150), 54.80631560177362, 1e-9);
  EXPECT_NEAR(reaction_at(two, 0.300), 54.80631560177362, 1e-9) << "constant beyond 150 mm";
}

TEST(LiquefiedSandTest, ForceOfThePileThatWasTestedIsAtMost15) {
  const LiquefiedSand metres{1.0, 1.0};
  const Curve six = curve_of(metres, {6.0, 0.0, 0.2, 10.0, 0.0, Loading::static_}, kFine);
  EXPECT_NEAR(six.points.back()[1], 10.128636155181834, 1e-9);
  EXPECT_NEAR(six.points.back()[0], 0.029852073129304443, 1e-9);
  const Curve wide = curve_of(metres, {1.0, 0.0, 3.0, 10.0, 0.0, Loading::static_}, kFine);
  EXPECT_NEAR(wide.points.back()[1], 91.59753170605545, 1e-6) << "the factor of the diameter ends at 2.6 m";
}

/// Values of openpile 1.0.2: reese_weakrock(Ei = 50e3, qu = 2000, RQD = 60, xr = 1.5, D = 1.2, k = 0.0005).
TEST(WeakRockTest, CurveIsThatOfOpenpile) {
  const WeakRock rock{2000.0, 50e3, 60.0, 0.0005};
  const Curve curve = curve_of(rock, {4.0, 60.0, 1.2, 10.0, 2.5, Loading::static_}, kFine);
  EXPECT_NEAR(curve.points[1][0], 9.345283e-05, 0.003 * 9.345283e-05)
      << "openpile's exponent is 1.333, not 4/3";
  const double values[][2] = {{0.0004300896, 1821.869}, {0.001103363, 2305.722}, {0.0024, 2800.143},
                              {0.006, 3520.993},        {0.0096, 3960.0},        {0.01152, 3960.0}};
  for (const auto& [y, p] : values) {
    EXPECT_NEAR(reaction_at(curve, y), p, 1.1 * kFine * 3960.0) << y;
  }
  EXPECT_NEAR(curve.points[1][1] / curve.points[1][0], 50e3 * (100.0 + 400.0 * 1.5 / 3.6), 1.0);
}

TEST(WeakRockTest, StrengthAndModulusAreConstantBelowThreeDiameters) {
  const WeakRock rock{2000.0, 50e3, 60.0, 0.0005};
  for (const double depth : {3.6, 8.0}) {
    const Curve curve = curve_of(rock, {2.5 + depth, 60.0, 1.2, 20.0, 2.5, Loading::static_}, kFine);
    EXPECT_NEAR(peak_of(curve), 5.2 * 0.6 * 2000.0 * 1.2, 1e-9);
    EXPECT_NEAR(curve.points[1][1] / curve.points[1][0], 500.0 * 50e3, 1.0);
  }
}

TEST(WeakRockTest, SmallModulusLeavesALineToTheStrength) {
  const WeakRock rock{2000.0, 100.0, 60.0, 0.00005};
  const Curve curve = curve_of(rock, {4.0, 60.0, 1.2, 10.0, 2.5, Loading::static_}, kFine);
  ASSERT_EQ(curve.points.size(), 2U);
  EXPECT_NEAR(curve.points[1][1], 3960.0, 1e-9);
  EXPECT_NEAR(curve.points[1][0], 3960.0 / (100.0 * (100.0 + 400.0 * 1.5 / 3.6)), 1e-12);
}

}  // namespace
}  // namespace snapthrough::api::soil
