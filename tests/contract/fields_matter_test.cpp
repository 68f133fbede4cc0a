/// Every field of the request document matters: changing it changes the answer. (That wrong values are
/// refused, each with its pointer, is tested in tests/api and tests/solver/check.)
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "api/api.h"
#include "solver/solve.h"

namespace snapthrough {
namespace {

using nlohmann::json;

/// A frame of two members with something of everything on it.
const char* const kModel = R"({
  "title": "frame", "units": {"length": "m", "force": "kN"},
  "nodes": [{"id": "a", "x": 0, "y": 0}, {"id": "b", "x": 3, "y": 2}, {"id": "c", "x": 6, "y": 0}],
  "sections": [{"id": "s", "EA": 900, "EI": 2, "GA": 300, "mass": 3, "expansion": 1e-3},
               {"id": "e", "E": 2000, "A": 0.5, "I": 0.001, "nu": 0.2, "shear_area": 0.4, "density": 2, "expansion": 1e-3}],
  "members": [{"id": "m", "start": "a", "end": "b", "section": "s", "curve": {"type": "arc", "sweep_degrees": -40}},
              {"id": "n", "start": "b", "end": "c", "section": "e", "curve": {"type": "sine", "rise": 0.2, "half_waves": 2}}],
  "supports": [{"node": "a", "fixed": ["x", "y"]},
               {"node": "c", "fixed": ["x", "y", "rotation"], "angle_degrees": 10, "displacement": {"x": 0.001, "y": 0.002, "rotation": 0.003}}],
  "springs": [{"id": "k", "at": {"member": "m", "fraction": 0.4}, "direction": [0.3, -1], "stiffness": 0.5, "reaction": "compression_only", "gap": 0.001},
              {"id": "l", "at": {"node": "b"}, "to": {"node": "c"}, "direction": [1, 0], "stiffness": 0.1}],
  "foundations": [{"id": "f", "member": "n", "stiffness": 0.4, "shear_stiffness": 0.1, "range": [0.1, 0.9]},
                  {"id": "g", "member": "m", "stiffness": 0.4, "reaction": "compression_only", "side": "right", "gap": 0.001}],
  "loads": [{"type": "point", "at": {"member": "m", "fraction": 0.6}, "force": [0.02, -0.1], "moment": 0.01},
            {"type": "distributed", "member": "n", "force": [0.01, -0.03], "range": [0.2, 0.8], "per": "horizontal"},
            {"type": "pressure", "member": "m", "value": 0.01, "side": "left"},
            {"type": "initial_strain", "member": "n", "axial": 1e-4, "curvature": 1e-3},
            {"type": "self_weight", "gravity": [0, -1e-3]},
            {"type": "temperature", "member": "m", "change": 0.1, "gradient": 0.5}],
  "load_cases": [{"id": "case", "factor": 1.5, "grows": false, "loads": [{"type": "pressure", "member": "n", "value": 0.001}]}],
  "imperfections": [{"type": "sine", "member": "m", "half_waves": 1, "amplitude": 0.02},
                    {"type": "mode", "number": 1, "amplitude": 0.01},
                    {"type": "points", "member": "n", "offsets": [[0.3, 0.01], [0.6, -0.02]]}],
  "monitors": [{"id": "w", "at": {"member": "m", "fraction": 0.5}, "component": "normal"},
               {"id": "v", "at": {"node": "b"}, "component": "y"}]})";

const char* const kStatic =
    R"({"type": "static", "load_factors": [0.7], "discretization": {"elements": 6, "order": 3},
  "output": {"points_per_member": 5}})";
const char* const kPath = R"({"type": "path", "discretization": {"elements": 6, "order": 3},
  "stop": {"limit_points": 3, "load_factor": [-1, 40], "monitor": {"id": "v", "range": [-0.9, 0.9]}, "steps": 40},
  "step": {"initial": 0.1, "min": 1e-9, "max": 0.5}, "output": {"states": "none"}})";
const char* const kBuckling =
    R"({"type": "buckling", "modes": 2, "discretization": {"elements": {"m": 5, "n": 6}, "order": 3}})";

/// The answer of a request: the result document without its counts and times, and without the digest of the
/// request, which every change changes.
json answer(const json& request) {
  const auto outcome = api::read_request(request.dump());
  if (!outcome.request) {
    ADD_FAILURE() << api::write_findings(outcome.findings).dump() << "\n" << request.dump();
    return {};
  }
  json document =
      api::write_result(*outcome.request, solve(outcome.request->model, outcome.request->analysis), 0.0);
  document.erase("diagnostics");
  document.erase("request_sha256");
  return document;
}

struct Field {
  const char* pointer;
  const char* value;  ///< JSON
};

