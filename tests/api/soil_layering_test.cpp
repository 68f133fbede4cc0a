/// Equivalent depths of layered soil: closed forms, an own quadrature, and what they leave alone.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "api/list_foundations.h"
#include "api/read_soils.h"
#include "api/soil/equivalent_depth.h"
#include "api/soil/ultimate_resistance.h"
#include "tests/api/straight_lines.h"
#include "tests/findings.h"

namespace snapthrough::api {
namespace {

using nlohmann::json;
using snapthrough::testing::interpolated;
using snapthrough::testing::is_finding;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

/// Clay with 3 Su D = 60, (gamma D + J Su) = 18 per depth and 9 Su D = 180 for D = 1.
constexpr const char* kSoft = R"({"type": "soft_clay", "unit_weight": 8, "Su": 20, "eps50": 0.01, "J": 0.5})";
/// Clay with 3 Su D = 150, (gamma D + J Su) = 35 per depth and 9 Su D = 450 for D = 1.
constexpr const char* kStiff =
    R"({"type": "soft_clay", "unit_weight": 10, "Su": 50, "eps50": 0.01, "J": 0.5})";
constexpr const char* kSand =
    R"({"type": "api_sand", "unit_weight": 9, "C1": 2, "C2": 3, "C3": 30, "k": 2e4})";

/// A vertical pile of diameter 1 and length 20 from the surface, in layers that end at given depths.
json model_in(const std::vector<std::pair<double, const char*>>& layers) {
  json model = json::parse(R"({
    "nodes": [{"id": "head", "x": 0, "y": 0}, {"id": "tip", "x": 0, "y": -20}],
    "sections": [], "members": [{"id": "pile", "start": "head", "end": "tip", "section": "s"}],
    "soils": [{"id": "site", "loading": "static", "layering": "georgiadis", "accuracy": 1e-4}],
    "foundations": [{"id": "f", "member": "pile", "soil": "site", "diameter": 1}]
  })");
  double above = 0.0;
  for (const auto& [bottom, fields] : layers) {
    json layer = json::parse(fields);
    layer.update({{"top", above}, {"bottom", bottom}});
    model["soils"][0]["layers"].push_back(std::move(layer));
    above = bottom;
  }
  return model;
}

json& soil_of(json& model) { return model["soils"][0]; }

json foundations_of(const json& model) {
  Report report;
  json out = json::array();
  for (ListedSupport& one : list_foundations(Value(model, PointerPath("/model"), report)).foundations) {
    out.push_back(std::move(one.made));
  }
  EXPECT_THAT(report.findings(), IsEmpty());
  return out;
}

/// Returns the largest force of the points of a table.
double peak_of(const json& points) {
  double found = 0.0;
  for (const json& point : points) {
    found = std::max(found, point[1].get<double>());
  }
  return found;
}

/// Returns the sum of the largest lateral forces per length at a depth.
double capacity_at(const json& model, double depth) {
  const double fraction = depth / 20.0;
  double sum = 0.0;
  for (const json& one : foundations_of(model)) {
    if (!one.contains("component") && one["range"][0] <= fraction && fraction < one["range"][1]) {
      const json& law = one["law"];
      sum += law["type"] == "table" ? interpolated(law["factor"]["along"], fraction) * peak_of(law["points"])
                                    : interpolated(law["capacity"]["along"], fraction);
    }
  }
  return sum;
}

/// Returns the integral of a function from a to b by the midpoint rule.
double integrated(const std::function<double(double)>& value, double a, double b) {
  constexpr int kParts = 400'000;
  double sum = 0.0;
  for (int i = 0; i < kParts; ++i) {
    sum += value(a + (b - a) * (i + 0.5) / kParts);
  }
  return sum * (b - a) / kParts;
}

/// Returns the depth to which the integral of a resistance is a force, by bisection.
double depth_of(const std::function<double(double)>& value, double force) {
  double low = 0.0, high = 100.0;
  for (int i = 0; i < 45; ++i) {
    const double middle = 0.5 * (low + high);
    (integrated(value, 0.0, middle) < force ? low : high) = middle;
  }
  return low;
}

/// A Pmax of kSand for D = 1.
double sand_resistance(double X) {
  return std::max(0.9, 3.0 - 0.8 * X) * std::min(2.0 * X + 3.0, 30.0) * 9.0 * X;
}
double soft_resistance(double X) { return std::min(60.0 + 18.0 * X, 180.0); }

// F = 60 * 4 + 9 * 4^2 = 384 and 150 h + 17.5 h^2 = F.
const double kStiffTop = (std::sqrt(150.0 * 150.0 + 70.0 * 384.0) - 150.0) / 35.0;

TEST(SoilLayering, StrongClayBeneathSoftClayIsShallower) {
  const json model = model_in({{4, kSoft}, {20, kStiff}});
  EXPECT_NEAR(capacity_at(model, 3.0), 114.0, 1e-9);
  EXPECT_NEAR(capacity_at(model, 4.0), 150.0 + 35.0 * kStiffTop, 1e-8);
  EXPECT_NEAR(capacity_at(model, 6.0), 150.0 + 35.0 * (kStiffTop + 2.0), 1e-8);
  json plain = model;
  soil_of(plain).erase("layering");
  EXPECT_NEAR(capacity_at(plain, 6.0), 150.0 + 52.0 + 150.0, 1e-8);  // s = 4 * 8 + 2 * 10
}

// F = 150 * 4 + 17.5 * 4^2 = 880; the soft clay alone has 800 down to its deep mechanism at 20/3, so that
// h = 20/3 + 80/180.
TEST(SoilLayering, SoftClayBeneathStrongClayIsDeep) {
  const json model = model_in({{4, kStiff}, {20, kSoft}});
  EXPECT_NEAR(capacity_at(model, 4.0), 180.0, 1e-8);
  EXPECT_NEAR(capacity_at(model, 4.5), 180.0, 1e-8);
}

// The third layer carries the first with the second at its own equivalent depths: F = 384 + 300 + 17.5 * 2 *
// (2 h + 2), and 60 h + 9 h^2 = F above the depth 20/3, where it is 800.
TEST(SoilLayering, ResistanceAboveIsThatAtEquivalentDepths) {
  const json model = model_in({{4, kSoft}, {5, kStiff}, {20, kSoft}});
  const double force = 384.0 + 150.0 + 17.5 * (2.0 * kStiffTop + 1.0);
  const double top = (std::sqrt(3600.0 + 36.0 * force) - 60.0) / 18.0;
  ASSERT_LT(top, 20.0 / 3.0 - 0.25);
  EXPECT_NEAR(capacity_at(model, 5.25), 60.0 + 18.0 * (top + 0.25), 1e-8);
}

// The strength at the upper face counts for the equivalent depth, and the own one beneath: Su = 54 at 6.
TEST(SoilLayering, StrengthThatVariesCountsByItsUpperFace) {
  const json model = model_in(
      {{4, kSoft},
       {20, R"({"type": "soft_clay", "unit_weight": 10, "Su": [50, 82], "eps50": 0.01, "J": 0.5})"}});
  const double exact = 3.0 * 54.0 + (10.0 + 27.0) * (kStiffTop + 2.0);
  EXPECT_NEAR(capacity_at(model, 6.0), exact, 1e-4 * exact);
}

// X_R = 300/35 is the depth of transition of the stiff clay alone.
TEST(SoilLayering, CyclicClayFallsByItsEquivalentDepth) {
  json model = model_in({{4, kSoft}, {20, kStiff}});
  soil_of(model).update({{"loading", "cyclic"}, {"accuracy", 1e-3}});
  const double X = kStiffTop + 2.0;
  const double exact = 0.72 * X * 35.0 / 300.0 * (150.0 + 35.0 * X);
  EXPECT_NEAR(capacity_at(model, 6.0), exact, 1e-3 * exact);
}

TEST(SoilLayering, SandOverClayIsThatOfAQuadrature) {
  const json model = model_in({{5, kSand}, {20, kSoft}});
  EXPECT_NEAR(capacity_at(model, 3.0), sand_resistance(3.0), 1e-4 * sand_resistance(3.0));
  const json shallow = model_in({{1, kSand}, {20, kSoft}});
  const double top = depth_of(soft_resistance, integrated(sand_resistance, 0.0, 1.0));
  ASSERT_LT(top, 2.0);
  EXPECT_NEAR(capacity_at(shallow, 2.5), soft_resistance(top + 1.5), 1e-7);
}

TEST(SoilLayering, ClayOverSandIsThatOfAQuadrature) {
  const json model = model_in({{4, kSoft}, {20, kSand}});
  const double top = depth_of(sand_resistance, integrated(soft_resistance, 0.0, 4.0));
  for (const double depth : {4.0, 5.0, 8.0, 19.0}) {
    const double exact = sand_resistance(top + depth - 4.0);
    EXPECT_NEAR(capacity_at(model, depth), exact, 1.1e-4 * exact) << depth;
  }
  for (const json& one : foundations_of(model)) {
    if (one["id"] == "f layer 2") {  // k X with the equivalent depth
      EXPECT_NEAR(interpolated(one["law"]["stiffness"]["along"], 0.5), 2e4 * (top + 6.0), 0.01);
    }
  }
}

// Below the water table at 2: F = 120 + 28 * 2 = 176 with 18 per depth cubed above it, 60 h + 9 h^2 = F.
TEST(SoilLayering, WaterTableIsAnInterface) {
  json model = model_in({{20, kSoft}});
  soil_of(model).update({{"water_table", 2}, {"water_unit_weight", 10}});
  soil_of(model)["layers"][0]["unit_weight"] = 18;
  const double top = (std::sqrt(3600.0 + 36.0 * 176.0) - 60.0) / 18.0;
  EXPECT_NEAR(capacity_at(model, 4.0), 60.0 + 18.0 * (top + 2.0), 1e-8);
}

// Soil of the depths below 1 is the whole ground; local scour takes reactions alone.
TEST(SoilLayering, GeneralScourCountsAndLocalScourDoesNot) {
  json model = model_in({{5, kSoft}, {20, kStiff}});
  soil_of(model)["scour"] = {{"general", 1}, {"local", 0.5}};
  EXPECT_NEAR(capacity_at(model, 7.0), 150.0 + 35.0 * (kStiffTop + 2.0), 1e-8);
  EXPECT_EQ(capacity_at(model, 1.25), 0.0);
}

TEST(SoilLayering, AxialCurvesKeepTheirDepthsAndStresses) {
  json model = model_in({{4, kSoft}, {20, kStiff}});
  for (json& layer : soil_of(model)["layers"]) {
    layer["axial"] = {{"type", "api_tz_clay"}, {"residual", 0.8}};
  }
  const auto axial = [](const json& made) {
    json out = json::array();
    std::copy_if(made.begin(), made.end(), std::back_inserter(out),
                 [](const json& one) { return one.contains("component"); });
    return out;
  };
  const json found = axial(foundations_of(model));
  soil_of(model)["layering"] = "none";
  EXPECT_FALSE(found.empty());
  EXPECT_EQ(found, axial(foundations_of(model)));
}

TEST(SoilLayering, RockAndLiquefiedSandAndLayersBeneathKeepTheirDepths) {
  for (const char* own : {R"({"type": "weak_rock", "unit_weight": 12, "q_u": 2e3, "E_ir": 5e5, "RQD": 50,
                              "k_rm": 5e-4})",
                          R"({"type": "liquefied_sand", "unit_weight": 9, "metre": 1, "kilonewton": 1})"}) {
    json model = model_in({{3, kSoft}, {5, kStiff}, {8, own}, {20, kStiff}});
    soil_of(model)["accuracy"] = 0.01;
    json plain = model;
    soil_of(plain)["layering"] = "none";
    EXPECT_GT(std::abs(capacity_at(model, 4.0) - capacity_at(plain, 4.0)), 1.0);
    const json made = foundations_of(model), made_plain = foundations_of(plain);
    ASSERT_EQ(made.size(), made_plain.size());
    for (std::size_t i = 0; i < made.size(); ++i) {
      if (made[i]["range"][1] > 0.26) {
        EXPECT_EQ(made[i], made_plain[i]);
      }
    }
  }
}

