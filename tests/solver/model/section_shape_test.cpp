/// Area, second moment and shear area of cross sections against published tables and closed forms.
#include "solver/model/section_shape.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "solver/numeric/gauss_rule.h"

namespace snapthrough {
namespace {

constexpr double kPi = std::numbers::pi;

struct Published {
  std::string name;
  double area;           ///< cm^2
  double second_moment;  ///< cm^4
};

/// Tables of makers for EN 10365: areas to three or four digits, second moments to four at most.
const Published kPublished[] = {
    {"IPE 80", 7.64, 80.1},     {"IPE 100", 10.3, 171},     {"IPE 120", 13.2, 318},
    {"IPE 140", 16.4, 541},     {"IPE 160", 20.1, 869},     {"IPE 180", 23.9, 1317},
    {"IPE 200", 28.5, 1943},    {"IPE 220", 33.4, 2772},    {"IPE 240", 39.1, 3892},
    {"IPE 270", 45.9, 5790},    {"IPE 300", 53.8, 8356},    {"IPE 330", 62.6, 11770},
    {"IPE 360", 72.7, 16270},   {"IPE 400", 84.5, 23130},   {"IPE 450", 98.8, 33740},
    {"IPE 500", 116, 48200},    {"IPE 550", 134, 67120},    {"IPE 600", 156, 92080},
    {"HEA 100", 21.2, 349},     {"HEA 120", 25.3, 606},     {"HEA 140", 31.4, 1033},
    {"HEA 160", 38.8, 1673},    {"HEA 180", 45.3, 2510},    {"HEA 200", 53.8, 3692},
    {"HEA 220", 64.3, 5410},    {"HEA 240", 76.8, 7763},    {"HEA 260", 86.8, 10450},
    {"HEA 280", 97.3, 13670},   {"HEA 300", 112.5, 18260},  {"HEA 320", 124.4, 22930},
    {"HEA 340", 133.5, 27690},  {"HEA 360", 142.8, 33090},  {"HEA 400", 159.0, 45070},
    {"HEA 450", 178.0, 63720},  {"HEA 500", 197.5, 86970},  {"HEA 550", 211.8, 111900},
    {"HEA 600", 226.5, 141200}, {"HEA 650", 241.6, 175200}, {"HEA 700", 260.5, 215300},
    {"HEA 800", 285.8, 303400}, {"HEA 900", 320.5, 422100}, {"HEA 1000", 346.8, 553800},
    {"HEB 100", 26.0, 450},     {"HEB 120", 34.0, 864},     {"HEB 140", 43.0, 1509},
    {"HEB 160", 54.3, 2492},    {"HEB 180", 65.3, 3831},    {"HEB 200", 78.1, 5696},
    {"HEB 220", 91.0, 8091},    {"HEB 240", 106.0, 11260},  {"HEB 260", 118.4, 14920},
    {"HEB 280", 131.4, 19270},  {"HEB 300", 149.1, 25170},  {"HEB 320", 161.3, 30820},
    {"HEB 340", 170.9, 36660},  {"HEB 360", 180.6, 43190},  {"HEB 400", 197.8, 57680},
    {"HEB 450", 218.0, 79890},  {"HEB 500", 238.6, 107200}, {"HEB 550", 254.1, 136700},
    {"HEB 600", 270.0, 171000}, {"HEB 650", 286.3, 210600}, {"HEB 700", 306.4, 256900},
    {"HEB 800", 334.2, 359100}, {"HEB 900", 371.3, 494100}, {"HEB 1000", 400.0, 644700},
    {"HEM 100", 53.2, 1143},    {"HEM 120", 66.4, 2018},    {"HEM 140", 80.6, 3291},
    {"HEM 160", 97.1, 5098},    {"HEM 180", 113.3, 7483},   {"HEM 200", 131.3, 10640},
    {"HEM 220", 149.4, 14600},  {"HEM 240", 199.6, 24290},  {"HEM 260", 219.6, 31310},
    {"HEM 280", 240.2, 39550},  {"HEM 300", 303.1, 59200},  {"HEM 320", 312.0, 68130},
    {"HEM 340", 315.8, 76370},  {"HEM 360", 318.8, 84870},  {"HEM 400", 325.8, 104100},
    {"HEM 450", 335.4, 131500}, {"HEM 500", 344.3, 161900}, {"HEM 550", 354.4, 198000},
    {"HEM 600", 363.7, 237400}, {"HEM 650", 373.7, 281700}, {"HEM 700", 383.0, 329300},
    {"HEM 800", 404.3, 442600}, {"HEM 900", 423.6, 570400}, {"HEM 1000", 444.2, 722300}};

/// Half a unit of the last published digit, and a little more for a table that rounds from rounded values.
double half_unit(double value, int digits, double least) {
  const double unit = std::pow(10.0, std::floor(std::log10(value)) + 1.0 - digits);
  return 0.51 * std::max(unit, least);
}

TEST(Profiles, HaveThePublishedAreasAndSecondMoments) {
  ASSERT_EQ(std::size(kPublished), profiles().size());
  for (std::size_t i = 0; i < profiles().size(); ++i) {
    const Profile& profile = profiles()[i];
    const Published& published = kPublished[i];
    ASSERT_EQ(profile.name, published.name);
    const SectionGeometry cm = i_section(scaled(profile.section, 0.1));
    const bool ipe = published.name.starts_with("IPE");
    EXPECT_NEAR(cm.area, published.area, half_unit(published.area, ipe ? 3 : 4, 0.1 * (ipe ? 0.1 : 1.0)))
        << profile.name;
    EXPECT_NEAR(cm.second_moment, published.second_moment,
                half_unit(published.second_moment, 4, published.name == "IPE 80" ? 0.1 : 1.0))
        << profile.name;
  }
}

TEST(Sections, RoundBarsAndThinTubesHaveTheirClosedForms) {
  const SectionGeometry bar = tube(2.0, 1.0);
  EXPECT_NEAR(bar.area, kPi, 1e-14);
  EXPECT_NEAR(bar.second_moment, kPi / 4.0, 1e-14);
  EXPECT_NEAR(bar.shear_area, 6.0 / 7.0 * kPi, 1e-14);
  const SectionGeometry thin = tube(2.0, 1e-9);
  EXPECT_NEAR(thin.area, 2.0 * kPi * 1e-9, 1e-17);
  EXPECT_NEAR(thin.second_moment, kPi * 1e-9, 1e-17);
  EXPECT_NEAR(thin.shear_area, 0.5 * thin.area, 1e-16);
}

/// A fillet of radius r on a section without web and flange of importance: the second moment by quadrature.
TEST(Sections, FilletsAreThoseOfAQuarterCircle) {
  const ISection without{10.0, 8.0, 1.0, 1.0, 0.0};
  ISection with = without;
  with.root_radius = 2.0;
  double area = 0.0;
  double moment = 0.0;
  const Quadrature gauss = gauss_legendre(40);
  for (std::size_t i = 0; i < gauss.points.size(); ++i) {
    const double turn = 0.5 * kPi * gauss.points[i];  // angle along the arc: smooth integrand
    const double x = 2.0 - 2.0 * std::sin(turn);      // distance from the web
    const double y = 2.0 - 2.0 * std::cos(turn);      // distance from the flange
    const double dy = 2.0 * std::sin(turn) * 0.5 * kPi * gauss.weights[i];
    area += 4.0 * x * dy;
    moment += 4.0 * x * (4.0 - y) * (4.0 - y) * dy;
  }
  EXPECT_NEAR(i_section(with).area - i_section(without).area, area, 1e-12);
  EXPECT_NEAR(i_section(with).second_moment - i_section(without).second_moment, moment, 1e-10);
}

/// Shear flow of thin walls under a unit force: q = S / I; shear area = 1 / int q^2 / t.
TEST(Sections, ShearAreaOfAnISectionIsThatOfItsShearFlow) {
  const ISection section{200.0, 100.0, 5.6, 8.5, 12.0};
  const double h = section.depth - section.flange;
  const double flange = section.width * section.flange;
  const double I = 0.5 * flange * h * h + section.web * h * h * h / 12.0;
  double energy = 0.0;
  const Quadrature gauss = gauss_legendre(6);
  for (std::size_t i = 0; i < gauss.points.size(); ++i) {
    const double y = 0.5 * h * gauss.points[i];
    const double in_web = (0.5 * flange * h + 0.5 * section.web * (0.25 * h * h - y * y)) / I;
    energy += h * gauss.weights[i] * in_web * in_web / section.web;
    const double z = 0.5 * section.width * gauss.points[i];
    const double in_flange = 0.5 * section.flange * h * (0.5 * section.width - z) / I;
    energy += 2.0 * section.width * gauss.weights[i] * in_flange * in_flange / section.flange;
  }
  EXPECT_NEAR(i_section(section).shear_area, 1.0 / energy, 1e-9);
}

}  // namespace
}  // namespace snapthrough