json request_of(const char* analysis) {
  return {{"model", json::parse(kModel)}, {"analysis", json::parse(analysis)}};
}

json changed(const json& request, const Field& field) {
  json other = request;
  other[json::json_pointer(field.pointer)] = json::parse(field.value);
  return other;
}

void PrintTo(const Field& field, std::ostream* out) { *out << field.pointer << " = " << field.value; }

class ModelField : public ::testing::TestWithParam<Field> {};
TEST_P(ModelField, ChangesTheAnswer) {
  static const json base = request_of(kStatic);
  static const json reference = answer(base);
  ASSERT_FALSE(reference.contains("failure")) << reference["failure"];
  EXPECT_NE(answer(changed(base, GetParam())), reference);
}

INSTANTIATE_TEST_SUITE_P(
    Contract, ModelField,
    ::testing::Values(
        Field{"/model/title", R"("other")"}, Field{"/model/units/length", R"("mm")"},
        Field{"/model/units/force", R"("N")"}, Field{"/model/nodes/1/x", "3.1"},
        Field{"/model/nodes/1/y", "2.1"}, Field{"/model/sections/0/EA", "800"},
        Field{"/model/sections/0/EI", "2.1"}, Field{"/model/sections/0/GA", "200"},
        Field{"/model/sections/1/E", "2100"}, Field{"/model/sections/1/A", "0.6"},
        Field{"/model/sections/1/I", "0.0011"}, Field{"/model/sections/1/nu", "0.3"},
        Field{"/model/sections/1/shear_area", "0.3"},
        Field{"/model/members/0", R"({"id": "m", "start": "b", "end": "a", "section": "s"})"},
        Field{"/model/members/0/section", R"("e")"}, Field{"/model/members/0/curve/sweep_degrees", "-50"},
        Field{"/model/members/0/curve", R"({"type": "line"})"},
        Field{"/model/members/0/curve", R"({"type": "parabola", "rise": 0.3})"},
        Field{"/model/members/0/curve", R"({"type": "points", "points": [[1, 1.2], [2, 1.9]]})"},
        Field{"/model/members/1/curve/rise", "0.25"}, Field{"/model/members/1/curve/half_waves", "1"},
        Field{"/model/members/0/release", R"({"start": [], "end": ["rotation"]})"},
        Field{"/model/members/1/release", R"({"start": [], "end": ["rotation"]})"},
        Field{"/model/members/1/release", R"({"end": {"rotation": 0.5}})"},
        Field{"/model/members/1/curve", R"({"type": "parabola", "rise": 0.2, "direction": [0, 1]})"},
        Field{
            "/model/sections/1",
            R"({"id": "e", "EA": 1e3, "EI": {"along": [[0, 2], [1, 1]], "power": 4}, "mass": 2, "expansion": 1e-3})"},
        Field{
            "/model/sections/1",
            R"({"id": "e", "E": 2000, "nu": 0.2, "shape": {"type": "rectangle", "width": 2, "depth": 0.2}, "density": 2, "expansion": 1e-3})"},
        Field{
            "/model/sections/1",
            R"({"id": "e", "E": 2000, "G": 900, "shape": {"type": "tube", "diameter": 1, "thickness": 0.2}, "density": 2, "expansion": 1e-3})"},
        Field{
            "/model/sections/1",
            R"({"id": "e", "E": 2e9, "profile": "HEB 200", "unit": "cm", "density": 2, "expansion": 1e-3})"},
        Field{"/model/supports/0/fixed", R"(["x", "y", "rotation"])"},
        Field{"/model/supports/0/node", R"("b")"}, Field{"/model/supports/1/angle_degrees", "20"},
        Field{"/model/supports/1/displacement/x", "0.002"},
        Field{"/model/supports/1/displacement/y", "0.001"},
        Field{"/model/supports/1/displacement/rotation", "0"},
        Field{"/model/supports/1/displacement/pattern", R"("constant")"}));

