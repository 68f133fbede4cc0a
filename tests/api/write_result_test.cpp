/// The result document: names of the contract, nulls where nothing is known, numbers that survive.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "api/api.h"
#include "api/provenance.h"

namespace snapthrough::api {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;

Request some_request() {
  Request request;
  request.model.title = "arch";
  request.model.units = {{"length", "m"}};
  return request;
}

State full_state() {
  State state;
  state.load_factor = 66.25;
  state.refinements = 2;
  const Peak low{-1.5, 0.25};
  const Peak high{2.5, 0.5};
  state.members = {{"m",
                    {0.0},
                    {1.0},
                    {2.0},
                    {3.0},
                    {4.0},
                    {5.0},
                    {6.0},
                    {7.0},
                    {8.0},
                    {9.0},
                    {10.0},
                    {0.5},
                    {-0.75},
                    {{low, high}, {low, low}, {high, high}, high, Utilisation{-0.75, 0.25, Fibre::right}}}};
  state.supports = {{"a", 1.0, 2.0, 3.0}};
  state.springs = {{"k", -0.5, -0.25, true, {1.5, 2.5, 3.5}, 0.25}};
  state.foundations = {{"soil",
                        {0.0, 1.0},
                        {0.25, 0.0},
                        {0.5, -0.5},
                        {{0.0, 0.5}, {0.75, 1.0}},
                        {0.5, 1.5, 2.5},
                        {low, high},
                        {0.625, 0.0}}};
  state.loads = {4.5, 5.5, 6.5};
  return state;
}

Result full_result() {
  Result r;
  r.summary = {66.25, CriticalType::bifurcation, 1e-5, "limit_points", "one limit point"};
  r.critical_points = {{0,
                        CriticalType::bifurcation,
                        66.25,
                        1e-5,
                        1.5,
                        {{"crown", -0.5}},
                        0,
                        1,
                        2,
                        0,
                        CriticalCause::contact,
                        Mode{{{"m", {0.0}, {1.0}, {0.5}, {3.0}}}},
                        true,
                        false,
                        {{4, 5, 66.5}, {8, 5, {}}}},
                       {0, CriticalType::limit_max, 76.5, {}, 2.5, {}, -1, -1, 1, {}},
                       {1, CriticalType::limit_min, 10.0, {}, 3.5, {}, 2, 1, 1, {}}};
  r.summary.softest = Softest{60.5, 0.0625, Mode{{{"m", {0.0}, {0.0}, {1.0}, {0.5}}}}};
  r.summary.at_critical = AtCritical{0.75, 0.5, 0.25, 0.125};
  r.critical_points[0].imperfection = 0.125;
  r.critical_points[0].member = "m";
  r.critical_points[0].sensitivities = {{"/model/nodes/0/x", 2.5, {}},
                                        {"/model/nodes/0/y", {}, NoDerivative::breaks_bifurcation}};
  r.branches = {{0,
                 {},
                 {0.0, 1.0},
                 {0.0, 0.5},
                 {{"crown", {0.0, -0.25}}},
                 {0, 1},
                 {1.0, std::nullopt},
                 {{"soil", {1.0, 0.5}}},
                 {},
                 {0},
                 PathRates{{2.0, 1.5}, {{"crown", {-0.5, -0.75}}}},
                 "limit_points"},
                {1, 0, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}}};
  r.neutral_motion = {{0, 0.5, {}, {{"n", 0.0, 1.0, 0.25}}}};
  r.contact_events = {{1, "soil", true, 2.5, 0.5, 2, 1}};
  r.states = {full_state()};
  r.static_table =
      StaticTable{{0.5, 1.0}, {{"crown", {0.0, -0.25}}}, {0, {}}, {{"soil", {1.0, 0.5}}}, {{}, 0}};
  r.not_reached = {2.0};
  const Extreme least{-1.0, 0.25, 0, 0.5}, most{2.0, 0.75, 1, 1.5};
  r.extremes = {{"m",
                 {least, most},
                 {most, most},
                 {least, least},
                 most,
                 UtilisationExtreme{{0.875, 0.5, Fibre::left}, 1, 1.5}}};
  r.first_yield = FirstYield{33.5, 1e-6, 0.75, "m", {-1.0, 0.25, Fibre::right}, {{"crown", -0.125}}};
  r.warnings = {{"large_strain", "much"}};
  r.buckling = BucklingResult{{1.5, 2.5}, {1e-6, {}}, {{{{"m", {0.0}, {1.0}, {2.0}, {3.0}}}}}};
  r.discretization = {16, 3, 142, 2, 1e-3, 1e-4, 3, {}};
  r.diagnostics = {20, 1, 60, 61, 1e-12, {"foundation soil: stiffness 0"}};
  return r;
}

