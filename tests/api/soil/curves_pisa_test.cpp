/// Curves of PISA against values that the functions of openpile 1.0.2 returned, and against the equation of
/// the conic.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "tests/api/soil/reaction.h"

namespace snapthrough::api::soil {
namespace {

using snapthrough::testing::kFine;
using snapthrough::testing::reaction_at;

/// Compares a curve with (displacement, force) of another program, relative to the last force.
void expect_values(const Curve& curve, const std::vector<std::array<double, 2>>& values) {
  const double largest = values.back()[1];
  for (const auto& [x, y] : values) {
    EXPECT_NEAR(reaction_at(curve, x), y, 1.1 * kFine * largest) << x;
  }
  EXPECT_NEAR(curve.points.back()[1], largest, 1e-6 * largest);
}

const PisaClay kCowden{100.0, 60e3};
const PisaClay kCowdenBase{150.0, 240e3};
constexpr Place kCowdenPlace{5.0, 50.0, 7.5, 22.5, 0.0, Loading::static_};
constexpr Place kCowdenTip{22.5, 225.0, 7.5, 22.5, 0.0, Loading::static_};

TEST(PisaClayTest, CurvesAreThoseOfOpenpile) {
  expect_values(curve_of(kCowden, kCowdenPlace, kFine), {{0.06035, 2177.621},
                                                         {0.150875, 2790.839},
                                                         {0.30175, 3175.737},
                                                         {0.6035, 3451.345},
                                                         {1.408167, 3638.669},
                                                         {2.212833, 3680.957},
                                                         {3.0175, 3689.283}});
  expect_values(
      moment_curve_of(kCowden, kCowdenPlace, kFine),
      {{6.345163e-06, 29.0325}, {3.172582e-05, 145.1625}, {0.000232656, 1064.525}, {0.000348984, 1451.625}});
  expect_values(base_shear_curve_of(kCowdenBase, kCowdenTip, kFine), {{0.02209687, 3807.886},
                                                                      {0.05524219, 4254.474},
                                                                      {0.2209687, 4551.271},
                                                                      {0.5155937, 4610.687},
                                                                      {1.104844, 4625.1}});
  expect_values(base_moment_curve_of(kCowdenBase, kCowdenTip, kFine), {{0.00216375, 15047.32},
                                                                       {0.005409375, 21998.47},
                                                                       {0.0216375, 31328.34},
                                                                       {0.0504875, 34578.1},
                                                                       {0.1081875, 35536.22}});
}

const PisaSand kDunkirk{0.75, 50e3};
const PisaSand kDunkirkBase{0.75, 120e3};
constexpr Place kDunkirkPlace{5.0, 50.0, 6.0, 20.0, 0.0, Loading::static_};
constexpr Place kDunkirkTip{20.0, 200.0, 6.0, 20.0, 0.0, Loading::static_};

TEST(PisaSandTest, CurvesAreThoseOfOpenpile) {
  expect_values(curve_of(kDunkirk, kDunkirkPlace, kFine), {{0.0092421, 793.5823},
                                                           {0.02310525, 1338.439},
                                                           {0.0462105, 1966.692},
                                                           {0.092421, 2856.786},
                                                           {0.215649, 4342.151},
                                                           {0.338877, 5165.768},
                                                           {0.462105, 5459.948}});
  expect_values(moment_curve_of(kDunkirk, kDunkirkPlace, 1000.0, kFine),
                {{2.925074e-07, 29.83575}, {2.925074e-06, 298.3575}, {1.462537e-05, 1491.788}});
  expect_values(base_shear_curve_of(kDunkirkBase, kDunkirkTip, kFine), {{0.00029755, 562.4974},
                                                                        {0.000743875, 1130.145},
                                                                        {0.0029755, 2330.741},
                                                                        {0.006942833, 2907.344},
                                                                        {0.0148775, 3100.704}});
  expect_values(base_moment_curve_of(kDunkirkBase, kDunkirkTip, kFine), {{0.001496333, 4709.994},
                                                                         {0.003740833, 6610.293},
                                                                         {0.01496333, 8694.887},
                                                                         {0.03491444, 9285.759},
                                                                         {0.07481667, 9445.032}});
}

TEST(PisaSandTest, MomentIsProportionalToTheLateralForce) {
  const Curve one = moment_curve_of(kDunkirk, kDunkirkPlace, 1000.0, kFine);
  const Curve two = moment_curve_of(kDunkirk, kDunkirkPlace, 2000.0, kFine);
  EXPECT_DOUBLE_EQ(two.points.back()[1], 2.0 * one.points.back()[1]);
  EXPECT_DOUBLE_EQ(two.points.back()[0], one.points.back()[0]);
  EXPECT_FALSE(moment_curve_of(kDunkirk, kDunkirkPlace, 0.0, kFine).has_resistance());
}

/// The first line has the initial stiffness; all other points are on the conic.
TEST(ConicTest, PointsSatisfyTheEquationOfTheConic) {
  for (const double n : {0.02, 0.3, 0.5, 0.7, 0.93, 0.99}) {
    for (const double r : {1.01, 2.0, 40.0, 300.0}) {
      const double k = r * 3.0 / 50.0;
      const Curve curve = conic_curve({k, n, 50.0, 3.0}, 1.0, 1.0, kFine);
      for (std::size_t i = 0; i < curve.points.size(); ++i) {
        if (i == 1) {
          continue;
        }
        const auto [x, y] = curve.points[i];
        const double difference = y / 3.0 - x / 50.0;
        const double left = (1.0 - n) * (y / 3.0 - k * x / 3.0) * (y / 3.0 - 1.0);
        EXPECT_NEAR(left, n * difference * difference, 1e-12 * (1.0 + r)) << n << " " << r << " " << x;
      }
      EXPECT_NEAR(curve.points.back()[0], 50.0, 1e-12);
      EXPECT_NEAR(curve.points.back()[1], 3.0, 1e-12);
      EXPECT_NEAR(curve.points[1][1] / curve.points[1][0], k, 1e-12 * k) << n << " " << r;
    }
  }
}

TEST(ConicTest, ValueIsRightWhereTheEquationHasTheRootZero) {
  // with n = 3/4, k x_u/y_u = 3/2 and x = x_u/2 the conic is -v^2/2 + 5 v/16 = 0, v = y/y_u
  EXPECT_DOUBLE_EQ(conic_value({1.5 * 3.0 / 50.0, 0.75, 50.0, 3.0}, 25.0), 0.625 * 3.0);
}

TEST(ConicTest, EndsOfTheRangeOfNGiveStraightLines) {
  const Curve two = conic_curve({0.3, 0.0, 50.0, 3.0}, 1.0, 1.0, kFine);
  EXPECT_NEAR(reaction_at(two, 5.0), 1.5, 1e-12);
  EXPECT_NEAR(reaction_at(two, 10.0), 3.0, 1e-12);
  EXPECT_NEAR(reaction_at(two, 30.0), 3.0, 1e-12);
  for (const Conic& conic : {Conic{0.3, 1.0, 50.0, 3.0}, Conic{0.3, 1.2, 50.0, 3.0},
                             Conic{0.01, 0.5, 50.0, 3.0}, Conic{-1.0, 0.5, 50.0, 3.0}}) {
    EXPECT_NEAR(reaction_at(conic_curve(conic, 1.0, 1.0, kFine), 25.0), 1.5, 1e-12);
  }
  EXPECT_FALSE(conic_curve({0.3, 0.5, 50.0, -0.1}, 1.0, 1.0, kFine).has_resistance());
  EXPECT_FALSE(conic_curve({0.3, 0.5, -0.1, 3.0}, 1.0, 1.0, kFine).has_resistance());
}

TEST(PisaClayTest, MomentEndsWhereTheCalibrationGivesNone) {
  Place place = kCowdenPlace;
  place.depth = 6.0 * place.diameter;
  EXPECT_TRUE(moment_curve_of(kCowden, place, kFine).has_resistance());
  place.depth = 6.1 * place.diameter;  // 0.2899 / 0.04775 = 6.07
  EXPECT_FALSE(moment_curve_of(kCowden, place, kFine).has_resistance());
}

}  // namespace
}  // namespace snapthrough::api::soil
