/// Derivatives of critical loads: closed forms of columns, and differences of whole analyses for the rest.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>
#include <vector>

#include "api/api.h"
#include "solver/solve.h"

namespace snapthrough {
namespace {

using nlohmann::json;

constexpr double kAccuracy = 1e-10;

json critical() {
  return {
      {"type", "critical"}, {"discretization", {{"accuracy", kAccuracy}}}, {"output", {{"states", "none"}}}};
}

Result result_of(const json& request) {
  const auto outcome = api::read_request(request.dump());
  if (!outcome.request) {
    ADD_FAILURE() << api::write_findings(outcome.findings).dump();
    return {};
  }
  return solve(outcome.request->model, outcome.request->analysis);
}

/// The first critical point with its sensitivities.
CriticalPoint first_point(json request, const std::vector<std::string>& pointers) {
  request["analysis"]["sensitivities"] = pointers;
  const Result result = result_of(request);
  EXPECT_FALSE(result.failure) << result.failure->detail;
  if (result.critical_points.empty()) {
    ADD_FAILURE() << result.summary.message;
    return {};
  }
  return result.critical_points.front();
}

/// The derivative by central differences of whole analyses, of two steps, extrapolated.
double difference(const json& request, const std::string& pointer, double step, CriticalType type) {
  const json::json_pointer place(pointer);
  const double value = request.at(place).get<double>();
  const auto load = [&](double other) {
    json changed = request;
    changed[place] = other;
    const Result result = result_of(changed);
    if (result.failure || result.critical_points.empty() || result.critical_points.front().type != type) {
      ADD_FAILURE() << pointer << " = " << other << ": " << result.summary.message;
      return 0.0;
    }
    return result.critical_points.front().load_factor;
  };
  const auto rate = [&](double h) { return (load(value + h) - load(value - h)) / (2.0 * h); };
  return (4.0 * rate(0.5 * step) - rate(step)) / 3.0;
}

struct Case {
  const char* name;
  const char* model;
  CriticalType type;
  std::vector<std::string> pointers;
  double size = 0.0;  ///< of what is changed, where its value is no measure; 0: the value
};

void PrintTo(const Case& one, std::ostream* out) { *out << one.name; }

class SensitivityOf : public ::testing::TestWithParam<Case> {};

/// Relative to the derivative, or to a thousandth of what the load factor itself would need.
TEST_P(SensitivityOf, AgreesWithDifferencesOfWholeAnalyses) {
  constexpr double kShare = 1e-3;
  constexpr double kStep = 1e-3;
  const Case& one = GetParam();
  const json request{{"model", json::parse(one.model)}, {"analysis", critical()}};
  const CriticalPoint point = first_point(request, one.pointers);
  ASSERT_EQ(point.type, one.type);
  ASSERT_EQ(point.sensitivities.size(), one.pointers.size());
  for (std::size_t i = 0; i < one.pointers.size(); ++i) {
    const Sensitivity& found = point.sensitivities[i];
    EXPECT_EQ(found.pointer, one.pointers[i]);
    ASSERT_TRUE(found.derivative) << found.pointer;
    const double value = request.at(json::json_pointer(found.pointer)).get<double>();
    const double size = one.size > 0.0 ? one.size : std::abs(value);
    const double expected = difference(request, found.pointer, kStep * size, one.type);
    const double scale = std::max(std::abs(expected), kShare * std::abs(point.load_factor) / size);
    EXPECT_NEAR(*found.derivative, expected, 1e-6 * scale) << found.pointer;
  }
}

const char* const kArch = R"({
  "nodes": [{"id": "a", "x": 0, "y": 0}, {"id": "b", "x": 4, "y": 0.2}],
  "sections": [{"id": "s", "E": 3e5, "A": 0.1, "I": 1e-4, "nu": 0.2, "shear_area": 0.08}],
  "members": [{"id": "m", "start": "a", "end": "b", "section": "s", "curve": {"type": "arc", "sweep_degrees": -50}}],
  "supports": [{"node": "a", "fixed": ["x", "y"]}, {"node": "b", "fixed": ["x", "y", "rotation"]}],
  "loads": [{"type": "point", "at": {"member": "m", "fraction": 0.45}, "force": [0.2, -3], "moment": 0.1},
            {"type": "distributed", "member": "m", "force": [0.05, -1], "range": [0.2, 0.9], "per": "horizontal"},
            {"type": "distributed", "member": "m", "force": [0.1, -0.2], "pattern": "constant"}],
  "imperfections": [{"type": "sine", "member": "m", "half_waves": 2, "amplitude": 0.01},
                    {"type": "points", "member": "m", "offsets": [[0.3, 0.004], [0.7, -0.003]]}]})";