TEST(WriteResult, PartsAreThoseOfTheWholeDocument) {
  Result result = full_result();
  const json whole = write_result(some_request(), result, 0.5);
  const std::string_view parts[] = {"buckling", "summary", "nothing"};
  const json some = write_result(some_request(), result, 0.5, parts);
  EXPECT_EQ(some.size(), 2U);
  EXPECT_EQ(some["buckling"], whole["buckling"]);
  EXPECT_EQ(some["summary"], whole["summary"]);
}

/// What full_result() is written as, but for `program`.
constexpr const char* kFullDocument = R"({"model": {"title": "arch", "units": {"length": "m"}},
    "summary": {"critical_load_factor": 66.25, "critical_type": "bifurcation", "error_estimate": 1e-5,
                "softest": {"load_factor": 60.5, "stiffness_ratio": 0.0625, "mode": {"members": {"m": {"s": [0.0], "u": [0.0], "v": [1.0], "rotation": [0.5]}}}},
                "at_critical": {"displacement": 0.75, "relative_displacement": 0.5, "rotation": 0.25, "strain": 0.125},
                "termination": "limit_points", "message": "one limit point"},
    "critical_points": [
      {"branch": 0, "type": "bifurcation", "cause": "contact", "load_factor": 66.25, "error_estimate": 1e-5, "arc_length": 1.5,
       "monitors": {"crown": -0.5}, "negative_before": 0, "negative_after": 1, "multiplicity": 2, "imperfection": 0.125, "state": 0, "member": "m",
       "mode": {"members": {"m": {"s": [0.0], "u": [1.0], "v": [0.5], "rotation": [3.0]}}},
       "confirmed": true, "meshes": [{"elements": 4, "order": 5, "load_factor": 66.5},
                                     {"elements": 8, "order": 5, "load_factor": null}],
       "sensitivities": [{"pointer": "/model/nodes/0/x", "derivative": 2.5, "reason": null},
                         {"pointer": "/model/nodes/0/y", "derivative": null, "reason": "breaks_bifurcation"}]},
      {"branch": 0, "type": "limit_max", "cause": "smooth", "load_factor": 76.5, "error_estimate": null, "arc_length": 2.5,
       "monitors": {}, "negative_before": null, "negative_after": null, "multiplicity": 1, "imperfection": null, "state": null, "member": null, "mode": null,
       "confirmed": false, "meshes": []},
      {"branch": 1, "type": "limit_min", "cause": "smooth", "load_factor": 10.0, "error_estimate": null, "arc_length": 3.5,
       "monitors": {}, "negative_before": 2, "negative_after": 1, "multiplicity": 1, "imperfection": null, "state": null, "member": null, "mode": null,
       "confirmed": false, "meshes": []}],
    "branches": [
      {"id": 0, "parent": null, "load_factor": [0.0, 1.0], "arc_length": [0.0, 0.5],
       "monitors": {"crown": [0.0, -0.25]}, "negative_eigenvalues": [0, 1], "stiffness_ratio": [1.0, null], "contact_fraction": {"soil": [1.0, 0.5]},
       "computed": [0], "rates": {"load_factor": [2.0, 1.5], "monitors": {"crown": [-0.5, -0.75]}}, "termination": "limit_points"},
      {"id": 1, "parent": 0, "load_factor": [], "arc_length": [], "monitors": {}, "negative_eigenvalues": [], "stiffness_ratio": [], "contact_fraction": {}, "termination": ""}],
    "neutral_motion": [{"branch": 0, "from": 0.5, "to": null, "nodes": {"n": {"u": 0.0, "v": 1.0, "rotation": 0.25}}}],
    "contact_events": [{"branch": 1, "id": "soil", "type": "opened", "load_factor": 2.5, "arc_length": 0.5,
                        "zones_before": 2, "zones_after": 1}],
    "states": [{"branch": 0, "load_factor": 66.25, "refinements": 2,
      "members": {"m": {"s": [0.0], "x0": [1.0], "y0": [2.0], "x": [3.0], "y": [4.0], "u": [5.0], "v": [6.0],
        "rotation": [7.0], "axial_force": [8.0], "shear_force": [9.0], "bending_moment": [10.0],
        "utilisation_left": [0.5], "utilisation_right": [-0.75],
        "extremes": {"axial_force": {"min": {"value": -1.5, "s": 0.25}, "max": {"value": 2.5, "s": 0.5}}, "shear_force": {"min": {"value": -1.5, "s": 0.25}, "max": {"value": -1.5, "s": 0.25}},
                     "bending_moment": {"min": {"value": 2.5, "s": 0.5}, "max": {"value": 2.5, "s": 0.5}}, "displacement": {"max": {"value": 2.5, "s": 0.5}},
                     "utilisation": {"value": -0.75, "s": 0.25, "fibre": "right"}}}},
      "supports": {"a": {"fx": 1.0, "fy": 2.0, "moment": 3.0}},
      "springs": {"k": {"force": -0.5, "displacement": -0.25, "closed": true,
                        "resultant": {"fx": 1.5, "fy": 2.5, "moment": 3.5}, "mobilised": 0.25}},
      "foundations": {"soil": {"s": [0.0, 1.0], "reaction": [0.25, 0.0], "displacement": [0.5, -0.5],
        "contact": [[0.0, 0.5], [0.75, 1.0]], "resultant": {"fx": 0.5, "fy": 1.5, "moment": 2.5}, "extremes": {"min": {"value": -1.5, "s": 0.25}, "max": {"value": 2.5, "s": 0.5}}, "mobilised": [0.625, 0.0]}},
      "loads": {"fx": 4.5, "fy": 5.5, "moment": 6.5}}],
    "static": {"load_factor": [0.5, 1.0], "monitors": {"crown": [0.0, -0.25]}, "negative_eigenvalues": [0, null],
      "contact_fraction": {"soil": [1.0, 0.5]}, "state": [null, 0]},
    "not_reached": [2.0],
    "extremes": {"members": {"m": {
      "axial_force": {"min": {"value": -1.0, "s": 0.25, "branch": 0, "load_factor": 0.5}, "max": {"value": 2.0, "s": 0.75, "branch": 1, "load_factor": 1.5}},
      "shear_force": {"min": {"value": 2.0, "s": 0.75, "branch": 1, "load_factor": 1.5}, "max": {"value": 2.0, "s": 0.75, "branch": 1, "load_factor": 1.5}},
      "bending_moment": {"min": {"value": -1.0, "s": 0.25, "branch": 0, "load_factor": 0.5},
                         "max": {"value": -1.0, "s": 0.25, "branch": 0, "load_factor": 0.5}},
      "displacement": {"max": {"value": 2.0, "s": 0.75, "branch": 1, "load_factor": 1.5}},
      "utilisation": {"value": 0.875, "s": 0.5, "fibre": "left", "branch": 1, "load_factor": 1.5}}}},
    "first_yield": {"load_factor": 33.5, "error_estimate": 1e-6, "arc_length": 0.75, "member": "m", "s": 0.25,
                    "fibre": "right", "stress": "compression", "monitors": {"crown": -0.125}},
    "warnings": [{"code": "large_strain", "detail": "much"}],
    "buckling": {"load_factors": [1.5, 2.5], "error_estimates": [1e-6, null],
      "modes": [{"members": {"m": {"s": [0.0], "u": [1.0], "v": [2.0], "rotation": [3.0]}}}]},
    "discretization": {"elements": 16, "order": 3, "unknowns": 142, "refinements": 2, "paths": 3,
      "accuracy": {"requested": 1e-3, "estimated": 1e-4}}, "kind": "result", "program": null,
    "diagnostics": {"steps": 20, "rejected_steps": 1, "iterations": 60, "factorizations": 61,
      "max_relative_residual": 1e-12, "wall_time_s": 0.125, "skipped": ["foundation soil: stiffness 0"]}
  })";

