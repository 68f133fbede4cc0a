/// Tables by depth of soils in a request against the curves of their formulas at single depths.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>
#include <numbers>
#include <random>
#include <string>

#include "api/list_foundations.h"
#include "api/soil/curve_depths.h"
#include "tests/api/straight_lines.h"
#include "tests/findings.h"

namespace snapthrough::api {
namespace {

using nlohmann::json;
using snapthrough::testing::interpolated;
using snapthrough::testing::is_finding;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::SizeIs;

/// A model of a vertical pile of diameter 2 from 1 above ground to 11 below, in one layer of 20.
json model_in(const json& soil, const char* loading = "static") {
  json model = json::parse(R"({
    "nodes": [{"id": "head", "x": 0, "y": 1}, {"id": "tip", "x": 0, "y": -11}],
    "sections": [], "members": [{"id": "pile", "start": "head", "end": "tip", "section": "s"}],
    "soils": [{"id": "site", "layers": [{"top": 0, "bottom": 20, "unit_weight": 9}]}],
    "foundations": [{"id": "f", "member": "pile", "soil": "site", "diameter": 2}]
  })");
  model["soils"][0]["loading"] = loading;
  model["soils"][0]["layers"][0].update(soil);
  return model;
}

ListedSupports listed(const json& model) {
  Report report;
  ListedSupports out = list_foundations(Value(model, PointerPath("/model"), report));
  EXPECT_THAT(report.findings(), IsEmpty());
  return out;
}

/// Returns the sum of the reactions of tables of one component at a depth.
double reaction(const ListedSupports& supports, const std::string& component, double depth, double w) {
  const double fraction = (depth + 1.0) / 12.0;
  double sum = 0.0;
  for (const ListedSupport& one : supports.foundations) {
    const json& range = one.made["range"];
    if (one.made.value("component", "normal") == component && range[0] <= fraction && fraction < range[1]) {
      const json& law = one.made["law"];
      EXPECT_EQ(law["interpolation"], "linear");
      sum += interpolated(law["factor"]["along"], fraction) * interpolated(law["points"], w);
    }
  }
  return sum;
}

struct Type {
  const char* name;
  const char* fields;
  const char* loading;
  std::function<soil::LayerType(double)> at;  ///< parameters by depth
};
void PrintTo(const Type& type, std::ostream* out) { *out << type.name; }

class SoilTables : public ::testing::TestWithParam<Type> {};

// The formula's curve is taken at random depths and displacements with an accuracy ten times as fine. Where
// the largest force is less than `accuracy` of that of the layer, the error is relative to that share.
TEST_P(SoilTables, KeepTheAccuracyAtEveryDepthAndDisplacement) {
  const Type& type = GetParam();
  for (const double accuracy : {0.05, 0.01}) {
    json model = model_in(json::parse(type.fields), type.loading);
    model["soils"][0]["accuracy"] = accuracy;
    const ListedSupports supports = listed(model);
    const bool is_cyclic = type.loading == std::string("cyclic");
    const auto exact_at = [&](double depth) {
      const soil::Place place{depth, 9.0 * depth, 2.0,
                              11.0,  0.0,         is_cyclic ? soil::Loading::cyclic : soil::Loading::static_};
      return curve_of(type.at(depth), place, std::max(0.1 * accuracy, 1e-4));
    };
    const double least =
        accuracy * std::max(largest_force(exact_at(5.5), 2.0), largest_force(exact_at(11.0), 2.0));
    std::mt19937 random(7);
    double largest = 0.0;
    for (int i = 0; i < 2000; ++i) {
      const double depth = std::uniform_real_distribution(0.2, 10.999)(random);
      const double y = std::pow(10.0, std::uniform_real_distribution(-5.0, 0.0)(random));
      const soil::Curve exact = exact_at(depth);
      const double error = std::abs(reaction(supports, "normal", depth, y) - force_at(exact, y));
      largest = std::max(largest, error / std::max(largest_force(exact, 2.0), least));
    }
    EXPECT_LT(largest, 1.1 * accuracy);
    EXPECT_GT(largest, 0.05 * accuracy) << "there are far more curves than the accuracy needs";
  }
}

double linear(double top, double bottom, double depth) { return top + (bottom - top) * depth / 20.0; }

INSTANTIATE_TEST_SUITE_P(
    Types, SoilTables,
    ::testing::Values(
        Type{"soft_clay_matlock", R"({"type": "soft_clay_matlock", "Su": [20, 60], "eps50": 0.01, "J": 0.5})",
             "cyclic",
             [](double X) {
               return soil::SoftClayMatlock{linear(20, 60, X), 0.01, 0.5};
             }},
        Type{"soft_clay_api_points",
             R"({"type": "soft_clay_matlock", "Su": 30, "eps50": 0.01, "J": 0.5, "start": "api_points"})",
             "static",
             [](double) {
               return soil::SoftClayMatlock{30, 0.01, 0.5, soil::SoftClayStart::api_points};
             }},
        Type{"stiff_clay",
             R"({"type": "stiff_clay", "Su": [80, 120], "eps50": 0.005, "J": 0.5, "cycles": 100,
                 "first_point": 0.1})",
             "cyclic",
             [](double X) {
               return soil::StiffClay{linear(80, 120, X), linear(80, 120, 0.5 * X), 0.005, 0.5, 100, 0.1};
             }},
        Type{"stiff_clay_free_water",
             R"({"type": "stiff_clay_free_water", "Su": [80, 120], "eps50": 0.005, "k": [1e5, 2e5]})",
             "static",
             [](double X) {
               return soil::StiffClayFreeWater{linear(80, 120, X), linear(80, 120, 0.5 * X), 0.005,
                                               linear(1e5, 2e5, X)};
             }},
        Type{"reese_sand", R"({"type": "reese_sand", "phi": 35, "k": 20000})", "cyclic",
             [](double) {
               return soil::ReeseSand{35, 20000};
             }},
        Type{"pisa_clay", R"({"type": "pisa_clay", "Su": [80, 120], "G0": [4e4, 8e4]})", "static",
             [](double X) {
               return soil::PisaClay{linear(80, 120, X), linear(4e4, 8e4, X)};
             }},
        Type{"pisa_sand", R"({"type": "pisa_sand", "relative_density": 0.7, "G0": [4e4, 8e4]})", "static",
             [](double X) {
               return soil::PisaSand{0.7, linear(4e4, 8e4, X)};
             }},
        Type{"weak_rock",
             R"({"type": "weak_rock", "q_u": [2000, 3000], "E_ir": 5e5, "RQD": 50, "k_rm": 5e-4})", "static",
             [](double X) {
               return soil::WeakRock{linear(2000, 3000, X), 5e5, 50, 5e-4};
             }},
        Type{"liquefied_sand", R"({"type": "liquefied_sand", "metre": 1, "kilonewton": 1})", "static",
             [](double) {
               return soil::LiquefiedSand{1, 1};
             }}),
    [](const auto& type) { return std::string(type.param.name); });

