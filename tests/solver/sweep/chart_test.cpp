/// Charts of functions that are known: distance of straight lines, places of jumps, pieces.

#include "solver/sweep/chart.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace snapthrough {
namespace {

constexpr int kParts = 4096;
constexpr ChartAxis kAxis{kParts, 8};
constexpr ChartLimits kLimits{0.01, 1000};

ChartCurve chart_of(const std::function<double(double)>& value) {
  return chart_curve(
      [&](int place) {
        return ChartValue{value(static_cast<double>(place) / kParts), ""};
      },
      kAxis, kLimits);
}

/// Largest distance of the lines between rows of one piece from the function, as a share of its value.
double largest_distance(const ChartCurve& curve, const std::function<double(double)>& value) {
  double largest = 0.0;
  for (std::size_t i = 1; i < curve.places.size(); ++i) {
    const double from = curve.places[i - 1];
    const double to = curve.places[i];
    for (int k = 1; k < 20 && curve.pieces[i] == curve.pieces[i - 1]; ++k) {
      const double t = k / 20.0;
      const double line = (1.0 - t) * *curve.values[i - 1].value + t * *curve.values[i].value;
      largest = std::max(largest, std::abs(line / value((from + t * (to - from)) / kParts) - 1.0));
    }
  }
  return largest;
}

TEST(ChartCurve, LinesAreWithinTheShareOfSmoothValuesAndCorners) {
  const auto root = [](double x) { return 0.1 + std::sqrt(x); };
  const auto corner = [](double x) { return 1.0 + 3.0 * std::abs(x - 0.3217); };
  const auto wave = [](double x) { return 2.0 + std::sin(9.0 * x); };
  EXPECT_LE(largest_distance(chart_of(root), root), 0.01);
  EXPECT_LE(largest_distance(chart_of(corner), corner), 0.01);
  EXPECT_LE(largest_distance(chart_of(wave), wave), 0.01);
  EXPECT_EQ(chart_of(wave).count(), 1);
}

/// A straight line needs no place but those that look for bends: ends, middles and first quarters.
TEST(ChartCurve, NothingIsAddedToAStraightLine) {
  EXPECT_EQ(chart_of([](double x) { return 1.0 + x; }).places.size(), 8U * 3U + 1U);
}

TEST(ChartCurve, AJumpLiesBetweenNeighbouringPlaces) {
  const auto value = [](double x) { return x < 0.37 ? 1.0 + x : 2.0 + x * x; };
  const ChartCurve curve = chart_of(value);
  ASSERT_EQ(curve.count(), 2);
  const auto jump = std::find(curve.jumps.begin(), curve.jumps.end(), true) - curve.jumps.begin();
  const auto i = static_cast<std::size_t>(jump);
  EXPECT_EQ(curve.places[i], static_cast<int>(std::ceil(0.37 * kParts)));
  EXPECT_EQ(curve.places[i - 1], curve.places[i] - 1);
  EXPECT_LE(largest_distance(curve, value), 0.01);
}

/// The middle of [0.5, 1] lies on the line between its ends, though the value jumps at 0.6.
TEST(ChartCurve, AJumpThatTheMiddleDoesNotShowIsFound) {
  const auto value = [](double x) { return x < 0.6 ? 1.0 : 1.5 + 2.0 * (x - 0.75); };
  const ChartCurve curve = chart_of(value);
  EXPECT_EQ(curve.count(), 2);
  EXPECT_LE(largest_distance(curve, value), 0.01);
}

/// A value that falls like a root beside its jump has one break, not one at each of its steep steps.
TEST(ChartCurve, ASteepFlankBelongsToItsJump) {
  const ChartCurve curve =
      chart_of([](double x) { return x < 0.4 ? 3.0 : 2.0 - 2.5 * std::sqrt(std::min(x - 0.4, 0.1)); });
  EXPECT_EQ(curve.count(), 2);
}

TEST(ChartCurve, KindsAreKeptApartWithoutAJump) {
  const ChartCurve curve = chart_curve(
      [](int place) {
        return ChartValue{1.0, place < 1000 ? "limit" : "bifurcation"};
      },
      kAxis, kLimits);
  ASSERT_EQ(curve.count(), 2);
  EXPECT_EQ(std::count(curve.jumps.begin(), curve.jumps.end(), true), 0);
  const auto second = std::lower_bound(curve.pieces.begin(), curve.pieces.end(), 1) - curve.pieces.begin();
  EXPECT_EQ(curve.places[static_cast<std::size_t>(second)], 1000);
}

TEST(ChartCurve, PlacesWithoutValueAreAPiece) {
  const ChartCurve curve = chart_curve(
      [](int place) {
        return ChartValue{place < 1000 || place > 2000 ? std::optional(1.0) : std::nullopt, ""};
      },
      kAxis, kLimits);
  EXPECT_EQ(curve.count(), 3);
}

TEST(ChartCurve, TooFewPlacesAreTold) {
  const ChartCurve curve = chart_curve(
      [](int place) {
        return ChartValue{1.0 + 0.5 * std::sin(place), ""};
      },
      kAxis, {0.01, 100});
  ASSERT_TRUE(curve.unfinished);
  EXPECT_LT(curve.unfinished->first, curve.unfinished->second);
  EXPECT_LE(curve.places.size(), 105U);
}

/// A surface with a corner and a jump along curved lines, at 2000 places of a lattice that has none of its
/// own.
TEST(ChartSurface, BlendsAreWithinTheShareAndJumpsInPlace) {
  constexpr ChartAxis kOuter{1024, 8};
  const auto value = [](double p, double q) {
    const double base = 1.0 + 0.5 * p * std::sin(3.0 * q) + std::abs(q - 0.2 - 0.1 * p);
    return q > 0.6 + 0.2 * p - 0.1 * p * p ? base + 0.8 + 0.5 * p : base;
  };
  const ChartSurface surface = chart_surface(
      [&](int outer, int inner) {
        return ChartValue{value(outer / 1024.0, static_cast<double>(inner) / kParts), ""};
      },
      kOuter, kAxis, {0.01, 20'000});
  ASSERT_FALSE(surface.unfinished);
  int between = 0;
  for (int k = 0; k < 2000; ++k) {
    const double p = 1024.0 * std::fmod(0.618033988749895 * k, 1.0);
    const double q = kParts * std::fmod(0.754877666246693 * k, 1.0);
    const auto after = std::upper_bound(surface.places.begin(), surface.places.end() - 1, p);
    const auto i = static_cast<std::size_t>(after - surface.places.begin());
    const double share = (p - surface.places[i - 1]) / (surface.places[i] - surface.places[i - 1]);
    const std::optional<double> found = between_curves(surface.curves[i - 1], surface.curves[i], share, q);
    const double jump = 0.6 + 0.2 * p / 1024.0 - 0.1 * p * p / 1024.0 / 1024.0;
    if (std::abs(q / kParts - jump) < 0.001) {
      ++between;
      continue;
    }
    ASSERT_TRUE(found) << p << ' ' << q;
    ASSERT_NEAR(*found / value(p / 1024.0, q / kParts), 1.0, 0.01) << p << ' ' << q;
  }
  EXPECT_LE(between, 10);
}

TEST(ChartSurface, PlacesAreComputedOnce) {
  std::set<std::pair<int, int>> seen;
  int calls = 0;
  const ChartSurface surface = chart_surface(
      [&](int outer, int inner) {
        ++calls;
        seen.emplace(outer, inner);
        return ChartValue{1.0 + 1e-3 * outer * inner / 4096.0, ""};
      },
      {1024, 4}, {kParts, 4}, kLimits);
  std::size_t places = 0;
  for (const ChartCurve& curve : surface.curves) {
    places += curve.places.size();
  }
  EXPECT_FALSE(surface.unfinished);
  EXPECT_EQ(static_cast<std::size_t>(calls), seen.size());
  EXPECT_LE(places, seen.size());
}

}  // namespace
}  // namespace snapthrough
