/// What is refused, with which pointer and code: a sound document with one value put in, and the one finding
/// it gives.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <random>
#include <string>

#include "api/api.h"
#include "tests/api/documents.h"
#include "tests/findings.h"

namespace snapthrough::api {
namespace {

using nlohmann::json;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using testing::is_finding;
using ::testing::IsEmpty;
using ::testing::SizeIs;
using ::testing::UnorderedElementsAre;

json sound() { return json::parse(testing::sound_document()); }

/// Findings, apart from those that something is not implemented yet.
std::vector<Finding> findings_of(const json& document) {
  std::vector<Finding> findings = read_request(document.dump()).findings;
  std::erase_if(findings, [](const Finding& f) { return f.code == "unsupported"; });
  return findings;
}

TEST(ReadRequest, SoundDocumentIsARequest) {
  const ReadOutcome outcome = read_request(testing::sound_document());
  EXPECT_FALSE(outcome.malformed);
  EXPECT_THAT(outcome.findings, IsEmpty());
  ASSERT_TRUE(outcome.request.has_value());
  EXPECT_EQ(outcome.request->model.title, "beam");
  EXPECT_EQ(outcome.request->analysis.discretization.elements, 8);
  EXPECT_EQ(*outcome.request->document, sound());
}

TEST(ReadRequest, DocumentInMemoryIsReadTheSame) {
  const auto document = std::make_shared<const json>(sound());
  const ReadOutcome outcome = read_request_document(document);
  ASSERT_TRUE(outcome.request.has_value());
  EXPECT_EQ(outcome.request->document, document);
}

TEST(ReadRequest, SensitivitiesAreNumbersOfTheModel) {
  json document = sound();
  document["analysis"]["sensitivities"] = {"/model/nodes/1/x", "/model/foundations/0/stiffness"};
  const ReadOutcome outcome = read_request(document.dump());
  ASSERT_TRUE(outcome.request.has_value());
  const std::vector<Variation>& variations = outcome.request->analysis.sensitivities;
  ASSERT_THAT(variations, SizeIs(2));
  EXPECT_EQ(variations[0].pointer, "/model/nodes/1/x");
  EXPECT_EQ(variations[0].value, 2.0);
  EXPECT_EQ(variations[0].model_at(2.5)->nodes[1].x, 2.5);
  EXPECT_EQ(variations[1].model_at(4.0)->foundations[0].stiffness, 4.0);
  EXPECT_EQ(variations[1].model_at(-1.0), std::nullopt) << "a stiffness is not negative";
}

TEST(ReadRequest, SensitivitiesSayWhatTheyCannotBe) {
  json document = sound();
  document["analysis"]["sensitivities"] = {"/analysis/stop/steps",
                                           "no pointer",
                                           "/model/nodes/7/x",
                                           "/model/foundations/0/gap",
                                           "/model/nodes/0/id",
                                           "/model/loads/0/force",
                                           "/model/imperfections/0/half_waves",
                                           "/model/monitors/0/at/fraction",
                                           3};
  const std::string at = "/analysis/sensitivities/";
  EXPECT_THAT(
      findings_of(document),
      UnorderedElementsAre(is_finding(at + "0", "invalid_pointer"), is_finding(at + "1", "invalid_pointer"),
                           is_finding(at + "2", "no_such_place"), is_finding(at + "3", "no_such_place"),
                           is_finding(at + "4", "not_supported"), is_finding(at + "5", "not_supported"),
                           is_finding(at + "6", "not_supported"), is_finding(at + "7", "not_supported"),
                           is_finding(at + "8", "wrong_type")));
}

TEST(ReadRequest, MalformedTextIsNotARequest) {
  const ReadOutcome outcome = read_request("{\"model\": ");
  EXPECT_TRUE(outcome.malformed);
  EXPECT_THAT(outcome.findings, ElementsAre(is_finding("/model", "malformed")));
  EXPECT_FALSE(outcome.request.has_value());
}

TEST(ReadRequest, WrongRequestIsNotMalformed) {
  const ReadOutcome outcome = read_request("[]");
  EXPECT_FALSE(outcome.malformed);
  EXPECT_THAT(outcome.findings, ElementsAre(is_finding("", "wrong_type")));
  EXPECT_FALSE(outcome.request.has_value());
}

TEST(ReadRequest, EmptyObjectNamesBothHalves) {
  EXPECT_THAT(read_request("{}").findings,
              ElementsAre(is_finding("/model", "missing_field"), is_finding("/analysis", "missing_field")));
}

struct Case {
  const char* name;
  const char* at;     ///< where the value is put in
  const char* value;  ///< JSON, or empty to take away what is there
  const char* pointer;
  const char* code;
};
void PrintTo(const Case& c, std::ostream* out) { *out << c.name; }

class ReadRequestRefuses : public ::testing::TestWithParam<Case> {};

TEST_P(ReadRequestRefuses, WithItsFindingAndNoOther) {
  json document = sound();
  const json::json_pointer at(GetParam().at);
  if (*GetParam().value == '\0') {
    document.at(at.parent_pointer()).erase(at.back());
  } else {
    document[at] = json::parse(GetParam().value);
  }
  EXPECT_THAT(findings_of(document), ElementsAre(is_finding(GetParam().pointer, GetParam().code)));
}

const Case kCases[] = {
    {"UnknownAtTop", "/modle", "{}", "/modle", "unknown_field"},
    {"ModelNotObject", "/model", "[]", "/model", "wrong_type"},
    {"AnalysisMissing", "/analysis", "", "/analysis", "missing_field"},
    {"TitleNumber", "/model/title", "1", "/model/title", "wrong_type"},
    {"UnitsArray", "/model/units", "[]", "/model/units", "wrong_type"},
    {"UnitsNumber", "/model/units", R"({"length": 1})", "/model/units/length", "wrong_type"},
    {"NodesMissing", "/model/nodes", "", "/model/nodes", "missing_field"},
    {"NodesObject", "/model/nodes", "{}", "/model/nodes", "wrong_type"},
    {"NodeNull", "/model/nodes/1", "null", "/model/nodes/1", "wrong_type"},
    {"NodeXMissing", "/model/nodes/1/x", "", "/model/nodes/1/x", "missing_field"},
    {"NodeXString", "/model/nodes/1/x", "\"2\"", "/model/nodes/1/x", "wrong_type"},
    {"NodeIdNumber", "/model/nodes/0/id", "7", "/model/nodes/0/id", "wrong_type"},
    {"NodeIdMissing", "/model/nodes/0/id", "", "/model/nodes/0/id", "missing_field"},
    {"NodeUnknownField", "/model/nodes/0/z", "0", "/model/nodes/0/z", "unknown_field"},
    {"EscapedPointer", "/model/nodes/0/a~1b~0c", "0", "/model/nodes/0/a~1b~0c", "unknown_field"},
    {"SectionEmpty", "/model/sections/0", R"({"id": "steel", "EA": 1})", "/model/sections/0/EI",
     "missing_field"},
    {"SectionIdMissing", "/model/sections/0/id", "", "/model/sections/0/id", "missing_field"},
    {"SectionNegativeEI", "/model/sections/0/EI", "-10", "/model/sections/0/EI", "out_of_range"},
    {"SectionBothForms", "/model/sections/0", R"({"id": "steel", "EA": 1, "EI": 1, "E": 1, "A": 1, "I": 1})",
     "/model/sections/0", "ambiguous"},
    {"SectionNoI", "/model/sections/0", R"({"id": "steel", "E": 1, "A": 1})", "/model/sections/0/I",
     "missing_field"},
    {"SectionENegative", "/model/sections/0", R"({"id": "steel", "E": -1, "A": 1, "I": 1})",
     "/model/sections/0/E", "out_of_range"},
    {"SectionAreaZero", "/model/sections/0", R"({"id": "steel", "E": 1, "A": 0, "I": 1})",
     "/model/sections/0/A", "out_of_range"},
    {"SectionShearWithoutNu", "/model/sections/0",
     R"({"id": "steel", "E": 1, "A": 1, "I": 1, "shear_area": 1})", "/model/sections/0/nu", "missing_field"},
    {"SectionShearAreaZero", "/model/sections/0",
     R"({"id": "steel", "E": 1, "A": 1, "I": 1, "nu": 0.3, "shear_area": 0})", "/model/sections/0/shear_area",
     "out_of_range"},
    {"SectionNuTooHigh", "/model/sections/0", R"({"id": "steel", "E": 1, "A": 1, "I": 1, "nu": 0.6})",
     "/model/sections/0/nu", "out_of_range"},
    {"SectionNuMinusOne", "/model/sections/0",
     R"({"id": "steel", "E": 1, "A": 1, "I": 1, "nu": -1, "shear_area": 1})", "/model/sections/0/nu",
     "out_of_range"},
    {"SectionProductOverflows", "/model/sections/0", R"({"id": "steel", "E": 1e100, "A": 1e100, "I": 1})",
     "/model/sections/0", "out_of_range"},
    {"SectionTableWithEI", "/model/sections/0",
     R"({"id": "steel", "EA": 1, "EI": 1, "bending": {"law": {"type": "table", "points": [[1, 1]]}}})",
     "/model/sections/0/EI", "ambiguous"},
    {"SectionPowerWithoutEI", "/model/sections/0",
     R"({"id": "steel", "EA": 1, "bending": {"law": {"type": "ramberg_osgood", "moment": 1, "exponent": 3}}})",
     "/model/sections/0/EI", "missing_field"},
    {"SectionPowerOfATaper", "/model/sections/0",
     R"({"id": "steel", "EA": 1, "EI": {"along": [[0, 1], [1, 2]]}, "bending": {"law": {"type": "ramberg_osgood", "moment": 1, "exponent": 3}}})",
     "/model/sections/0/bending", "not_supported"},
    {"SectionPowerTooLow", "/model/sections/0",
     R"({"id": "steel", "EA": 1, "EI": 1, "bending": {"law": {"type": "ramberg_osgood", "moment": 1, "exponent": 1.5}}})",
     "/model/sections/0/bending/law/exponent", "out_of_range"},
    {"SectionBendsByAnUnknownLaw", "/model/sections/0",
     R"({"id": "steel", "EA": 1, "EI": 1, "bending": {"law": {"type": "tanh", "moment": 1}}})",
     "/model/sections/0/bending/law/type", "unknown_value"},
    {"SectionBendsWithoutLaw", "/model/sections/0", R"({"id": "steel", "EA": 1, "EI": 1, "bending": {}})",
     "/model/sections/0/bending/law", "missing_field"},
    {"SectionTableWithoutPoints", "/model/sections/0",
     R"({"id": "steel", "EA": 1, "bending": {"law": {"type": "table", "points": [[0, 0]]}}})",
     "/model/sections/0/bending/law/points", "empty"},
    {"SectionTableGoesBack", "/model/sections/0",
     R"({"id": "steel", "EA": 1, "bending": {"law": {"type": "table", "points": [[1, 1], [0.5, 2]]}}})",
     "/model/sections/0/bending/law/points/1/0", "not_increasing"},
    {"SectionTableWithAPlateau", "/model/sections/0",
     R"({"id": "steel", "EA": 1, "bending": {"law": {"type": "table", "points": [[1, 1], [2, 1]]}}})",
     "/model/sections/0/bending/law/points/1/1", "out_of_range"},
    {"SectionTableBetweenUnknownLines", "/model/sections/0",
     R"({"id": "steel", "EA": 1, "bending": {"law": {"type": "table", "points": [[1, 1]], "interpolation": "cubic"}}})",
     "/model/sections/0/bending/law/interpolation", "unknown_value"},
    {"MemberStartMissing", "/model/members/0/start", "", "/model/members/0/start", "missing_field"},
    {"MemberSectionUnknown", "/model/members/0/section", "\"wood\"", "/model/members/0/section",
     "unknown_reference"},
    {"MemberZeroLength", "/model/nodes/1/x", "0", "/model/members/0", "zero_length"},
    {"CurveTypeMissing", "/model/members/0/curve", "{}", "/model/members/0/curve/type", "missing_field"},
    {"CurveTypeUnknown", "/model/members/0/curve", R"({"type": "arch", "x": 1})",
     "/model/members/0/curve/type", "unknown_value"},
    {"CurveString", "/model/members/0/curve", "\"line\"", "/model/members/0/curve", "wrong_type"},
    {"LineWithRise", "/model/members/0/curve", R"({"type": "line", "rise": 1})",
     "/model/members/0/curve/rise", "unknown_field"},
    {"ArcSweepMissing", "/model/members/0/curve", R"({"type": "arc"})",
     "/model/members/0/curve/sweep_degrees", "missing_field"},
    {"ArcSweepTooLarge", "/model/members/0/curve", R"({"type": "arc", "sweep_degrees": 400})",
     "/model/members/0/curve/sweep_degrees", "out_of_range"},
    {"ParabolaRiseMissing", "/model/members/0/curve", R"({"type": "parabola"})",
     "/model/members/0/curve/rise", "missing_field"},
    {"SineHalfWavesFraction", "/model/members/0/curve", R"({"type": "sine", "rise": 1, "half_waves": 1.5})",
     "/model/members/0/curve/half_waves", "wrong_type"},
    {"SplinePointOfThree", "/model/members/0/curve", R"({"type": "points", "points": [[1, 2, 3]]})",
     "/model/members/0/curve/points/0", "wrong_type"},
    {"ReleaseUnknownEnd", "/model/members/0/release", R"({"middle": []})", "/model/members/0/release/middle",
     "unknown_field"},
    {"ReleaseUnknownName", "/model/members/0/release", R"({"start": ["x"]})",
     "/model/members/0/release/start/0", "unknown_value"},
    {"ReleaseAxial", "/model/members/0/release", R"({"start": ["rotation", "axial"]})",
     "/model/members/0/release/start/1", "unknown_value"},
    {"ReleaseShearStiffness", "/model/members/0/release", R"({"end": {"shear": 5}})",
     "/model/members/0/release/end/shear", "unknown_field"},
    {"ReleaseLawMissing", "/model/members/0/release", R"({"end": {"rotation": {}}})",
     "/model/members/0/release/end/rotation/law", "missing_field"},
    {"ReleaseLawUnknownType", "/model/members/0/release",
     R"({"end": {"rotation": {"law": {"type": "sine"}}}})", "/model/members/0/release/end/rotation/law/type",
     "unknown_value"},
    {"SpringLawUnknownType", "/model/springs/0",
     R"({"id": "k0", "at": {"node": "b"}, "direction": [0, 1], "law": {"type": "sine"}})",
     "/model/springs/0/law/type", "unknown_value"},
    {"ReleaseLawVaries", "/model/members/0/release",
     R"({"end": {"rotation": {"law": {"type": "tanh", "stiffness": 5, "capacity": {"along": [[0, 1], [1, 2]]}}}}})",
     "/model/members/0/release/end/rotation/law/capacity", "not_supported"},
    {"ReleaseTwice", "/model/members/0/release", R"({"end": ["rotation", "rotation"]})",
     "/model/members/0/release/end/1", "duplicate"},
    {"SupportFixedMissing", "/model/supports/0/fixed", "", "/model/supports/0/fixed", "missing_field"},
    {"SupportFixedString", "/model/supports/0/fixed", "\"x\"", "/model/supports/0/fixed", "wrong_type"},
    {"SupportFixedUnknown", "/model/supports/0/fixed/1", "\"z\"", "/model/supports/0/fixed/1",
     "unknown_value"},
    {"SupportFixedTwice", "/model/supports/0/fixed", R"(["x", "y", "x"])", "/model/supports/0/fixed/2",
     "duplicate"},
    {"SupportNodeUnknown", "/model/supports/0/node", "\"q\"", "/model/supports/0/node", "unknown_reference"},
    {"SupportAngleString", "/model/supports/0/angle_degrees", "\"30\"", "/model/supports/0/angle_degrees",
     "wrong_type"},
    {"DisplacementUnknownField", "/model/supports/0/displacement", R"({"x": 0, "z": 1})",
     "/model/supports/0/displacement/z", "unknown_field"},
    {"DisplacementNotFixed", "/model/supports/0/displacement", R"({"rotation": 1})",
     "/model/supports/0/displacement/rotation", "not_fixed"},
    {"PatternWithoutDisplacement", "/model/supports/0/pattern", "\"constant\"", "/model/supports/0/pattern",
     "missing_field"},
    {"SpringDirectionName", "/model/springs/0/direction", "\"normal\"", "/model/springs/0/direction",
     "unknown_value"},
    {"SpringDirectionNumber", "/model/springs/0/direction", "3", "/model/springs/0/direction", "wrong_type"},
    {"SpringDirectionZero", "/model/springs/0/direction", "[0, 0]", "/model/springs/0/direction",
     "zero_direction"},
    {"SpringAtMissing", "/model/springs/0/at", "", "/model/springs/0/at", "missing_field"},
    {"SpringAtBoth", "/model/springs/0/at", R"({"node": "a", "member": "ab", "fraction": 0})",
     "/model/springs/0/at", "ambiguous"},
    {"SpringAtNothing", "/model/springs/0/at", "{}", "/model/springs/0/at", "missing_field"},
    {"SpringAtNodeFraction", "/model/springs/0/at", R"({"node": "a", "fraction": 0})",
     "/model/springs/0/at/fraction", "unknown_field"},
    {"SpringAtNoFraction", "/model/springs/0/at", R"({"member": "ab"})", "/model/springs/0/at/fraction",
     "missing_field"},
    {"SpringReaction", "/model/springs/0/reaction", "\"compression\"", "/model/springs/0/reaction",
     "unknown_value"},
    {"FoundationStiffnessMissing", "/model/foundations/0/stiffness", "", "/model/foundations/0/stiffness",
     "missing_field"},
    {"FoundationSideUnknown", "/model/foundations/0/side", "\"outside\"", "/model/foundations/0/side",
     "unknown_value"},
    {"FoundationSideAndDirection", "/model/foundations/0",
     R"({"id": "f", "member": "ab", "stiffness": 1, "side": "left", "direction": [0, 1]})",
     "/model/foundations/0/side", "ambiguous"},
    {"FoundationRigidBilateral", "/model/foundations/0",
     R"({"id": "f", "member": "ab", "stiffness": "rigid"})", "/model/foundations/0/stiffness",
     "needs_one_sided"},
    {"FoundationStiffnessNamed", "/model/foundations/0/stiffness", "\"stiff\"",
     "/model/foundations/0/stiffness", "unknown_value"},
    {"FoundationGapsDescend", "/model/foundations/0",
     R"({"id": "f", "member": "ab", "stiffness": 1, "reaction": "compression_only",
         "gap": {"along": [[0.5, 0.1], [0.4, 0]]}})",
     "/model/foundations/0/gap/along/1/0", "not_increasing"},
    {"OutlinePulls", "/model/foundations/0",
     R"({"id": "f", "member": "ab", "stiffness": 1, "reaction": "tension_only",
         "outline": {"type": "line", "through": [0, 0], "into": [0, -1]}})",
     "/model/foundations/0/outline", "not_supported"},
    {"OutlineAndSide", "/model/foundations/0",
     R"({"id": "f", "member": "ab", "stiffness": 1, "reaction": "compression_only", "side": "left",
         "outline": {"type": "line", "through": [0, 0], "into": [0, -1]}})",
     "/model/foundations/0/outline", "ambiguous"},
    {"OutlineCircleNoRadius", "/model/foundations/0",
     R"({"id": "f", "member": "ab", "stiffness": 1, "reaction": "compression_only",
         "outline": {"type": "circle", "center": [0, 0], "radius": 0, "medium": "outside"}})",
     "/model/foundations/0/outline/radius", "out_of_range"},
    {"OutlineCornerTooRound", "/model/foundations/0",
     R"({"id": "f", "member": "ab", "stiffness": 1, "reaction": "compression_only",
         "outline": {"type": "polyline", "points": [[0, 0], [1, 0], [1, 1]], "rounding": 1.5, "medium": "left"}})",
     "/model/foundations/0/outline/rounding", "out_of_range"},
    {"OutlinePointTwice", "/model/foundations/0",
     R"({"id": "f", "member": "ab", "stiffness": 1, "reaction": "compression_only",
         "outline": {"type": "spline", "points": [[0, 0], [1, 0], [1, 0]], "medium": "left"}})",
     "/model/foundations/0/outline/points/2", "coincident_points"},
    {"FoundationRangeOne", "/model/foundations/0/range", "[0.5]", "/model/foundations/0/range", "wrong_type"},
    {"FoundationRangeReversed", "/model/foundations/0/range", "[0.5, 0.4]", "/model/foundations/0/range",
     "out_of_range"},
    {"FoundationGapString", "/model/foundations/0/gap", "\"0\"", "/model/foundations/0/gap", "wrong_type"},
    {"LoadTypeMissing", "/model/loads/0/type", "", "/model/loads/0/type", "missing_field"},
    {"LoadTypeUnknown", "/model/loads/0/type", "\"points\"", "/model/loads/0/type", "unknown_value"},
    {"LoadForceMissing", "/model/loads/0/force", "", "/model/loads/0/force", "missing_field"},
    {"LoadForceText", "/model/loads/0/force", R"([0, "1"])", "/model/loads/0/force/1", "wrong_type"},
    {"LoadPattern", "/model/loads/0/pattern", "\"dead\"", "/model/loads/0/pattern", "unknown_value"},
    {"LoadMemberOfPoint", "/model/loads/0/member", "\"ab\"", "/model/loads/0/member", "unknown_field"},
    {"LoadPer", "/model/loads/1",
     R"({"type": "distributed", "member": "ab", "force": [0, 1], "per": "span"})", "/model/loads/1/per",
     "unknown_value"},
    {"PressureValueMissing", "/model/loads/1", R"({"type": "pressure", "member": "ab"})",
     "/model/loads/1/value", "missing_field"},
    {"StrainMemberMissing", "/model/loads/1", R"({"type": "initial_strain", "axial": 1})",
     "/model/loads/1/member", "missing_field"},
    {"ImperfectionType", "/model/imperfections/0/type", "\"cosine\"", "/model/imperfections/0/type",
     "unknown_value"},
    {"ImperfectionHalfWavesText", "/model/imperfections/0/half_waves", "\"1\"",
     "/model/imperfections/0/half_waves", "wrong_type"},
    {"ModeNumberMissing", "/model/imperfections/0", R"({"type": "mode", "amplitude": 1})",
     "/model/imperfections/0/number", "missing_field"},
    {"OffsetsMissing", "/model/imperfections/0", R"({"type": "points", "member": "ab"})",
     "/model/imperfections/0/offsets", "missing_field"},
    {"MonitorComponent", "/model/monitors/0/component", "\"z\"", "/model/monitors/0/component",
     "unknown_value"},
    {"MonitorFraction", "/model/monitors/0/at/fraction", "1.25", "/model/monitors/0/at/fraction",
     "out_of_range"},
    {"TypeMissing", "/analysis/type", "", "/analysis/type", "missing_field"},
    {"TypeUnknown", "/analysis/type", "\"paths\"", "/analysis/type", "unknown_value"},
    {"ModesWraps", "/analysis/modes", "4294967297", "/analysis/modes", "out_of_range"},
    {"ModesHuge", "/analysis/modes", "1e300", "/analysis/modes", "out_of_range"},
    {"ModesUnsigned", "/analysis/modes", "18446744073709551615", "/analysis/modes", "out_of_range"},
    {"ModesTrue", "/analysis/modes", "true", "/analysis/modes", "wrong_type"},
    {"LoadFactorsNumber", "/analysis/load_factors", "1", "/analysis/load_factors", "wrong_type"},
    {"Geometry", "/analysis/geometry", "\"cubic\"", "/analysis/geometry", "unknown_value"},
    {"AccuracyAndMesh", "/analysis/discretization", R"({"accuracy": 1e-3, "elements": 4})",
     "/analysis/discretization", "ambiguous"},
    {"OrderWithoutElements", "/analysis/discretization", R"({"order": 2})",
     "/analysis/discretization/elements", "missing_field"},
    {"ElementsText", "/analysis/discretization/elements", "\"8\"", "/analysis/discretization/elements",
     "wrong_type"},
    {"ElementsFraction", "/analysis/discretization/elements", "8.5", "/analysis/discretization/elements",
     "wrong_type"},
    {"ElementsOfNone", "/analysis/discretization/elements", "{}", "/analysis/discretization/elements",
     "empty"},
    {"ElementsOfStranger", "/analysis/discretization/elements", R"({"ab": 2, "x": 3})",
     "/analysis/discretization/elements/x", "unknown_reference"},
    {"MeshRule", "/analysis/discretization/foundation", "\"lump\"", "/analysis/discretization/foundation",
     "unknown_value"},
    {"ControlName", "/analysis/control", "\"displacement\"", "/analysis/control", "unknown_value"},
    {"ControlNumber", "/analysis/control", "1", "/analysis/control", "wrong_type"},
    {"ControlField", "/analysis/control", R"({"displacement": "mid", "x": 1})", "/analysis/control/x",
     "unknown_field"},
    {"StepText", "/analysis/step", R"({"initial": "small"})", "/analysis/step/initial", "wrong_type"},
    {"StopUnknown", "/analysis/stop/limits", "1", "/analysis/stop/limits", "unknown_field"},
    {"StopMonitorId", "/analysis/stop/monitor", R"({"range": [0, 1]})", "/analysis/stop/monitor/id",
     "missing_field"},
    {"StopSteps", "/analysis/stop/steps", "0", "/analysis/stop/steps", "out_of_range"},
    {"BranchesFollow", "/analysis/branches", R"({"follow": "second"})", "/analysis/branches/follow",
     "unknown_value"},
    {"StatesName", "/analysis/output/states", "\"some\"", "/analysis/output/states", "unknown_value"},
    {"StatesNumber", "/analysis/output/states", "5", "/analysis/output/states", "wrong_type"},
    {"StatesBoth", "/analysis/output/states", R"({"every": 2, "at_load_factors": [1]})",
     "/analysis/output/states", "ambiguous"},
    {"StatesNeither", "/analysis/output/states", "{}", "/analysis/output/states", "missing_field"},
    {"PointsPerMember", "/analysis/output/points_per_member", "1", "/analysis/output/points_per_member",
     "out_of_range"},
};
INSTANTIATE_TEST_SUITE_P(Field, ReadRequestRefuses, ::testing::ValuesIn(kCases),
                         [](const auto& param_info) { return std::string(param_info.param.name); });

