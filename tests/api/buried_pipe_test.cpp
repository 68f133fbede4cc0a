/// The soil around a buried pipe: values of its formulas, sides, and mistakes by their places.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>

#include "api/api.h"
#include "api/list_foundations.h"
#include "api/sweep.h"
#include "tests/findings.h"

namespace snapthrough::api {
namespace {

using nlohmann::json;
using snapthrough::testing::is_finding;
using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::Field;
using ::testing::IsEmpty;
using ::testing::SizeIs;

/// A pipe of diameter 0.5 whose axis is at a depth of 1: H/D = 2, H D = 0.5.
json pipe_request() {
  return json::parse(R"({
    "model": {
      "nodes": [{"id": "a", "x": 0, "y": 0}, {"id": "b", "x": 20, "y": 1}],
      "sections": [{"id": "steel", "E": 2e8, "shape": {"type": "tube", "diameter": 0.5, "thickness": 0.01}}],
      "members": [{"id": "line", "start": "a", "end": "b", "section": "steel"}],
      "foundations": [{"id": "soil", "member": "line", "pipe": {"plane": "vertical", "depth": 1,
        "displacements": {"axial": 0.003},
        "soil": {"type": "sand", "unit_weight": 16, "total_unit_weight": 20, "phi": 30, "coating_factor": 0.8,
                 "density": "dense"}}}],
      "loads": [{"type": "point", "at": {"node": "b"}, "force": [1, 0]}]
    },
    "analysis": {"type": "static"}
  })");
}

json& pipe_of(json& request) { return request["model"]["foundations"][0]["pipe"]; }

json& in_clay(json& request) {
  pipe_of(request)["soil"] = json::parse(R"({"type": "clay", "unit_weight": 8, "total_unit_weight": 18,
                                             "Su": 50, "adhesion": 0.9, "consistency": "stiff"})");
  return request;
}

json foundations_of(const json& request) {
  EXPECT_THAT(read_request(request.dump()).findings, IsEmpty());
  return with_laws_of_soil(request.at("model")).at("foundations");
}

/// Expects a table of one line up to a displacement and a force.
void expect_reaction(const json& foundation, const std::string& id, double displacement, double force) {
  EXPECT_EQ(foundation["id"], id);
  EXPECT_EQ(foundation["law"]["type"], "table");
  EXPECT_EQ(foundation["law"]["interpolation"], "linear");
  const json& points = foundation["law"]["points"];
  ASSERT_THAT(points, SizeIs(2));
  EXPECT_EQ(points[0], json({0.0, 0.0}));
  EXPECT_NEAR(points[1][0].get<double>(), displacement, 1e-12) << id;
  EXPECT_NEAR(points[1][1].get<double>(), force, 5e-5 * force) << id;
}

// gamma H D = 8; K0 = 0.5; tan(24 degrees) = 0.445229; N_q = exp(pi tan 30) tan^2(60) = 18.40112;
// N_qv = 30/44 * 2 = 1.363636; N_gamma = exp(2.9) = 18.17415, times 20 * 0.5^2 / 2 = 2.5.
TEST(BuriedPipe, InSandHasTheForcesOfTheGuideline) {
  const json made = foundations_of(pipe_request());
  ASSERT_THAT(made, SizeIs(3));
  expect_reaction(made[0], "soil axial", 0.003, std::numbers::pi * 8 * 0.75 * 0.445229);
  expect_reaction(made[1], "soil uplift", 0.01, 10.90909);
  expect_reaction(made[2], "soil bearing", 0.05, 18.40112 * 8 + 18.17415 * 2.5);
  EXPECT_EQ(made[0]["component"], "tangent");
}

// N_qh(30, 2) = 4.565 + 2.468 - 0.356 + 0.0342 - 0.00146544 = 6.70973456, and of 35 degrees
// 6.816 + 4.038 - 0.584 + 0.061208 - 0.0026928 = 10.3285152.
TEST(BuriedPipe, InPlanHasLateralForcesInBothDirections) {
  json request = pipe_request();
  pipe_of(request)["plane"] = "horizontal";
  json made = foundations_of(request);
  ASSERT_THAT(made, SizeIs(2));
  expect_reaction(made[1], "soil lateral", 0.05, 6.70973456 * 8);
  EXPECT_FALSE(made[1].contains("reaction"));
  pipe_of(request)["soil"]["phi"] = 32;
  made = foundations_of(request);
  expect_reaction(made[1], "soil lateral", 0.05, (0.6 * 6.70973456 + 0.4 * 10.3285152) * 8);
  pipe_of(request)["soil"]["phi"] = 45;  // 17.658 + 6.618 + 0.192 - 0.051544 - 0.0020784
  expect_reaction(foundations_of(request)[1], "soil lateral", 0.05, 24.4143776 * 8);
}

