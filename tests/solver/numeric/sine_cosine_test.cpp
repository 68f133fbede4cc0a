/// Sines and cosines of many angles against the C library's in extended precision.
#include "solver/numeric/sine_cosine.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace snapthrough {
namespace {

TEST(SineCosine, HasSixteenDigitsAtEveryAngle) {
  constexpr double kError = 3e-16;  // as its comment says: half a unit of 1 and one of the rest
  Angles angles;
  for (auto* list : {&angles.angle, &angles.sine, &angles.cosine}) list->resize(1, Lanes::Zero());
  for (const double size : {1e-9, 0.1, 1.0, 4.0, 30.0, 1e3, 1e5})
    for (int i = -2000; i < 2000; i += kLanes) {
      for (int l = 0; l < kLanes; ++l) angles.angle[0][l] = size * (i + l) / 2000.0;
      find_sines(angles);
      for (int l = 0; l < kLanes; ++l) {
        const long double x = angles.angle[0][l];
        EXPECT_NEAR(angles.sine[0][l], static_cast<double>(std::sin(x)), kError) << angles.angle[0][l];
        EXPECT_NEAR(angles.cosine[0][l], static_cast<double>(std::cos(x)), kError) << angles.angle[0][l];
      }
    }
}

TEST(SineCosine, KeepsSmallAnglesAndWhatIsNotANumber) {
  Angles angles;
  for (auto* list : {&angles.angle, &angles.sine, &angles.cosine}) list->resize(1, Lanes::Zero());
  angles.angle[0] << 1e-300, -1e-20, std::numeric_limits<double>::quiet_NaN(),
      std::numeric_limits<double>::infinity();
  find_sines(angles);
  EXPECT_EQ(angles.sine[0][0], 1e-300);
  EXPECT_EQ(angles.sine[0][1], -1e-20);
  EXPECT_EQ(angles.cosine[0][1], 1.0);
  for (const int lane : {2, 3})
    EXPECT_TRUE(std::isnan(angles.sine[0][lane]) && std::isnan(angles.cosine[0][lane]));
}

}  // namespace
}  // namespace snapthrough
