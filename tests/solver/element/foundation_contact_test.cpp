#include "solver/element/foundation_contact.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <random>
#include <vector>

namespace snapthrough {
namespace {

/// Displacements of an element of some order, and the strip under it.
struct Drawn {
  std::vector<double> dx, dy;
  std::array<double, 2> ua{};
};

Drawn draw(std::mt19937& random, int order) {
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  Drawn out;
  for (int q = 0; q < order; ++q) {
    out.dx.push_back(uniform(random));
    out.dy.push_back(uniform(random));
  }
  out.ua = {uniform(random), uniform(random)};
  return out;
}

/// A one-sided foundation of stiffness 1.
FoundationLaw law_along(const Direction& direction, double gap) {
  FoundationLaw out;
  out.direction = direction;
  out.law = {1.0, gap, true};
  return out;
}

Direction direction_on(bool curved) {
  return curved ? Direction{true, {}, -1.0} : Direction{false, {0.6, 0.8}, 1.0};
}

/// A strip of stiffness 1 without gap under part of an element.
FoundationContact strip_on(int order, bool curved, std::array<double, 2> range) {
  const auto axis =
      std::make_shared<const AxisCurve>(ArcCurve{120.0}, std::array{0.0, 0.0}, std::array{2.0, 0.0});
  return FoundationContact(order, law_along(direction_on(curved), 0.0),
                           {axis, 0.2 * axis->length(), 0.3 * axis->length()}, range, 0);
}

double contact_at(const std::vector<FoundationContact::Interval>& zones, double xi) {
  return std::ranges::any_of(zones, [xi](const auto& zone) { return xi >= zone.from && xi <= zone.to; })
             ? 1.0
             : 0.0;
}

/// Local extrema of the penetration strictly inside the element, by 4000 samples.
std::vector<double> extrema(const FoundationContact& strip, const Drawn& u) {
  constexpr int kCells = 4000;
  std::vector<double> g;
  for (int i = 0; i <= kCells; ++i) g.push_back(strip.penetration(double(i) / kCells, u.ua, u.dx, u.dy));
  std::vector<double> out;
  for (int i = 1; i < kCells; ++i)
    if ((g[i] - g[i - 1]) * (g[i + 1] - g[i]) < 0.0) out.push_back(double(i) / kCells);
  return out;
}

/// The gap is chosen so that contact just begins or just ends at each extremum in turn: zones of some
/// hundredths of the element and less, which samples at fixed places miss.
void expect_zones_found(bool curved) {
  std::mt19937 random(7);
  int tried = 0;
  int missed = 0;
  for (int order = 2; order <= 8; ++order)
    for (int n = 0; n < 100; ++n) {
      const Drawn u = draw(random, order);
      const FoundationContact strip = strip_on(order, curved, {0.0, 1.0});
      for (const double at : extrema(strip, u))
        for (const double depth : {1e-3, 1e-6, -1e-3, -1e-6}) {
          const double gap = strip.penetration(at, u.ua, u.dx, u.dy) - depth;
          const FoundationContact shifted = strip.with_law(law_along(direction_on(curved), gap), 0);
          std::vector<FoundationContact::Interval> zones;
          shifted.contact_intervals(u.ua, u.dx, u.dy, zones);
          const bool right = contact_at(zones, at) == (depth > 0.0 ? 1.0 : 0.0);
          EXPECT_TRUE(right || std::abs(depth) < 1e-5)
              << "order " << order << " draw " << n << " at " << at << " depth " << depth;
          missed += right ? 0 : 1;
          ++tried;
        }
    }
  EXPECT_GT(tried, 1000);
  // two extrema between neighbouring samples, a millionth of the displacements apart in depth
  EXPECT_LE(missed, tried / 1000);
}

TEST(FoundationContact, FindsZonesSmallerThanItsSamplingUnderAFixedDirection) { expect_zones_found(false); }
TEST(FoundationContact, FindsZonesSmallerThanItsSamplingUnderACurvedAxis) { expect_zones_found(true); }

TEST(FoundationContact, EndsOfContactAreRootsOfThePenetration) {
  std::mt19937 random(3);
  for (int order = 1; order <= 8; ++order) {
    const Drawn u = draw(random, order);
    const FoundationContact strip =
        strip_on(order, true, {0.1, 0.9})
            .with_law(law_along(direction_on(true),
                                strip_on(order, true, {0.1, 0.9}).penetration(0.37, u.ua, u.dx, u.dy)),
                      0);
    std::vector<FoundationContact::Interval> zones;
    strip.contact_intervals(u.ua, u.dx, u.dy, zones);
    ASSERT_FALSE(zones.empty());
    double nearest = 1.0;
    for (const auto& zone : zones)
      nearest = std::min({nearest, std::abs(zone.from - 0.37), std::abs(zone.to - 0.37)});
    EXPECT_LT(nearest, 1e-12) << order;
  }
}

/// An axis with knots inside the element, which no polynomial follows to rounding.
TEST(FoundationContact, EndsOfContactAreRootsWhereSamplesDoNotResolveTheAxis) {
  const auto axis =
      std::make_shared<const AxisCurve>(PointsCurve{{{0.3, 0.25}, {0.8, 0.05}, {1.1, 0.3}, {1.6, -0.1}}},
                                        std::array{0.0, 0.0}, std::array{2.0, 0.0});
  std::mt19937 random(11);
  int ends = 0;
  for (int n = 0; n < 200; ++n) {
    const int order = 1 + n % 8;
    const Drawn u = draw(random, order);
    const FoundationContact strip(order, law_along({true, {}, 1.0}, 0.02), {axis, 0.0, axis->length()},
                                  {0.05, 1.0}, 0);
    std::vector<FoundationContact::Interval> zones;
    strip.contact_intervals(u.ua, u.dx, u.dy, zones);
    for (const auto& zone : zones)
      for (const double at : {zone.from, zone.to}) {
        if (at == 0.05 || at == 1.0) continue;
        ++ends;
        EXPECT_LT(std::abs(strip.penetration(at, u.ua, u.dx, u.dy)), 1e-13) << "draw " << n << " at " << at;
      }
  }
  EXPECT_GT(ends, 100);
}

TEST(FoundationContact, SlopeIsTheDerivativeOfThePenetration) {
  std::mt19937 random(5);
  for (const bool curved : {false, true}) {
    const Drawn u = draw(random, 5);
    const FoundationContact strip =
        strip_on(5, curved, {0.0, 1.0}).with_law(law_along(direction_on(curved), 0.1), 0);
    constexpr double kStep = 1e-4;
    for (const double at : {0.13, 0.5, 0.88}) {
      const double difference = (strip.penetration(at + kStep, u.ua, u.dx, u.dy) -
                                 strip.penetration(at - kStep, u.ua, u.dx, u.dy)) /
                                (2.0 * kStep);
      EXPECT_NEAR(strip.penetration_slope(at, u.ua, u.dx, u.dy), difference, 1e-6) << at;
    }
  }
}

/// The shape t^2 (c - t), t the distance from an end that is clamped: contact, or the loss of it, in the last
/// c of the element, while the value at the end is rounding's, of either sign.
TEST(FoundationContact, FindsZonesBesideAClampedEnd) {
  const CollocationRule& rule = CollocationRule::of(3);
  for (const double c : {0.3, 0.03, 3e-3, 3e-4})
    for (const double sign : {1.0, -1.0})
      for (const bool at_start : {false, true}) {
        Drawn u;
        u.dx.assign(3, 0.0);
        for (int q = 0; q < 3; ++q) {
          const double t = at_start ? rule.point(q) : 1.0 - rule.point(q);
          u.dy.push_back((at_start ? sign : -sign) * (2.0 * t * c - 3.0 * t * t));
        }
        u.ua = {0.0, at_start ? 0.0 : sign * (c - 1.0)};
        for (const double rounding : {0.0, 1e-19, -1e-19}) {
          const FoundationContact strip(3, law_along({false, {0.0, 1.0}, 1.0}, rounding), {}, {0.0, 1.0}, 0);
          std::vector<FoundationContact::Interval> zones;
          strip.contact_intervals(u.ua, u.dx, u.dy, zones);
          const auto place = [at_start](double t) { return at_start ? t : 1.0 - t; };
          EXPECT_EQ(contact_at(zones, place(0.5 * c)), sign > 0.0 ? 1.0 : 0.0) << c << " " << rounding;
          EXPECT_EQ(contact_at(zones, place(2.0 * c)), sign > 0.0 ? 0.0 : 1.0) << c << " " << rounding;
        }
      }
}

}  // namespace
}  // namespace snapthrough