INSTANTIATE_TEST_SUITE_P(
    ContractSupports, ModelField,
    ::testing::Values(
        Field{"/model/springs/0/at/member", R"("n")"}, Field{"/model/springs/0/at/fraction", "0.5"},
        Field{"/model/springs/0/at", R"({"node": "b"})"}, Field{"/model/springs/0/direction", "[1, 0]"},
        Field{"/model/springs/0/direction", R"("rotation")"}, Field{"/model/springs/0/stiffness", "0.6"},
        Field{"/model/springs/0/reaction", R"("tension_only")"}, Field{"/model/springs/0/gap", "0.002"},
        Field{"/model/springs/1/to/node", R"("a")"}, Field{"/model/springs/1/direction", R"("rotation")"},
        Field{"/model/members/2",
              R"({"id": "r", "start": "a", "end": "c", "section": "s", "reaction": "tension_only"})"},
        Field{"/model/foundations/0/member", R"("m")"}, Field{"/model/foundations/0/stiffness", "0.5"},
        Field{"/model/foundations/0/shear_stiffness", "0.2"},
        Field{"/model/foundations/0/range", "[0.2, 0.9]"}, Field{"/model/foundations/0/direction", "[0, 1]"},
        Field{"/model/foundations/1/shear_stiffness", "0.2"},
        Field{"/model/foundations/1/reaction", R"("tension_only")"},
        Field{"/model/foundations/1/side", R"("left")"}, Field{"/model/foundations/1/gap", "0.002"},
        Field{"/model/loads/0/at/fraction", "0.61"}, Field{"/model/loads/0/force", "[0.02, -0.11]"},
        Field{"/model/loads/0/moment", "0.02"}, Field{"/model/loads/0/pattern", R"("constant")"},
        Field{"/model/loads/1/member", R"("m")"}, Field{"/model/loads/1/force", "[0.01, -0.04]"},
        Field{"/model/loads/1/range", "[0.3, 0.8]"}, Field{"/model/loads/1/per", R"("length")"},
        Field{"/model/loads/1/per", R"("vertical")"}, Field{"/model/loads/2/value", "0.02"},
        Field{"/model/loads/2/value", R"({"along": [[0, 0.01], [1, 0.02]]})"},
        Field{"/model/loads/2/side", R"("right")"}, Field{"/model/loads/2/member", R"("n")"},
        Field{"/model/loads/1/force", R"({"along": [[0.2, [0.01, -0.03]], [0.8, [0.01, -0.04]]]})"},
        Field{"/model/loads/1/axes", R"("member")"}, Field{"/model/loads/3/axial", "2e-4"},
        Field{"/model/loads/3/curvature", "2e-3"},
        Field{"/model/loads/3/axial", R"({"along": [[0, 1e-4], [1, 3e-4]]})"},
        Field{"/model/loads/3/curvature", R"({"along": [[0, 1e-3], [1, 3e-3]]})"},
        Field{"/model/loads/4/gravity", "[0, -2e-3]"}, Field{"/model/loads/5/change", "2"},
        Field{"/model/loads/5/gradient", R"({"along": [[0, 1], [1, 2]]})"},
        Field{"/model/loads/5/member", R"("n")"}, Field{"/model/sections/0/mass", "4"},
        Field{"/model/sections/0/mass", R"({"along": [[0, 2], [1, 1]]})"},
        Field{"/model/sections/1/density", "4"}, Field{"/model/sections/0/expansion", "2e-3"},
        Field{"/model/load_cases/0/factor", "2"}, Field{"/model/load_cases/0/grows", "true"},
        Field{"/model/load_cases/0/loads/0/value", "0.02"}, Field{"/model/imperfections/0/half_waves", "2"},
        Field{"/model/imperfections/0/amplitude", "0.03"}, Field{"/model/imperfections/0/member", R"("n")"},
        Field{"/model/imperfections/1/number", "2"}, Field{"/model/imperfections/1/amplitude", "0.02"},
        Field{"/model/imperfections/2/offsets", "[[0.3, 0.01], [0.6, -0.03]]"},
        Field{"/model/imperfections/2/member", R"("m")"}));

class PathField : public ::testing::TestWithParam<Field> {};
TEST_P(PathField, ChangesTheAnswer) {
  static const json base = request_of(kPath);
  static const json reference = answer(base);
  ASSERT_FALSE(reference.contains("failure")) << reference["failure"];
  EXPECT_NE(answer(changed(base, GetParam())), reference);
}

INSTANTIATE_TEST_SUITE_P(
    Contract, PathField,
    ::testing::Values(Field{"/model/monitors/0/component", R"("x")"},
                      Field{"/model/monitors/0/component", R"("rotation")"},
                      Field{"/model/monitors/0/at/fraction", "0.6"},
                      Field{"/model/monitors/1/at", R"({"member": "n", "fraction": 0.5})"},
                      Field{"/model/monitors/0/id", R"("w2")"}, Field{"/analysis/type", R"("critical")"},
                      Field{"/analysis/discretization", R"({"accuracy": 1e-3})"},
                      Field{"/analysis/discretization/elements", "7"},
                      Field{"/analysis/discretization/elements", R"({"m": 7, "n": 6})"},
                      Field{"/analysis/discretization/order", "4"},
                      Field{"/analysis/discretization/foundation", R"("lumped")"},
                      Field{"/analysis/step/initial", "0.05"},
                      Field{"/analysis/step", R"({"initial": 0.1, "max": 0.1})"},
                      Field{"/analysis/step/direction", "-1"}, Field{"/analysis/stop/load_factor", "[-1, 3]"},
                      Field{"/analysis/stop/monitor/range", "[-0.01, 0.01]"},
                      Field{"/analysis/stop/monitor", R"({"id": "w", "range": [-0.05, 0.05]})"},
                      Field{"/analysis/stop/steps", "2"}, Field{"/analysis/output/states", R"("all")"},
                      Field{"/analysis/output/states", R"({"every": 2})"},
                      Field{"/analysis/output/path_points", "50"}, Field{"/analysis/output/extremes", "true"},
                      Field{"/analysis/output/states", R"({"at_load_factors": [0.5]})"}));

