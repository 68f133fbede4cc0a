/// Axial curves against the printed tables of API RP 2GEO.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/api/soil/reaction.h"

namespace snapthrough::api::soil {
namespace {

using snapthrough::testing::kFine;
using snapthrough::testing::reaction_at;

constexpr Place kPlace{5.0, 50.0, 0.8, 20.0, 0.0, Loading::static_};
constexpr double kPerimeter = std::numbers::pi * 0.8;

TEST(ApiTzTest, ClayHasThePrintedTableAndItsResidual) {
  const double printed[][2] = {{0.0016, 0.3}, {0.0031, 0.5}, {0.0057, 0.75},
                               {0.008, 0.9},  {0.01, 1.0},   {0.02, 0.8}};
  const Curve curve = curve_of(ApiTzClay{40.0, 0.8}, kPlace, kFine);
  for (const auto& [z, t] : printed) {
    EXPECT_NEAR(reaction_at(curve, z * 0.8), t * 40.0 * kPerimeter, 1e-9) << z;
  }
  EXPECT_NEAR(reaction_at(curve, 1.0), 0.8 * 40.0 * kPerimeter, 1e-9);
}

TEST(ApiTzTest, SandYieldsAtThePeakDisplacement) {
  const Curve curve = curve_of(ApiTzSand{60.0, 0.0025}, kPlace, kFine);
  EXPECT_NEAR(reaction_at(curve, 0.00125), 30.0 * kPerimeter, 1e-9);
  EXPECT_NEAR(reaction_at(curve, 0.0025), 60.0 * kPerimeter, 1e-9);
  EXPECT_NEAR(reaction_at(curve, 0.1), 60.0 * kPerimeter, 1e-9);
  EXPECT_FALSE(curve_of(ApiTzSand{0.0, 0.0025}, kPlace, kFine).has_resistance());
}

TEST(ApiQzTest, TipHasThePrintedTable) {
  const double printed[][2] = {{0.002, 0.25}, {0.013, 0.5}, {0.042, 0.75},
                               {0.073, 0.9},  {0.1, 1.0},   {0.5, 1.0}};
  const Curve curve = tip_curve_of({4'800.0, 0.5}, kPlace);
  for (const auto& [z, q] : printed) {
    EXPECT_NEAR(reaction_at(curve, z * 0.8), q * 2'400.0, 1e-9) << z;
  }
}

TEST(ApiFrictionTest, AdhesionIsContinuousAndAtMostTheStrength) {
  EXPECT_NEAR(api_clay_friction(50.0, 50.0), 25.0, 1e-12);
  EXPECT_NEAR(api_clay_friction(50.0, 200.0), 50.0, 1e-12) << "0.5 (1/4)^-0.5 = 1";
  EXPECT_NEAR(api_clay_friction(50.0, 500.0), 50.0, 1e-12) << "no more than the strength";
  EXPECT_NEAR(api_clay_friction(160.0, 10.0), 40.0, 1e-12) << "0.5 x 16^-0.25 = 1/4";
  EXPECT_NEAR(api_clay_friction(50.0, 50.001), 25.0, 1e-3);
  EXPECT_EQ(api_clay_friction(50.0, 0.0), 0.0);
}

}  // namespace
}  // namespace snapthrough::api::soil