// c D = 25; N_ch = 6.752 + 0.13 - 11.063/9 + 7.119/27 = 5.9164444; gamma H D = 4.
TEST(BuriedPipe, InClayHasTheForcesOfTheGuideline) {
  json request = pipe_request();
  json made = foundations_of(in_clay(request));
  ASSERT_THAT(made, SizeIs(3));
  expect_reaction(made[0], "soil axial", 0.003, std::numbers::pi * 0.5 * 45);
  expect_reaction(made[1], "soil uplift", 0.1, 100);
  expect_reaction(made[2], "soil bearing", 0.1, 5.141593 * 25 + 4 + 0.0820850 * 18 * 0.125);
  pipe_of(request)["plane"] = "horizontal";
  expect_reaction(foundations_of(request)[1], "soil lateral", 0.05, 5.9164444 * 25);
}

TEST(BuriedPipe, FactorsAreLimited) {
  json request = pipe_request();
  pipe_of(in_clay(request))["depth"] = 5;  // 2 H/D = 20
  expect_reaction(foundations_of(request)[1], "soil uplift", 0.1, 10 * 25);
  pipe_of(request).update({{"plane", "horizontal"}});  // 6.752 + 0.65 - 0.09143 + 0.005349 is less than 9
  expect_reaction(foundations_of(request)[1], "soil lateral", 0.05, 7.315918 * 25);
  request = pipe_request();
  pipe_of(request)["depth"] = 5;
  pipe_of(request)["soil"]["phi"] = 20;  // phi/44 H/D = 4.545 < N_q = 6.399; 0.01 H = D/10
  expect_reaction(foundations_of(request)[1], "soil uplift", 0.05, 4.545455 * 40);
}

TEST(BuriedPipe, ConsistencyAndGivenDisplacementsSetWhereForcesAreReached) {
  json request = pipe_request();
  pipe_of(request)["soil"]["density"] = "loose";
  expect_reaction(foundations_of(request)[1], "soil uplift", 0.02, 10.90909);
  pipe_of(request)["displacements"].update({{"uplift", 0.015}, {"bearing", 0.04}, {"lateral", 0.03}});
  expect_reaction(foundations_of(request)[1], "soil uplift", 0.015, 10.90909);
  EXPECT_EQ(foundations_of(request)[2]["law"]["points"][1][0], 0.04);
  pipe_of(request)["plane"] = "horizontal";
  EXPECT_EQ(foundations_of(request)[1]["law"]["points"][1][0], 0.03);
  json clay = pipe_request();
  pipe_of(in_clay(clay))["soil"]["consistency"] = "soft";
  pipe_of(clay)["depth"] = 0.3;  // 0.2 H = 0.06
  EXPECT_NEAR(foundations_of(clay)[1]["law"]["points"][1][0].get<double>(), 0.06, 1e-15);
}

// Total weight and K0 default to the effective weight and 1 - sin(phi).
TEST(BuriedPipe, DefaultsAreThoseOfTheDocument) {
  json request = pipe_request();
  json given = request;
  pipe_of(request)["soil"].erase("total_unit_weight");
  pipe_of(given)["soil"].update({{"total_unit_weight", 16}, {"K0", 0.5}});
  pipe_of(given)["diameter"] = 0.5;
  const json made = foundations_of(request), other = foundations_of(given);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(made[i]["law"]["points"][1][1].get<double>(), other[i]["law"]["points"][1][1].get<double>(),
                1e-13);
  }
}

TEST(BuriedPipe, UpliftIsAboveThePipeWhicheverWayItsMemberRuns) {
  json request = pipe_request();
  json made = foundations_of(request);
  EXPECT_EQ(made[1]["side"], "left");
  EXPECT_EQ(made[2]["side"], "right");
  request["model"]["members"][0].update({{"start", "b"}, {"end", "a"}});
  made = foundations_of(request);
  EXPECT_EQ(made[1]["side"], "right");
  EXPECT_EQ(made[2]["side"], "left");
  for (const std::size_t i : {1, 2}) {
    EXPECT_EQ(made[i]["reaction"], "compression_only");
  }
}

TEST(BuriedPipe, DisplacementOfTheGroundMovesEachFoundation) {
  json request = pipe_request();
  request["model"]["foundations"][0]["displacement"] = {{"y", 0.1}};
  const ReadOutcome read = read_request(request.dump());
  ASSERT_THAT(read.findings, IsEmpty());
  EXPECT_THAT(read.request->model.foundations, SizeIs(3));
  EXPECT_THAT(read.request->model.foundations,
              Each(Field("displacement", &Foundation::displacement,
                         ::testing::Optional(Field(&GroundDisplacement::y, AlongMember(0.1))))));
}

TEST(BuriedPipe, InPlanMayTurnAndBend) {
  json request = pipe_request();
  pipe_of(request)["plane"] = "horizontal";
  request["model"]["nodes"][1] = {{"id", "b"}, {"x", 0}, {"y", 20}};
  request["model"]["members"][0]["curve"] = {{"type", "arc"}, {"sweep_degrees", 40}};
  EXPECT_THAT(foundations_of(request), SizeIs(2));
}

