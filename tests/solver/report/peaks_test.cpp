/// Extremes between samples: of functions whose extremes are known in closed form.
#include "solver/report/peaks.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

namespace snapthrough {
namespace {

constexpr double kPi = std::numbers::pi;

/// The search over pieces between ends; the function is sampled at five places of each.
struct Searched {
  Searched(std::function<double(double)> f, const std::vector<double>& ends) : function(std::move(f)) {
    const auto at = [this](double s) { return std::array{function(s)}; };
    for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
      const double last = i + 2 < ends.size() ? ends[i + 1] - 1e-9 : ends[i + 1];
      search.add_piece(
          {}, [](std::size_t) { return std::array{0.0}; }, {ends[i], at(ends[i])}, {last, at(last)}, at);
    }
    search.refine(at);
    range = search.range(0, at);
  }
  std::function<double(double)> function;
  PeakSearch<1> search;
  PeakRange range;
};

TEST(Peaks, AreBetweenSamples) {
  for (const double phase : {0.0, 0.3, 1.1, 2.0, 2.9}) {
    const Searched found([phase](double s) { return std::sin(s + phase); }, {0.0, 2.0 * kPi});
    EXPECT_NEAR(found.range.max.value, 1.0, 1e-6) << phase;
    EXPECT_NEAR(found.range.min.value, -1.0, 1e-6) << phase;
    EXPECT_NEAR(std::sin(found.range.max.s + phase), 1.0, 1e-6) << phase;
  }
}

/// A maximum that the samples beside an end do not show: the parabola s - 12 s^2 has it at 1/24.
TEST(Peaks, AreFoundBesideEnds) {
  const auto function = [](double s) { return s - 12.0 * s * s; };
  EXPECT_NEAR(Searched(function, {0.0, 1.0}).range.max.value, 1.0 / 48.0, 1e-6 * 11.0);
  const auto reversed = [&](double s) { return function(1.0 - s); };
  EXPECT_NEAR(Searched(reversed, {0.0, 1.0}).range.max.value, 1.0 / 48.0, 1e-6 * 11.0);
}

/// Both sides of a jump count, and a kink is as good a place as any.
TEST(Peaks, AreOnBothSidesOfAJump) {
  const Searched jump([](double s) { return s < 0.4 ? s : s - 1.0; }, {0.0, 0.4, 1.0});
  EXPECT_NEAR(jump.range.max.value, 0.4, 1e-8);
  EXPECT_EQ(jump.range.min.value, -0.6);
  EXPECT_NEAR(jump.range.max.s, 0.4, 1e-8);
  const Searched kink([](double s) { return -std::abs(s - 0.37); }, {0.0, 0.37, 1.0});
  EXPECT_NEAR(kink.range.max.value, 0.0, 1e-8);
}

/// Rounding does not choose the place of a value that is the same everywhere.
TEST(Peaks, OfAConstantAreAtItsStart) {
  const Searched found([](double s) { return -2.0 + 1e-15 * std::sin(40.0 * s); }, {0.25, 1.0, 2.0});
  EXPECT_EQ(found.range.min.s, 0.25);
  EXPECT_EQ(found.range.max.s, 0.25);
  EXPECT_NEAR(found.range.min.value, -2.0, 1e-14);
}

/// Waves that the first samples are too far apart for.
TEST(Peaks, OfWavesNeedMoreSamples) {
  const Searched found([](double s) { return std::sin(9.0 * s) + 0.1 * s; }, {0.0, 2.0});
  double most = -2.0;
  for (int i = 0; i <= 200000; ++i) most = std::max(most, found.function(1e-5 * i));
  EXPECT_NEAR(found.range.max.value, most, 2e-6);
}

/// A constant has its first place; values that only rounding moves are not searched.
TEST(Peaks, OfAConstantAreAtItsBegin) {
  const Searched found([](double) { return -2.5; }, {0.0, 1.0, 3.0});
  EXPECT_EQ(found.range.max.value, -2.5);
  EXPECT_EQ(found.range.min.value, -2.5);
  EXPECT_EQ(found.range.max.s, 0.0);
}

}  // namespace
}  // namespace snapthrough