const char* const kLee = R"({
  "nodes": [{"id": "a", "x": 0, "y": 0}, {"id": "b", "x": 0, "y": 120}, {"id": "c", "x": 120, "y": 120}],
  "sections": [{"id": "s", "EA": 4320, "EI": 1440}],
  "members": [{"id": "column", "start": "a", "end": "b", "section": "s"},
              {"id": "beam", "start": "b", "end": "c", "section": "s"}],
  "supports": [{"node": "a", "fixed": ["x", "y"]}, {"node": "c", "fixed": ["x", "y"]}],
  "loads": [{"type": "point", "at": {"member": "beam", "fraction": 0.2}, "force": [0, -1]}]})";

const char* const kPipe = R"({
  "nodes": [{"id": "invert", "x": 0, "y": -1}, {"id": "crown", "x": 0, "y": 1}],
  "sections": [{"id": "wall", "EA": 1e5, "EI": 1}],
  "members": [{"id": "right", "start": "invert", "end": "crown", "section": "wall", "curve": {"type": "arc", "sweep_degrees": 180}},
              {"id": "left", "start": "crown", "end": "invert", "section": "wall", "curve": {"type": "arc", "sweep_degrees": 180}}],
  "supports": [{"node": "invert", "fixed": ["x", "y"]}, {"node": "crown", "fixed": ["x"]}],
  "foundations": [{"id": "r", "member": "right", "stiffness": 300, "reaction": "compression_only", "side": "right", "gap": 0.001},
                  {"id": "l", "member": "left", "stiffness": 300, "reaction": "compression_only", "side": "right", "gap": 0.001}],
  "loads": [{"type": "pressure", "member": "right", "value": 1, "side": "right"},
            {"type": "pressure", "member": "left", "value": 1, "side": "right"},
            {"type": "point", "at": {"node": "crown"}, "force": [0, -0.2]}]})";

const char* const kShallow = R"({
  "nodes": [{"id": "a", "x": 0, "y": 0}, {"id": "b", "x": 1, "y": 0}],
  "sections": [{"id": "s", "EA": 4000, "EI": 1, "GA": 2000}],
  "members": [{"id": "m", "start": "a", "end": "b", "section": "s", "curve": {"type": "sine", "rise": 0.2, "half_waves": 1}}],
  "supports": [{"node": "a", "fixed": ["x", "y"]},
               {"node": "b", "fixed": ["x", "y", "rotation"], "angle_degrees": 12,
                "displacement": {"x": -0.002, "rotation": 0.01, "pattern": "constant"}}],
  "springs": [{"id": "k", "at": {"member": "m", "fraction": 0.4}, "direction": [0.2, -1], "stiffness": 100,
               "reaction": "compression_only", "gap": 0.01},
              {"id": "r", "at": {"node": "a"}, "direction": "rotation", "stiffness": 2}],
  "foundations": [{"id": "f", "member": "m", "stiffness": 20, "range": [0.1, 0.8], "direction": [0.1, -1]},
                  {"id": "g", "member": "m", "stiffness": 20, "shear_stiffness": 3}],
  "loads": [{"type": "point", "at": {"member": "m", "fraction": 0.5}, "force": [0, -1]},
            {"type": "initial_strain", "member": "m", "axial": -1e-3, "curvature": 0.05, "pattern": "constant"}],
  "imperfections": [{"type": "mode", "number": 1, "amplitude": 0.004}]})";

