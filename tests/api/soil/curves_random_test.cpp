/// What holds for every curve: order, accuracy, units, growth with strength; at random places in the accepted
/// ranges.

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "api/soil/ultimate_resistance.h"
#include "tests/api/soil/reaction.h"

namespace snapthrough::api::soil {
namespace {

using snapthrough::testing::peak_of;
using snapthrough::testing::reaction_at;

/// Units of a curve: factors of length and force relative to the random numbers'.
struct Units {
  double length = 1.0, force = 1.0;

  [[nodiscard]] double stress() const { return force / (length * length); }
  [[nodiscard]] double modulus() const { return stress() / length; }
};

/// A curve of random parameters.
struct Case {
  std::string name;
  /// @param strength multiplies the strength of the soil
  std::function<Curve(Units units, double strength, double accuracy)> curve;
  double displacement_exponent = 1.0;  ///< of the length in the curve's displacement: 0 for rotations
  double force_exponent = -1.0;        ///< of the length in the curve's force
  bool grows = true;                   ///< a greater strength lessens no force
};

class Draw {
 public:
  explicit Draw(unsigned seed) : random_(seed) {}

  double uniform(double a, double b) { return std::uniform_real_distribution<double>(a, b)(random_); }
  /// Returns a number that is as likely in each decade.
  double decade(double a, double b) { return std::exp(uniform(std::log(a), std::log(b))); }
  bool coin() { return uniform(0.0, 1.0) < 0.5; }

 private:
  std::mt19937 random_;
};

struct Ground {
  Place place;
  double Su = 0.0, Su_mean = 0.0, G0 = 0.0, k = 0.0;

