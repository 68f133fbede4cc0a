/// p-y curves against the formulas of API RP 2GEO and Matlock, evaluated by hand and by a second way.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <random>
#include <sstream>
#include <string>

#include "api/convert/convert.h"
#include "api/soil/ultimate_resistance.h"
#include "tests/findings.h"

namespace snapthrough::api {
namespace {

using nlohmann::json;
using snapthrough::testing::is_finding;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::SizeIs;

/// Homogeneous sand with C1, C2 and C3 of phi = 30 degrees; the pile's head is at the surface.
json sand_document() {
  return json::parse(R"({
    "pile": {"member": "shaft", "diameter": 0.5, "length": 10},
    "layers": [{"type": "sand", "from": 0, "to": 10, "gamma": 10, "phi": 30, "k": 11000}],
    "loading": "static", "accuracy": 1e-4
  })");
}

/// Homogeneous clay with y50 = 2.5 x 0.01 x 1 = 0.025 and X_R = 6 / (8/20 + 0.5) = 20/3.
json clay_document() {
  return json::parse(R"({
    "pile": {"member": "shaft", "diameter": 1, "length": 20},
    "layers": [{"type": "soft_clay", "from": 0, "to": 20, "gamma": 8, "Su": 20, "eps50": 0.01, "J": 0.5}],
    "loading": "static", "accuracy": 1e-4
  })");
}

json converted(const json& document) {
  const Conversion conversion = convert_soil(document.dump());
  EXPECT_THAT(conversion.findings, IsEmpty());
  return conversion.document == nullptr ? json::object() : *conversion.document;
}

/// Returns the value of pairs [abscissa, value] by linear interpolation, constant outside.
double interpolated(const json& pairs, double at) {
  for (std::size_t i = 0; i + 1 < pairs.size(); ++i) {
    const double a = pairs[i][0];
    const double b = pairs[i + 1][0];
    if (at <= b) {
      const double fraction = std::clamp((at - a) / (b - a), 0.0, 1.0);
      return (1.0 - fraction) * pairs[i][1].get<double>() + fraction * pairs[i + 1][1].get<double>();
    }
  }
  return pairs.back()[1];
}

/// Returns the reaction of a law.
double reaction(const json& law, double fraction, double y) {
  const auto value = [&](const char* key) { return interpolated(law[key]["along"], fraction); };
  if (law["type"] == "tanh") {
    const double capacity = value("capacity");
    return capacity > 0.0 ? capacity * std::tanh(value("stiffness") * y / capacity) : 0.0;
  }
  EXPECT_EQ(law["type"], "power");
  const double part = std::pow(y / law["reference"].get<double>(), law["exponent"].get<double>());
  return std::min(value("capacity") * std::min(part, 1.0), value("stiffness") * y);
}

/// Returns the sum of the reactions of all foundations at a fraction of the pile.
double reaction_at(const json& parts, double fraction, double y) {
  double sum = 0.0;
  for (const json& foundation : parts.at("foundations")) {
    if (foundation["range"][0] <= fraction && fraction < foundation["range"][1]) {
      sum += reaction(foundation["law"], fraction, y);
    }
  }
  return sum;
}

// phi = 30 degrees: a = 15, b = 60, b - phi = 30 degrees; tan 15 = 2 - sqrt 3, cos 15 = (sqrt 6 + sqrt 2)/4.
//   C1 = 0.4 (1/sqrt 3)(sqrt 3/2) / ((1/sqrt 3) cos 15) + 3 (2 - sqrt 3) sqrt 3 + 0.4 sqrt 3 (1/2 - 2 + sqrt
//   3)
//      = 0.346410162 / 0.965925826 + 1.392304845 + 0.160769515 = 0.358630176 + 1.553074360 = 1.91170
//   C2 = sqrt 3 / (1/sqrt 3) - 1/3 = 8/3
//   C3 = (3^4 - 1)/3 + 0.4 (1/sqrt 3) 9 = 26.666666667 + 2.078460969 = 28.74513
TEST(SandCoefficients, AreThoseOfTheEquationsAtThirtyDegrees) {
  const soil::SandCoefficients found = soil::sand_coefficients(30.0);
  EXPECT_NEAR(found.C1, 1.911704550, 1e-8);
  EXPECT_NEAR(found.C2, 8.0 / 3.0, 1e-12);
  EXPECT_NEAR(found.C3, 28.745127636, 1e-8);
}