const char* const kDriven = R"({
  "nodes": [{"id": "a", "x": 0, "y": 0}, {"id": "t", "x": 1, "y": 0.3}, {"id": "b", "x": 2.1, "y": 0}],
  "sections": [{"id": "s", "EA": 1000, "EI": 1}],
  "members": [{"id": "m", "start": "a", "end": "t", "section": "s"},
              {"id": "n", "start": "t", "end": "b", "section": "s", "curve": {"type": "parabola", "rise": 0.1}}],
  "supports": [{"node": "a", "fixed": ["x", "y"]},
               {"node": "b", "fixed": ["x", "y"], "angle_degrees": 20, "displacement": {"x": 0.01, "y": -0.1}}],
  "loads": [{"type": "point", "at": {"node": "t"}, "force": [0, -2], "pattern": "constant"}]})";

const char* const kSymmetric = R"({
  "nodes": [{"id": "a", "x": 0, "y": 0}, {"id": "b", "x": 2, "y": 0}],
  "sections": [{"id": "s", "EA": 2000, "EI": 1}],
  "members": [{"id": "m", "start": "a", "end": "b", "section": "s", "curve": {"type": "arc", "sweep_degrees": -90}}],
  "supports": [{"node": "a", "fixed": ["x", "y"]}, {"node": "b", "fixed": ["x", "y"]}],
  "foundations": [{"id": "f", "member": "m", "stiffness": 3, "shear_stiffness": 0.1}],
  "loads": [{"type": "point", "at": {"member": "m", "fraction": 0.5}, "force": [0, -1]}]})";

INSTANTIATE_TEST_SUITE_P(
    Sensitivity, SensitivityOf,
    ::testing::Values(
        Case{"limit point of an arch",
             kArch,
             CriticalType::limit_max,
             {"/model/sections/0/E", "/model/sections/0/A", "/model/sections/0/I", "/model/sections/0/nu",
              "/model/sections/0/shear_area", "/model/members/0/curve/sweep_degrees", "/model/nodes/1/y",
              "/model/loads/0/at/fraction", "/model/loads/0/force/0", "/model/loads/0/force/1",
              "/model/loads/0/moment", "/model/loads/1/force/0", "/model/loads/1/range/0",
              "/model/loads/1/range/1", "/model/loads/2/force/1", "/model/imperfections/0/amplitude",
              "/model/imperfections/1/offsets/0/0", "/model/imperfections/1/offsets/1/1"}},
        Case{"Lee's frame",
             kLee,
             CriticalType::limit_max,
             {"/model/sections/0/EI", "/model/sections/0/EA", "/model/nodes/1/y", "/model/nodes/2/x",
              "/model/loads/0/at/fraction", "/model/loads/0/force/1"}},
        Case{"Lee's frame askew",
             kLee,
             CriticalType::limit_max,
             {"/model/nodes/0/x", "/model/nodes/0/y", "/model/nodes/1/x", "/model/nodes/2/y",
              "/model/loads/0/force/0"},
             10.0},
        Case{"pipe in one-sided soil behind a gap",
             kPipe,
             CriticalType::limit_max,
             {"/model/sections/0/EI", "/model/sections/0/EA", "/model/foundations/0/stiffness",
              "/model/foundations/1/gap", "/model/loads/0/value", "/model/loads/2/force/1",
              "/model/nodes/1/y"}},
        Case{"shallow arch over a spring with a gap",
             kShallow,
             CriticalType::limit_max,
             {"/model/sections/0/GA", "/model/members/0/curve/rise", "/model/supports/1/angle_degrees",
              "/model/supports/1/displacement/x", "/model/supports/1/displacement/rotation",
              "/model/springs/0/at/fraction", "/model/springs/0/direction/0", "/model/springs/0/stiffness",
              "/model/springs/0/gap", "/model/springs/1/stiffness", "/model/foundations/0/stiffness",
              "/model/foundations/0/range/0", "/model/foundations/0/range/1",
              "/model/foundations/0/direction/0", "/model/foundations/1/shear_stiffness",
              "/model/loads/1/axial", "/model/loads/1/curvature", "/model/imperfections/0/amplitude",
              "/model/nodes/1/x"}},
        Case{"toggle that a support drives",
             kDriven,
             CriticalType::limit_max,
             {"/model/supports/1/displacement/x", "/model/supports/1/displacement/y",
              "/model/supports/1/angle_degrees", "/model/nodes/1/y", "/model/members/1/curve/rise",
              "/model/loads/0/force/1", "/model/sections/0/EA"}},
        Case{"bifurcation of a bent arch",
             kSymmetric,
             CriticalType::bifurcation,
             {"/model/sections/0/EI", "/model/sections/0/EA", "/model/foundations/0/stiffness",
              "/model/foundations/0/shear_stiffness", "/model/members/0/curve/sweep_degrees",
              "/model/nodes/1/x", "/model/loads/0/force/1"}}),
    [](const auto& one) {
      std::string name = one.param.name;
      std::erase_if(name, [](unsigned char c) { return std::isalnum(c) == 0; });
      return name;
    });