TEST(ReadRequest, NegativeStiffnessAndMissingNodeAreBothFound) {
  json document = sound();
  document["model"]["sections"][0]["EI"] = -10;
  document["model"]["members"][0]["end"] = "nowhere";
  EXPECT_THAT(findings_of(document),
              UnorderedElementsAre(is_finding("/model/sections/0/EI", "out_of_range"),
                                   is_finding("/model/members/0/end", "unknown_reference")));
}

TEST(ReadRequest, UnreadableAndOutOfRangeAreBothFound) {
  json document = sound();
  document["model"]["nodes"][0]["x"] = "zero";
  document["model"]["sections"][0]["EI"] = -10;
  document["analysis"]["discretization"]["order"] = 99;
  EXPECT_THAT(findings_of(document),
              ElementsAre(is_finding("/model/nodes/0/x", "wrong_type"),
                          is_finding("/model/sections/0/EI", "out_of_range"),
                          is_finding("/analysis/discretization/order", "out_of_range")));
}

TEST(ReadRequest, UnknownFieldSuggestsTheNearestName) {
  json document = sound();
  document["model"]["members"][0]["curv"] = {{"type", "line"}};
  auto findings = findings_of(document);
  ASSERT_THAT(findings, SizeIs(1));
  EXPECT_THAT(findings[0].detail, HasSubstr("did you mean \"curve\"?"));
  document = sound();
  document["analysis"]["type"] = "criticl";
  findings = findings_of(document);
  ASSERT_THAT(findings, SizeIs(1));
  EXPECT_THAT(findings[0].detail, HasSubstr("did you mean \"critical\"?"));
}

