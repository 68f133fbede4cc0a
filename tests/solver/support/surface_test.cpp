/// Signed distances to surfaces of media, and their derivatives, against central differences.
#include "solver/support/surface.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

namespace snapthrough {
namespace {

using Vec2 = std::array<double, 2>;

struct Named {
  std::string name;
  Outline outline;
};

std::vector<Named> outlines() {
  const std::vector<Vec2> hill{{-1.0, 0.0}, {-0.2, 0.3}, {0.5, -0.1}, {1.4, 0.4}, {2.0, 0.0}};
  return {{"cavity", CircleOutline{{0.3, -0.2}, 1.7, false}},
          {"bar", CircleOutline{{0.3, -0.2}, 0.6, true}},
          {"floor", LineOutline{{0.0, -0.4}, {0.3, -2.0}}},
          {"spline_left", SplineOutline{hill, Side::left}},
          {"spline_right", SplineOutline{hill, Side::right}},
          {"polyline", PolylineOutline{hill, 0.2, Side::right}}};
}

std::shared_ptr<const Surface> made(const Outline& outline) { return make_surface(outline, {0.1, 0.2}, 2.0); }

/// Points beside the surfaces, away from the places where the nearest point jumps.
const std::vector<Vec2> kPlaces{{-0.31, 0.02}, {0.05, 0.021}, {0.33, -0.2},
                                {0.62, 0.05},  {1.3, 0.0},    {-0.9, -0.1}};

TEST(Surface, HasTheDerivativesOfItsDistance) {
  constexpr double kStep = 1e-6;
  for (const auto& [name, outline] : outlines()) {
    const auto surface = made(outline);
    for (const Vec2& x : kPlaces) {
      const SurfacePoint at = surface->at(x);
      EXPECT_NEAR(std::hypot(at.into[0], at.into[1]), 1.0, 1e-14) << name;
      for (int c = 0; c < 2; ++c) {
        Vec2 ahead = x;
        Vec2 behind = x;
        ahead[c] += kStep;
        behind[c] -= kStep;
        const double slope = (surface->at(ahead).depth - surface->at(behind).depth) / (2.0 * kStep);
        EXPECT_NEAR(slope, at.into[c], 1e-8) << name << " at " << x[0] << ", " << x[1];
      }
      const Vec2 tangent{-at.into[1], at.into[0]};
      const auto moved = [&](Vec2 along, double distance) {
        return surface->at({x[0] + distance * along[0], x[1] + distance * along[1]});
      };
      const SurfacePoint ahead = moved(tangent, kStep);
      const SurfacePoint behind = moved(tangent, -kStep);
      for (int c = 0; c < 2; ++c)
        EXPECT_NEAR((ahead.into[c] - behind.into[c]) / (2.0 * kStep), at.bend * tangent[c], 1e-7) << name;
      EXPECT_NEAR((ahead.bend - behind.bend) / (2.0 * kStep), at.bend_rate, 1e-6) << name;
      const double along_normal = (moved(at.into, kStep).bend - moved(at.into, -kStep).bend) / (2.0 * kStep);
      EXPECT_NEAR(along_normal, -at.bend * at.bend, 1e-6) << name;
    }
  }
}

TEST(Surface, MeasuresFromTheMediumsSide) {
  EXPECT_NEAR(made(CircleOutline{{0.1, 0.2}, 4.0, false})->at({0.0, 1.5}).depth, -0.5, 1e-15);
  EXPECT_NEAR(made(CircleOutline{{0.1, 0.2}, 4.0, true})->at({0.0, 1.5}).depth, 0.5, 1e-15);
  EXPECT_NEAR(made(LineOutline{{5.0, -1.8}, {0.0, -3.0}})->at({7.0, -1.25}).depth, 0.25, 1e-15);
}

/// A spline through points of a circle is that circle up to the fourth order of their distance.
TEST(Surface, OfASplineThroughACircleIsNearThatCircle) {
  std::vector<Vec2> points;
  for (int i = 0; i <= 40; ++i)
    points.push_back(
        {2.0 * std::cos(std::numbers::pi * i / 40.0), 2.0 * std::sin(std::numbers::pi * i / 40.0)});
  const auto surface = make_surface(SplineOutline{points, Side::right}, {0.0, 0.0}, 1.0);
  for (const double r : {1.8, 2.0, 2.1})
    for (const double angle : {0.7, 1.5, 2.2})
      EXPECT_NEAR(surface->at({r * std::cos(angle), r * std::sin(angle)}).depth, r - 2.0, 2e-6);
}

/// The arc of a corner between two sides at a right angle, and the sides beyond their ends.
TEST(Surface, OfAPolylineIsRoundedAtItsCorner) {
  const auto surface =
      make_surface(PolylineOutline{{{0.0, 0.0}, {3.0, 0.0}, {3.0, 3.0}}, 1.0, Side::left}, {0.0, 0.0}, 1.0);
  const double half = std::sqrt(0.5);
  EXPECT_NEAR(surface->at({2.0 + 1.5 * half, 1.0 - 1.5 * half}).depth, -0.5, 1e-14);
  EXPECT_NEAR(surface->at({-7.0, 0.25}).depth, 0.25, 1e-14);
  EXPECT_NEAR(surface->at({3.5, 8.0}).depth, -0.5, 1e-14);
}

/// Rounding leaves no point without a nearest piece where a line and an arc meet.
TEST(Surface, OfAPolylineHasNoHoleBesideItsArcs) {
  for (int k = 0; k < 500; ++k) {
    const double turn = 0.002 * (k + 1) * (k % 2 == 0 ? 1.0 : -1.0);
    const double angle = 0.37 * k;
    const std::array<double, 2> corner{1.3 * std::cos(angle), 1.3 * std::sin(angle)};
    const std::array<double, 2> end{corner[0] + std::cos(angle + turn), corner[1] + std::sin(angle + turn)};
    const auto surface =
        make_surface(PolylineOutline{{{0.0, 0.0}, corner, end}, 0.4, Side::right}, {0.0, 0.0}, 1.0);
    ASSERT_EQ(surface->seams().size(), 2u);
    for (const SurfaceSeam& seam : surface->seams())
      for (const double depth : {-0.1, 0.03, 0.2}) {
        const std::array<double, 2> x{seam.x[0] + depth * seam.tangent[1],
                                      seam.x[1] - depth * seam.tangent[0]};
        const SurfacePoint at = surface->at(x);
        EXPECT_NEAR(at.depth, depth, 1e-14) << k;
        EXPECT_NEAR(std::hypot(at.into[0], at.into[1]), 1.0, 1e-14) << k;
      }
  }
}

}  // namespace
}  // namespace snapthrough