/// Returns the first layer of a model's soil.
soil::Layer layer_of(const json& model) {
  Report report;
  return read_soils(Value(model.at("soils"), PointerPath("/soils"), report)).at(0).profile().layers.at(0);
}

struct Type {
  const char* name;
  const char* fields;
};
void PrintTo(const Type& type, std::ostream* out) { *out << type.name; }

class SoilLayeringOfOneSoil : public ::testing::TestWithParam<Type> {};

// A layer that is divided has the reactions of the whole one, within the accuracy of both.
TEST_P(SoilLayeringOfOneSoil, IsThatWithoutLayers) {
  const char* fields = GetParam().fields;
  for (const char* loading : {"static", "cyclic"}) {
    json divided = model_in({{0.7, fields}, {3, fields}, {9, fields}, {20, fields}});
    json whole = model_in({{20, fields}});
    for (json* model : {&divided, &whole}) {
      soil_of(*model).update({{"loading", loading}, {"accuracy", 0.005}});
    }
    soil_of(whole)["layering"] = "none";
    for (const double depth : {0.5, 0.8, 2.0, 3.5, 8.0, 12.0, 19.0}) {
      const double exact = capacity_at(whole, depth);
      EXPECT_NEAR(capacity_at(divided, depth), exact, 0.01 * exact) << loading << " " << depth;
    }
  }
}