TEST(BuriedPipe, SweepOverItsDepthMakesTheLawsAnew) {
  json sweep = pipe_request();
  sweep["parameters"] = json::parse(
      R"([{"name": "H", "targets": [{"pointer": "/model/foundations/0/pipe/depth"}], "values": [1, 2]}])");
  sweep["design"] = "grid";
  sweep["outputs"] = {"/states/0/load_factor"};
  const SweepOutcome outcome = read_sweep(sweep.dump());
  ASSERT_THAT(outcome.findings, IsEmpty());
  const ReadOutcome point = read_request_document(outcome.sweep->document_at(1));
  ASSERT_THAT(point.findings, IsEmpty());
  json deeper = pipe_request();
  pipe_of(deeper)["depth"] = 2;
  EXPECT_EQ(point.request->model.foundations, read_request(deeper.dump()).request->model.foundations);
}

struct Mistake {
  const char* name;
  std::function<void(json&)> make;  ///< changes pipe_request()
  const char* pointer;              ///< below /model
  const char* code;
};
void PrintTo(const Mistake& mistake, std::ostream* out) { *out << mistake.name; }

class BuriedPipeRefuses : public ::testing::TestWithParam<Mistake> {};

TEST_P(BuriedPipeRefuses, ByPointerAndRule) {
  json request = pipe_request();
  GetParam().make(request);
  EXPECT_THAT(read_request(request.dump()).findings,
              ElementsAre(is_finding(std::string("/model") + GetParam().pointer, GetParam().code)));
}

json& entry(json& request) { return request["model"]["foundations"][0]; }
json& soil(json& request) { return pipe_of(request)["soil"]; }

INSTANTIATE_TEST_SUITE_P(
    Requests, BuriedPipeRefuses,
    ::testing::Values(
        Mistake{"steep", [](json& r) { r["model"]["nodes"][1]["y"] = 4.1; }, "/foundations/0/member",
                "not_supported"},
        Mistake{"curved",
                [](json& r) {
                  r["model"]["members"][0]["curve"] = {{"type", "arc"}, {"sweep_degrees", 9}};
                },
                "/foundations/0/member", "not_supported"},
        Mistake{"shallow", [](json& r) { pipe_of(r)["depth"] = 0.2; }, "/foundations/0/pipe/depth",
                "out_of_range"},
        Mistake{"deep", [](json& r) { pipe_of(r)["depth"] = 5.1; }, "/foundations/0/pipe/depth",
                "out_of_range"},
        Mistake{"plane", [](json& r) { pipe_of(r)["plane"] = "plan"; }, "/foundations/0/pipe/plane",
                "unknown_value"},
        Mistake{"phi", [](json& r) { soil(r)["phi"] = 46; }, "/foundations/0/pipe/soil/phi", "out_of_range"},
        Mistake{"coating", [](json& r) { soil(r)["coating_factor"] = 1.1; },
                "/foundations/0/pipe/soil/coating_factor", "out_of_range"},
        Mistake{"weight", [](json& r) { soil(r)["total_unit_weight"] = 10; },
                "/foundations/0/pipe/soil/total_unit_weight", "out_of_range"},
        Mistake{"density", [](json& r) { soil(r).erase("density"); }, "/foundations/0/pipe/soil/density",
                "missing_field"},
        Mistake{"type", [](json& r) { soil(r)["type"] = "silt"; }, "/foundations/0/pipe/soil/type",
                "unknown_value"},
        Mistake{"axial", [](json& r) { pipe_of(r)["displacements"] = json::object(); },
                "/foundations/0/pipe/displacements/axial", "missing_field"},
        Mistake{"adhesion", [](json& r) { soil(in_clay(r))["adhesion"] = 0; },
                "/foundations/0/pipe/soil/adhesion", "out_of_range"},
        Mistake{"huge", [](json& r) { soil(in_clay(r))["Su"] = 1e150; }, "/foundations/0/pipe",
                "out_of_range"},
        Mistake{"law", [](json& r) { entry(r)["stiffness"] = 3; }, "/foundations/0/stiffness", "ambiguous"},
        Mistake{"soil", [](json& r) { entry(r)["soil"] = "site"; }, "/foundations/0/pipe", "ambiguous"},
        Mistake{"range",
                [](json& r) {
                  entry(r)["range"] = {0, 1};
                },
                "/foundations/0/range", "unknown_field"},
        Mistake{"member", [](json& r) { entry(r)["member"] = "mast"; }, "/foundations/0/member",
                "unknown_reference"},
        Mistake{"no_diameter",
                [](json& r) {
                  r["model"]["sections"][0] = {{"id", "steel"}, {"EA", 1}, {"EI", 1}};
                },
                "/foundations/0", "missing_field"},
        Mistake{"pipe", [](json& r) { entry(r)["pipe"] = 3; }, "/foundations/0/pipe", "wrong_type"}),
    [](const auto& mistake) { return std::string(mistake.param.name); });

}  // namespace
}  // namespace snapthrough::api