TEST(WriteResult, EveryFieldOfTheContract) {
  const json expected = json::parse(kFullDocument);
  json written = write_result(some_request(), full_result(), 0.125);
  EXPECT_EQ(std::exchange(written["program"], expected["program"]), program_json());
  EXPECT_EQ(written, expected) << json::diff(expected, written).dump(2);
}

TEST(WriteResult, NothingKnownIsNull) {
  const json written = write_result(some_request(), Result{}, 0.0);
  EXPECT_EQ(written["summary"]["critical_load_factor"], nullptr);
  EXPECT_EQ(written["summary"]["critical_type"], nullptr);
  EXPECT_EQ(written["summary"]["error_estimate"], nullptr);
  EXPECT_EQ(written["discretization"]["elements"], nullptr);
  EXPECT_EQ(written["discretization"]["accuracy"], json({{"requested", nullptr}, {"estimated", nullptr}}));
  EXPECT_EQ(written["diagnostics"]["max_relative_residual"], nullptr);
  EXPECT_EQ(written["branches"], json::array());
  EXPECT_EQ(written["not_reached"], json::array());
  EXPECT_EQ(written["warnings"], json::array());
  EXPECT_FALSE(written.contains("buckling"));
  EXPECT_FALSE(written.contains("static"));
  EXPECT_FALSE(written.contains("extremes"));
  EXPECT_FALSE(written.contains("first_yield"));
  EXPECT_FALSE(written.contains("failure"));
}