// phi = 20 degrees: a = 10, b = 55, b - phi = 35 degrees; tan^2 35 = 0.490291 = Ka, tan^2 55 = 2.039607.
//   C1 = 0.4 x 0.363970 x 0.819152 / (0.700208 x 0.984808) + 2.039607 x 0.176327 / 0.700208
//        + 0.4 x 1.428148 (0.363970 x 0.819152 - 0.176327) = 0.172946 + 0.513613 + 0.069591 = 0.756150
//   C2 = 1.428148 / 0.700208 - 0.490291 = 1.549314
//   C3 = 0.490291 (2.039607^4 - 1) + 0.4 x 0.363970 x 2.039607^2 = 7.994477 + 0.605646 = 8.600123
TEST(SandCoefficients, AreThoseOfTheEquationsAtTwentyDegrees) {
  const soil::SandCoefficients found = soil::sand_coefficients(20.0);
  EXPECT_NEAR(found.C1, 0.756150, 1e-5);
  EXPECT_NEAR(found.C2, 1.549314, 1e-5);
  EXPECT_NEAR(found.C3, 8.600123, 5e-5);
}

struct Curve {
  double X, y, p;
};

void expect_curves(const json& parts, double length, std::initializer_list<Curve> curves, double tolerance) {
  for (const Curve& curve : curves) {
    EXPECT_NEAR(reaction_at(parts, curve.X / length, curve.y), curve.p, tolerance * curve.p)
        << "X = " << curve.X << ", y = " << curve.y;
  }
}

// D = 0.5, C2 D = 1.333333, C3 D = 14.372564, s = 10 X, deep below (C3 - C2) D / C1 = 6.8207.
//   X    Pmax                                            A     A Pmax      k X y / (A Pmax)        tanh p 0.5
//   (0.955852 + 1.333333) 5 = 11.445928             2.2   25.181042   27.5/25.181042  1.092091
//   0.797640  20.08541 1    (1.911705 + 1.333333) 10 = 32.450378            1.4   45.430530
//   110/45.430530   2.421279  0.984350  44.71953 2    (3.823409 + 1.333333) 20 = 103.134849 0.9   92.821364
//   220/92.821364   2.370144  0.982679  91.21361 8    14.372564 x 80 = 1149.805105 (shallow 1330.2)   0.9
//   1034.824595 1760/1034.8246  1.700771  0.935505  968.08402
TEST(ConvertSoil, SandUnderStaticLoadsIsThatOfTheFormulas) {
  expect_curves(converted(sand_document()), 10.0,
                {{0.5, 0.005, 20.08541}, {1, 0.01, 44.71953}, {2, 0.01, 91.21361}, {8, 0.02, 968.08402}},
                1.1e-4);
}

// A = 0.9:  X = 0.5: 10.301335 tanh(27.5/10.301335 = 2.669557) = 10.301335 x 0.990446 = 10.20291
//           X = 1:   29.205341 tanh(110/29.205341 = 3.766434) = 29.205341 x 0.998930 = 29.17410
TEST(ConvertSoil, SandUnderCyclicLoadsHasTheFactorOfTheDepthEverywhere) {
  json document = sand_document();
  document["loading"] = "cyclic";
  expect_curves(converted(document), 10.0, {{0.5, 0.005, 10.20291}, {1, 0.01, 29.17410}, {2, 0.01, 91.21361}},
                1.1e-4);
}

TEST(ConvertSoil, SandTakesCoefficientsInPlaceOfTheFrictionAngle) {
  json document = sand_document();
  json& layer = document["layers"][0];
  layer.erase("phi");
  layer.update({{"C1", 1.911704550}, {"C2", 2.666666667}, {"C3", 28.745127636}});
  expect_curves(converted(document), 10.0, {{0.5, 0.005, 20.08541}, {8, 0.02, 968.08402}}, 1.1e-4);
}