TEST(ReadRequest, UnknownFieldThatResemblesNothingListsWhatIsKnown) {
  json document = sound();
  document["model"]["nodes"][0]["temperature"] = 20;
  const auto findings = findings_of(document);
  ASSERT_THAT(findings, SizeIs(1));
  EXPECT_THAT(findings[0].detail, HasSubstr("known here: id, x, y"));
}

/// Detail of the only finding of a document with one field more.
std::string detail_with_field(const char* pointer, const json& value) {
  json document = sound();
  document[json::json_pointer(pointer)] = value;
  const auto findings = findings_of(document);
  EXPECT_EQ(findings.size(), 1U) << pointer;
  return findings.empty() ? "" : findings.front().detail;
}

/// "reaction" was answered with 'did you mean "section"?'.
TEST(ReadRequest, UnknownFieldOfOtherObjectsNamesThem) {
  EXPECT_EQ(detail_with_field("/model/members/0/gap", 0.1),
            "unknown field \"gap\"; \"gap\" is a field of foundations and springs");
  EXPECT_THAT(detail_with_field("/analysis/steps", 10), HasSubstr("\"steps\" is a field of analysis.stop"));
  EXPECT_THAT(detail_with_field("/model/nodes/0/fixed", json::array({"x"})),
              HasSubstr("\"fixed\" is a field of supports"));
  EXPECT_THAT(detail_with_field("/model/analysis", json::object()),
              HasSubstr("\"analysis\" is a field of the request"));
}

