/// Soil in a request: the foundations that it gives, and mistakes by their places.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>

#include "api/api.h"
#include "api/convert/convert.h"
#include "api/list_foundations.h"
#include "api/plot/plot.h"
#include "api/sweep.h"
#include "tests/findings.h"

namespace snapthrough::api {
namespace {

using nlohmann::json;
using snapthrough::testing::is_finding;
using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::Field;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::SizeIs;

/// A pile of 20 with its head at the surface, in clay of 5 above sand, loaded at its head.
json pile_request() {
  return json::parse(R"({
    "model": {
      "nodes": [{"id": "head", "x": 0, "y": 0}, {"id": "tip", "x": 0, "y": -20}],
      "sections": [{"id": "tube", "E": 2e8, "shape": {"type": "tube", "diameter": 1, "thickness": 0.02}}],
      "members": [{"id": "shaft", "start": "head", "end": "tip", "section": "tube"}],
      "supports": [{"node": "tip", "fixed": ["y"]}],
      "soils": [{"id": "site", "loading": "static", "layers": [
        {"type": "soft_clay", "top": 0, "bottom": 5, "unit_weight": 8, "Su": [20, 45], "eps50": 0.01, "J": 0.5},
        {"type": "api_sand", "top": 5, "bottom": 25, "unit_weight": 10, "phi": 35, "k": 20000}]}],
      "foundations": [{"id": "shaft", "member": "shaft", "soil": "site"}],
      "loads": [{"type": "point", "at": {"node": "head"}, "force": [100, 0]}]
    },
    "analysis": {"type": "static"}
  })");
}

/// The same pile as a document for `convert soil`.
json pile_document() {
  return json::parse(R"({
    "pile": {"member": "shaft", "diameter": 1, "length": 20},
    "layers": [
      {"type": "soft_clay", "from": 0, "to": 5, "gamma": 8, "Su": [20, 45], "eps50": 0.01, "J": 0.5},
      {"type": "sand", "from": 5, "to": 25, "gamma": 10, "phi": 35, "k": 20000}],
    "loading": "static"
  })");
}

Request read_sound(const json& document) {
  ReadOutcome outcome = read_request(document.dump());
  EXPECT_THAT(outcome.findings, IsEmpty());
  if (!outcome.request) {
    throw std::runtime_error("the request cannot be read");
  }
  return *std::move(outcome.request);
}

/// The request with the foundations of a soil document in place of its soil.
json explicit_request(const json& soil_document) {
  json request = pile_request();
  request["model"].erase("soils");
  request["model"]["foundations"] = convert_soil_document(soil_document).document->at("foundations");
  return request;
}

/// Soil of one layer, in clay with 3 Su D = 60, J Su = 10 per depth and 9 Su D = 180 for D = 1.
json clay_request() {
  json request = pile_request();
  request["model"]["soils"][0]["layers"] = json::parse(R"([
    {"type": "soft_clay", "top": 0, "bottom": 25, "unit_weight": 8, "Su": 20, "eps50": 0.01, "J": 0.5}])");
  request["model"]["soils"][0]["accuracy"] = 1e-4;
  return request;
}

/// Returns the value of a number by fractions of a member.
double value_at(const json& number, double fraction) {
  const json& pairs = number.at("along");
  for (std::size_t i = 1; i < pairs.size(); ++i) {
    const double a = pairs[i - 1][0], b = pairs[i][0];
    if (fraction <= b) {
      const double t = std::clamp((fraction - a) / (b - a), 0.0, 1.0);
      return (1.0 - t) * pairs[i - 1][1].get<double>() + t * pairs[i][1].get<double>();
    }
  }
  return pairs.back()[1];
}

bool holds(const json& foundation, double fraction) {
  return foundation["range"][0] <= fraction && fraction < foundation["range"][1];
}

json foundations_of(const json& request) { return with_laws_of_soil(request.at("model")).at("foundations"); }

/// Returns the sum of the capacities of laws that act at a fraction of a member.
double capacity_at(const json& request, double fraction, const std::string& member = "shaft") {
  double sum = 0.0;
  for (const json& foundation : foundations_of(request)) {
    if (foundation["member"] == member && holds(foundation, fraction)) {
      sum += value_at(foundation["law"]["capacity"], fraction);
    }
  }
  return sum;
}