// D = 1, y50 = 0.025, 9 Su D = 180:
//   X = 2:  Pmax = (3 x 20 + 16) 1 + 0.5 x 20 x 2 = 96.  y = y50/8 = 0.003125: 0.5 x 96 x 0.5 = 24.  y = 8
//   y50: 96. X = 10: (60 + 80) + 100 = 240 > 180: Pmax = 180.  y = 0.025: 90.  y = 0.1 = 4 y50: 90 x 4^(1/3)
//   = 142.86611. Below y = 0.1 y50 = 0.0025 a line: p(0.0025) = 0.5 x 0.1^(1/3) Pmax = 0.23207944 Pmax; X =
//   2, y = 0.00125: 96 x 0.23207944 / 2 = 11.139813.
TEST(ConvertSoil, ClayUnderStaticLoadsIsThatOfTheFormulas) {
  expect_curves(converted(clay_document()), 20.0,
                {{2, 0.003125, 24},
                 {2, 0.2, 96},
                 {2, 1, 96},
                 {2, 0.00125, 11.139813},
                 {10, 0.025, 90},
                 {10, 0.1, 142.86611}},
                1e-4);
}

// X_R = 20/3. Deep: 0.72 x 180 = 129.6 from 3 y50 = 0.075 on; at y = y50 0.5 x 180 = 90.
TEST(ConvertSoil, ClayUnderCyclicLoadsIsThatOfTheFormulasBelowTheTransition) {
  json document = clay_document();
  document["loading"] = "cyclic";
  document["accuracy"] = 1e-3;
  expect_curves(converted(document), 20.0, {{10, 0.075, 129.6}, {10, 0.5, 129.6}, {10, 0.025, 90}}, 1e-4);
}

// Shallow, p stays below what cycles leave: 0.72 X/X_R Pmax. At X = 2: 0.216 x 96 = 20.736; at X = 5: Pmax =
// 60 + 40 + 50 = 150, 0.54 x 150 = 81; on the way there 0.5 x 150 = 75 at y50 and 37.5 at y50/8. Curves are
// within `accuracy` of Pmax.
TEST(ConvertSoil, ClayUnderCyclicLoadsLosesResistanceAboveTheTransition) {
  json document = clay_document();
  document["loading"] = "cyclic";
  document["accuracy"] = 1e-3;
  const json parts = converted(document);
  struct Row {
    double X, y, p, Pmax;
  };
  for (const Row& row : {Row{2, 0.2, 20.736, 96}, Row{5, 1, 81, 150}, Row{5, 0.025, 75, 150},
                         Row{5, 0.003125, 37.5, 150}, Row{2, 0.0001, 0.89118506, 96}}) {
    EXPECT_NEAR(reaction_at(parts, row.X / 20, row.y), row.p, 1e-3 * row.Pmax) << row.X << ' ' << row.y;
  }
}

/// Returns Matlock's cyclic curve, or the largest curve below it that does not fall.
double cyclic_clay(double X, double y) {
  const double Pmax = std::min(60.0 + 8.0 * X + 10.0 * X, 180.0);
  const double curve = y < 0.0025 ? y / 0.0025 * 0.5 * std::cbrt(0.1) : 0.5 * std::cbrt(y / 0.025);
  return Pmax * std::min(curve, 0.72 * std::min(1.0, X / (20.0 / 3.0)));
}

TEST(ConvertSoil, CyclicCurvesBetweenDepthsKeepTheAccuracy) {
  for (const double accuracy : {0.05, 0.01}) {
    json document = clay_document();
    document["loading"] = "cyclic";
    document["accuracy"] = accuracy;
    const json parts = converted(document);
    EXPECT_LT(parts["foundations"].size(), 0.4 / accuracy + 8.0);
    double largest = 0.0;
    for (double X = 0.01; X < 20.0; X += 0.037) {
      for (double y = 1e-5; y < 0.3; y *= 1.3) {
        const double exact = cyclic_clay(X, y);
        const double error = std::abs(reaction_at(parts, X / 20.0, y) - exact);
        largest = std::max(largest, error / std::min(60.0 + 18.0 * X, 180.0));
      }
    }
    EXPECT_LT(largest, accuracy);
    EXPECT_GT(largest, 0.5 * accuracy) << "there are more curves than the accuracy needs";
  }
}