/// "axial" was answered as a field of loads of type "initial_strain".
TEST(ReadRequest, ReleaseOfAxialOrShearForceSaysHowItIsModelled) {
  const char* hint = "only rotation is. An axial or shear release is two nodes at one place with springs";
  EXPECT_THAT(detail_with_field("/model/members/0/release", {{"start", {{"axial", 5.0}}}}), HasSubstr(hint));
  EXPECT_THAT(detail_with_field("/model/members/0/release", {{"start", {"shear"}}}), HasSubstr(hint));
}

/// The moment of a joint is a stiffness or a law.
TEST(ReadRequest, ReleaseByALaw) {
  json document = sound();
  document["model"]["members"][0]["release"] = {
      {"start", {{"rotation", {{"law", {{"type", "tanh"}, {"stiffness", 500.0}, {"capacity", 40.0}}}}}}},
      {"end", {{"rotation", 7.0}}}};
  const ReadOutcome outcome = read_request(document.dump());
  ASSERT_THAT(outcome.findings, IsEmpty());
  const Member& member = outcome.request->model.members[0];
  EXPECT_TRUE(member.release_start_rotation);
  ASSERT_TRUE(member.release_start_law);
  EXPECT_EQ(member.release_start_law->type, ReactionLaw::Type::tanh);
  EXPECT_EQ(member.release_start_law->stiffness.constant, 500.0);
  EXPECT_EQ(member.release_start_law->capacity.constant, 40.0);
  EXPECT_FALSE(member.release_end_law);
  EXPECT_EQ(member.release_end_stiffness, 7.0);
}