TEST(SoilRequest, IsTheModelOfTheExplicitLaws) {
  for (const char* loading : {"static", "cyclic"}) {
    json request = pile_request();
    json document = pile_document();
    request["model"]["soils"][0]["loading"] = loading;
    document["loading"] = loading;
    EXPECT_EQ(read_sound(request).model, read_sound(explicit_request(document)).model);
  }
}

TEST(SoilRequest, OfAMemberThatRunsUpwardsIsTheModelOfTheExplicitLaws) {
  json request = pile_request();
  json document = pile_document();
  request["model"]["members"][0].update({{"start", "tip"}, {"end", "head"}});
  request["model"]["foundations"][0].update({{"ground_level", -1.5}, {"diameter", 0.75}});
  document["pile"].update({{"head", "end"}, {"head_depth", -1.5}, {"diameter", 0.75}});
  json given = explicit_request(document);
  given["model"]["members"] = request["model"]["members"];
  EXPECT_EQ(read_sound(request).model, read_sound(given).model);
}

TEST(SoilRequest, IsConvertedToItsExplicitFoundations) {
  const Conversion conversion = convert_soil_document(pile_request());
  ASSERT_THAT(conversion.findings, IsEmpty());
  EXPECT_EQ(*conversion.document, *convert_soil_document(pile_document()).document);
}

TEST(SoilRequest, WithAMistakeIsNotConverted) {
  json request = pile_request();
  request["model"]["nodes"][1].erase("y");
  const Conversion conversion = convert_soil_document(request);
  EXPECT_EQ(conversion.document, nullptr);
  EXPECT_THAT(conversion.findings, ElementsAre(is_finding("/model/nodes/1/y", "missing_field")));
}

TEST(SoilRequest, OtherFoundationsKeepTheirPlacesInTheList) {
  json request = pile_request();
  json& foundations = request["model"]["foundations"];
  const json first{{"id", "first"}, {"member", "shaft"}, {"stiffness", 3}};
  foundations.insert(foundations.begin(), first);
  foundations.push_back({{"id", "last"}, {"member", "shaft"}, {"stiffness", 4}});
  const Model model = read_sound(request).model;
  ASSERT_THAT(model.foundations, SizeIs(4));
  EXPECT_EQ(model.foundations.front().id, "first");
  EXPECT_EQ(model.foundations[1].id, "shaft layer 1");
  EXPECT_EQ(model.foundations.back().id, "last");
}

// Total unit weight 18, water 10 from depth 2 on: s(1) = 18, s(4) = 36 + 16 = 52, Pmax = 60 + s + 10 X.
TEST(SoilRequest, WaterTableSetsTheEffectiveStress) {
  json request = clay_request();
  json& soil = request["model"]["soils"][0];
  soil.update({{"water_table", 2}, {"water_unit_weight", 10}});
  soil["layers"][0]["unit_weight"] = 18;
  EXPECT_NEAR(capacity_at(request, 0.05), 88.0, 0.01);
  EXPECT_NEAR(capacity_at(request, 0.2), 152.0, 0.02);
  const json made = foundations_of(request);
  ASSERT_THAT(made, SizeIs(2));
  EXPECT_EQ(made[0]["id"], "shaft layer 1 part 1");
  EXPECT_EQ(made[1]["id"], "shaft layer 1 part 2");
  EXPECT_EQ(made[1]["range"][0], 0.1);
  soil["water_table"] = -1;  // under water: s(1) = 8
  EXPECT_NEAR(capacity_at(request, 0.05), 78.0, 0.01);
}

// The surface is at depth 1 and soil holds from depth 1.5 on. Depth 3 is X = 2: Pmax = 60 + 16 + 20 = 96.
TEST(SoilRequest, GeneralScourLowersTheSurfaceAndLocalScourTakesResistanceAlone) {
  json request = clay_request();
  request["model"]["soils"][0]["scour"] = {{"general", 1}, {"local", 0.5}};
  EXPECT_NEAR(capacity_at(request, 0.15), 96.0, 0.01);
  EXPECT_EQ(foundations_of(request)[0]["range"][0], 0.075);
}

// Su = 10 + 2 z at the depth z = 10, X = 5 below the scoured surface: 3 Su + s + J Su X = 90 + 40 + 75.
TEST(SoilRequest, ScourLeavesTheStrengthOfEachDepth) {
  json request = clay_request();
  json& soil = request["model"]["soils"][0];
  soil["layers"][0]["Su"] = {10, 60};
  soil["scour"] = {{"general", 5}};
  EXPECT_NEAR(capacity_at(request, 0.5), 205.0, 0.03);
}