/// Returns A Pmax of sand_document() at a depth, by the formulas as they stand.
double sand_capacity(double X) {
  const double s = 10.0 * X;
  return std::max(0.9, 3.0 - 0.8 * X / 0.5) *
         std::min((1.911704550 * X + 2.666666667 * 0.5) * s, 28.745127636 * 0.5 * s);
}

TEST(ConvertSoil, CapacityBetweenBreakPointsKeepsTheAccuracyAtEveryDepth) {
  for (const double accuracy : {0.1, 0.01, 1e-3}) {
    json document = sand_document();
    document["accuracy"] = accuracy;
    const json capacity = converted(document)["foundations"][0]["law"]["capacity"]["along"];
    EXPECT_LT(static_cast<double>(capacity.size()), 5.0 + 2.5 / std::sqrt(accuracy));
    double largest = 0.0;
    for (double X = 1e-6; X < 10.0; X = X * 1.01 + 1e-6) {
      const double exact = sand_capacity(X);
      largest = std::max(largest, std::abs(interpolated(capacity, X / 10.0) - exact) / exact);
    }
    EXPECT_LT(largest, accuracy * (1.0 + 1e-6));
    EXPECT_GT(largest, 0.5 * accuracy) << "there are more break points than the accuracy needs";
  }
}

// Strength 10 + 2 X, J = 0.5, D = 1, s = 8 X: (8 X - 6 (10 + 2 X)) + 0.5 (10 + 2 X) X = X^2 + X - 60 = 0 at
// X_R = (sqrt 241 - 1)/2 = 7.26209. At X = 5: Pmax = 3 x 20 + 40 + 0.5 x 20 x 5 = 150; at X = 9: 9 x 28 =
// 252.
TEST(ConvertSoil, StrengthOfClayGrowsLinearly) {
  json document = clay_document();
  document["layers"][0]["Su"] = {10, 50};
  expect_curves(converted(document), 20.0, {{5, 1, 150}, {9, 1, 252}}, 1e-4);
  const soil::SoftClay clay{10.0, 50.0, 0.01, 0.5};
  const soil::Layer layer{0.0, 20.0, 8.0, clay};
  EXPECT_NEAR(soil::transition_depth(clay, layer, 1.0, soil::Cubic({0.0, 8.0, 0.0, 0.0})), 7.262087348, 1e-9);
}

// The formula of homogeneous soil, also where the layer ends above X_R.
TEST(TransitionDepth, OfHomogeneousSoilIsThatOfTheStandard) {
  for (const double thickness : {1.0, 30.0}) {
    for (const double Su : {5.0, 20.0, 100.0}) {
      const soil::SoftClay clay{Su, Su, 0.01, 0.25};
      const soil::Layer layer{0.0, thickness, 8.0, clay};
      EXPECT_NEAR(soil::transition_depth(clay, layer, 1.2, soil::Cubic({0.0, 8.0, 0.0, 0.0})),
                  6.0 * 1.2 / (8.0 * 1.2 / Su + 0.25), 1e-10);
    }
  }
}

// Clay of 4 with gamma 8 above sand of gamma 10, D = 1, phi = 30 degrees: at X = 6 s = 32 + 20 = 52, A = 0.9,
// Pmax = (1.911705 x 6 + 2.666667) 52 = 735.118486 (deep 28.745 x 52 = 1494.7), A Pmax = 661.606637;
// k X y = 11000 x 6 x 0.01 = 660: p = 661.606637 tanh(0.997572) = 661.606637 x 0.760572 = 503.19975.
TEST(ConvertSoil, StressOfAllLayersAboveCounts) {
  json document = clay_document();
  document["layers"][0]["to"] = 4;
  document["layers"].push_back(
      {{"type", "sand"}, {"from", 4}, {"to", 20}, {"gamma", 10}, {"phi", 30}, {"k", 11000}});
  const json parts = converted(document);
  ASSERT_THAT(parts["foundations"], SizeIs(2));
  EXPECT_EQ(parts["foundations"][0]["range"], json({0.0, 0.2}));
  EXPECT_EQ(parts["foundations"][1]["range"], json({0.2, 1.0}));
  expect_curves(parts, 20.0, {{6, 0.01, 503.19975}}, 1e-4);
}

