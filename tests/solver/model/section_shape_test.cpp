/// Area, second moment and shear area of cross sections against published tables and closed forms.
#include "solver/model/section_shape.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <string_view>
#include <vector>

#include "solver/model/profiles.h"
#include "solver/numeric/gauss_rule.h"
#include "tests/solver/model/published_profiles.h"

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

SectionGeometry in_centimetres(const std::string& name) {
  const auto found = find_profile(name);
  EXPECT_TRUE(found) << name;
  return found ? geometry_of(*found, 0.1) : SectionGeometry{};
}

TEST(Profiles, HaveThePublishedAreasAndSecondMoments) {
  for (const Published& published : kPublished) {
    const SectionGeometry cm = in_centimetres(published.name);
    const bool ipe = published.name.starts_with("IPE");
    EXPECT_NEAR(cm.area, published.area, half_unit(published.area, ipe ? 3 : 4, 0.1 * (ipe ? 0.1 : 1.0)))
        << published.name;
    EXPECT_NEAR(cm.second_moment, published.second_moment,
                half_unit(published.second_moment, 4, published.name == "IPE 80" ? 0.1 : 1.0))
        << published.name;
  }
}

/// Tables print three or four digits, some of them of rounded dimensions: 0.6 % of the area, 1 % of the
/// moment.
TEST(Profiles, OfAllEuropeanSeriesAgreeWithPublishedTables) {
  std::size_t european = 0;
  for (const ProfileSeries& series : profile_series())
    if (series.standard == "EN 10365:2017") european += series.profiles.size();
  EXPECT_EQ(std::size(kPublishedProfiles), european);
  for (const PublishedProfile& published : kPublishedProfiles) {
    const SectionGeometry cm = in_centimetres(published.name);
    EXPECT_NEAR(cm.area, published.area, 6e-3 * published.area) << published.name;
    EXPECT_NEAR(cm.second_moment, published.second_moment, 1e-2 * published.second_moment) << published.name;
  }
}

/// Dimensions have three digits: half a unit of the last one is up to 0.43 % of a width, 0.28 % of a
/// thickness.
TEST(Profiles, OfAiscHaveThePrintedAreaAndShapesThatAgree) {
  const ProfileSeries& american = profile_series().back();
  ASSERT_EQ(american.name, "W");
  EXPECT_EQ(american.profiles.size(), 289u);
  for (const Profile& profile : american.profiles) {
    const SectionGeometry inches = flanged_section(profile.section);
    EXPECT_NEAR(inches.area, profile.area, 8e-3 * profile.area) << profile.name;
    EXPECT_NEAR(inches.second_moment, profile.second_moment, 1e-2 * profile.second_moment) << profile.name;
  }
  const SectionGeometry cm = in_centimetres("W12X26");  // AISC: 7.65 in^2, 204 in^4
  EXPECT_NEAR(cm.area, 7.65 * 2.54 * 2.54, 1e-12);
  EXPECT_NEAR(cm.second_moment, 204.0 * std::pow(2.54, 4), 1e-9);
}

TEST(Profiles, AreFoundByAllOfTheirNames) {
  struct Names {
    const char* own;
    std::vector<const char*> others;
  };
  const Names all[] = {
      {"HEA 200", {"HE 200 A", "HE200A", "HEA200", "he200a", "  hea  200 ", "HE A 200"}},
      {"HEAA 100", {"HE 100 AA", "HEAA100"}},
      {"IPE 200", {"IPE200", "ipe 200", "IPE 200.0"}},
      {"IPE A 300", {"IPE 300 A", "IPEA 300", "ipea300"}},
      {"HE 1000x393", {"HE 1000 x 393", "HE1000X393", "HE 1000 \xC3\x97 393"}},
      {"HD 260x93", {"HD 260 x 93.0", "HD 260x93,0"}},
      {"HL 1100 R", {"HL1100R", "HL R 1100"}},
      {"UB 457x191x67", {"457x191x67 UB", "UKB 457 x 191 x 67", "ub 457*191*67", "UB 457 191 67"}},
      {"UC 203x203x46", {"UKC203x203x46"}},
      {"UPN 200", {"UNP 200", "UPN200"}},
      {"IPN 300", {"INP 300"}},
      {"W 12x26", {"W12X26", "w12x26", "W 12 X 26"}}};
  for (const Names& names : all) {
    const auto own = find_profile(names.own);
    ASSERT_TRUE(own) << names.own;
    EXPECT_EQ(own->profile->name, names.own);
    for (const char* other : names.others) {
      const auto found = find_profile(other);
      EXPECT_TRUE(found && found->profile == own->profile) << other;
    }
  }
  for (const ProfileSeries& series : profile_series()) {
    for (const Profile& profile : series.profiles) {
      const auto found = find_profile(profile.name);
      EXPECT_TRUE(found && found->profile == &profile) << profile.name << " has the name of another profile";
    }
  }
}

TEST(Profiles, OfUnknownNamesAreNotFound) {
  for (const char* name :
       {"", " ", "HEA", "200", "HEB 210", "HE 200", "HEA 200 300", "HEA200A100", "IPE 3x00", "IPE -200",
        "IPE 200 x", "x200", "HEA 2.0.0", "W12X", "IPE 1e2", "HEA\t200"})
    EXPECT_FALSE(find_profile(name)) << name;
}