// The equivalent depth of each part is its own depth, but for the error of integrals.
TEST_P(SoilLayeringOfOneSoil, HasItsOwnDepths) {
  const json model = model_in({{20, GetParam().fields}});
  for (const soil::Loading loading : {soil::Loading::static_, soil::Loading::cyclic}) {
    soil::EquivalentDepths depths(1.0, loading, 1e6);
    for (const auto& [from, to] : {std::pair(0.0, 0.7), {0.7, 3.0}, {3.0, 9.0}, {9.0, 20.0}}) {
      soil::Layer layer = layer_of(model);
      layer.from = from;
      layer.to = to;
      EXPECT_NEAR(depths.next(layer).value(), from, 1e-10 * from);
    }
  }
}

struct Above {
  const char* name;
  const char* fields;
  std::function<double(double)> resistance;  ///< of the formula, for D = 1
};
void PrintTo(const Above& above, std::ostream* out) { *out << above.name; }

class SoilLayeringBeneath : public ::testing::TestWithParam<Above> {};

// Half a diameter of a soil above clay, in which 60 h + 9 h^2 = F above the depth 20/3.
TEST_P(SoilLayeringBeneath, ResistanceIsThatOfTheFormula) {
  soil::EquivalentDepths depths(1.0, soil::Loading::static_, 1e6);
  const double force = integrated(GetParam().resistance, 0.0, 0.5);
  ASSERT_LT(force, 800.0);
  soil::Layer above = layer_of(model_in({{0.5, GetParam().fields}}));
  soil::Layer clay = layer_of(model_in({{20, kSoft}}));
  EXPECT_EQ(depths.next(above).value(), 0.0);
  const double exact = (std::sqrt(3600.0 + 36.0 * force) - 60.0) / 18.0;
  EXPECT_NEAR(depths.next(clay).value(), exact, 1e-9 * exact);
}