TEST(SoilRequest, MultiplierScalesForcesAndDisplacements) {
  json request = pile_request();
  const json plain = foundations_of(request);
  request["model"]["foundations"][0]["multiplier"] = {{"p", 0.5}, {"y", 2}};
  const json scaled = foundations_of(request);
  ASSERT_THAT(scaled, SizeIs(2));
  for (const std::size_t i : {0, 1}) {
    const json &a = plain[i]["law"], &b = scaled[i]["law"];
    EXPECT_NEAR(value_at(b["capacity"], 0.4), 0.5 * value_at(a["capacity"], 0.4), 1e-9);
    EXPECT_NEAR(value_at(b["stiffness"], 0.4), 0.25 * value_at(a["stiffness"], 0.4), 1e-9);
  }
  EXPECT_NEAR(scaled[0]["law"]["reference"].get<double>(), 2 * plain[0]["law"]["reference"].get<double>(),
              1e-12);
}

TEST(SoilRequest, TwoMembersInOneSoilHaveTheReactionsOfOne) {
  json request = pile_request();
  json& model = request["model"];
  model["nodes"].push_back({{"id", "joint"}, {"x", 0}, {"y", -8}});
  model["members"] = json::parse(R"([
    {"id": "upper", "start": "head", "end": "joint", "section": "tube"},
    {"id": "lower", "start": "tip", "end": "joint", "section": "tube"}])");
  model["foundations"] = json::parse(R"([
    {"id": "upper", "member": "upper", "soil": "site"}, {"id": "lower", "member": "lower", "soil": "site"}])");
  model["soils"][0]["accuracy"] = 1e-4;
  json one = pile_request();
  one["model"]["soils"][0]["accuracy"] = 1e-4;
  for (const double depth : {0.5, 3.0, 6.0, 7.99, 8.01, 15.0, 19.9}) {
    const double exact = capacity_at(one, depth / 20);
    const double found = depth < 8 ? capacity_at(request, depth / 8, "upper")
                                   : capacity_at(request, (20 - depth) / 12, "lower");
    EXPECT_NEAR(found, exact, 2e-4 * exact) << depth;
  }
  read_sound(request);
}

// Depths count downwards: the member of length 25 spans 20 of depth.
TEST(SoilRequest, InclinedMemberHasTheReactionsOfItsDepths) {
  json request = clay_request();
  request["model"]["nodes"][1]["x"] = 15;
  EXPECT_NEAR(capacity_at(request, 0.1), 96.0, 0.01);  // X = 2
}

TEST(SoilRequest, MemberAboveScouredGroundHasNoReaction) {
  json request = pile_request();
  request["model"]["soils"][0]["scour"] = {{"general", 21}};
  EXPECT_THAT(foundations_of(request), IsEmpty());
}

TEST(SoilRequest, DisplacementOfTheGroundMovesEachFoundation) {
  json request = pile_request();
  request["model"]["foundations"][0]["displacement"] = {{"x", 0.1}};
  const Model model = read_sound(request).model;
  EXPECT_THAT(model.foundations,
              Each(Field("displacement", &Foundation::displacement,
                         ::testing::Optional(Field(&GroundDisplacement::x, AlongMember(0.1))))));
}

TEST(SoilRequest, SweepOverDiameterAndFrictionAngleMakesTheLawsAnew) {
  json sweep = pile_request();
  sweep["parameters"] = json::parse(R"([
    {"name": "D", "targets": [{"pointer": "/model/foundations/0/diameter"}], "values": [1, 2]},
    {"name": "phi", "targets": [{"pointer": "/model/soils/0/layers/1/phi"}], "values": [30, 40]}])");
  sweep["model"]["foundations"][0]["diameter"] = 1;
  sweep["design"] = "grid";
  sweep["outputs"] = {"/states/0/load_factor"};
  const SweepOutcome outcome = read_sweep(sweep.dump());
  ASSERT_THAT(outcome.findings, IsEmpty());
  ASSERT_EQ(outcome.sweep->size(), 4U);
  json document = pile_document();
  for (std::uint64_t i = 0; i < 4; ++i) {
    document["pile"]["diameter"] = i < 2 ? 1 : 2;
    document["layers"][1]["phi"] = i % 2 == 0 ? 30 : 40;
    const ReadOutcome point = read_request_document(outcome.sweep->document_at(i));
    ASSERT_THAT(point.findings, IsEmpty());
    EXPECT_EQ(point.request->model.foundations, read_sound(explicit_request(document)).model.foundations);
  }
}