/// A form of the same object is named by its type.
TEST(ReadRequest, UnknownFieldOfAnotherFormNamesItsType) {
  json document = sound();
  document["model"]["loads"][0] = {
      {"type", "point"}, {"at", {{"node", "b"}}}, {"force", {0.0, -1.0}}, {"axial", 1e-4}};
  auto findings = findings_of(document);
  ASSERT_THAT(findings, SizeIs(1));
  EXPECT_THAT(findings[0].detail, HasSubstr("is a field of loads of type \"initial_strain\""));
}

/// A name is suggested within two letters and less than half of the word, or where it begins with the word.
TEST(ReadRequest, OnlyNamesThatWereProbablyMeantAreSuggested) {
  EXPECT_THAT(detail_with_field("/analysis/otuput", json::object()), HasSubstr("did you mean \"output\"?"));
  EXPECT_THAT(detail_with_field("/analysis/output/points", 3),
              HasSubstr("did you mean \"points_per_member\"?"));
  EXPECT_THAT(detail_with_field("/analysis/oxpxtx", 1), HasSubstr("known here: "));
  EXPECT_THAT(detail_with_field("/model/nodes/0/z", 1.0), HasSubstr("known here: "));
  EXPECT_THAT(detail_with_field("/model/nodes/0/ix", 1.0), HasSubstr("known here: "));
}