/// ps of sand of 35 degrees and a unit weight of 10, with A of the figures for static loads near the surface.
double reese_resistance(double X) {
  const auto [C1, C2, C3] = soil::sand_coefficients(35.0);
  return (2.90 - 0.72 * X) * std::min(C1 * X + C2, C3) * 10.0 * X;
}

INSTANTIATE_TEST_SUITE_P(
    Types, SoilLayeringBeneath,
    ::testing::Values(
        Above{"api_sand", kSand, sand_resistance},
        Above{"soft_clay_matlock",
              R"({"type": "soft_clay_matlock", "unit_weight": 8, "Su": [20, 60], "eps50": 0.01, "J": 0.5})",
              [](double X) {
                const double Su = 20.0 + 80.0 * X;
                return std::min(3.0 * Su + 8.0 * X + 0.5 * Su * X, 9.0 * Su);
              }},
        Above{"stiff_clay",
              R"({"type": "stiff_clay", "unit_weight": 9, "Su": [80, 100], "eps50": 0.005, "J": 0.5})",
              [](double X) {
                const double mean = 80.0 + 20.0 * X;
                return std::min(3.0 * mean + 9.0 * X + 0.5 * mean * X, 9.0 * (80.0 + 40.0 * X));
              }},
        Above{
            "stiff_clay_free_water",
            R"({"type": "stiff_clay_free_water", "unit_weight": 9, "Su": [80, 10], "eps50": 0.005, "k": 1e5})",
            [](double X) {
              const double mean = 80.0 - 70.0 * X;
              return std::min(2.0 * mean + 9.0 * X + 2.83 * mean * X, 11.0 * (80.0 - 140.0 * X));
            }},
        Above{"reese_sand", R"({"type": "reese_sand", "unit_weight": 10, "phi": 35, "k": 2e4})",
              reese_resistance}),
    [](const auto& above) { return std::string(above.param.name); });