  [[nodiscard]] Place in(Units u) const {
    return {place.depth * u.length,           place.stress * u.stress(),  place.diameter * u.length,
            place.embedded_length * u.length, place.layer_top * u.length, place.loading};
  }
};

Ground ground(Draw& draw) {
  Ground g;
  g.place.diameter = draw.decade(0.1, 12.0);
  g.place.embedded_length = g.place.diameter * draw.decade(1.0, 100.0);
  g.place.depth = g.place.embedded_length * draw.decade(1e-4, 1.0);
  g.place.layer_top = g.place.depth * draw.uniform(0.0, 1.0);
  g.place.stress = g.place.depth * draw.uniform(1.0, 22.0);
  g.place.loading = draw.coin() ? Loading::cyclic : Loading::static_;
  g.Su = draw.decade(1.0, 1'000.0);
  g.Su_mean = g.Su * draw.decade(0.1, 10.0);
  g.G0 = g.Su * draw.decade(10.0, 3'000.0);
  g.k = draw.decade(100.0, 1e6);
  return g;
}

std::vector<Case> clay_cases(Draw& draw) {
  const Ground g = ground(draw);
  const double eps50 = draw.decade(kLeastEps50, kLargestEps50);
  const double J = draw.uniform(kLeastJ, kLargestJ);
  const double first = draw.coin() ? 0.0 : draw.decade(1e-6, kLargestFirstPoint);
  const double cycles = draw.decade(kLeastCycles, kLargestCycles);
  const auto start = draw.coin() ? SoftClayStart::formula : SoftClayStart::api_points;
  // under cyclic loads stronger clay has a deeper transition, above which the force falls
  const bool grows = g.place.loading == Loading::static_;
  return {{"soft_clay_matlock",
           [=](Units u, double f, double a) {
             return curve_of(SoftClayMatlock{f * g.Su * u.stress(), eps50, J, start, first}, g.in(u), a);
           },
           1.0, -1.0, grows},
          {"stiff_clay_free_water",
           [=](Units u, double f, double a) {
             return curve_of(StiffClayFreeWater{f * g.Su * u.stress(), f * g.Su_mean * u.stress(), eps50,
                                                g.k * u.modulus()},
                             g.in(u), a);
           }},
          {"stiff_clay",
           [=](Units u, double f, double a) {
             return curve_of(
                 StiffClay{f * g.Su * u.stress(), f * g.Su_mean * u.stress(), eps50, J, cycles, first},
                 g.in(u), a);
           }},
          {"api_tz_clay",
           [=, residual = draw.uniform(kLeastResidual, kLargestResidual)](Units u, double f, double a) {
             return curve_of(ApiTzClay{f * g.Su * u.stress(), residual}, g.in(u), a);
           }}};
}

std::vector<Case> pisa_cases(Draw& draw) {
  const Ground g = ground(draw);
  const double R = draw.uniform(kLeastRelativeDensity, kLargestRelativeDensity);
  const auto clay = [=](Units u, double f) { return PisaClay{f * g.Su * u.stress(), g.G0 * u.stress()}; };
  const auto sand = [=](Units u) { return PisaSand{R, g.G0 * u.stress()}; };
  const auto heavier = [=](Units u, double f) {
    Place place = g.in(u);
    place.stress *= f;
    return place;
  };
  return {
      {"pisa_clay", [=](Units u, double f, double a) { return curve_of(clay(u, f), g.in(u), a); }},
      {"pisa_clay m", [=](Units u, double f, double a) { return moment_curve_of(clay(u, f), g.in(u), a); },
       0.0, 0.0},
      {"pisa_clay H",
       [=](Units u, double f, double a) { return base_shear_curve_of(clay(u, f), g.in(u), a); }, 1.0, 0.0},
      {"pisa_clay M",
       [=](Units u, double f, double a) { return base_moment_curve_of(clay(u, f), g.in(u), a); }, 0.0, 1.0},
      {"pisa_sand", [=](Units u, double f, double a) { return curve_of(sand(u), heavier(u, f), a); }},
      {"pisa_sand m",
       [=](Units u, double f, double a) {
         return moment_curve_of(sand(u), heavier(u, 1.0), f * g.Su * u.force / u.length, a);
       },
       0.0, 0.0},
      {"pisa_sand H",
       [=](Units u, double f, double a) { return base_shear_curve_of(sand(u), heavier(u, f), a); }, 1.0, 0.0},
      {"pisa_sand M",
       [=](Units u, double f, double a) { return base_moment_curve_of(sand(u), heavier(u, f), a); }, 0.0,
       1.0},
  };
}

std::vector<Case> sand_cases(Draw& draw) {
  const Ground g = ground(draw);
  const double phi = draw.uniform(kLeastPhi, kLargestPhi - 1.0);
  const double rqd = draw.uniform(kLeastRqd, kLargestRqd);
  const double k_rm = draw.decade(kLeastKrm, kLargestKrm);
  return {{"reese_sand",
           [=](Units u, double f, double a) {
             return curve_of(ReeseSand{f > 1.0 ? phi + 1.0 : phi, g.k * u.modulus()}, g.in(u), a);
           }},
          {"weak_rock",
           [=](Units u, double f, double a) {
             return curve_of(WeakRock{f * g.Su * u.stress(), g.G0 * u.stress(), rqd, k_rm}, g.in(u), a);
           }},
          {"liquefied_sand",
           [=](Units u, double f, double a) {
             Place place = g.in(u);
             place.depth = std::min(place.depth, 100.0 * u.length);
             place.diameter *= f > 1.0 ? 1.1 : 1.0;
             return curve_of(LiquefiedSand{u.length, u.force}, place, a);
           }},
          {"api_tz_sand",
           [=](Units u, double f, double a) {
             return curve_of(ApiTzSand{f * g.Su * u.stress(), 0.0025 * u.length}, g.in(u), a);
           }},
          {"api_qz",
           [=](Units u, double f, double /*a*/) {
             const double D = g.place.diameter * u.length;
             return tip_curve_of({f * g.Su * u.stress(), std::numbers::pi / 4.0 * D * D}, g.in(u));
           },
           1.0, 0.0}};
}

template <class Check>
void for_random_cases(int count, const Check& check) {
  Draw draw(20261130);
  for (int i = 0; i < count; ++i) {
    for (const auto& make : {clay_cases, pisa_cases, sand_cases}) {
      for (const Case& c : make(draw)) {
        SCOPED_TRACE(c.name + ", round " + std::to_string(i));
        check(c, draw);
        if (::testing::Test::HasFailure()) {
          return;
        }
      }
    }
  }
}

TEST(SoilCurvesTest, PointsAreFiniteAscendAndBeginAtTheOrigin) {
  for_random_cases(400, [](const Case& c, Draw& draw) {
    const Curve curve = c.curve({}, 1.0, draw.decade(kLeastAccuracy, kLargestAccuracy));
    ASSERT_FALSE(curve.points.empty());
    EXPECT_EQ(curve.points[0][0], 0.0);
    EXPECT_EQ(curve.points[0][1], 0.0);
    for (std::size_t i = 1; i < curve.points.size(); ++i) {
      EXPECT_TRUE(std::isfinite(curve.points[i][0]) && std::isfinite(curve.points[i][1]));
      EXPECT_GT(curve.points[i][0], curve.points[i - 1][0]);
      EXPECT_GE(curve.points[i][1], 0.0);
    }
    EXPECT_EQ(curve.has_resistance(), peak_of(curve) > 0.0);
    EXPECT_LE(curve.points.size(), 300U);
  });
}

TEST(SoilCurvesTest, LinesAreWithinTheAccuracyOfFinerLines) {
  for_random_cases(100, [](const Case& c, Draw& draw) {
    const double accuracy = draw.decade(1e-3, kLargestAccuracy);
    const Curve coarse = c.curve({}, 1.0, accuracy);
    const Curve fine = c.curve({}, 1.0, kLeastAccuracy);
    const double largest = peak_of(fine);
    EXPECT_LE(coarse.points.size(), fine.points.size());
    for (const auto& [y, p] : fine.points) {
      EXPECT_NEAR(reaction_at(coarse, y), p, accuracy * largest * (1.0 + 1e-6)) << y;
    }
    for (std::size_t i = 0; i < coarse.points.size(); ++i) {
      const auto [y, p] = coarse.points[i];
      // the first line may leave a curve of finite initial stiffness along its tangent; other points are on
      // it
      const double off = kLeastAccuracy + (i == 1 ? 0.5 * accuracy : 0.0);
      EXPECT_NEAR(reaction_at(fine, y), p, off * largest * (1.0 + 1e-6)) << y;
    }
  });
}

TEST(SoilCurvesTest, UnitsOnlyScaleACurve) {
  const Units millimetres{1'000.0, 1'000.0};  // mm and N in place of m and kN
  for_random_cases(100, [&](const Case& c, Draw& /*draw*/) {
    const Curve own = c.curve({}, 1.0, 0.01);
    const Curve scaled = c.curve(millimetres, 1.0, 0.01);
    const double y_factor = std::pow(millimetres.length, c.displacement_exponent);
    const double p_factor = millimetres.force * std::pow(millimetres.length, c.force_exponent);
    EXPECT_EQ(own.has_resistance(), scaled.has_resistance());
    const double largest = peak_of(own);
    for (const auto& [y, p] : own.points) {
      EXPECT_NEAR(reaction_at(scaled, y * y_factor) / p_factor, p, 0.011 * largest) << y;
    }
    EXPECT_NEAR(peak_of(scaled) / p_factor, largest, 1e-6 * largest);
  });
}

TEST(SoilCurvesTest, StrongerSoilReactsNoLess) {
  for_random_cases(100, [](const Case& c, Draw& draw) {
    const Curve own = c.curve({}, 1.0, kLeastAccuracy);
    const Curve stronger = c.curve({}, draw.uniform(1.01, 3.0), kLeastAccuracy);
    if (!c.grows) {
      return;
    }
    const double slack = 1.1 * kLeastAccuracy * (peak_of(own) + peak_of(stronger));
    for (const auto& [y, p] : own.points) {
      EXPECT_GE(reaction_at(stronger, y) + slack, p) << y;
    }
  });
}

}  // namespace
}  // namespace snapthrough::api::soil