TEST(ResultFields, BucklingAnswersWithItsModes) {
  const json base = request_of(kBuckling);
  const json reference = answer(base);
  for (const Field& field :
       {Field{"/analysis/modes", "3"}, Field{"/analysis/output", R"({"points_per_member": 11})"},
        Field{"/analysis/discretization/elements", R"({"m": 6, "n": 6})"}})
    EXPECT_NE(answer(changed(base, field)), reference) << field.pointer;
}

TEST(ResultFields, BucklingAnswersDependOnReversed) {
  json base = request_of(kBuckling);
  for (const char* list : {"springs", "foundations"})
    for (json& support : base["model"][list]) {
      support.erase("reaction");
      support.erase("gap");
    }
  EXPECT_NE(answer(changed(base, {"/analysis/reversed", "true"})), answer(base));
}

TEST(ResultFields, StaticAnswersDependOnGeometryAndFactors) {
  const json base = request_of(kStatic);
  const json reference = answer(base);
  for (const Field& field :
       {Field{"/analysis/geometry", R"("linear")"}, Field{"/analysis/load_factors", "[0.7, 0.8]"},
        Field{"/analysis/output/points_per_member", "7"}, Field{"/analysis/output/states", R"("none")"},
        Field{"/analysis/output/extremes", "true"}})
    EXPECT_NE(answer(changed(base, field)), reference) << field.pointer;
}

/// A shallow arch that bifurcates, passes two limit points, and turns under load and displacement control.
const char* const kArch = R"({"model": {
  "nodes": [{"id": "a", "x": -17.364817766693033, "y": 0}, {"id": "b", "x": 17.364817766693033, "y": 0}],
  "sections": [{"id": "s", "EA": 420, "EI": 1.4}],
  "members": [{"id": "arch", "start": "a", "end": "b", "section": "s", "curve": {"type": "arc", "sweep_degrees": -20}}],
  "supports": [{"node": "a", "fixed": ["x", "y"]}, {"node": "b", "fixed": ["x", "y"]}],
  "loads": [{"type": "point", "at": {"member": "arch", "fraction": 0.5}, "force": [0, -1.4e-4]}],
  "monitors": [{"id": "crown", "at": {"member": "arch", "fraction": 0.5}, "component": "y"}]},
  "analysis": {"type": "path", "discretization": {"elements": 8, "order": 4}, "stop": {"limit_points": 2, "steps": 80},
               "output": {"states": "none"}}})";

TEST(ResultFields, PathAnswersDependOnControlBranchesAndLimitPoints) {
  const json base = json::parse(kArch);
  const json reference = answer(base);
  for (const Field& field :
       {Field{"/analysis/control", R"("load")"}, Field{"/analysis/control", R"({"displacement": "crown"})"},
        Field{"/analysis/branches", R"({"follow": "first"})"},
        Field{"/analysis/branches", R"({"follow": "all", "limit": 3})"},
        Field{"/analysis/stop/limit_points", "1"}, Field{"/analysis/stop/negative_eigenvalues", "0"},
        Field{"/analysis/output/states", R"("critical")"},
        Field{"/analysis/sensitivities", R"(["/model/nodes/1/x"])"}, Field{"/analysis/koiter", "true"}})
    EXPECT_NE(answer(changed(base, field)), reference) << field.pointer << " = " << field.value;
}

/// `load` ends at the first limit point, `displacement` where the monitor turns.
TEST(ResultFields, ControlEndsWhereItCannotGoOn) {
  json request = json::parse(kArch);
  request["analysis"]["control"] = "load";
  json result = answer(request);
  EXPECT_EQ(result["summary"]["termination"], "limit_points");
  EXPECT_EQ(result["critical_points"].size(), 2u);
  request["analysis"]["control"] = {{"displacement", "crown"}};
  request["analysis"]["stop"]["limit_points"] = 5;
  result = answer(request);
  EXPECT_EQ(result["summary"]["termination"], "monitor_turned");
}

}  // namespace
}  // namespace snapthrough
