/// Axes by their arc length: against closed forms and the integral of their own curvature.
#include "solver/geometry/axis_curve.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "solver/geometry/cubic_spline.h"

namespace snapthrough {
namespace {

constexpr std::array<double, 2> kStart{1.0, 2.0};
constexpr std::array<double, 2> kEnd{4.0, 6.0};  // chord 5

AxisCurve axis(const Curve& curve) { return {curve, kStart, kEnd}; }

TEST(AxisCurve, OfALineIsItsChord) {
  const AxisCurve line = axis(LineCurve{});
  EXPECT_DOUBLE_EQ(line.length(), 5.0);
  EXPECT_TRUE(line.straight());
  EXPECT_NEAR(line.at(2.5).x, 2.5, 1e-15);
  EXPECT_NEAR(line.at(2.5).y, 4.0, 1e-15);
}

/// Chord 2 R sin(sweep / 2), to the left for a positive sweep.
TEST(AxisCurve, OfAnArcHasItsRadius) {
  for (const double degrees : {-300.0, -90.0, 1e-3, 90.0, 180.0, 359.0}) {
    const AxisCurve arc = axis(ArcCurve{degrees});
    const double sweep = degrees * std::numbers::pi / 180.0;
    const double radius = 2.5 / std::sin(0.5 * std::abs(sweep));
    EXPECT_NEAR(arc.length(), radius * std::abs(sweep), 1e-12 * arc.length()) << degrees;
    EXPECT_NEAR(arc.at(arc.length()).x, 4.0, 1e-12 * arc.length()) << degrees;
    EXPECT_NEAR(arc.at(arc.length()).y, 6.0, 1e-12 * arc.length()) << degrees;
    EXPECT_NEAR(arc.at(arc.length()).angle - arc.at(0.0).angle, sweep, 1e-12) << degrees;
    EXPECT_NEAR(arc.at(0.3 * arc.length()).curvature, std::copysign(1.0 / radius, degrees), 1e-12);
  }
}

/// Whatever the curve: unit speed along its angle, its angle the integral of its curvature, and both ends
/// met.
TEST(AxisCurve, HasItsArcLengthAsParameter) {
  const Curve curves[] = {ParabolaCurve{1.7}, SineCurve{0.8, 3},
                          PointsCurve{{{2.0, 2.5}, {2.5, 4.5}, {3.5, 5.0}}}};
  for (const Curve& curve : curves) {
    SCOPED_TRACE(curve.index());
    const AxisCurve a = axis(curve);
    EXPECT_FALSE(a.straight());
    EXPECT_NEAR(a.at(0.0).x, 1.0, 1e-12);
    EXPECT_NEAR(a.at(0.0).y, 2.0, 1e-12);
    EXPECT_NEAR(a.at(a.length()).x, 4.0, 1e-11);
    EXPECT_NEAR(a.at(a.length()).y, 6.0, 1e-11);
    const double h = 1e-4 * a.length();
    for (double s = 0.013 * a.length(); s < 0.99 * a.length(); s += 0.0371 * a.length()) {
      const AxisPoint p = a.at(s);
      const AxisPoint before = a.at(s - h);
      const AxisPoint after = a.at(s + h);
      EXPECT_NEAR((after.x - before.x) / (2.0 * h), std::cos(p.angle), 1e-5) << s;
      EXPECT_NEAR((after.y - before.y) / (2.0 * h), std::sin(p.angle), 1e-5) << s;
      EXPECT_NEAR((after.angle - before.angle) / (2.0 * h), p.curvature, 1e-4 * (1.0 + std::abs(p.curvature)))
          << s;
    }
  }
}

/// A sine of n half-waves is n times the one half-wave, mirrored at the chord each time.
TEST(AxisCurve, OfASineRepeatsItsFirstHalfWave) {
  const int half_waves = 5;
  const double chord = 2.0;
  const AxisCurve whole(SineCurve{0.7, half_waves}, {0.0, 0.0}, {chord * half_waves, 0.0});
  const AxisCurve wave(SineCurve{0.7, 1}, {0.0, 0.0}, {chord, 0.0});
  EXPECT_NEAR(whole.length(), half_waves * wave.length(), 1e-13 * whole.length());
  for (int k = 0; k < half_waves; ++k) {
    const double side = k % 2 == 0 ? 1.0 : -1.0;
    for (const double part : {0.0, 0.01, 0.3, 0.5, 0.77, 1.0}) {
      const AxisPoint here = whole.at((k + part) * wave.length());
      const AxisPoint there = wave.at(part * wave.length());
      EXPECT_NEAR(here.x, k * chord + there.x, 1e-12) << k << ' ' << part;
      EXPECT_NEAR(here.y, side * there.y, 1e-12) << k << ' ' << part;
      EXPECT_NEAR(here.angle, side * there.angle, 1e-12) << k << ' ' << part;
      EXPECT_NEAR(here.curvature, side * there.curvature, 1e-11) << k << ' ' << part;
    }
    const double from = 0.3 * wave.length();
    EXPECT_NEAR(whole.turning(from, from + k * wave.length()), k * wave.turning(0.0, wave.length()), 1e-12)
        << k;
  }
}

/// A spline through points of a circle at equal angles tends to the circle with the fourth power of the
/// angle.
TEST(AxisCurve, OfASplineTendsToItsCircle) {
  const int pieces = 200;
  PointsCurve points;
  for (int i = 1; i < pieces; ++i) {
    const double angle = std::numbers::pi * (1.0 - static_cast<double>(i) / pieces);
    points.points.push_back({std::cos(angle), std::sin(angle)});
  }
  const AxisCurve spline(points, {-1.0, 0.0}, {1.0, 0.0});
  EXPECT_NEAR(spline.length(), std::numbers::pi, 1e-8);
  EXPECT_NEAR(spline.turning(0.0, spline.length()), std::numbers::pi, 1e-4);
  EXPECT_NEAR(spline.turning(0.25 * spline.length(), 0.5 * spline.length()), 0.25 * std::numbers::pi, 1e-6);
  ASSERT_EQ(spline.knots().size(), pieces - 3U);
  EXPECT_NEAR(spline.knots().front(), 2.0 * std::numbers::pi / pieces, 1e-8);
  EXPECT_NEAR(spline.at(0.3).curvature, -1.0, 1e-3);
}

/// y = 4 r x (1 - x): the length of a parabola of rise r over a chord of one is a closed form.
TEST(AxisCurve, OfAParabolaHasItsClosedFormLength) {
  for (const double rise : {0.01, 0.3, 2.0}) {
    const AxisCurve parabola(ParabolaCurve{rise}, {0.0, 0.0}, {1.0, 0.0});
    const double m = 4.0 * rise;
    const double length = 0.5 * std::sqrt(1.0 + m * m) + std::asinh(m) / (2.0 * m);
    EXPECT_NEAR(parabola.length(), length, 1e-12 * length) << rise;
    EXPECT_NEAR(parabola.at(0.5 * parabola.length()).y, rise, 1e-11) << rise;
  }
}

/// Not-a-knot splines have the cubics they interpolate.
TEST(CubicSpline, KeepsACubic) {
  const auto f = [](double t) { return 1.0 - 2.0 * t + 0.5 * t * t - 0.3 * t * t * t; };
  const std::vector<double> t{-1.0, 0.2, 0.9, 2.0, 3.5};
  std::vector<double> values;
  for (const double at : t) values.push_back(f(at));
  const CubicSpline spline(t, values);
  for (double at = -1.5; at < 4.0; at += 0.17) {
    const auto [value, first, second] = spline.at(at);
    EXPECT_NEAR(value, f(at), 1e-12) << at;
    EXPECT_NEAR(first, -2.0 + at - 0.9 * at * at, 1e-12) << at;
    EXPECT_NEAR(second, 1.0 - 1.8 * at, 1e-12) << at;
  }
  EXPECT_NEAR(CubicSpline({0.0, 1.0, 3.0}, {0.0, 1.0, 9.0}).at(2.0)[0], 4.0, 1e-13) << "a parabola by three";
  EXPECT_NEAR(CubicSpline({0.0, 2.0}, {1.0, 5.0}).at(0.5)[0], 2.0, 1e-14) << "a line by two";
}

/// A sine of h half waves turns by 2 h atan(its steepest slope), however steep, wherever it is looked at.
TEST(AxisCurve, TellsHowMuchItTurns) {
  const double rise = 15.0;
  const int half_waves = 80;
  const AxisCurve axis(SineCurve{rise, half_waves}, {0.0, 0.0}, {2.5, 0.0});
  const double steepest = std::atan(rise * half_waves * std::numbers::pi / 2.5);
  EXPECT_NEAR(axis.turning(0.0, axis.length()), 2.0 * half_waves * steepest, 1e-6);
  EXPECT_NEAR(axis.turning(0.0, 0.5 * axis.length()), half_waves * steepest, 1e-6);
  const AxisCurve arc(ArcCurve{-90.0}, {0.0, 0.0}, {1.0, 0.0});
  EXPECT_NEAR(arc.turning(0.25 * arc.length(), 0.75 * arc.length()), 0.25 * std::numbers::pi, 1e-14);
}

}  // namespace
}  // namespace snapthrough
