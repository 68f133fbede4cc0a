/// Every rule of check(): one request that breaks it and nothing else, and the finding that it must give.

#include "solver/check/check.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "solver/model/limits.h"
#include "solver/model/pointer.h"
#include "tests/findings.h"
#include "tests/solver/check/sound_model.h"

namespace snapthrough {

namespace {

using ::testing::ElementsAre;
using testing::is_finding;
using ::testing::IsEmpty;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInf = std::numeric_limits<double>::infinity();

/// All findings except that something is not implemented yet, which these tests are not about.
std::vector<Finding> check_rules(const Model& model, const Analysis& analysis) {
  std::vector<Finding> findings = check(model, analysis);
  std::erase_if(findings, [](const Finding& f) { return f.code == "unsupported"; });
  return findings;
}

TEST(PointerPath, IsAsLongAsItMustBe) {
  PointerPath path("/model");
  std::string expected = "/model";
  for (std::size_t i = 0; i < 30; ++i) {
    path = path.with("a/b~").with(i);
    expected += "/a~1b~0/" + std::to_string(i);
    EXPECT_EQ(path.text(), expected);
  }
}

struct Case {
  const char* name;
  void (*spoil)(Model& m, Analysis& a);
  const char* pointer;
  const char* code;
};

void PrintTo(const Case& c, std::ostream* out) { *out << c.name; }

PointLoad& point_load(Model& m) { return std::get<PointLoad>(m.loads[0]); }
DistributedLoad& distributed_load(Model& m) { return std::get<DistributedLoad>(m.loads[1]); }
SineImperfection& sine_imperfection(Model& m) { return std::get<SineImperfection>(m.imperfections[0]); }
void use_curve(Model& m, Curve curve) { m.members[0].curve = std::move(curve); }
void use_load(Model& m, Load load) { m.loads.push_back(std::move(load)); }

DistributedLoad varying(Along<std::array<double, 2>> force) {
  DistributedLoad load;
  load.member = "ab";
  load.force_along = std::move(force);
  return load;
}

void use_worst(Model& m) { m.imperfections[0] = WorstImperfection{OffsetNorm::rms, 1e-3}; }

void start_with_a_state(const Model& m, Analysis& a) {
  const std::vector<double> zeros{0.0, 0.0};
  a.type = AnalysisType::path;
  a.start.emplace();
  for (const Member& member : m.members)
    a.start->members.push_back({member.id, {0.0, 1.0}, zeros, zeros, zeros, zeros, zeros, zeros});
}

void add_members(Model& m, std::size_t count) {
  while (m.members.size() < count) {
    m.members.push_back(m.members[0]);
    m.members.back().id = "more" + std::to_string(m.members.size());
  }
}

void put_first_nodes_together_far_away(Model& m) {
  for (Node& node : m.nodes) {
    node.x += 1e6;
    node.y += 1e6;
  }
  m.nodes[1].x = 1e6 + 1e-9;
}
PointsCurve curve_of(std::size_t points) {
  PointsCurve curve;
  for (std::size_t i = 0; i < points; ++i) {
    curve.points.push_back({1.0 + 1e-5 * static_cast<double>(i), 1.0});
  }
  return curve;
}

class CheckRule : public ::testing::TestWithParam<Case> {};

TEST_P(CheckRule, GivesItsFindingAndNoOther) {
  auto [model, analysis] = testing::sound_request();
  GetParam().spoil(model, analysis);
  EXPECT_THAT(check_rules(model, analysis), ElementsAre(is_finding(GetParam().pointer, GetParam().code)));
}

std::string case_name(const ::testing::TestParamInfo<Case>& param_info) { return param_info.param.name; }

#define SPOIL(...) []([[maybe_unused]] Model& m, [[maybe_unused]] Analysis& a) { __VA_ARGS__; }

const Case kStructureCases[] = {
    {"IdEmpty", SPOIL(m.sections.push_back({"", 1.0, 1.0, {}})), "/model/sections/1/id", "bad_id"},
    {"IdControl", SPOIL(m.sections.push_back({"a\nb", 1.0, 1.0, {}})), "/model/sections/1/id", "bad_id"},
    {"IdTooLong", SPOIL(m.sections.push_back({std::string(kMaxIdLength + 1, 'a'), 1.0, 1.0, {}})),
     "/model/sections/1/id", "bad_id"},
    {"NodeIdTwice", SPOIL(m.nodes.push_back({"a", 9.0, 9.0})), "/model/nodes/3/id", "duplicate_id"},
    {"NodeNotFinite", SPOIL(m.nodes[1].y = kInf), "/model/nodes/1/y", "out_of_range"},
    {"NodeNan", SPOIL(m.nodes[0].x = kNan), "/model/nodes/0/x", "out_of_range"},
    {"NodeTooLarge", SPOIL(m.nodes[2].x = 1e200), "/model/nodes/2/x", "out_of_range"},
    {"NodeUnreached", SPOIL(m.nodes.push_back({"far", 9.0, 9.0})), "/model/nodes/3", "unreached_node"},
    {"SectionIdTwice", SPOIL(m.sections.push_back(m.sections[0])), "/model/sections/1/id", "duplicate_id"},
    {"AxialStiffnessZero", SPOIL(m.sections[0].EA = 0.0), "/model/sections/0/EA", "out_of_range"},
    {"AxialStiffnessMinusInfinite", SPOIL(m.sections[0].EA = -kInf), "/model/sections/0/EA", "out_of_range"},
    {"BendingStiffnessNegative", SPOIL(m.sections[0].EI = -1.0), "/model/sections/0/EI", "out_of_range"},
    {"ShearStiffnessZero", SPOIL(m.sections[0].GA = 0.0), "/model/sections/0/GA", "out_of_range"},
    {"MemberIdTwice", SPOIL(m.members.push_back({"ab", "a", "c", "steel", {}})), "/model/members/2/id",
     "duplicate_id"},
    {"MemberStartUnknown", SPOIL(m.members[0].start = "z"), "/model/members/0/start", "unknown_reference"},
    {"MemberEndUnknown", SPOIL(m.members[1].end = "z"), "/model/members/1/end", "unknown_reference"},
    {"MemberSectionUnknown", SPOIL(m.members[0].section = "z"), "/model/members/0/section",
     "unknown_reference"},
    {"MemberToItself", SPOIL(m.members.push_back({"x", "a", "a", "steel", {}})), "/model/members/2",
     "zero_length"},
    {"MemberWithoutLength", SPOIL(m.nodes[1].x = 1e-12), "/model/members/0", "zero_length"},
    {"MemberWithoutLengthFarAway", SPOIL(put_first_nodes_together_far_away(m)), "/model/members/0",
     "zero_length"},
    {"ArcWithoutSweep", SPOIL(use_curve(m, ArcCurve{0.0})), "/model/members/0/curve/sweep_degrees",
     "out_of_range"},
    {"ArcFullTurn", SPOIL(use_curve(m, ArcCurve{-360.0})), "/model/members/0/curve/sweep_degrees",
     "out_of_range"},
    {"ParabolaRiseNan", SPOIL(use_curve(m, ParabolaCurve{kNan})), "/model/members/0/curve/rise",
     "out_of_range"},
    {"SineRiseInfinite", SPOIL(use_curve(m, SineCurve{kInf, 1})), "/model/members/0/curve/rise",
     "out_of_range"},
    {"SineHalfWavesZero", SPOIL(use_curve(m, SineCurve{1.0, 0})), "/model/members/0/curve/half_waves",
     "out_of_range"},
    {"SplineWithoutPoints", SPOIL(use_curve(m, PointsCurve{})), "/model/members/0/curve/points", "empty"},
    {"SplinePointNan", SPOIL(use_curve(m, PointsCurve{{{1.0, kNan}}})), "/model/members/0/curve/points/0/1",
     "out_of_range"},
    {"SplinePointAtStart", SPOIL(use_curve(m, PointsCurve{{{0.0, 0.0}, {1.0, 0.5}}})),
     "/model/members/0/curve/points/0", "coincident_points"},
    {"SplinePointsTwice", SPOIL(use_curve(m, PointsCurve{{{1.0, 0.5}, {1.0, 0.5}}})),
     "/model/members/0/curve/points/1", "coincident_points"},
    {"SplinePointAtEnd", SPOIL(use_curve(m, PointsCurve{{{1.0, 0.5}, {2.0, 0.0}}})),
     "/model/members/0/curve/points/1", "coincident_points"},
    {"SplineTooManyPoints", SPOIL(use_curve(m, curve_of(kMaxCurvePoints + 1))),
     "/model/members/0/curve/points", "too_many"},
};
INSTANTIATE_TEST_SUITE_P(Structure, CheckRule, ::testing::ValuesIn(kStructureCases), case_name);

const Case kSupportCases[] = {
    {"SupportNodeUnknown", SPOIL(m.supports.push_back({"z", true, false, false, 0.0, {}})),
     "/model/supports/2/node", "unknown_reference"},
    {"SupportTwiceOnNode", SPOIL(m.supports.push_back(m.supports[0])), "/model/supports/2/node",
     "duplicate_id"},
    {"SupportFixesNothing", SPOIL(m.supports.push_back({"b", false, false, false, 0.0, {}})),
     "/model/supports/2/fixed", "empty"},
    {"SupportAngleNan", SPOIL(m.supports[0].angle_degrees = kNan), "/model/supports/0/angle_degrees",
     "out_of_range"},
    {"PrescribedNotFixed", SPOIL(m.supports[1].displacement = {0.1, 0.0, 0.0, Pattern::constant}),
     "/model/supports/1/displacement/x", "not_fixed"},
    {"PrescribedRotationNotFixed", SPOIL(m.supports[1].displacement = {0.0, 0.1, 0.2, Pattern::constant}),
     "/model/supports/1/displacement/rotation", "not_fixed"},
    {"PrescribedNan", SPOIL(m.supports[1].displacement = {0.0, kNan, 0.0, Pattern::constant}),
     "/model/supports/1/displacement/y", "out_of_range"},
    {"NothingHolds", SPOIL(m.supports.clear(); m.springs.clear(); m.foundations.clear()), "/model/supports",
     "mechanism"},
    {"MomentOnReleasedMembersOnly",
     SPOIL(m.members[1].release_end_rotation = true; std::get<PointLoad>(m.loads[0]).moment = 1.0),
     "/model/loads/0/moment", "mechanism"},
    {"SpringIdTwice", SPOIL(m.springs.push_back(m.springs[0])), "/model/springs/1/id", "duplicate_id"},
    {"SpringMemberUnknown", SPOIL(m.springs[0].at.member = "z"), "/model/springs/0/at/member",
     "unknown_reference"},
    {"SpringFractionAboveOne", SPOIL(m.springs[0].at.fraction = 1.5), "/model/springs/0/at/fraction",
     "out_of_range"},
    {"SpringDirectionZero", SPOIL(m.springs[0].direction = {0.0, 0.0}), "/model/springs/0/direction",
     "zero_direction"},
    {"SpringDirectionNan", SPOIL(m.springs[0].direction = {kNan, 1.0}), "/model/springs/0/direction",
     "out_of_range"},
    {"SpringStiffnessNegative", SPOIL(m.springs[0].stiffness = -1.0), "/model/springs/0/stiffness",
     "out_of_range"},
    {"SpringGapNegative", SPOIL(m.springs[0].gap = -0.1), "/model/springs/0/gap", "out_of_range"},
    {"SpringGapBilateral", SPOIL(m.springs[0].reaction = Reaction::bilateral), "/model/springs/0/gap",
     "needs_one_sided"},
    {"FoundationIdTwice", SPOIL(m.foundations.push_back(m.foundations[0])), "/model/foundations/1/id",
     "duplicate_id"},
    {"FoundationMemberUnknown", SPOIL(m.foundations[0].member = "z"), "/model/foundations/0/member",
     "unknown_reference"},
    {"FoundationStiffnessNegative", SPOIL(m.foundations[0].stiffness = -1.0),
     "/model/foundations/0/stiffness", "out_of_range"},
    {"FoundationShearNegative", SPOIL(m.foundations[0].shear_stiffness = -1.0),
     "/model/foundations/0/shear_stiffness", "out_of_range"},
    {"LayerOnGapsThatVary",
     SPOIL(m.foundations[0].shear_stiffness = 1.0; m.foundations[0].gap_along = {{0.0, 0.1}, {1.0, 0.2}}),
     "/model/foundations/0/shear_stiffness", "not_supported"},
    {"LayerOnRigidGround", SPOIL(m.foundations[0].shear_stiffness = 1.0; m.foundations[0].stiffness = kInf),
     "/model/foundations/0/shear_stiffness", "not_supported"},
    {"LayerWithoutStiffness", SPOIL(m.foundations[0].shear_stiffness = 1.0; m.foundations[0].stiffness = 0.0),
     "/model/foundations/0/shear_stiffness", "not_supported"},
    {"LayerThatIsLumped",
     SPOIL(m.foundations[0].shear_stiffness = 1.0; a.discretization.fixed_mesh = true;
           a.discretization.elements = 8; a.discretization.foundation = FoundationRule::lumped),
     "/analysis/discretization/foundation", "not_supported"},
    {"EndlessWithoutLayer", SPOIL(m.foundations[0].ground_end = GroundEnd::endless),
     "/model/foundations/0/ground_end", "not_supported"},
    {"FoundationRangeReversed", SPOIL(m.foundations[0].range = {0.5, 0.5}), "/model/foundations/0/range",
     "out_of_range"},
    {"FoundationRangeOutside", SPOIL(m.foundations[0].range = {0.5, 1.1}), "/model/foundations/0/range",
     "out_of_range"},
    {"FoundationGapBilateral", SPOIL(m.foundations[0].reaction = Reaction::bilateral),
     "/model/foundations/0/gap", "needs_one_sided"},
    {"FoundationDirectionZero", SPOIL(m.foundations[0].direction = {0.0, 0.0}),
     "/model/foundations/0/direction", "zero_direction"},
};
INSTANTIATE_TEST_SUITE_P(Support, CheckRule, ::testing::ValuesIn(kSupportCases), case_name);

ReactionLaw joint_law(AlongMember stiffness, double capacity) {
  ReactionLaw law;
  law.type = ReactionLaw::Type::tanh;
  law.stiffness = std::move(stiffness);
  law.capacity = capacity;
  return law;
}

const Case kMemberCases[] = {
    {"MassNegative", SPOIL(m.sections[0].mass = -1.0), "/model/sections/0/mass", "out_of_range"},
    {"TaperWithoutStiffness", SPOIL(m.sections[0].EI = AlongMember({{0.0, 1.0}, {1.0, 0.0}})),
     "/model/sections/0/EI/along/1/1", "out_of_range"},
    {"TaperBackwards", SPOIL(m.sections[0].GA = AlongMember({{1.0, 1.0}, {0.0, 2.0}})),
     "/model/sections/0/GA/along/1/0", "not_increasing"},
    {"TaperPowerZero", SPOIL(m.sections[0].mass = AlongMember({{0.0, 1.0}, {1.0, 2.0}}, 0.0)),
     "/model/sections/0/mass/power", "out_of_range"},
    {"ExpansionNan", SPOIL(m.sections[0].expansion = kNan), "/model/sections/0/expansion", "out_of_range"},
    {"JointStiffnessNegative", SPOIL(m.members[1].release_end_stiffness = -1.0),
     "/model/members/1/release/end/rotation", "out_of_range"},
    {"JointLawWithoutCapacity", SPOIL(m.members[1].release_end_law = joint_law(2.0, 0.0)),
     "/model/members/1/release/end/rotation/law/capacity", "out_of_range"},
    {"JointLawVaries",
     SPOIL(m.members[0].release_start_law = joint_law(AlongMember({{0.0, 1.0}, {1.0, 2.0}}), 1.0)),
     "/model/members/0/release/start/rotation/law/stiffness", "not_supported"},
    {"RodWithAJointLaw",
     SPOIL(m.springs.clear(); m.members[1].reaction = Reaction::tension_only;
           m.members[1].curve = LineCurve{}; m.members[1].release_start_law = joint_law(2.0, 1.0)),
     "/model/members/1/release/start/rotation", "not_supported"},
    {"ParabolaDirectionZero", SPOIL(use_curve(m, ParabolaCurve{0.5, std::array{0.0, 0.0}})),
     "/model/members/0/curve/direction", "zero_direction"},
    {"ParabolaAlongItsChord",
     SPOIL(use_curve(
         m, ParabolaCurve{0.5, std::array{m.nodes[0].x - m.nodes[1].x, m.nodes[0].y - m.nodes[1].y}})),
     "/model/members/0/curve/direction", "out_of_range"},
    {"VaryingForceNan", SPOIL(use_load(m, varying({{0.0, {0.0, 1.0}}, {1.0, {kNan, 1.0}}}))),
     "/model/loads/2/force/along/1/1/0", "out_of_range"},
    {"VaryingForceOutside", SPOIL(use_load(m, varying({{0.0, {0.0, 1.0}}, {1.5, {0.0, 1.0}}}))),
     "/model/loads/2/force/along/1/0", "out_of_range"},
    {"VaryingForceTwiceAtAPlace", SPOIL(use_load(m, varying({{0.5, {0.0, 1.0}}, {0.5, {0.0, 1.0}}}))),
     "/model/loads/2/force/along/1/0", "not_increasing"},
    {"WeightWithoutMass", SPOIL(use_load(m, SelfWeight{{0.0, -10.0}, Pattern::constant})),
     "/model/sections/0/mass", "missing_field"},
    {"GravityInfinite",
     SPOIL(m.sections[0].mass = 1.0; use_load(m, SelfWeight{{kInf, 0.0}, Pattern::constant})),
     "/model/loads/2/gravity/0", "out_of_range"},
    {"TemperatureWithoutExpansion",
     SPOIL(use_load(m, TemperatureLoad{"ab", 1.0, 0.0, Pattern::constant, {}, {}})),
     "/model/sections/0/expansion", "missing_field"},
    {"TemperatureMemberUnknown",
     SPOIL(use_load(m, TemperatureLoad{"z", 1.0, 0.0, Pattern::constant, {}, {}})), "/model/loads/2/member",
     "unknown_reference"},
    {"LoadCaseIdTwice", SPOIL(m.load_cases = {{"one", 0}, {"one", 0}}), "/model/load_cases/1/id",
     "duplicate_id"},
    {"LoadOfACase", SPOIL(m.load_cases = {{"one", m.loads.size()}}; point_load(m).force[1] = kNan),
     "/model/load_cases/0/loads/0/force/1", "out_of_range"},
};
INSTANTIATE_TEST_SUITE_P(Members, CheckRule, ::testing::ValuesIn(kMemberCases), case_name);

const Case kActionCases[] = {
    {"LoadNodeUnknown", SPOIL(point_load(m).at.node = "z"), "/model/loads/0/at/node", "unknown_reference"},
    {"LoadNowhere", SPOIL(point_load(m).at.node = ""), "/model/loads/0/at", "ambiguous"},
    {"LoadForceNan", SPOIL(point_load(m).force[1] = kNan), "/model/loads/0/force/1", "out_of_range"},
    {"LoadMomentInfinite", SPOIL(point_load(m).moment = kInf), "/model/loads/0/moment", "out_of_range"},
    {"DistributedMemberUnknown", SPOIL(distributed_load(m).member = "z"), "/model/loads/1/member",
     "unknown_reference"},
    {"DistributedRangeReversed", SPOIL(distributed_load(m).range = {0.7, 0.2}), "/model/loads/1/range",
     "out_of_range"},
    {"DistributedForceInfinite", SPOIL(distributed_load(m).force[0] = kInf), "/model/loads/1/force/0",
     "out_of_range"},
    {"PressureMemberUnknown", SPOIL(use_load(m, PressureLoad{"z", 1.0, {}, {}})), "/model/loads/2/member",
     "unknown_reference"},
    {"PressureNan", SPOIL(use_load(m, PressureLoad{"ab", kNan, {}, {}})), "/model/loads/2/value",
     "out_of_range"},
    {"StrainMemberUnknown", SPOIL(use_load(m, InitialStrain{"z", 1.0, 0.0, {}})), "/model/loads/2/member",
     "unknown_reference"},
    {"StrainCurvatureNan", SPOIL(use_load(m, InitialStrain{"ab", 0.0, kNan, {}})), "/model/loads/2/curvature",
     "out_of_range"},
    {"NoLoad", SPOIL(m.loads.clear()), "/model/loads", "no_load"},
    {"LoadsZero", SPOIL(point_load(m).force = {0.0, 0.0}; distributed_load(m).force = {0.0, 0.0}),
     "/model/loads", "no_load"},
    {"LoadsConstant",
     SPOIL(point_load(m).pattern = Pattern::constant; distributed_load(m).pattern = Pattern::constant),
     "/model/loads", "no_load"},
    {"ImperfectionMemberUnknown", SPOIL(sine_imperfection(m).member = "z"), "/model/imperfections/0/member",
     "unknown_reference"},
    {"ImperfectionHalfWavesZero", SPOIL(sine_imperfection(m).half_waves = 0),
     "/model/imperfections/0/half_waves", "out_of_range"},
    {"ImperfectionAmplitudeNan", SPOIL(sine_imperfection(m).amplitude = kNan),
     "/model/imperfections/0/amplitude", "out_of_range"},
    {"ModeNumberZero", SPOIL(m.imperfections[0] = ModeImperfection{0, 1.0}), "/model/imperfections/0/number",
     "out_of_range"},
    {"ModeAmplitudeInfinite", SPOIL(m.imperfections[0] = ModeImperfection{1, kInf}),
     "/model/imperfections/0/amplitude", "out_of_range"},
    {"OffsetsMemberUnknown", SPOIL(m.imperfections[0] = PointsImperfection{"z", {{0.0, 0.0}, {1.0, 0.1}}}),
     "/model/imperfections/0/member", "unknown_reference"},
    {"OffsetsTooFew", SPOIL(m.imperfections[0] = PointsImperfection{"ab", {{0.0, 0.0}}}),
     "/model/imperfections/0/offsets", "empty"},
    {"OffsetsNotIncreasing", SPOIL(m.imperfections[0] = PointsImperfection{"ab", {{0.5, 0.0}, {0.5, 0.1}}}),
     "/model/imperfections/0/offsets/1/0", "not_increasing"},
    {"OffsetsTooNear",
     SPOIL(m.imperfections[0] = PointsImperfection{"ab", {{0.0, 0.0}, {1e-12, 0.1}, {0.5, 0.0}, {1.0, 0.1}}}),
     "/model/imperfections/0/offsets/1/0", "not_increasing"},
    {"OffsetsOutside", SPOIL(m.imperfections[0] = PointsImperfection{"ab", {{0.5, 0.0}, {1.5, 0.1}}}),
     "/model/imperfections/0/offsets/1/0", "out_of_range"},
    {"OffsetsNan", SPOIL(m.imperfections[0] = PointsImperfection{"ab", {{0.5, kNan}, {1.0, 0.1}}}),
     "/model/imperfections/0/offsets/0/1", "out_of_range"},
    {"WorstAmplitudeZero", SPOIL(m.imperfections[0] = WorstImperfection{OffsetNorm::rms, 0.0}),
     "/model/imperfections/0/amplitude", "out_of_range"},
    {"WorstAmplitudeNan", SPOIL(m.imperfections[0] = WorstImperfection{OffsetNorm::max, kNan}),
     "/model/imperfections/0/amplitude", "out_of_range"},
    {"WorstTwice", SPOIL(m.imperfections.assign(2, WorstImperfection{OffsetNorm::rms, 1e-3})),
     "/model/imperfections/1", "too_many"},
    {"WorstLinearised", SPOIL(use_worst(m); a.type = AnalysisType::buckling), "/model/imperfections/0/type",
     "not_supported"},
    {"WorstOfSmallDisplacements",
     SPOIL(use_worst(m); a.type = AnalysisType::static_; a.geometry = Geometry::linear),
     "/model/imperfections/0/type", "not_supported"},
    {"WorstOfAFallingLoad", SPOIL(use_worst(m); a.type = AnalysisType::path; a.step.direction = -1.0),
     "/analysis/step/direction", "not_supported"},
    {"WorstOfAGivenState", SPOIL(use_worst(m); start_with_a_state(m, a)), "/analysis/start", "not_supported"},
    {"WorstOfManyMembers", SPOIL(use_worst(m); add_members(m, kMaxWorstMembers + 1)), "/model/members",
     "too_many"},
    {"MonitorIdTwice", SPOIL(m.monitors.push_back(m.monitors[0])), "/model/monitors/2/id", "duplicate_id"},
    {"MonitorMemberUnknown", SPOIL(m.monitors[0].at.member = "z"), "/model/monitors/0/at/member",
     "unknown_reference"},
    {"MonitorFractionNan", SPOIL(m.monitors[0].at.fraction = kNan), "/model/monitors/0/at/fraction",
     "out_of_range"},
    {"MonitorNormalAtNode", SPOIL(m.monitors[1].component = Component::normal), "/model/monitors/1/component",
     "needs_member"},
};
INSTANTIATE_TEST_SUITE_P(Action, CheckRule, ::testing::ValuesIn(kActionCases), case_name);

const Case kAnalysisCases[] = {
    {"ModesZero", SPOIL(a.modes = 0), "/analysis/modes", "out_of_range"},
    {"LoadFactorsEmpty", SPOIL(a.load_factors.clear()), "/analysis/load_factors", "empty"},
    {"LoadFactorNan", SPOIL(a.load_factors = {1.0, kNan}), "/analysis/load_factors/1", "out_of_range"},
    {"AccuracyZero", SPOIL(a.discretization = {}; a.discretization.accuracy = 0.0),
     "/analysis/discretization/accuracy", "out_of_range"},
    {"AccuracyAboveHalf", SPOIL(a.discretization = {}; a.discretization.accuracy = 0.6),
     "/analysis/discretization/accuracy", "out_of_range"},
    {"ElementsZero", SPOIL(a.discretization.elements = 0; a.discretization.member_elements = {{"ab", 4}}),
     "/analysis/discretization/elements", "missing_field"},
    {"ElementsNegative", SPOIL(a.discretization.elements = -4), "/analysis/discretization/elements",
     "out_of_range"},
    {"ElementsTooMany", SPOIL(a.discretization.elements = kMaxElementsPerMember + 1),
     "/analysis/discretization/elements", "out_of_range"},
    {"ElementsMemberUnknown", SPOIL(a.discretization.member_elements = {{"z/1", 4}}),
     "/analysis/discretization/elements/z~11", "unknown_reference"},
    {"ElementsMemberZero", SPOIL(a.discretization.member_elements = {{"ab", 0}}),
     "/analysis/discretization/elements/ab", "out_of_range"},
    {"OrderZero", SPOIL(a.discretization.order = 0), "/analysis/discretization/order", "out_of_range"},
    {"OrderTooHigh", SPOIL(a.discretization.order = kMaxOrder + 1), "/analysis/discretization/order",
     "out_of_range"},
    {"ControlMonitorUnknown", SPOIL(a.control = {ControlType::displacement, "z"}),
     "/analysis/control/displacement", "unknown_reference"},
    {"StepInitialZero", SPOIL(a.step.initial = 0.0), "/analysis/step/initial", "out_of_range"},
    {"StepMinNegative", SPOIL(a.step.min = -1.0), "/analysis/step/min", "out_of_range"},
    {"StepMaxInfinite", SPOIL(a.step.max = kInf), "/analysis/step/max", "out_of_range"},
    {"StepMinAboveInitial", SPOIL(a.step.min = 0.15), "/analysis/step", "out_of_range"},
    {"StepInitialAboveMax", SPOIL(a.step.initial = 0.3), "/analysis/step", "out_of_range"},
    {"StepMinAboveMax", SPOIL(a.step.initial.reset(); a.step.min = 0.3), "/analysis/step", "out_of_range"},
    {"StopLimitPointsZero", SPOIL(a.stop.limit_points = 0), "/analysis/stop/limit_points", "out_of_range"},
    {"StopStepsZero", SPOIL(a.stop.steps = 0), "/analysis/stop/steps", "out_of_range"},
    {"StopNegativeEigenvaluesBelowZero", SPOIL(a.stop.negative_eigenvalues = -1),
     "/analysis/stop/negative_eigenvalues", "out_of_range"},
    {"StepDirectionZero", SPOIL(a.step.direction = 0.0), "/analysis/step/direction", "out_of_range"},
    {"StepDirectionTwo", SPOIL(a.step.direction = -2.0), "/analysis/step/direction", "out_of_range"},
    {"StopLoadFactorReversed", SPOIL(a.stop.load_factor = {2.0, 1.0}), "/analysis/stop/load_factor",
     "out_of_range"},
    {"StopMonitorUnknown", SPOIL(a.stop.monitor->id = "z"), "/analysis/stop/monitor/id", "unknown_reference"},
    {"StopMonitorRangeEmpty", SPOIL(a.stop.monitor->range = {1.0, 1.0}), "/analysis/stop/monitor/range",
     "out_of_range"},
    {"BranchLimitZero", SPOIL(a.branches.limit = 0), "/analysis/branches/limit", "out_of_range"},
    {"OutputEveryZero", SPOIL(a.output.states = StateOutput::every; a.output.every = 0),
     "/analysis/output/states/every", "out_of_range"},
    {"OutputFactorsEmpty", SPOIL(a.output.states = StateOutput::at_load_factors),
     "/analysis/output/states/at_load_factors", "empty"},
    {"OutputFactorsNotThoseOfTheAnalysis",
     SPOIL(a.type = AnalysisType::static_; a.load_factors = {0.5, 1.0};
           a.output.states = StateOutput::at_load_factors; a.output.at_load_factors = {1.0, 0.75}),
     "/analysis/output/states/at_load_factors/1", "unknown_reference"},
    {"OutputPathPointsOne", SPOIL(a.output.path_points = 1), "/analysis/output/path_points", "out_of_range"},
    {"OutputPathPointsTooMany", SPOIL(a.output.path_points = kMaxPathPoints + 1),
     "/analysis/output/path_points", "out_of_range"},
    {"OutputPointsOne", SPOIL(a.output.points_per_member = 1), "/analysis/output/points_per_member",
     "out_of_range"},
    {"OutputPointsTooMany", SPOIL(a.output.points_per_member = kMaxPointsPerMember + 1),
     "/analysis/output/points_per_member", "out_of_range"},
};
INSTANTIATE_TEST_SUITE_P(Analysis, CheckRule, ::testing::ValuesIn(kAnalysisCases), case_name);

TEST(Check, SoundRequestHasNoFindings) {
  const auto [model, analysis] = testing::sound_request();
  EXPECT_THAT(check(model, analysis), IsEmpty());
}

TEST(Check, EmptyModelNamesWhatIsMissing) {
  EXPECT_THAT(check_rules({}, {}),
              ElementsAre(is_finding("/model/nodes", "empty"), is_finding("/model/sections", "empty"),
                          is_finding("/model/members", "empty"), is_finding("/model/loads", "no_load")));
}

TEST(Check, TwoMistakesGiveTwoFindingsInDocumentOrder) {
  auto [model, analysis] = testing::sound_request();
  model.sections[0].EI = -1.0;
  model.members[1].end = "nowhere";
  EXPECT_THAT(check(model, analysis), ElementsAre(is_finding("/model/sections/0/EI", "out_of_range"),
                                                  is_finding("/model/members/1/end", "unknown_reference")));
}

TEST(Check, StaticNeedsNoLoad) {
  auto [model, analysis] = testing::sound_request();
  model.loads.clear();
  analysis.type = AnalysisType::static_;
  EXPECT_THAT(check_rules(model, analysis), IsEmpty());
}

TEST(Check, PrescribedDisplacementAloneIsALoad) {
  auto [model, analysis] = testing::sound_request();
  model.loads.clear();
  model.supports[1].displacement = {0.0, 0.1, 0.0, Pattern::proportional};
  EXPECT_THAT(check_rules(model, analysis), IsEmpty());
}

TEST(Check, ShortMembersOfALargeModelAreNotZero) {
  auto [model, analysis] = testing::sound_request();
  model.nodes[1].x = 1e-6;
  EXPECT_THAT(check_rules(model, analysis), IsEmpty());
  constexpr double kMegametre = 1e-6;  // the same with lengths in other units
  for (Node& node : model.nodes) {
    node.x *= kMegametre;
  }
  model.sections[0].EI *= kMegametre * kMegametre;
  model.springs[0].stiffness /= kMegametre;
  model.springs[0].gap *= kMegametre;
  model.foundations[0].stiffness /= kMegametre * kMegametre;
  model.foundations[0].gap *= kMegametre;
  EXPECT_THAT(check_rules(model, analysis), IsEmpty());
}

TEST(Check, DetailNamesTheFieldAndTheValue) {
  auto [model, analysis] = testing::sound_request();
  model.sections[0].EI = -2.5;
  const auto findings = check(model, analysis);
  ASSERT_EQ(findings.size(), 1U);
  EXPECT_EQ(findings[0].detail, "EI must be positive and finite, got -2.5");
}

TEST(Check, LongIdsAreShortenedBetweenCharacters) {
  auto [model, analysis] = testing::sound_request();
  std::string id = "x";
  for (int i = 0; i < 40; ++i) {
    id += "\u00e9";  // two bytes: byte 60 falls inside one
  }
  model.members[0].section = id;
  const auto findings = check(model, analysis);
  ASSERT_EQ(findings.size(), 1U);
  EXPECT_EQ(findings[0].detail, "there is no section \"" + id.substr(0, 59) + "...\"");
}

TEST(Check, TotalElementsAreBounded) {
  auto [model, analysis] = testing::sound_request();
  for (int i = 0; i < 10; ++i) {
    model.members.push_back({"m" + std::to_string(i), "a", "c", "steel", {}});
  }
  analysis.discretization.elements = kMaxElementsPerMember;
  EXPECT_THAT(check_rules(model, analysis),
              ElementsAre(is_finding("/analysis/discretization/elements", "too_many")));
}

// The points near the origin are one place for a spline that reaches 1e150: its equations were singular, and
// the check crashed.
TEST(Check, PointsOfSplinesBelongToTheExtent) {
  auto [model, analysis] = testing::sound_request();
  use_curve(model, PointsCurve{{{-1e150, 22.0}, {8.4, -47.6}, {-2.7, 10.9}, {36.8, 0.5}}});
  const std::vector<Finding> findings = check_rules(model, analysis);
  EXPECT_THAT(findings, ::testing::Contains(is_finding("/model/members/0", "zero_length")));
}

/// Both members are hinged at b, where nothing has the node's rotation.
testing::SoundRequest request_with_hinge() {
  auto request = testing::sound_request();
  request.model.members[0].release_end_rotation = true;
  request.model.members[1].release_start_rotation = true;
  request.model.springs[0] = {"s1", {"b", "", 0.0}, {{0.0, 1.0}}, 5.0, Reaction::bilateral, 0.0};
  request.model.monitors.push_back({"turn", {"b", "", 0.0}, Component::rotation});
  return request;
}

/// Such a monitor was 0 without a word.
TEST(Check, RotationOfANodeWhereAllMembersAreHingedIsRefused) {
  const auto [model, analysis] = request_with_hinge();
  const auto findings = check(model, analysis);
  ASSERT_THAT(findings, ElementsAre(is_finding("/model/monitors/2/component", "needs_member")));
  EXPECT_EQ(
      findings[0].detail,
      "node \"b\" has no rotation: members \"ab\", \"bc\" are hinged there, and no support or rotational "
      "spring turns with it; component rotation needs a location on a member here");
}

TEST(Check, RotationOfANodeIsWatchedWhereSomethingTurnsWithIt) {
  auto request = request_with_hinge();
  request.model.monitors[2].at = {"", "ab", 1.0};
  EXPECT_THAT(check(request.model, request.analysis), IsEmpty()) << "a member's end turns";
  request = request_with_hinge();
  request.model.monitors[2].component = Component::y;
  EXPECT_THAT(check(request.model, request.analysis), IsEmpty()) << "the node moves";
  request = request_with_hinge();
  request.model.members[1].release_start_rotation = false;
  EXPECT_THAT(check(request.model, request.analysis), IsEmpty()) << "a member is not hinged";
  request = request_with_hinge();
  request.model.springs.push_back({"turning", {"b", "", 0.0}, {}, 1.0, Reaction::bilateral, 0.0});
  EXPECT_THAT(check(request.model, request.analysis), IsEmpty()) << "a spring turns";
  request.model.springs.back().stiffness = 0.0;
  EXPECT_THAT(check(request.model, request.analysis),
              ElementsAre(is_finding("/model/monitors/2/component", "needs_member")))
      << "a spring without stiffness is left out";
  request = request_with_hinge();
  request.model.supports.push_back({"b", false, false, true, 0.0, {}});
  EXPECT_THAT(check(request.model, request.analysis), IsEmpty()) << "a support holds it";
}

/// Contact under the opposite load is another, which a linearised analysis does not know.
TEST(Check, ReversedLoadNeedsBilateralSupports) {
  auto [model, analysis] = testing::sound_request();
  analysis.type = AnalysisType::buckling;
  analysis.reversed = true;
  EXPECT_THAT(check(model, analysis), ElementsAre(is_finding("/analysis/reversed", "unsupported")));
  model.springs[0].reaction = Reaction::bilateral;
  model.springs[0].gap = 0.0;
  EXPECT_THAT(check(model, analysis), ElementsAre(is_finding("/analysis/reversed", "unsupported")));
  model.foundations[0].reaction = Reaction::bilateral;
  model.foundations[0].gap = 0.0;
  EXPECT_THAT(check(model, analysis), IsEmpty());
  auto path = testing::sound_request();
  path.analysis.reversed = true;
  EXPECT_THAT(check(path.model, path.analysis), IsEmpty()) << "it does not concern a path";
}

TEST(Check, StatePointsAreBounded) {
  auto [model, analysis] = testing::sound_request();
  for (int i = 0; i < 30; ++i) {
    model.members.push_back({"m" + std::to_string(i), "a", "c", "steel", {}});
  }
  analysis.output.points_per_member = kMaxPointsPerMember;
  EXPECT_THAT(check_rules(model, analysis),
              ElementsAre(is_finding("/analysis/output/points_per_member", "too_many")));
}

/// Rules that ask for the stiffness of a law meet it before its own rules have refused it.
TEST(Check, RefusesTablesWithoutPointsWhereverTheirStiffnessIsAskedFor) {
  for (const std::vector<std::array<double, 2>>& points :
       {std::vector<std::array<double, 2>>{}, {{0.0, 0.0}}, {{0.0, 1.0}}}) {
    auto [model, analysis] = testing::sound_request();
    analysis.type = AnalysisType::buckling;
    analysis.reversed = true;
    ReactionLaw law;
    law.type = ReactionLaw::Type::table;
    law.points = points;
    Foundation base;
    base.id = "table";
    base.member = model.members[0].id;
    base.reaction = Reaction::compression_only;
    base.law = law;
    model.foundations = {base};
    Spring spring;
    spring.id = "law";
    spring.at = {model.nodes[0].id, "", 0.0};
    spring.direction = {{0.0, 1.0}};
    spring.law = law;
    model.springs = {spring};
    const std::vector<Finding> findings = check(model, analysis);
    EXPECT_TRUE(std::any_of(findings.begin(), findings.end(), [](const Finding& finding) {
      return finding.pointer.starts_with("/model/foundations/0/law/points");
    }));
  }
}

}  // namespace
}  // namespace snapthrough