TEST(ReadRequest, MisspeltListIsNotAlsoReportedAsMissing) {
  json document = sound();
  document["model"]["laods"] = document["model"]["loads"];
  document["model"].erase("loads");
  EXPECT_THAT(findings_of(document), ElementsAre(is_finding("/model/laods", "unknown_field")));
}

TEST(ReadRequest, FindingsAreBounded) {
  json document = sound();
  for (int i = 0; i < 3 * kMaxFindings; ++i) {
    document["model"]["nodes"].push_back({{"id", 1}, {"x", nullptr}});
  }
  const auto findings = findings_of(document);
  ASSERT_THAT(findings, SizeIs(kMaxFindings + 1));
  EXPECT_THAT(findings.back(), is_finding("", "too_many_findings"));
}

TEST(ReadRequest, FindingsAreWrittenAsJson) {
  EXPECT_EQ(write_findings({{"/a", "b", "c d"}}),
            json::parse(R"([{"pointer": "/a", "code": "b", "detail": "c d"}])"));
  EXPECT_EQ(write_findings({}), json::array());
}

/// Places of all values in a document, the root apart.
void collect_pointers(const json& value, const json::json_pointer& at, std::vector<json::json_pointer>& all) {
  if (!at.empty()) {
    all.push_back(at);
  }
  for (const auto& item : value.items()) {
    if (value.is_array()) {
      collect_pointers(item.value(), at / static_cast<std::size_t>(std::stoul(item.key())), all);
    } else if (value.is_object()) {
      collect_pointers(item.value(), at / item.key(), all);
    }
  }
}

