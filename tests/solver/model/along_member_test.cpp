/// Numbers that vary along a member.
#include "solver/model/along_member.h"

#include <gtest/gtest.h>

#include <cmath>

namespace snapthrough {
namespace {

TEST(AlongMember, IsLinearInItsRoot) {
  for (const double n : {0.5, 1.0, 2.0, 3.0, 4.0, 7.5}) {
    const AlongMember value({{0.2, std::pow(3.0, n)}, {0.6, 1.0}, {1.0, std::pow(2.0, n)}}, n);
    EXPECT_EQ(value.at(0.0), std::pow(3.0, n));
    EXPECT_NEAR(value.at(0.3), std::pow(2.5, n), 1e-14 * std::pow(2.5, n)) << n;
    EXPECT_NEAR(value.at(0.9), std::pow(1.75, n), 1e-14 * std::pow(1.75, n)) << n;
    EXPECT_EQ(value.at(1.0), std::pow(2.0, n));
    EXPECT_EQ(value.least(), 1.0);
    EXPECT_EQ(value.largest(), std::pow(3.0, n));
  }
}

/// For n -> infinity the logarithm of the value is linear; small powers do not overflow.
TEST(AlongMember, TakesExtremePowers) {
  EXPECT_NEAR(AlongMember({{0.0, 1.0}, {1.0, 16.0}}, 1e9).at(0.25), 2.0, 1e-8);
  EXPECT_NEAR(AlongMember({{0.0, 16.0}, {1.0, 1.0}}, 1e9).at(0.25), 8.0, 1e-7);
  EXPECT_NEAR(AlongMember({{0.0, 1e-100}, {1.0, 1e100}}, 1e-3).at(0.5) / (1e100 * std::pow(0.5, 1e-3)), 1.0,
              1e-12);
}

}  // namespace
}  // namespace snapthrough