TEST(ConvertSoil, FoundationsLieWhereThePileTouchesGround) {
  json document = sand_document();
  document["pile"]["head_depth"] = -2;
  document["pile"]["head"] = "end";
  const json above = converted(document);
  EXPECT_EQ(above["foundations"][0]["range"], json({0.0, 0.8}));
  // X = 2 is at 4 from the head, thus at the fraction 1 - 0.4
  EXPECT_NEAR(reaction_at(above, 0.6, 0.01), 91.21361, 0.01);
  document["pile"]["head_depth"] = 1;
  document["layers"][0]["to"] = 11;
  const json below = converted(document);
  EXPECT_EQ(below["foundations"][0]["range"], json({0.0, 1.0}));
  EXPECT_NEAR(reaction_at(below, 0.9, 0.01), 91.21361, 0.01);
}

/// Returns a random document of static loads: clay and sand in turn, thin and thick layers.
json random_document(std::mt19937& random) {
  const auto between = [&random](double lo, double hi) {
    return std::uniform_real_distribution<double>(lo, hi)(random);
  };
  json layers = json::array();
  double from = 0.0;
  for (int i = 0; i < 5; ++i) {
    json layer{{"from", from}, {"to", from + std::exp(between(-2, 2))}, {"gamma", between(5, 12)}};
    if (random() % 2 == 0) {
      layer.update({{"type", "sand"}, {"phi", between(20, 45)}, {"k", between(1e3, 5e4)}});
    } else {
      const double top = random() % 4 == 0 ? 0.0 : between(1, 60);
      layer.update({{"type", "soft_clay"},
                    {"Su", {top, random() % 4 == 0 && top > 0 ? 0.0 : between(1, 60)}},
                    {"eps50", between(0.005, 0.03)},
                    {"J", between(0.25, 0.5)}});
    }
    from = layer["to"];
    layers.push_back(layer);
  }
  const double head = between(-2, 0.5);
  return {{"pile",
           {{"member", "m"},
            {"diameter", between(0.1, 3)},
            {"head_depth", head},
            {"length", 0.99 * from - head}}},
          {"layers", layers},
          {"loading", "static"},
          {"accuracy", 0.01}};
}

/// Returns p of a document of static loads by the formulas as they stand, at a depth inside a layer.
double static_reaction(const json& document, double X, double y) {
  const double D = document["pile"]["diameter"];
  double s = 0.0;
  for (const json& layer : document["layers"]) {
    const double from = layer["from"], to = layer["to"];
    if (X > to) {
      s += layer["gamma"].get<double>() * (to - from);
      continue;
    }
    s += layer["gamma"].get<double>() * (X - from);
    if (layer["type"] == "sand") {
      const soil::SandCoefficients C = soil::sand_coefficients(layer["phi"]);
      const double capacity =
          std::max(0.9, 3.0 - 0.8 * X / D) * std::min((C.C1 * X + C.C2 * D) * s, C.C3 * D * s);
      return capacity * std::tanh(layer["k"].get<double>() * X * y / capacity);
    }
    const double top = layer["Su"][0], bottom = layer["Su"][1];
    const double Su = top + (bottom - top) * (X - from) / (to - from);
    const double Pmax = std::min((3.0 * Su + s) * D + layer["J"].get<double>() * Su * X, 9.0 * Su * D);
    const double t = y / (2.5 * layer["eps50"].get<double>() * D);
    return Pmax * std::min({1.0, 0.5 * std::cbrt(t), 0.5 * std::cbrt(0.1) / 0.1 * t});
  }
  return 0.0;
}

TEST(ConvertSoil, RandomLayersKeepTheAccuracyEverywhere) {
  std::mt19937 random(50);
  for (int i = 0; i < 200; ++i) {
    const json document = random_document(random);
    const json parts = converted(document);
    const double head = document["pile"]["head_depth"], length = document["pile"]["length"];
    for (int j = 0; j < 200; ++j) {
      const double fraction =
          std::uniform_real_distribution<double>(std::max(0.0, -head / length), 1.0)(random);
      const double X = head + fraction * length;
      const double y = std::pow(10.0, std::uniform_real_distribution<double>(-5.0, 0.0)(random));
      const double exact = static_reaction(document, X, y);
      EXPECT_NEAR(reaction_at(parts, fraction, y), exact, 0.01 * exact + 1e-9) << document << X << ' ' << y;
    }
    for (const json& foundation : parts["foundations"]) {
      for (const json& pair : foundation["law"]["capacity"]["along"]) {
        EXPECT_GE(pair[1], 0.0) << document;
      }
    }
  }
}