TEST(Profiles, NearAnUnknownNameAreOfItsSeries) {
  using Names = std::vector<std::string_view>;
  EXPECT_EQ(profiles_near("HEB 210"), (Names{"HEB 220", "HEB 200", "HEB 240"}));
  EXPECT_EQ(profiles_near("ipe310"), (Names{"IPE 300", "IPE 330", "IPE 270"}));
  EXPECT_EQ(profiles_near("HE 200"), (Names{"HEA 200", "HEAA 200", "HEB 200"}));
  EXPECT_EQ(profiles_near("UB 457x191x70"), (Names{"UB 457x191x67", "UB 457x191x74", "UB 457x191x82"}));
  EXPECT_EQ(profiles_near("HD 400"), (Names{"HD 400x187", "HD 400x216", "HD 400x237"}));
  EXPECT_TRUE(profiles_near("Q 200").empty());
  EXPECT_TRUE(profiles_near("HEB").empty());
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
  const FlangedSection without{10.0, 8.0, 1.0, 1.0, 0.0};
  FlangedSection with = without;
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
  EXPECT_NEAR(flanged_section(with).area - flanged_section(without).area, area, 1e-12);
  EXPECT_NEAR(flanged_section(with).second_moment - flanged_section(without).second_moment, moment, 1e-10);
}

/// Shear flow of thin walls under a unit force: q = S / I; shear area = 1 / int q^2 / t.
TEST(Sections, ShearAreaOfAnISectionIsThatOfItsShearFlow) {
  const FlangedSection section{200.0, 100.0, 5.6, 8.5, 12.0};
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
  EXPECT_NEAR(flanged_section(section).shear_area, 1.0 / energy, 1e-9);
}

/// A web as wide as the flanges leaves a rectangle of 3 by 10.
TEST(Sections, WithoutOutstandingFlangesAreRectangles) {
  const SectionGeometry solid = flanged_section({10.0, 3.0, 3.0, 1.0, 0.0});
  EXPECT_NEAR(solid.area, 30.0, 1e-13);
  EXPECT_NEAR(solid.second_moment, 250.0, 1e-12);
}

/// Flanges on one side of the web, from its centre: half as many as in the test above, twice as long.
TEST(Sections, ShearAreaOfAChannelIsThatOfItsShearFlow) {
  FlangedSection section{200.0, 80.0, 6.0, 11.0, 13.0};
  section.channel = true;
  const double h = section.depth - section.flange;
  const double length = section.width - 0.5 * section.web;
  const double flange = length * section.flange;
  const double I = 0.5 * flange * h * h + section.web * h * h * h / 12.0;
  double energy = 0.0;
  const Quadrature gauss = gauss_legendre(6);
  for (std::size_t i = 0; i < gauss.points.size(); ++i) {
    const double y = 0.5 * h * gauss.points[i];
    const double in_web = (0.5 * flange * h + 0.5 * section.web * (0.25 * h * h - y * y)) / I;
    energy += h * gauss.weights[i] * in_web * in_web / section.web;
    const double from_tip = length * gauss.points[i];
    const double in_flange = 0.5 * section.flange * h * from_tip / I;
    energy += 2.0 * length * gauss.weights[i] * in_flange * in_flange / section.flange;
  }
  EXPECT_NEAR(flanged_section(section).shear_area, 1.0 / energy, 1e-9);
}

/// Thickness of a tapered flange at a distance x from the face of the web, from circles that touch its faces.
double thickness(const FlangedSection& s, double reach, double x) {
  const double lean = std::atan(s.slope);
  const auto line = [&](double at) { return s.flange + s.slope * (reach - s.flange_at - at); };
  if (x < s.root_radius * (1.0 - std::sin(lean)))
    return line(s.root_radius) + s.root_radius / std::cos(lean) -
           std::sqrt(s.root_radius * s.root_radius - (x - s.root_radius) * (x - s.root_radius));
  const double toe = reach - s.toe_radius;
  if (x > toe + s.toe_radius * std::sin(lean))
    return line(toe) - s.toe_radius / std::cos(lean) +
           std::sqrt(s.toe_radius * s.toe_radius - (x - toe) * (x - toe));
  return line(x);
}

/// Strips of the flanges along x, by the midpoint rule.
TEST(Sections, TaperedFlangesAreThoseOfTheirStrips) {
  for (const bool channel : {false, true}) {
    const FlangedSection s{300.0, 125.0, 10.8, 16.2, 10.8, channel, 0.14, 31.25, 6.5};
    const double reach = (s.width - s.web) / (channel ? 1.0 : 2.0);
    constexpr int kStrips = 40000;
    double area = 0.0;
    double moment = 0.0;
    for (int i = 0; i < kStrips; ++i) {
      const double inner = 150.0 - thickness(s, reach, reach * (i + 0.5) / kStrips);
      area += (150.0 - inner) * reach / kStrips;
      moment += (150.0 * 150.0 * 150.0 - inner * inner * inner) / 3.0 * reach / kStrips;
    }
    const double flanges = channel ? 2.0 : 4.0;
    const SectionGeometry found = flanged_section(s);
    EXPECT_NEAR(found.area, 300.0 * s.web + flanges * area, 1e-6 * found.area);
    EXPECT_NEAR(found.second_moment, s.web * 300.0 * 300.0 * 300.0 / 12.0 + flanges * moment,
                1e-6 * found.second_moment);
  }
}

}  // namespace
}  // namespace snapthrough
