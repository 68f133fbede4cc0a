/// Every field of the contract arrives in the field of the model or analysis that it names.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "api/read_parts.h"
#include "tests/api/documents.h"

namespace snapthrough::api {
namespace {

using ::testing::DoubleEq;
using ::testing::ElementsAre;
using ::testing::Field;
using ::testing::IsEmpty;
using ::testing::Optional;
using ::testing::Pair;

template <class T>
T read_whole(const nlohmann::json& json) {
  Report report;
  T out;
  read(Value(json, PointerPath(), report), out);
  for (const Finding& finding : report.findings()) {
    ADD_FAILURE() << finding.pointer << " " << finding.code << " " << finding.detail;
  }
  return out;
}

class FullModel : public ::testing::Test {
 protected:
  const Model model_ = read_whole<Model>(nlohmann::json::parse(testing::full_model()));
};

TEST_F(FullModel, TitleUnitsNodes) {
  EXPECT_EQ(model_.title, "everything");
  EXPECT_THAT(model_.units, ElementsAre(Pair("force", "kN"), Pair("length", "m")));
  ASSERT_EQ(model_.nodes.size(), 2U);
  EXPECT_EQ(model_.nodes[0].id, "a");
  EXPECT_EQ(model_.nodes[0].x, -1.5);
  EXPECT_EQ(model_.nodes[0].y, 2.0);
  EXPECT_EQ(model_.nodes[1].y, 4.25);
}

TEST_F(FullModel, Sections) {
  ASSERT_EQ(model_.sections.size(), 3U);
  const auto& [s, t, u] = std::tie(model_.sections[0], model_.sections[1], model_.sections[2]);
  EXPECT_EQ(s.id, "s");
  EXPECT_EQ(s.EA, 100.0);
  EXPECT_EQ(s.EI, 2.0);
  EXPECT_THAT(s.GA, Optional(30.0));
  EXPECT_EQ(t.EA, 100.0);                                                      // E A = 200 * 0.5
  EXPECT_EQ(t.EI, 50.0);                                                       // E I = 200 * 0.25
  EXPECT_THAT(t.GA, Optional(Field(&AlongMember::constant, DoubleEq(32.0))));  // 0.4 * 200 / (2 * 1.25)
  EXPECT_EQ(u.GA, std::nullopt);                                               // no shear area: unshearable
}

TEST_F(FullModel, MembersAndCurves) {
  ASSERT_EQ(model_.members.size(), 5U);
  const Member& m0 = model_.members[0];
  EXPECT_EQ(m0.id, "m0");
  EXPECT_EQ(m0.start, "a");
  EXPECT_EQ(m0.end, "b");
  EXPECT_EQ(m0.section, "s");
  EXPECT_TRUE(std::holds_alternative<LineCurve>(m0.curve));
  EXPECT_TRUE(m0.release_start_rotation);
  EXPECT_FALSE(m0.release_end_rotation);
  EXPECT_EQ(std::get<ArcCurve>(model_.members[1].curve).sweep_degrees, -20.0);
  EXPECT_FALSE(model_.members[1].release_start_rotation);
  EXPECT_TRUE(model_.members[1].release_end_rotation);
  EXPECT_EQ(m0.reaction, Reaction::bilateral);
  EXPECT_EQ(model_.members[2].reaction, Reaction::compression_only);
  EXPECT_EQ(std::get<ParabolaCurve>(model_.members[2].curve).rise, 0.5);
  EXPECT_EQ(std::get<SineCurve>(model_.members[3].curve).rise, 0.25);
  EXPECT_EQ(std::get<SineCurve>(model_.members[3].curve).half_waves, 3);
  EXPECT_THAT(std::get<PointsCurve>(model_.members[4].curve).points,
              ElementsAre(ElementsAre(0.0, 3.0), ElementsAre(1.0, 3.5)));
}

TEST_F(FullModel, Supports) {
  ASSERT_EQ(model_.supports.size(), 2U);
  const Support& a = model_.supports[0];
  EXPECT_EQ(a.node, "a");
  EXPECT_TRUE(a.x);
  EXPECT_FALSE(a.y);
  EXPECT_TRUE(a.rotation);
  EXPECT_EQ(a.angle_degrees, 30.0);
  ASSERT_TRUE(a.displacement.has_value());
  EXPECT_EQ(a.displacement->x, 0.1);
  EXPECT_EQ(a.displacement->y, 0.2);
  EXPECT_EQ(a.displacement->rotation, 0.3);
  EXPECT_EQ(a.displacement->pattern, Pattern::constant);
  EXPECT_TRUE(model_.supports[1].y);
  EXPECT_EQ(model_.supports[1].displacement->pattern, Pattern::constant) << "pattern beside the displacement";
}

TEST_F(FullModel, SpringsAndFoundations) {
  const Spring& k0 = model_.springs.at(0);
  EXPECT_EQ(k0.id, "k0");
  EXPECT_EQ(k0.at.member, "m0");
  EXPECT_EQ(k0.at.fraction, 0.25);
  EXPECT_THAT(k0.direction, Optional(ElementsAre(0.0, -2.0)));
  EXPECT_EQ(k0.stiffness, 5.0);
  EXPECT_EQ(k0.reaction, Reaction::tension_only);
  EXPECT_EQ(k0.gap, 0.125);
  EXPECT_EQ(model_.springs.at(1).at.node, "b");
  EXPECT_EQ(model_.springs.at(1).direction, std::nullopt);
  EXPECT_EQ(k0.to, std::nullopt);
  ASSERT_TRUE(model_.springs.at(1).to.has_value());
  EXPECT_EQ(model_.springs.at(1).to->node, "a");
  const Foundation& f0 = model_.foundations.at(0);
  EXPECT_EQ(f0.id, "f0");
  EXPECT_EQ(f0.member, "m0");
  EXPECT_EQ(f0.stiffness, 7.0);
  EXPECT_EQ(f0.shear_stiffness, 8.0);
  EXPECT_EQ(f0.reaction, Reaction::compression_only);
  EXPECT_EQ(f0.side, Side::right);
  EXPECT_THAT(f0.range, ElementsAre(0.1, 0.9));
  EXPECT_EQ(f0.gap, 0.01);
  EXPECT_EQ(f0.direction, std::nullopt);
  EXPECT_THAT(model_.foundations.at(1).direction, Optional(ElementsAre(1.0, 2.0)));
}

TEST_F(FullModel, Loads) {
  ASSERT_EQ(model_.loads.size(), 4U);
  const auto& point = std::get<PointLoad>(model_.loads[0]);
  EXPECT_EQ(point.at.node, "b");
  EXPECT_THAT(point.force, ElementsAre(1.0, 2.0));
  EXPECT_EQ(point.moment, 3.0);
  EXPECT_EQ(point.pattern, Pattern::constant);
  const auto& distributed = std::get<DistributedLoad>(model_.loads[1]);
  EXPECT_EQ(distributed.member, "m0");
  EXPECT_THAT(distributed.force, ElementsAre(4.0, 5.0));
  EXPECT_THAT(distributed.range, ElementsAre(0.2, 0.8));
  EXPECT_EQ(distributed.per, LoadMeasure::horizontal);
  EXPECT_EQ(distributed.pattern, Pattern::constant);
  const auto& pressure = std::get<PressureLoad>(model_.loads[2]);
  EXPECT_EQ(pressure.member, "m1");
  EXPECT_EQ(pressure.value, 6.0);
  EXPECT_EQ(pressure.side, Side::right);
  EXPECT_EQ(pressure.pattern, Pattern::constant);
  const auto& strain = std::get<InitialStrain>(model_.loads[3]);
  EXPECT_EQ(strain.member, "m0");
  EXPECT_EQ(strain.axial, 0.001);
  EXPECT_EQ(strain.curvature, 0.002);
  EXPECT_EQ(strain.pattern, Pattern::constant);
}

TEST_F(FullModel, ImperfectionsAndMonitors) {
  ASSERT_EQ(model_.imperfections.size(), 4U);
  const auto& sine = std::get<SineImperfection>(model_.imperfections[0]);
  EXPECT_EQ(sine.member, "m0");
  EXPECT_EQ(sine.half_waves, 2);
  EXPECT_EQ(sine.amplitude, 0.1);
  EXPECT_EQ(std::get<ModeImperfection>(model_.imperfections[1]).number, 3);
  EXPECT_EQ(std::get<ModeImperfection>(model_.imperfections[1]).amplitude, 0.2);
  EXPECT_EQ(std::get<PointsImperfection>(model_.imperfections[2]).member, "m1");
  EXPECT_THAT(std::get<PointsImperfection>(model_.imperfections[2]).offsets,
              ElementsAre(ElementsAre(0.0, 0.5), ElementsAre(1.0, 0.25)));
  EXPECT_EQ(std::get<WorstImperfection>(model_.imperfections[3]).norm, OffsetNorm::max);
  EXPECT_EQ(std::get<WorstImperfection>(model_.imperfections[3]).amplitude, 0.3);
  ASSERT_EQ(model_.monitors.size(), 2U);
  EXPECT_EQ(model_.monitors[0].id, "d0");
  EXPECT_EQ(model_.monitors[0].at.fraction, 0.75);
  EXPECT_EQ(model_.monitors[0].component, Component::normal);
  EXPECT_EQ(model_.monitors[1].component, Component::rotation);
}

Analysis read_analysis(const char* text) { return read_whole<Analysis>(nlohmann::json::parse(text)); }

TEST(ReadAnalysis, DefaultsAreThoseOfTheContract) {
  const Analysis a = read_analysis(R"({"type": "critical"})");
  EXPECT_EQ(a.type, AnalysisType::critical);
  EXPECT_EQ(a.modes, 1);
  EXPECT_THAT(a.load_factors, ElementsAre(1.0));
  EXPECT_EQ(a.geometry, Geometry::nonlinear);
  EXPECT_FALSE(a.discretization.fixed_mesh);
  EXPECT_EQ(a.discretization.accuracy, 1e-3);
  EXPECT_EQ(a.control.type, ControlType::arc_length);
  EXPECT_FALSE(a.step.initial || a.step.min || a.step.max);
  EXPECT_EQ(a.step.direction, 1.0);
  EXPECT_FALSE(a.reversed);
  EXPECT_FALSE(a.stop.limit_points || a.stop.load_factor || a.stop.monitor || a.stop.steps);
  EXPECT_FALSE(a.stop.negative_eigenvalues);
  EXPECT_EQ(a.branches.follow, Follow::primary);
  EXPECT_EQ(a.output.states, StateOutput::critical);
  EXPECT_EQ(a.output.points_per_member, 101);
  EXPECT_FALSE(a.output.path_points.has_value());
  EXPECT_FALSE(a.output.extremes);
}

TEST(ReadAnalysis, EveryField) {
  const Analysis a = read_analysis(R"({
    "type": "path", "modes": 4, "load_factors": [0.5, 2], "geometry": "linear",
    "discretization": {"elements": 40, "order": 3, "foundation": "lumped"}, "control": {"displacement": "d0"},
    "step": {"initial": 0.1, "min": 0.01, "max": 0.5, "direction": -1}, "reversed": true,
    "stop": {"limit_points": 2, "load_factor": [-1, 5], "monitor": {"id": "d0", "range": [-2, 3]}, "steps": 77,
             "negative_eigenvalues": 9},
    "branches": {"follow": "all", "limit": 6}, "output": {"states": {"every": 5}, "points_per_member": 11, "path_points": 300, "extremes": true}})");
  EXPECT_EQ(a.type, AnalysisType::path);
  EXPECT_EQ(a.modes, 4);
  EXPECT_THAT(a.load_factors, ElementsAre(0.5, 2.0));
  EXPECT_EQ(a.geometry, Geometry::linear);
  EXPECT_TRUE(a.discretization.fixed_mesh);
  EXPECT_EQ(a.discretization.elements, 40);
  EXPECT_EQ(a.discretization.order, 3);
  EXPECT_EQ(a.discretization.foundation, FoundationRule::lumped);
  EXPECT_EQ(a.control.type, ControlType::displacement);
  EXPECT_EQ(a.control.monitor, "d0");
  EXPECT_THAT(a.step.initial, Optional(0.1));
  EXPECT_THAT(a.step.min, Optional(0.01));
  EXPECT_THAT(a.step.max, Optional(0.5));
  EXPECT_EQ(a.step.direction, -1.0);
  EXPECT_TRUE(a.reversed);
  EXPECT_THAT(a.stop.negative_eigenvalues, Optional(9));
  EXPECT_THAT(a.stop.limit_points, Optional(2));
  EXPECT_THAT(a.stop.load_factor, Optional(ElementsAre(-1.0, 5.0)));
  ASSERT_TRUE(a.stop.monitor.has_value());
  EXPECT_EQ(a.stop.monitor->id, "d0");
  EXPECT_THAT(a.stop.monitor->range, ElementsAre(-2.0, 3.0));
  EXPECT_THAT(a.stop.steps, Optional(77));
  EXPECT_EQ(a.branches.follow, Follow::all);
  EXPECT_THAT(a.branches.limit, Optional(6));
  EXPECT_EQ(a.output.states, StateOutput::every);
  EXPECT_EQ(a.output.every, 5);
  EXPECT_EQ(a.output.points_per_member, 11);
  EXPECT_THAT(a.output.path_points, Optional(300));
  EXPECT_TRUE(a.output.extremes);
}

TEST(ReadAnalysis, OtherFormsOfFields) {
  const Analysis a = read_analysis(R"({"type": "static", "discretization": {"elements": {"m0": 4, "m1": 6}},
    "control": "load", "branches": {"follow": "first"}, "output": {"states": {"at_load_factors": [1, 2.5]}}})");
  EXPECT_EQ(a.type, AnalysisType::static_);
  EXPECT_TRUE(a.discretization.fixed_mesh);
  EXPECT_EQ(a.discretization.elements, 0);
  EXPECT_THAT(a.discretization.member_elements, ElementsAre(Pair("m0", 4), Pair("m1", 6)));
  EXPECT_EQ(a.control.type, ControlType::load);
  EXPECT_EQ(a.branches.follow, Follow::first);
  EXPECT_EQ(a.output.states, StateOutput::at_load_factors);
  EXPECT_THAT(a.output.at_load_factors, ElementsAre(1.0, 2.5));
  const Analysis b = read_analysis(
      R"({"type": "buckling", "discretization": {"accuracy": 1e-6}, "control": "arc_length",
          "output": {"states": "all"}})");
  EXPECT_EQ(b.type, AnalysisType::buckling);
  EXPECT_FALSE(b.discretization.fixed_mesh);
  EXPECT_EQ(b.discretization.accuracy, 1e-6);
  EXPECT_EQ(b.output.states, StateOutput::all);
}

TEST(ReadAnalysis, IntegersOfAnySpelling) {
  EXPECT_EQ(read_analysis(R"({"type": "critical", "modes": 12.0})").modes, 12);
  EXPECT_EQ(read_analysis(R"({"type": "critical", "modes": 1.2e1})").modes, 12);
}

}  // namespace
}  // namespace snapthrough::api