// 0.1 + 0.2 is greater than 0.3 by rounding, also where another layer begins there.
TEST(ConvertSoil, LayersReachTheTipToRounding) {
  json document = sand_document();
  document["pile"].update({{"head_depth", 0.1}, {"length", 0.2}});
  document["layers"][0]["to"] = 0.3;
  EXPECT_THAT(converted(document)["foundations"], SizeIs(1));
  document["layers"].push_back(document["layers"][0]);
  document["layers"][1].update({{"from", 0.3}, {"to", 5}});
  EXPECT_THAT(converted(document)["foundations"], SizeIs(1));
}

TEST(ConvertSoil, UnitsAndNamesAreCarriedOver) {
  json document = sand_document();
  document["units"] = {{"length", "m"}};
  const json parts = converted(document);
  EXPECT_EQ(parts["units"], document["units"]);
  EXPECT_EQ(parts["foundations"][0]["id"], "shaft layer 1");
  EXPECT_EQ(parts["foundations"][0]["member"], "shaft");
}

// Every number of a law depends on the unit of force or length by a power: the formulas have no hidden units.
TEST(ConvertSoil, FormulasHoldInAnyConsistentUnits) {
  json document = sand_document();
  const json parts = converted(document);
  document["pile"].update({{"diameter", 0.5e3}, {"length", 10e3}});
  document["layers"][0].update(
      {{"to", 10e3}, {"gamma", 10e-6}, {"k", 11000e-6}});  // N and mm in place of kN and m
  const json scaled = converted(document);
  EXPECT_NEAR(reaction_at(scaled, 0.2, 10.0), reaction_at(parts, 0.2, 0.01), 1e-9);
}

struct Mistake {
  const char* name;
  const char* patch;  ///< merge patch of clay_document()
  const char* pointer;
  const char* code;
};
void PrintTo(const Mistake& mistake, std::ostream* out) { *out << mistake.name; }

class ConvertSoilRefuses : public ::testing::TestWithParam<Mistake> {};

TEST_P(ConvertSoilRefuses, ByPointerAndRule) {
  json document = clay_document();
  document.merge_patch(json::parse(GetParam().patch));
  const Conversion conversion = convert_soil(document.dump());
  EXPECT_EQ(conversion.document, nullptr);
  EXPECT_THAT(conversion.findings, ElementsAre(is_finding(GetParam().pointer, GetParam().code)));
}

constexpr const char* kLayer = R"("from": 0, "to": 20, "gamma": 8)";

const std::string kTwoLayers =
    std::string(R"({"layers": [{"type": "sand", "phi": 30, "k": 1, )") + kLayer +
    R"(}, {"type": "sand", "phi": 30, "k": 1, "from": 21, "to": 30, "gamma": 8}]})";
const std::string kNegativeStrength =
    std::string(R"({"layers": [{"type": "soft_clay", "Su": [-1, 5], "eps50": 0.1, "J": 0.5, )") + kLayer +
    "}]}";
const std::string kNoStrength =
    std::string(R"({"layers": [{"type": "soft_clay", "Su": 0, "eps50": 0.1, "J": 0.5, )") + kLayer + "}]}";
const std::string kLargeStrain =
    std::string(R"({"layers": [{"type": "soft_clay", "Su": 5, "eps50": 2, "J": 0.5, )") + kLayer + "}]}";
const std::string kNoAngle = std::string(R"({"layers": [{"type": "sand", "k": 1, )") + kLayer + "}]}";
const std::string kTwoForms =
    std::string(R"({"layers": [{"type": "sand", "phi": 30, "C1": 1, "k": 1, )") + kLayer + "}]}";
const std::string kLargeAngle =
    std::string(R"({"layers": [{"type": "sand", "phi": 46, "k": 1, )") + kLayer + "}]}";
const std::string kNoCoefficient =
    std::string(R"({"layers": [{"type": "sand", "C1": 1, "C3": 3, "k": 1, )") + kLayer + "}]}";
