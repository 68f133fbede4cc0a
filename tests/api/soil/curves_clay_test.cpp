/// Curves of clay against printed points, and against the sources' formulas in another form.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "tests/api/soil/reaction.h"

namespace snapthrough::api::soil {
namespace {

using snapthrough::testing::kFine;
using snapthrough::testing::peak_of;
using snapthrough::testing::reaction_at;
using ::testing::ElementsAre;

/// A place 2 deep in soil of unit weight 8. Clay of Su = 20, J = 0.5 has there
/// Pmax = (3 x 20 + 16) 1 + 0.5 x 20 x 2 = 96 and X_R = 6 x 20 / (8 + 0.5 x 20) = 20/3, so that X/X_R = 0.3.
Place shallow(Loading loading) { return {2.0, 16.0, 1.0, 20.0, 0.0, loading}; }
constexpr double kShallowPmax = 96.0;
/// A place in the same clay below the depth of transition, where Pmax = 9 Su D = 9 x 20 x 1.
Place deep(Loading loading) { return {10.0, 80.0, 1.0, 20.0, 0.0, loading}; }
constexpr double kDeepPmax = 180.0;
constexpr double kY50 = 2.5 * 0.01 * 1.0;

SoftClayMatlock soft_clay(SoftClayStart start) { return {20.0, 0.01, 0.5, start, 0.1}; }

TEST(SoftClayMatlockTest, StaticCurvePassesThePrintedPointsOfApi) {
  const Curve curve = curve_of(soft_clay(SoftClayStart::formula), shallow(Loading::static_), kFine);
  const double printed[][2] = {{0.1, 0.23}, {0.3, 0.33}, {1.0, 0.5}, {3.0, 0.72}, {8.0, 1.0}, {20.0, 1.0}};
  for (const auto& [y, p] : printed) {
    EXPECT_NEAR(reaction_at(curve, y * kY50) / kShallowPmax, p, 0.005)
        << "printed with two digits, y/y50 = " << y;
  }
}

TEST(SoftClayMatlockTest, ApiPointsArePointsOfTheCurve) {
  const Curve curve = curve_of(soft_clay(SoftClayStart::api_points), deep(Loading::static_), 0.1);
  ASSERT_EQ(curve.points.size(), 6U);
  const double printed[][2] = {{0.0, 0.0}, {0.1, 0.23}, {0.3, 0.33}, {1.0, 0.5}, {3.0, 0.72}, {8.0, 1.0}};
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_DOUBLE_EQ(curve.points[i][0], printed[i][0] * kY50);
    EXPECT_DOUBLE_EQ(curve.points[i][1], printed[i][1] * kDeepPmax);
  }
}

TEST(SoftClayMatlockTest, CyclicCurveFallsAboveTheTransitionOnly) {
  for (const auto start : {SoftClayStart::formula, SoftClayStart::api_points}) {
    const Curve falling = curve_of(soft_clay(start), shallow(Loading::cyclic), kFine);
    EXPECT_NEAR(reaction_at(falling, 3.0 * kY50), 0.72 * kShallowPmax, 1e-9);
    EXPECT_NEAR(reaction_at(falling, 9.0 * kY50), 0.72 * kShallowPmax * (1.0 + 0.3) / 2.0, 1e-9);
    EXPECT_NEAR(reaction_at(falling, 15.0 * kY50), 0.72 * kShallowPmax * 0.3, 1e-9);
    EXPECT_NEAR(reaction_at(falling, 90.0 * kY50), 0.72 * kShallowPmax * 0.3, 1e-9);
    const Curve flat = curve_of(soft_clay(start), deep(Loading::cyclic), kFine);
    EXPECT_NEAR(peak_of(flat), 0.72 * kDeepPmax, 1e-9);
    EXPECT_NEAR(reaction_at(flat, 90.0 * kY50), 0.72 * kDeepPmax, 1e-9);
  }
}

TEST(SoftClayMatlockTest, FirstPointEndsAStraightLine) {
  SoftClayMatlock clay = soft_clay(SoftClayStart::formula);
  const double at_point = 0.5 * std::cbrt(0.1) * kShallowPmax;
  const Curve line = curve_of(clay, shallow(Loading::static_), kFine);
  EXPECT_THAT(line.points[1], ElementsAre(0.1 * kY50, ::testing::DoubleNear(at_point, 1e-9)));
  clay.first_point = 0.0;
  const Curve steep = curve_of(clay, shallow(Loading::static_), kFine);
  EXPECT_NEAR(reaction_at(steep, 1e-3 * kY50), 0.05 * kShallowPmax, kFine * kShallowPmax);
}

/// Clay of the size of the tests at Manor: pc = (2 x 100 + 18) 0.6 + 2.83 x 100 x 1.8 = 640.2, less than 660.
constexpr double kPc = 640.2;
constexpr double kStiffY50 = 0.005 * 0.6;
Place stiff_place(Loading loading) { return {1.8, 18.0, 0.6, 15.0, 0.0, loading}; }
StiffClayFreeWater free_water() { return {100.0, 100.0, 0.005, 270'000.0}; }

/// Static curve as OpenSees 3 computes it (ReeseStiffClayBelowWS), with the paper's rounded constants.
double opensees_static(double Es, double y50, double A, double pc, double y) {
  const double y1 = 0.25 * pc * pc / (y50 * Es * Es);
  const double y2 = A * y50;
  if (y <= y1) {
    return Es * y;
  }
  if (y <= y2) {
    return 0.5 * pc * std::sqrt(y / y50);
  }
  if (y <= 6.0 * y2) {
    return 0.5 * pc * std::sqrt(y / y50) - 0.055 * pc * std::pow((y - y2) / y2, 1.25);
  }
  if (y <= 18.0 * y2) {
    return 0.5 * pc * std::sqrt(6.0 * A) - 0.411 * pc - 0.0625 / y50 * pc * (y - 6.0 * y2);
  }
  return pc * (1.225 * std::sqrt(A) - 0.75 * A - 0.411);
}

TEST(StiffClayFreeWaterTest, StaticCurveIsThatOfOpenSees) {
  const Curve curve = curve_of(free_water(), stiff_place(Loading::static_), kFine);
  const double A = curve.points.back()[0] / (18.0 * kStiffY50);
  for (int i = 1; i <= 300; ++i) {
    const double y = 20.0 * A * kStiffY50 * i / 300.0;
    EXPECT_NEAR(reaction_at(curve, y), opensees_static(270'000.0 * 1.8, kStiffY50, A, kPc, y), 5e-4 * kPc)
        << "0.411 is the paper's rounding of 0.055 x 5^1.25, y = " << y;
  }
  EXPECT_NEAR(curve.points[1][0], 0.25 * kPc * kPc / (kStiffY50 * 486'000.0 * 486'000.0), 1e-12)
      << "end of the first line";
}

/// Formulas by which a public MATLAB program (its function reesestiffclaysec) reads the figure of the
/// coefficient.
double read_static(double depth) {
  return std::min(0.0106 * std::pow(depth, 3) - 0.1006 * depth * depth + 0.3323 * depth + 0.2042, 0.6);
}
double read_cyclic(double depth) {
  return std::min(0.0229 * std::pow(depth, 3) - 0.1038 * depth * depth + 0.1652 * depth + 0.202, 0.3);
}

TEST(StiffClayFreeWaterTest, CoefficientsAreThoseThatOthersReadInTheFigure) {
  for (const double depth : {0.5, 1.0, 1.5, 2.0, 3.0, 4.0, 8.0}) {
    Place place = stiff_place(Loading::static_);
    place.depth = depth * 0.6;
    const StiffClayFreeWater clay{100.0, 100.0, 0.005, 1e9};
    const double As = curve_of(clay, place, kFine).points.back()[0] / (18.0 * kStiffY50);
    place.loading = Loading::cyclic;
    const double Ac = curve_of(clay, place, kFine).points.back()[0] / (1.8 * 4.1 * kStiffY50);
    EXPECT_NEAR(As, read_static(depth), 0.05) << depth;
    EXPECT_NEAR(Ac, read_cyclic(depth), 0.015) << depth;
  }
}

TEST(StiffClayFreeWaterTest, CyclicCurvePassesItsKinks) {
  const Curve curve = curve_of(free_water(), stiff_place(Loading::cyclic), kFine);
  const double A = 0.3 - 0.1 * (1.0 - std::tanh(4.5));
  const double yp = 4.1 * A * kStiffY50;
  EXPECT_NEAR(reaction_at(curve, 0.45 * yp), A * kPc, 1e-4 * kPc) << "top";
  EXPECT_NEAR(reaction_at(curve, 0.6 * yp), 0.936 * A * kPc, 5e-4 * kPc) << "0.936 is printed for 1 - 3^-2.5";
  EXPECT_NEAR(reaction_at(curve, 1.2 * yp), (0.936 - 0.085 * 0.6 * 4.1) * A * kPc, 5e-4 * kPc);
  EXPECT_NEAR(reaction_at(curve, 9.0 * yp), (0.936 - 0.102 * 4.1) * A * kPc, 5e-4 * kPc);
}

TEST(StiffClayFreeWaterTest, ResidualForceNearTheSurfaceIsNotNegative) {
  Place place = stiff_place(Loading::static_);
  place.depth = 0.01;
  const Curve curve = curve_of(StiffClayFreeWater{100.0, 100.0, 0.005, 1e9}, place, kFine);
  EXPECT_EQ(curve.points.back()[1], 0.0);
  EXPECT_LT(curve.points.back()[0], 18.0 * 0.21 * kStiffY50);
  EXPECT_GT(peak_of(curve), 0.0);
}

TEST(StiffClayFreeWaterTest, SmallModulusLeavesALineToTheResidualForce) {
  StiffClayFreeWater clay = free_water();
  clay.k = 10.0;
  const Curve curve = curve_of(clay, stiff_place(Loading::static_), kFine);
  ASSERT_EQ(curve.points.size(), 2U);
  EXPECT_NEAR(curve.points[1][1] / curve.points[1][0], 10.0 * 1.8, 1e-9);
  clay.k = 0.0;
  EXPECT_FALSE(curve_of(clay, stiff_place(Loading::static_), kFine).has_resistance());
}

TEST(StiffClayTest, CyclesAddTheDisplacementOfTheSource) {
  const StiffClay clay{20.0, 20.0, 0.01, 0.5, 100.0, 0.0};
  const Curve fixed = curve_of(clay, shallow(Loading::static_), kFine);
  EXPECT_NEAR(reaction_at(fixed, kY50), 0.5 * kShallowPmax, kFine * kShallowPmax);
  EXPECT_NEAR(reaction_at(fixed, 16.0 * kY50), kShallowPmax, 1e-9);
  EXPECT_NEAR(reaction_at(fixed, 50.0 * kY50), kShallowPmax, 1e-9);
  const Curve cyclic = curve_of(clay, shallow(Loading::cyclic), kFine);
  for (const double m : {0.3, 0.5, 0.8, 1.0}) {
    const double y_static = 16.0 * std::pow(m, 4) * kY50;                  // 0.5 (y/y50)^(1/4) = m
    const double added = kY50 * 9.6 * std::pow(m, 4) * std::log10(100.0);  // by 100 cycles
    EXPECT_NEAR(reaction_at(cyclic, y_static + added), m * kShallowPmax, kFine * kShallowPmax) << m;
  }
}

TEST(StiffClayTest, MeanStrengthRulesTheShallowMechanism) {
  const StiffClay clay{40.0, 20.0, 0.01, 0.5, 1.0, 0.0};
  EXPECT_NEAR(peak_of(curve_of(clay, shallow(Loading::static_), kFine)), kShallowPmax, 1e-9);
  const StiffClay soft_below{10.0, 20.0, 0.01, 0.5, 1.0, 0.0};
  EXPECT_NEAR(peak_of(curve_of(soft_below, shallow(Loading::static_), kFine)), 90.0, 1e-9);
}

}  // namespace
}  // namespace snapthrough::api::soil