TEST(WriteResult, FailureIsThereWhenThereIsOne) {
  Result result;
  result.failure = Failure{"step_underflow", "stuck at 3.2"};
  const json expected = json{{"code", "step_underflow"}, {"detail", "stuck at 3.2"}};
  EXPECT_EQ(write_result(some_request(), result, 0.0)["failure"], expected);
}

TEST(WriteResult, NumbersSurviveTheText) {
  Result result;
  const std::vector<double> values = {1.0 / 3.0, 93.117814, 5e-324, 1.7976931348623157e308,
                                      -0.1,      1e22,      66.2628};
  result.branches = {{0, {}, values, {}, {}, {}, {}, {}}};
  const std::string text = write_result(some_request(), result, 0.0).dump();
  EXPECT_EQ(json::parse(text)["branches"][0]["load_factor"].get<std::vector<double>>(), values);
  EXPECT_THAT(text, HasSubstr("93.117814,")) << "no more digits than the number needs";
}

TEST(WriteResult, NumberThatIsNotFiniteIsAnError) {
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    Result result = full_result();
    result.states[0].members[0].y[0] = bad;
    try {
      (void)write_result(some_request(), result, 0.0);
      ADD_FAILURE() << "accepted " << bad;
    } catch (const std::runtime_error& error) {
      EXPECT_THAT(error.what(), HasSubstr("/states/0/members/m/y/0"));
    }
  }
}

}  // namespace
}  // namespace snapthrough::api