/// A pinned column of length 3 on a base, one half wave: P = pi^2 EI / L^2 + K L^2 / pi^2.
json column() {
  return {{"model", json::parse(R"({
      "nodes": [{"id": "a", "x": 0, "y": 0}, {"id": "b", "x": 3, "y": 0}],
      "sections": [{"id": "s", "EA": 1e13, "EI": 5}],
      "members": [{"id": "m", "start": "a", "end": "b", "section": "s"}],
      "supports": [{"node": "a", "fixed": ["x", "y"]}, {"node": "b", "fixed": ["y"]}],
      "foundations": [{"id": "f", "member": "m", "stiffness": 1.5}],
      "loads": [{"type": "point", "at": {"node": "b"}, "force": [-2, 0], "moment": 0}]})")},
          {"analysis", critical()}};
}

TEST(Sensitivity, OfAColumnOnABaseIsTheClosedForm) {
  const CriticalPoint point =
      first_point(column(), {"/model/foundations/0/stiffness", "/model/sections/0/EI", "/model/nodes/1/x",
                             "/model/loads/0/force/0", "/model/nodes/0/x"});
  ASSERT_EQ(point.type, CriticalType::bifurcation);
  constexpr double kPi2 = std::numbers::pi * std::numbers::pi;
  constexpr double L = 3.0;
  constexpr double EI = 5.0;
  constexpr double K = 1.5;
  constexpr double force = 2.0;
  const double load = kPi2 * EI / (L * L) + K * L * L / kPi2;
  const double by_length = -2.0 * kPi2 * EI / (L * L * L) + 2.0 * K * L / kPi2;
  const std::vector<double> expected{L * L / kPi2 / force, kPi2 / (L * L) / force, by_length / force,
                                     load / (force * force), -by_length / force};
  ASSERT_NEAR(point.load_factor, load / force, 1e-9 * load);
  for (std::size_t i = 0; i < expected.size(); ++i) {
    ASSERT_TRUE(point.sensitivities[i].derivative) << i;
    EXPECT_NEAR(*point.sensitivities[i].derivative, expected[i], 1e-8 * std::abs(expected[i])) << i;
  }
}