TEST(SoilRequest, SensitivityToAStrengthMakesTheLawsAnew) {
  json request = pile_request();
  request["analysis"] = {{"type", "buckling"}, {"sensitivities", {"/model/soils/0/layers/0/Su/0"}}};
  request["model"]["loads"][0]["force"] = {0, -100};
  const Request read = read_sound(request);
  const auto changed = read.analysis.sensitivities.at(0).model_at(30.0);
  ASSERT_TRUE(changed.has_value());
  json document = pile_document();
  document["layers"][0]["Su"] = {30, 45};
  EXPECT_EQ(changed->foundations, read_sound(explicit_request(document)).model.foundations);
}

// A finding of the solver's checks counts the foundations that soil gives; its place is that of the request.
TEST(SoilRequest, FindingsOfChecksNameTheEntryOfTheRequest) {
  json request = pile_request();
  json& foundations = request["model"]["foundations"];
  foundations.push_back({{"id", "own"}, {"member", "shaft"}, {"stiffness", -1}});
  foundations.push_back(foundations[0]);  // repeats the ids of both layers
  EXPECT_THAT(read_request(request.dump()).findings,
              ElementsAre(is_finding("/model/foundations/1/stiffness", "out_of_range"),
                          is_finding("/model/foundations/2/id", "duplicate_id")));
}

TEST(SoilRequest, IsDrawnWithTheGroundAndTheLawsThatTheSoilGives) {
  PlotRequest plot;
  plot.kind = PlotKind::model;
  EXPECT_THAT(svg_of(pile_request(), plot), HasSubstr("ground-surface"));
  plot.kind = PlotKind::law;
  plot.law = "shaft layer 2";
  EXPECT_THAT(svg_of(pile_request(), plot), HasSubstr("shaft layer 2"));
}

TEST(SoilRequest, UnusedSoilIsAccepted) {
  json request = pile_request();
  request["model"]["soils"].push_back(request["model"]["soils"][0]);
  request["model"]["soils"][1]["id"] = "other";
  EXPECT_EQ(read_sound(request).model, read_sound(pile_request()).model);
  request["model"]["foundations"] = json::array({{{"id", "own"}, {"member", "shaft"}, {"stiffness", 1}}});
  EXPECT_THAT(read_sound(request).model.foundations, SizeIs(1));
}

struct Mistake {
  const char* name;
  std::function<void(json&)> make;  ///< changes the model of pile_request()
  const char* pointer;
  const char* code;
};
void PrintTo(const Mistake& mistake, std::ostream* out) { *out << mistake.name; }

class SoilRequestRefuses : public ::testing::TestWithParam<Mistake> {};

TEST_P(SoilRequestRefuses, ByPointerAndRule) {
  json request = pile_request();
  GetParam().make(request["model"]);
  EXPECT_THAT(read_request(request.dump()).findings,
              ElementsAre(is_finding(GetParam().pointer, GetParam().code)));
}

json& soil(json& model) { return model["soils"][0]; }
json& layer(json& model, std::size_t i) { return soil(model)["layers"][i]; }
json& entry(json& model) { return model["foundations"][0]; }