const std::string kHugeModulus =
    std::string(R"({"layers": [{"type": "sand", "phi": 30, "k": 1e150, )") + kLayer + "}]}";
const std::string kUnknownSoil = std::string(R"({"layers": [{"type": "peat", )") + kLayer + "}]}";

INSTANTIATE_TEST_SUITE_P(
    Documents, ConvertSoilRefuses,
    ::testing::Values(
        Mistake{"no_pile", R"({"pile": null})", "/pile", "missing_field"},
        Mistake{"diameter", R"({"pile": {"diameter": 0}})", "/pile/diameter", "out_of_range"},
        Mistake{"length", R"({"pile": {"length": "long"}})", "/pile/length", "wrong_type"},
        Mistake{"head", R"({"pile": {"head": "top"}})", "/pile/head", "unknown_value"},
        Mistake{"pile in the air", R"({"pile": {"head_depth": -20}})", "/pile/head_depth", "out_of_range"},
        Mistake{"member", R"({"pile": {"member": "a\u0001"}})", "/pile/member", "bad_id"},
        Mistake{"unknown field", R"({"pile": {"widht": 1}})", "/pile/widht", "unknown_field"},
        Mistake{"loading", R"({"loading": "dynamic"})", "/loading", "unknown_value"},
        Mistake{"accuracy", R"({"accuracy": 1e-5})", "/accuracy", "out_of_range"},
        Mistake{"no layers", R"({"layers": []})", "/layers", "out_of_range"},
        Mistake{"tip below layers", R"({"pile": {"head_depth": 1}})", "/layers/0/to", "out_of_range"},
        Mistake{"gap between layers", kTwoLayers.c_str(), "/layers/1/from", "out_of_range"},
        Mistake{"negative strength", kNegativeStrength.c_str(), "/layers/0/Su", "out_of_range"},
        Mistake{"no strength", kNoStrength.c_str(), "/layers/0/Su", "out_of_range"},
        Mistake{"eps50", kLargeStrain.c_str(), "/layers/0/eps50", "out_of_range"},
        Mistake{"sand without angle", kNoAngle.c_str(), "/layers/0", "missing_field"},
        Mistake{"sand by two forms", kTwoForms.c_str(), "/layers/0", "ambiguous"},
        Mistake{"phi", kLargeAngle.c_str(), "/layers/0/phi", "out_of_range"},
        Mistake{"C2", kNoCoefficient.c_str(), "/layers/0/C2", "missing_field"},
        Mistake{"huge stiffness", kHugeModulus.c_str(), "/layers/0", "out_of_range"},
        Mistake{"type", kUnknownSoil.c_str(), "/layers/0/type", "unknown_value"}),
    [](const auto& mistake) {
      std::string name = mistake.param.name;
      std::replace(name.begin(), name.end(), ' ', '_');
      return name;
    });

TEST(ConvertSoil, TextThatIsNoJsonIsMalformed) {
  EXPECT_THAT(convert_soil("{").findings, Contains(::testing::Field(&Finding::code, "malformed")));
}

// Coefficients so far apart that break points for them would fall together.
TEST(ConvertSoil, AccuracyThatCannotBeMetIsReported) {
  json document = sand_document();
  json& layer = document["layers"][0];
  layer.erase("phi");
  layer.update({{"C1", 1.0}, {"C2", 1e-30}, {"C3", 100.0}});
  EXPECT_THAT(convert_soil(document.dump()).findings, ElementsAre(is_finding("/layers/0", "out_of_range")));
}

// Cyclic clay needs 0.18/accuracy = 1800 curves above the transition depth.
TEST(ConvertSoil, MoreBreakPointsThanALayerMayHaveAreReported) {
  json document = clay_document();
  document["loading"] = "cyclic";
  EXPECT_THAT(convert_soil(document.dump()).findings, ElementsAre(is_finding("/layers/0", "out_of_range")));
}

TEST(ConvertSoil, ExampleIsConverted) {
  std::ifstream file(std::string(SNAPTHROUGH_SOURCE_DIR) + "/examples/convert/pile_soil.json");
  std::ostringstream text;
  text << file.rdbuf();
  EXPECT_THAT(converted(json::parse(text.str()))["foundations"], SizeIs(2));
}

}  // namespace
}  // namespace snapthrough::api