TEST(Sensitivity, ByWhatBreaksABifurcationIsNone) {
  json request = column();
  request["model"]["imperfections"] = {
      {{"type", "sine"}, {"member", "m"}, {"half_waves", 1}, {"amplitude", 0.0}},
      {{"type", "sine"}, {"member", "m"}, {"half_waves", 2}, {"amplitude", 0.0}}};
  const CriticalPoint point = first_point(
      request, {"/model/loads/0/force/1", "/model/loads/0/moment", "/model/imperfections/0/amplitude",
                "/model/nodes/1/y", "/model/imperfections/1/amplitude"});
  ASSERT_EQ(point.type, CriticalType::bifurcation);
  for (const std::size_t i : {1U, 2U}) {
    EXPECT_FALSE(point.sensitivities[i].derivative) << i;
    EXPECT_EQ(point.sensitivities[i].reason, NoDerivative::breaks_bifurcation) << i;
  }
  // the reaction at the end takes a force across; a column that is drawn askew under an axial load
  ASSERT_TRUE(point.sensitivities[0].derivative);
  EXPECT_NEAR(*point.sensitivities[0].derivative, 0.0, 1e-8);
  // a second half wave bends the column, not its mode
  ASSERT_TRUE(point.sensitivities[4].derivative);
  EXPECT_NEAR(*point.sensitivities[4].derivative, 0.0, 1e-8);
}

TEST(Sensitivity, OfAStiffnessThatIsNotThereYetIsFromOneSide) {
  json request = column();
  request["model"]["foundations"][0]["stiffness"] = 0.0;
  const CriticalPoint point = first_point(request, {"/model/foundations/0/stiffness"});
  ASSERT_TRUE(point.sensitivities.at(0).derivative);
  const double expected = 9.0 / (std::numbers::pi * std::numbers::pi) / 2.0;
  EXPECT_NEAR(*point.sensitivities[0].derivative, expected, 1e-8 * expected);
}

TEST(Sensitivity, SaysWhyThereIsNone) {
  // pressure on a node that is free: the tangent is not symmetric
  json follower{{"model", json::parse(kLee)}, {"analysis", critical()}};
  follower["model"]["loads"] = {{{"type", "pressure"}, {"member", "beam"}, {"value", 1.0}, {"side", "left"}}};
  const CriticalPoint point = first_point(follower, {"/model/sections/0/EI"});
  EXPECT_FALSE(point.sensitivities.at(0).derivative);
  EXPECT_EQ(point.sensitivities[0].reason, NoDerivative::unsymmetric);
  // a base that touches without pressure holds the column no more once there is a gap
  json touching = column();
  touching["model"]["foundations"][0] = {
      {"id", "f"},      {"member", "m"}, {"stiffness", 500.0}, {"reaction", "compression_only"},
      {"side", "left"}, {"gap", 0.0},    {"range", {0.0, 0.4}}};
  touching["model"]["foundations"][1] = touching["model"]["foundations"][0];
  touching["model"]["foundations"][1]["id"] = "g";
  touching["model"]["foundations"][1]["side"] = "right";
  const CriticalPoint held = first_point(touching, {"/model/foundations/0/gap"});
  EXPECT_FALSE(held.sensitivities.at(0).derivative);
  EXPECT_EQ(held.sensitivities[0].reason, NoDerivative::not_differentiable);
}

TEST(Sensitivity, IsOfEachCriticalPointOfAPathAndCostsNoPathOfItsOwn) {
  json request{{"model", json::parse(kArch)}, {"analysis", critical()}};
  request["analysis"] = {{"type", "path"}, {"stop", {{"limit_points", 2}}}};
  const Result plain = result_of(request);
  request["analysis"]["sensitivities"] = {"/model/sections/0/I", "/model/loads/0/force/1",
                                          "/model/nodes/0/x"};
  const Result result = result_of(request);
  ASSERT_GE(result.critical_points.size(), 2U);
  ASSERT_EQ(result.critical_points.size(), plain.critical_points.size());
  const auto points = static_cast<int>(result.critical_points.size());
  for (std::size_t i = 0; i < result.critical_points.size(); ++i) {
    EXPECT_EQ(result.critical_points[i].load_factor, plain.critical_points[i].load_factor);
    EXPECT_EQ(result.critical_points[i].sensitivities.size(), 3U);
    EXPECT_TRUE(plain.critical_points[i].sensitivities.empty());
  }
  // the points are found again to rounding; the numbers of the model cost nothing more
  EXPECT_LE(result.diagnostics.factorizations, plain.diagnostics.factorizations + 6 * points);
}

}  // namespace
}  // namespace snapthrough