INSTANTIATE_TEST_SUITE_P(
    Types, SoilLayeringOfOneSoil,
    ::testing::Values(
        Type{"soft_clay", kSoft}, Type{"api_sand", kSand},
        Type{"soft_clay_matlock",
             R"({"type": "soft_clay_matlock", "unit_weight": 8, "Su": 20, "eps50": 0.01, "J": 0.5})"},
        Type{"stiff_clay", R"({"type": "stiff_clay", "unit_weight": 9, "Su": 80, "eps50": 0.005, "J": 0.5})"},
        Type{"stiff_clay_free_water",
             R"({"type": "stiff_clay_free_water", "unit_weight": 9, "Su": 80, "eps50": 0.005, "k": 1e5})"},
        Type{"reese_sand", R"({"type": "reese_sand", "unit_weight": 10, "phi": 35, "k": 2e4})"}),
    [](const auto& type) { return std::string(type.param.name); });

struct Mistake {
  const char* name;
  std::function<void(json&)> make;  ///< changes the soil
  const char* pointer;
  const char* code;
};

TEST(SoilLayering, RefusesWhatHasNoEquivalentDepth) {
  const json pisa = json::parse(R"({"type": "pisa_clay", "Su": 80, "G0": 4e4, "unit_weight": 9})");
  for (const Mistake& mistake : {Mistake{"name", [](json& soil) { soil["layering"] = "reese"; },
                                         "/model/soils/0/layering", "unknown_value"},
                                 Mistake{"pisa",
                                         [&](json& soil) {
                                           soil["layers"][1].erase("eps50");
                                           soil["layers"][1].erase("J");
                                           soil["layers"][1].update(pisa);
                                         },
                                         "/model/soils/0/layers/1/type", "not_supported"},
                                 Mistake{"strength",
                                         [](json& soil) {
                                           soil["layers"][1]["Su"] = {0, 50};
                                         },
                                         "/model/soils/0/layers/1", "out_of_range"}}) {
    json model = model_in({{4, kSoft}, {20, kStiff}});
    mistake.make(soil_of(model));
    Report report;
    const ListedSupports supports = list_foundations(Value(model, PointerPath("/model"), report));
    EXPECT_EQ(supports.foundations.size(), 1U) << mistake.name;
    EXPECT_THAT(report.findings(), ElementsAre(is_finding(mistake.pointer, mistake.code))) << mistake.name;
  }
}

}  // namespace
}  // namespace snapthrough::api