INSTANTIATE_TEST_SUITE_P(
    Requests, SoilRequestRefuses,
    ::testing::Values(Mistake{"soil", [](json& m) { entry(m)["soil"] = "swamp"; },
                              "/model/foundations/0/soil", "unknown_reference"},
                      Mistake{"member", [](json& m) { entry(m)["member"] = "mast"; },
                              "/model/foundations/0/member", "unknown_reference"},
                      Mistake{"no_soils", [](json& m) { m.erase("soils"); }, "/model/foundations/0/soil",
                              "unknown_reference"},
                      Mistake{"law", [](json& m) { entry(m)["stiffness"] = 3; },
                              "/model/foundations/0/stiffness", "ambiguous"},
                      Mistake{"range",
                              [](json& m) {
                                entry(m)["range"] = {0, 1};
                              },
                              "/model/foundations/0/range", "unknown_field"},
                      Mistake{"id", [](json& m) { entry(m)["id"] = ""; }, "/model/foundations/0/id",
                              "bad_id"},
                      Mistake{"long_id", [](json& m) { entry(m)["id"] = std::string(195, 'x'); },
                              "/model/foundations/0/id", "bad_id"},
                      Mistake{"diameter", [](json& m) { entry(m)["diameter"] = 0; },
                              "/model/foundations/0/diameter", "out_of_range"},
                      Mistake{"no_diameter",
                              [](json& m) {
                                m["sections"][0] = {{"id", "tube"}, {"EA", 1}, {"EI", 1}};
                              },
                              "/model/foundations/0", "missing_field"},
                      Mistake{"multiplier",
                              [](json& m) {
                                entry(m)["multiplier"] = {{"p", 0}};
                              },
                              "/model/foundations/0/multiplier/p", "out_of_range"},
                      Mistake{"above_ground", [](json& m) { entry(m)["ground_level"] = -20; },
                              "/model/foundations/0/member", "out_of_range"},
                      Mistake{"curved",
                              [](json& m) {
                                m["members"][0]["curve"] = {{"type", "arc"}, {"sweep_degrees", 9}};
                              },
                              "/model/foundations/0/member", "not_supported"},
                      Mistake{"horizontal",
                              [](json& m) {
                                m["nodes"][1] = {{"id", "tip"}, {"x", 9}, {"y", 0}};
                              },
                              "/model/foundations/0/member", "not_supported"},
                      Mistake{"no_base", [](json& m) { entry(m)["base"] = true; },
                              "/model/foundations/0/base", "not_supported"},
                      Mistake{"displacement", [](json& m) { entry(m)["displacement"] = 3; },
                              "/model/foundations/0/displacement", "wrong_type"},
                      Mistake{"strength", [](json& m) { layer(m, 0)["Su"] = "soft"; },
                              "/model/soils/0/layers/0/Su", "wrong_type"},
                      Mistake{"phi", [](json& m) { layer(m, 1)["phi"] = 50; }, "/model/soils/0/layers/1/phi",
                              "out_of_range"},
                      Mistake{"layer_type", [](json& m) { layer(m, 1)["type"] = "sand"; },
                              "/model/soils/0/layers/1/type", "unknown_value"},
                      Mistake{"gap", [](json& m) { layer(m, 1)["top"] = 6; }, "/model/soils/0/layers/1/top",
                              "out_of_range"},
                      Mistake{"too_shallow", [](json& m) { layer(m, 1)["bottom"] = 19; },
                              "/model/soils/0/layers/1/bottom", "out_of_range"},
                      Mistake{"no_layers", [](json& m) { soil(m)["layers"] = json::array(); },
                              "/model/soils/0/layers", "out_of_range"},
                      Mistake{"huge_modulus", [](json& m) { layer(m, 1)["k"] = 1e150; },
                              "/model/soils/0/layers/1", "out_of_range"},
                      Mistake{"no_loading", [](json& m) { soil(m).erase("loading"); },
                              "/model/soils/0/loading", "missing_field"},
                      Mistake{"accuracy", [](json& m) { soil(m)["accuracy"] = 1; }, "/model/soils/0/accuracy",
                              "out_of_range"},
                      Mistake{"water_weight", [](json& m) { soil(m)["water_table"] = 1; },
                              "/model/soils/0/water_unit_weight", "missing_field"},
                      Mistake{"no_table", [](json& m) { soil(m)["water_unit_weight"] = 1; },
                              "/model/soils/0/water_unit_weight", "missing_field"},
                      Mistake{"buoyant",
                              [](json& m) {
                                soil(m).update({{"water_table", 5}, {"water_unit_weight", 10}});
                              },
                              "/model/soils/0/layers/1/unit_weight", "out_of_range"},
                      Mistake{"scour",
                              [](json& m) {
                                soil(m)["scour"] = {{"general", 25}};
                              },
                              "/model/soils/0/scour/general", "out_of_range"},
                      Mistake{"scour_sign",
                              [](json& m) {
                                soil(m)["scour"] = {{"local", -1}};
                              },
                              "/model/soils/0/scour/local", "out_of_range"},
                      Mistake{"duplicate_soil", [](json& m) { m["soils"].push_back(m["soils"][0]); },
                              "/model/soils/1/id", "duplicate_id"},
                      Mistake{"unknown_field", [](json& m) { soil(m)["watertable"] = 1; },
                              "/model/soils/0/watertable", "unknown_field"},
                      Mistake{"soils", [](json& m) { m["soils"] = 3; }, "/model/soils", "wrong_type"}),
    [](const auto& mistake) { return std::string(mistake.param.name); });

}  // namespace
}  // namespace snapthrough::api