json full_document() {
  return {
      {"model", json::parse(testing::full_model())},
      {"analysis", json::parse(R"({"type": "path", "discretization": {"elements": {"m0": 1, "m1": 1, "m2": 1,
             "m3": 1, "m4": 1}, "order": 2}, "control": {"displacement": "d0"}, "step": {"initial": 0.1},
             "stop": {"monitor": {"id": "d0", "range": [0, 1]}}, "output": {"states": {"every": 2}}})")}};
}

/// A boolean is allowed nowhere in the contract: put at any place it gives a finding at that place.
TEST(ReadRequest, WrongTypeIsReportedAtEveryPlace) {
  const json document = full_document();
  std::vector<json::json_pointer> places;
  collect_pointers(document, json::json_pointer(), places);
  ASSERT_GT(places.size(), 200U);
  for (const json::json_pointer& place : places) {
    json spoilt = document;
    spoilt[place] = true;
    EXPECT_THAT(findings_of(spoilt), ::testing::Contains(is_finding(place.to_string(), "wrong_type")))
        << place;
  }
}

/// Every object of the contract refuses a field that it does not know.
TEST(ReadRequest, UnknownFieldIsReportedInEveryObject) {
  const json document = full_document();
  std::vector<json::json_pointer> places;
  collect_pointers(document, json::json_pointer(), places);
  for (const json::json_pointer& place : places) {
    const bool is_free = place.to_string() == "/model/units" || place.to_string().ends_with("/elements");
    if (!document[place].is_object() || is_free) {
      continue;
    }
    json spoilt = document;
    spoilt[place]["never heard of"] = 1;
    EXPECT_THAT(findings_of(spoilt),
                ::testing::Contains(is_finding((place / "never heard of").to_string(), "unknown_field")));
  }
}