// Axial curves of API: all friction at D/100, `residual` of it from D/50 on.
TEST(SoilTables, AxialCurvesActAlongTheTangent) {
  const ListedSupports supports = listed(model_in(json::parse(
      R"({"type": "api_sand", "phi": 35, "k": 20000,
          "axial": {"type": "api_tz_clay", "friction": [20, 60], "residual": 0.8}})")));
  const double circumference = 2.0 * std::numbers::pi;
  EXPECT_NEAR(reaction(supports, "tangent", 10, 0.02), 40.0 * circumference, 0.01 * 40 * circumference);
  EXPECT_NEAR(reaction(supports, "tangent", 10, 0.5), 32.0 * circumference, 0.01 * 40 * circumference);
}

// Su = 80, s = 36 at depth 4: a = 0.5 (80/36)^-0.25 = 0.409523, f = 32.7618.
TEST(SoilTables, FrictionOfClayFollowsFromItsStrength) {
  const ListedSupports supports = listed(model_in(json::parse(
      R"({"type": "soft_clay", "Su": 80, "eps50": 0.01, "J": 0.5,
          "axial": {"type": "api_tz_clay", "residual": 1}})")));
  EXPECT_NEAR(reaction(supports, "tangent", 4, 0.1), 32.7618 * 2.0 * std::numbers::pi, 2.0);
}

TEST(SoilTables, ClayOfPisaResistsRotationAndHasABase) {
  json model = model_in(json::parse(R"({"type": "pisa_clay", "Su": 100, "G0": 5e4, "end_bearing": 900})"));
  model["foundations"][0]["base"] = true;
  const ListedSupports supports = listed(model);
  const soil::Place place{5, 45, 2, 11, 0, soil::Loading::static_};
  const soil::Curve moment = moment_curve_of(soil::PisaClay{100, 5e4}, place, 1e-4);
  for (const double rotation : {1e-4, 1e-3, 0.01}) {
    EXPECT_NEAR(reaction(supports, "rotation", 5, rotation), force_at(moment, rotation),
                0.01 * largest_force(moment, 1.0));
  }
  ASSERT_THAT(supports.springs, SizeIs(3));
  const json &shear = supports.springs[0].made, &turn = supports.springs[1].made,
             &bearing = supports.springs[2].made;
  const soil::Place tip{11, 99, 2, 11, 0, soil::Loading::static_};
  EXPECT_EQ(shear["law"]["points"], json(base_shear_curve_of(soil::PisaClay{100, 5e4}, tip, 0.01).points));
  EXPECT_EQ(turn["law"]["points"], json(base_moment_curve_of(soil::PisaClay{100, 5e4}, tip, 0.01).points));
  EXPECT_EQ(turn["direction"], "rotation");
  EXPECT_EQ(bearing["direction"], json({0.0, -1.0}));
  EXPECT_EQ(bearing["reaction"], "compression_only");
  EXPECT_NEAR(bearing["law"]["points"].back()[1].get<double>(), 900.0 * std::numbers::pi, 1e-9);
  EXPECT_EQ(shear["id"], "f base shear");
  for (const json* spring : {&shear, &turn, &bearing}) {
    EXPECT_EQ((*spring)["at"]["node"], "tip");
  }
}

// The curves of PISA depend on the embedded length of the pile: 11, whichever member they act on.
TEST(SoilTables, EmbeddedLengthIsThatOfAllMembersOfThePile) {
  const json soil = json::parse(R"({"type": "pisa_sand", "relative_density": 0.7, "G0": 5e4})");
  const ListedSupports whole = listed(model_in(soil));
  json model = model_in(soil);
  model["nodes"].push_back({{"id", "joint"}, {"x", 0}, {"y", -5}});
  model["members"] = json::parse(R"([{"id": "pile", "start": "head", "end": "joint", "section": "s"},
                                     {"id": "low", "start": "tip", "end": "joint", "section": "s"}])");
  model["foundations"].push_back({{"id", "g"}, {"member", "low"}, {"soil", "site"}, {"diameter", 2}});
  double sum = 0.0;
  for (const ListedSupport& one : listed(model).foundations) {
    const json& range = one.made["range"];
    if (one.made["member"] == "pile" && range[0] <= 0.5 && 0.5 < range[1]) {  // depth 2
      sum += interpolated(one.made["law"]["factor"]["along"], 0.5) *
             interpolated(one.made["law"]["points"], 0.01);
    }
  }
  EXPECT_NEAR(sum, reaction(whole, "normal", 2, 0.01), 0.01 * sum);
}

// Rock begins at depth 5: x = 1 at X = 6, pu = (2/3) 2000 x 2 (1 + 1.4/2) = 4533.3.
TEST(SoilTables, DepthInRockCountsFromItsSurface) {
  json model = model_in(json::parse(R"({"type": "api_sand", "phi": 35, "k": 20000})"));
  json& layers = model["soils"][0]["layers"];
  layers[0]["bottom"] = 5;
  layers.push_back(json::parse(R"({"type": "weak_rock", "top": 5, "bottom": 20, "unit_weight": 9,
                                   "q_u": 2000, "E_ir": 5e5, "RQD": 50, "k_rm": 5e-4})"));
  model["soils"][0].update({{"water_table", 5.5}, {"water_unit_weight", 4}});
  json found = json::array();
  for (const ListedSupport& one : listed(model).foundations) {
    if (one.made["law"]["type"] == "table") {
      found.push_back(one.made);
    }
  }
  double sum = 0.0;
  for (const json& one : found) {
    if (one["range"][0] <= 7.0 / 12 && 7.0 / 12 < one["range"][1]) {
      sum += interpolated(one["law"]["factor"]["along"], 7.0 / 12) * interpolated(one["law"]["points"], 2.0);
    }
  }
  EXPECT_NEAR(sum, 4533.3, 46.0);
}

TEST(SoilTables, MultiplierScalesPointsOfLateralCurvesAlone) {
  json model = model_in(json::parse(
      R"({"type": "stiff_clay", "Su": 80, "eps50": 0.005, "J": 0.5, "first_point": 0.1,
          "axial": {"type": "api_tz_sand", "friction": 50, "peak_displacement": 0.0025}})"));
  const ListedSupports plain = listed(model);
  model["foundations"][0]["multiplier"] = {{"p", 0.4}, {"y", 3}};
  const ListedSupports scaled = listed(model);
  EXPECT_NEAR(reaction(scaled, "normal", 5, 0.03), 0.4 * reaction(plain, "normal", 5, 0.01), 1e-9);
  EXPECT_NEAR(reaction(scaled, "tangent", 5, 0.001), reaction(plain, "tangent", 5, 0.001), 1e-12);
}

struct Mistake {
  const char* fields;
  const char* pointer;
  const char* code;
};

TEST(SoilTables, ParametersHaveTheirRanges) {
  for (const Mistake& mistake :
       {Mistake{R"({"type": "reese_sand", "phi": 10, "k": 1})", "/phi", "out_of_range"},
        Mistake{R"({"type": "reese_sand", "phi": 30, "k": [1, 0]})", "/k", "out_of_range"},
        Mistake{R"({"type": "stiff_clay", "Su": 5, "eps50": 0.5, "J": 0.5})", "/eps50", "out_of_range"},
        Mistake{R"({"type": "stiff_clay", "Su": 5, "eps50": 0.1})", "/J", "missing_field"},
        Mistake{R"({"type": "pisa_clay", "Su": 5, "G0": "high"})", "/G0", "wrong_type"},
        Mistake{R"({"type": "pisa_sand", "relative_density": 60, "G0": 1})", "/relative_density",
                "out_of_range"},
        Mistake{R"({"type": "weak_rock", "q_u": 1, "E_ir": 1, "RQD": -1, "k_rm": 1e-3})", "/RQD",
                "out_of_range"},
        Mistake{R"({"type": "liquefied_sand", "metre": 1})", "/kilonewton", "missing_field"},
        Mistake{R"({"type": "soft_clay_matlock", "Su": 1, "eps50": 0.1, "J": 1, "start": "steep"})", "/start",
                "unknown_value"},
        Mistake{R"({"type": "reese_sand", "phi": 30, "k": 1, "end_bearing": -1})", "/end_bearing",
                "out_of_range"},
        Mistake{
            R"({"type": "reese_sand", "phi": 30, "k": 1, "axial": {"type": "api_tz_clay", "residual": 1}})",
            "/axial", "missing_field"},
        Mistake{
            R"({"type": "reese_sand", "phi": 30, "k": 1, "axial": {"type": "api_tz_sand", "friction": 1}})",
            "/axial/peak_displacement", "missing_field"}}) {
    Report report;
    const json model = model_in(json::parse(mistake.fields));
    const ListedSupports supports = list_foundations(Value(model, PointerPath("/model"), report));
    EXPECT_THAT(supports.foundations, SizeIs(1));  // of unknown stiffness
    EXPECT_THAT(
        report.findings(),
        ElementsAre(is_finding(std::string("/model/soils/0/layers/0") + mistake.pointer, mistake.code)))
        << mistake.fields;
  }
}

}  // namespace
}  // namespace snapthrough::api