/// Random values at random places: reading always ends with a request or with findings that can be written.
TEST(ReadRequest, RandomValuesNeverBreakIt) {
  const json document = full_document();
  std::vector<json::json_pointer> places;
  collect_pointers(document, json::json_pointer(), places);
  const std::vector<json> values = {nullptr,
                                    true,
                                    0,
                                    -1,
                                    1e300,
                                    -1e-300,
                                    5'000'000'000,
                                    "",
                                    "m0",
                                    "a~/b",
                                    json::array(),
                                    json::object(),
                                    json::array({0, 0}),
                                    json::array({"x"}),
                                    {{"type", "arc"}}};
  std::mt19937 random(7);
  for (int trial = 0; trial < 3000; ++trial) {
    json spoilt = document;
    for (int i = 0; i < 4; ++i) {
      const json::json_pointer& place = places[random() % places.size()];
      if (spoilt.contains(place)) {
        spoilt[place] = values[random() % values.size()];
      }
    }
    const ReadOutcome outcome = read_request(spoilt.dump());
    ASSERT_NE(outcome.findings.empty(), !outcome.request.has_value()) << spoilt;
    ASSERT_NO_THROW((void)write_findings(outcome.findings).dump()) << spoilt;
  }
}

}  // namespace
}  // namespace snapthrough::api
