/// Sections by material and shape or profile, and load cases: what a request gives, and what is refused.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>
#include <vector>

#include "api/api.h"
#include "api/openapi/document.h"
#include "solver/model/profiles.h"
#include "solver/model/section_shape.h"
#include "solver/solve.h"
#include "tests/api/documents.h"

namespace snapthrough::api {
namespace {

using nlohmann::json;

json document_with(const json& section) {
  json document = json::parse(R"({
    "model": {"nodes": [{"id": "a", "x": 0, "y": 0}, {"id": "b", "x": 3, "y": 0}],
      "members": [{"id": "m", "start": "a", "end": "b", "section": "s"}],
      "supports": [{"node": "a", "fixed": ["x", "y", "rotation"]}],
      "loads": [{"type": "point", "at": {"node": "b"}, "force": [0, -1]}]},
    "analysis": {"type": "static"}})");
  document["model"]["sections"] = json::array({section});
  document["model"]["sections"][0]["id"] = "s";
  return document;
}

Section section_of(const json& section) {
  const ReadOutcome outcome = read_request(document_with(section).dump());
  if (!outcome.request) {
    ADD_FAILURE() << section << write_findings(outcome.findings).dump();
    return {};
  }
  return outcome.request->model.sections[0];
}

TEST(BendingLaw, IsRead) {
  const json power = {{"type", "ramberg_osgood"}, {"moment", 3.0}, {"exponent", 5.0}};
  const Section own = section_of({{"EA", 4.0}, {"EI", 7.0}, {"bending", {{"law", power}}}});
  ASSERT_TRUE(own.bending);
  EXPECT_EQ(own.bending->type, BendingLaw::Type::ramberg_osgood);
  EXPECT_EQ(own.bending->moment, 3.0);
  EXPECT_EQ(own.bending->exponent, 5.0);
  EXPECT_EQ(own.bending->coefficient, 1.0);
  EXPECT_EQ(own.EI.constant, 7.0);
  const json table = {
      {"type", "table"}, {"points", {{0, 0}, {0.5, 2}, {1.5, 3}}}, {"interpolation", "linear"}};
  const Section by_table = section_of({{"EA", 4.0}, {"bending", {{"law", table}}}});
  EXPECT_EQ(by_table.bending->interpolation, Interpolation::linear);
  EXPECT_EQ(by_table.bending->points.size(), 3u);
  EXPECT_DOUBLE_EQ(by_table.EI.constant, 4.0);
}

/// The table of a section by material replaces E I, and nothing else.
TEST(BendingLaw, TableReplacesTheEIOfAMaterial) {
  const json table = {{"type", "table"}, {"points", {{0.5, 2}}}};
  const Section steel =
      section_of({{"E", 10.0}, {"A", 2.0}, {"I", 3.0}, {"density", 5.0}, {"bending", {{"law", table}}}});
  EXPECT_DOUBLE_EQ(steel.EI.constant, 4.0);
  EXPECT_DOUBLE_EQ(steel.EA.constant, 20.0);
  EXPECT_DOUBLE_EQ(steel.mass->constant, 10.0);
  EXPECT_DOUBLE_EQ(steel.rotary_inertia->constant, 15.0);
}

/// Yield stress times area and section modulus; the second moment of a rectangle 2 x 3 is 4.5.
TEST(Strength, IsThatOfMaterialAndShape) {
  const json shape = {{"type", "rectangle"}, {"width", 2}, {"depth", 3}};
  const Section rectangle = section_of({{"E", 200.0}, {"shape", shape}, {"strength", 10}});
  ASSERT_TRUE(rectangle.strength);
  EXPECT_DOUBLE_EQ(rectangle.strength->axial_force.constant, 60.0);
  EXPECT_DOUBLE_EQ(rectangle.strength->bending_moment.constant, 30.0);
  EXPECT_EQ(rectangle.strength->compression, 1.0);
  const Section weak =
      section_of({{"E", 200.0}, {"shape", shape}, {"strength", {{"tension", 2.0}, {"compression", 30.0}}}});
  EXPECT_DOUBLE_EQ(weak.strength->bending_moment.constant, 6.0);
  EXPECT_DOUBLE_EQ(weak.strength->compression, 15.0);
  const Section tube = section_of(
      {{"E", 1.0}, {"shape", {{"type", "tube"}, {"diameter", 2}, {"thickness", 1}}}, {"strength", 8.0}});
  EXPECT_DOUBLE_EQ(tube.strength->bending_moment.constant, 2.0 * std::numbers::pi);
  const Section material = section_of({{"E", 1.0}, {"A", 2.0}, {"I", 3.0}, {"W", 5.0}, {"strength", 7.0}});
  EXPECT_DOUBLE_EQ(material.strength->axial_force.constant, 14.0);
  EXPECT_DOUBLE_EQ(material.strength->bending_moment.constant, 35.0);
  EXPECT_FALSE(section_of({{"E", 1.0}, {"A", 2.0}, {"I", 3.0}}).strength);
}

/// EN 10365 prints W = 557.1 cm3 of IPE 300 and 388.6 cm3 of HEA 200, and their areas 53.81 and 53.83 cm2.
TEST(Strength, OfProfilesHasTheirSectionModulus) {
  const auto strength = [](const char* name) {
    return *section_of({{"E", 2.1e8}, {"profile", name}, {"unit", "cm"}, {"strength", 1.0}}).strength;
  };
  EXPECT_NEAR(strength("IPE 300").bending_moment.constant, 557.1, 0.05);
  EXPECT_NEAR(strength("HEA 200").bending_moment.constant, 388.6, 0.05);
  EXPECT_NEAR(strength("IPE 300").axial_force.constant, 53.81, 0.005);
  EXPECT_NEAR(strength("HEA 200").axial_force.constant, 53.83, 0.005);
}

TEST(Strength, OfASectionByStiffnessMayTaper) {
  const Section tapering =
      section_of({{"EA", 4.0},
                  {"EI", 7.0},
                  {"strength", {{"axial_force", 3.0}, {"bending_moment", {{"along", {{0, 2}, {1, 1}}}}}}}});
  EXPECT_EQ(tapering.strength->axial_force.constant, 3.0);
  EXPECT_EQ(tapering.strength->bending_moment.at(0.5), 1.5);
}

TEST(Strength, IsRefused) {
  const json shape = {{"type", "rectangle"}, {"width", 2}, {"depth", 3}};
  const json law = {{"type", "ramberg_osgood"}, {"moment", 3.0}, {"exponent", 5.0}};
  const struct {
    json section;
    const char* pointer;
    const char* code;
  } refused[] = {
      {{{"E", 1.0}, {"shape", shape}, {"strength", 0}}, "/strength", "out_of_range"},
      {{{"E", 1.0}, {"shape", shape}, {"strength", "S355"}}, "/strength", "wrong_type"},
      {{{"E", 1.0}, {"shape", shape}, {"strength", {{"tension", 1}}}},
       "/strength/compression",
       "missing_field"},
      {{{"E", 1.0}, {"A", 1.0}, {"I", 1.0}, {"strength", 1}}, "/W", "missing_field"},
      {{{"E", 1.0}, {"A", 1.0}, {"I", 1.0}, {"W", 1}}, "/W", "ambiguous"},
      {{{"EA", 1.0}, {"EI", 1.0}, {"strength", 1}}, "/strength", "wrong_type"},
      {{{"EA", 1.0}, {"EI", 1.0}, {"strength", {{"axial_force", 1}}}},
       "/strength/bending_moment",
       "missing_field"},
      {{{"EA", 1.0}, {"EI", 1.0}, {"strength", {{"axial_force", -1}, {"bending_moment", 1}}}},
       "/strength/axial_force",
       "out_of_range"},
      {{{"E", 1.0}, {"shape", shape}, {"bending", {{"law", law}}}, {"strength", 1}},
       "/strength",
       "not_supported"},
  };
  for (const auto& one : refused) {
    const ReadOutcome outcome = read_request(document_with(one.section).dump());
    ASSERT_EQ(outcome.findings.size(), 1u) << one.section << write_findings(outcome.findings).dump();
    EXPECT_EQ(outcome.findings[0].pointer, std::string("/model/sections/0") + one.pointer) << one.section;
    EXPECT_EQ(outcome.findings[0].code, one.code) << one.section;
  }
}

TEST(ShapedSection, HasTheStiffnessOfItsShape) {
  const Section rectangle = section_of(
      {{"E", 200.0}, {"nu", 0.25}, {"shape", {{"type", "rectangle"}, {"width", 2}, {"depth", 3}}}});
  EXPECT_DOUBLE_EQ(rectangle.EA.constant, 1200.0);
  EXPECT_DOUBLE_EQ(rectangle.EI.constant, 200.0 * 4.5);
  EXPECT_DOUBLE_EQ(rectangle.GA->constant, 80.0 * 5.0);
  const Section bar =
      section_of({{"E", 1.0}, {"shape", {{"type", "tube"}, {"diameter", 2}, {"thickness", 1}}}});
  EXPECT_DOUBLE_EQ(bar.EI.constant, std::numbers::pi / 4.0);
  EXPECT_FALSE(bar.GA);
  const Section i = section_of(
      {{"E", 1.0},
       {"G", 0.5},
       {"shape", {{"type", "i_section"}, {"depth", 10}, {"width", 8}, {"web", 1}, {"flange", 2}}}});
  EXPECT_DOUBLE_EQ(i.EA.constant, 38.0);
  EXPECT_DOUBLE_EQ(i.EI.constant, (8.0 * 1000.0 - 7.0 * 216.0) / 12.0);
  EXPECT_DOUBLE_EQ(i.GA->constant, 0.5 * flanged_section({10, 8, 1, 2, 0}).shear_area);
}

TEST(ShapedSection, OfAWallIsStifferInPlaneStrain) {
  const json wall = {{"type", "wall"}, {"thickness", 0.5}, {"plane_strain", true}, {"nu", 0.2}};
  const Section strained = section_of({{"E", 24.0}, {"shape", wall}, {"density", 3.0}, {"expansion", 1e-5}});
  EXPECT_DOUBLE_EQ(strained.EA.constant, 24.0 / 0.96 * 0.5);
  EXPECT_DOUBLE_EQ(strained.EI.constant, 24.0 / 0.96 * 0.125 / 12.0);
  EXPECT_DOUBLE_EQ(strained.mass->constant, 1.5);
  EXPECT_DOUBLE_EQ(*strained.expansion, 1e-5);
  EXPECT_DOUBLE_EQ(section_of({{"E", 24.0}, {"shape", {{"type", "wall"}, {"thickness", 0.5}}}}).EA.constant,
                   12.0);
}

TEST(ShapedSection, OfAProfileIsInTheModelsUnit) {
  const Section m = section_of({{"E", 2.1e8}, {"profile", "IPE 300"}, {"unit", "m"}, {"mass", 42.2}});
  const Section mm = section_of({{"E", 210.0}, {"profile", "IPE 300"}, {"unit", "mm"}});
  EXPECT_NEAR(m.EI.constant, 2.1e8 * 8356e-8, 2e-5 * m.EI.constant);
  EXPECT_NEAR(m.EA.constant, 2.1e8 * 53.81e-4, 1e-4 * m.EA.constant);
  EXPECT_NEAR(mm.EI.constant, 1e6 * m.EI.constant, 1e-9 * mm.EI.constant);
  EXPECT_DOUBLE_EQ(m.mass->constant, 42.2);
}

TEST(ShapedSection, ProfilesAreThoseOfThePublishedInterface) {
  const json published = json::parse(openapi_document());
  const json& forms = published["components"]["schemas"]["Section"]["oneOf"];
  const json& field = forms.back()["properties"]["profile"];
  std::vector<std::string> names;
  for (const ProfileSeries& series : profile_series())
    for (const Profile& profile : series.profiles) names.emplace_back(profile.name);
  EXPECT_EQ(field["x-names"], json(names));
  for (const std::string example : field["examples"]) EXPECT_TRUE(find_profile(example)) << example;
}

TEST(ShapedSection, ProfilesHaveSeveralNames) {
  const auto of = [](const char* name) {
    return section_of({{"E", 2.1e8}, {"profile", name}, {"unit", "m"}, {"nu", 0.3}});
  };
  const Section own = of("HEA 200");  // published: 53.8 cm^2, 3692 cm^4
  EXPECT_NEAR(own.EA.constant, 2.1e8 * 53.83e-4, 1e-4 * own.EA.constant);
  EXPECT_NEAR(own.EI.constant, 2.1e8 * 3692e-8, 1e-4 * own.EI.constant);
  for (const char* name : {"HE 200 A", "HEA200", "he200a", "HE200A"}) {
    EXPECT_EQ(of(name).EI, own.EI) << name;
    EXPECT_EQ(of(name).GA, own.GA) << name;
  }
  EXPECT_NEAR(of("UPE 200").EI.constant, 2.1e8 * 1909e-8, 1e-3 * 2.1e8 * 1909e-8);  // published: 1909 cm^4
  const double printed = 204 * std::pow(0.0254, 4);                                 // AISC: 204 in^4
  EXPECT_NEAR(of("W12X26").EI.constant, 2.1e8 * printed, 1e-9);
}

TEST(ShapedSection, UnknownProfilesAreToldNamesOfTheirSeries) {
  const auto detail_of = [](const json& name) {
    const json section = {{"E", 1}, {"profile", name}, {"unit", "m"}};
    const ReadOutcome outcome = read_request(document_with(section).dump());
    return outcome.findings.size() == 1 ? outcome.findings[0].detail
                                        : write_findings(outcome.findings).dump();
  };
  EXPECT_EQ(
      detail_of("HEB 210"),
      R"("HEB 210" is not a rolled profile that is known here; did you mean "HEB 220", "HEB 200" or "HEB 240"?)");
  EXPECT_EQ(
      detail_of("Q 7"),
      R"("Q 7" is not a rolled profile that is known here; the series are IPE, IPN, HE, HD, HL, HP, UB, UC, UPE, UPN, W)");
  EXPECT_EQ(detail_of(200), "expected the name of a rolled profile, got number");
}

TEST(Sections, NumbersMayTaper) {
  const Section s = section_of(json::parse(
      R"({"EA": 5, "EI": {"along": [[0, 16], [0.5, 1]], "power": 4}, "GA": {"along": [[0, 3], [1, 1]]},
          "mass": {"along": [[0, 4], [1, 1]], "power": 2}})"));
  EXPECT_EQ(s.EA, 5.0);
  EXPECT_NEAR(s.EI.at(0.25), std::pow(1.5, 4), 1e-14);
  EXPECT_EQ(s.EI.at(0.7), 1.0);
  ASSERT_TRUE(s.GA && s.mass);
  EXPECT_EQ(s.GA->at(0.5), 2.0);
  EXPECT_NEAR(s.mass->at(0.5), 2.25, 1e-15);
  const Section shaped =
      section_of(json::parse(R"({"E": 1, "A": 1, "I": 1, "mass": {"along": [[0, 4], [1, 1]]}})"));
  ASSERT_TRUE(shaped.mass);
  EXPECT_EQ(shaped.mass->at(0.5), 2.5);
}

TEST(Sections, PointersNameNumbersOfATaper) {
  json document =
      document_with(json::parse(R"({"EA": 5, "EI": {"along": [[0, 16], [0.5, 1]], "power": 4}})"));
  document["analysis"] = {
      {"type", "critical"},
      {"sensitivities", {"/model/sections/0/EI/along/1/1", "/model/sections/0/EI/power"}}};
  document["model"]["loads"][0]["force"] = {-1, 0};
  const ReadOutcome outcome = read_request(document.dump());
  ASSERT_TRUE(outcome.request) << write_findings(outcome.findings).dump();
  const auto& variations = outcome.request->analysis.sensitivities;
  ASSERT_EQ(variations.size(), 2U);
  EXPECT_EQ(variations[0].value, 1.0);
  EXPECT_EQ(variations[0].model_at(2.0)->sections[0].EI.points[1].second, 2.0);
  EXPECT_FALSE(variations[0].model_at(-2.0));
  EXPECT_EQ(variations[1].model_at(3.0)->sections[0].EI.power, 3.0);
}

struct Refused {
  const char* section;
  const char* pointer;
  const char* code;
};
void PrintTo(const Refused& refused, std::ostream* out) { *out << refused.section; }

class RefusedSection : public ::testing::TestWithParam<Refused> {};
TEST_P(RefusedSection, NamesTheFieldAndTheRule) {
  const ReadOutcome outcome = read_request(document_with(json::parse(GetParam().section)).dump());
  ASSERT_EQ(outcome.findings.size(), 1u) << write_findings(outcome.findings).dump();
  EXPECT_EQ(outcome.findings[0].pointer, std::string("/model/sections/0") + GetParam().pointer);
  EXPECT_EQ(outcome.findings[0].code, GetParam().code);
}

INSTANTIATE_TEST_SUITE_P(
    Reader, RefusedSection,
    ::testing::Values(
        Refused{R"({"E": 1, "shape": {"type": "tube", "diameter": 2, "thickness": 1.01}})",
                "/shape/thickness", "out_of_range"},
        Refused{R"({"E": 1, "shape": {"type": "rectangle", "width": -2, "depth": 1}})", "/shape/width",
                "out_of_range"},
        Refused{
            R"({"E": 1, "shape": {"type": "i_section", "depth": 2, "width": 1, "web": 0.1, "flange": 1}})",
            "/shape/flange", "out_of_range"},
        Refused{R"({"E": 1, "shape": {"type": "i_section", "depth": 4, "width": 1, "web": 2, "flange": 1}})",
                "/shape/web", "out_of_range"},
        Refused{
            R"({"E": 1, "shape": {"type": "i_section", "depth": 4, "width": 1, "web": 0.1, "flange": 1, "root_radius": 0.5}})",
            "/shape/root_radius", "out_of_range"},
        Refused{R"({"E": 1, "shape": {"type": "wall", "thickness": 1, "plane_strain": true}})", "/shape/nu",
                "missing_field"},
        Refused{R"({"E": 1, "shape": {"type": "circle"}})", "/shape/type", "unknown_value"},
        Refused{R"({"E": 1, "profile": "IPE 310", "unit": "m"})", "/profile", "unknown_value"},
        Refused{R"({"E": 1, "profile": "IPE 300"})", "/unit", "missing_field"},
        Refused{R"({"E": 1, "nu": 0.2, "G": 1, "profile": "IPE 300", "unit": "m"})", "/nu", "ambiguous"},
        Refused{R"({"E": 1, "A": 1, "profile": "IPE 300", "unit": "m", "I": 1})", "", "ambiguous"},
        Refused{R"({"E": 1, "A": 1, "I": 1, "mass": 1, "density": 1})", "/density", "ambiguous"},
        Refused{R"({"EA": 1, "EI": 1, "density": 1})", "/density", "unknown_field"},
        Refused{R"({"EA": 1, "EI": 1, "mass": -1})", "/mass", "out_of_range"},
        Refused{R"({"EA": 1, "EI": {"along": [[0, 1]]}})", "/EI/along", "empty"},
        Refused{R"({"EA": 1, "EI": {"along": [[0, 1], [1, 0]]}})", "/EI/along/1/1", "out_of_range"},
        Refused{R"({"EA": 1, "EI": {"along": [[0.5, 1], [0.5, 2]]}})", "/EI/along/1/0", "not_increasing"},
        Refused{R"({"EA": {"along": [[0, 1], [1, 2]], "power": 0}, "EI": 1})", "/EA/power", "out_of_range"},
        Refused{R"({"EA": {"along": [[0, 1], [1, 2]], "powers": 2}, "EI": 1})", "/EA/powers",
                "unknown_field"},
        Refused{R"({"EA": 1, "EI": 1, "mass": {"along": [[0, 0], [1, 1]]}})", "/mass/along/0/1",
                "out_of_range"}));

json frame_with(const json& changes) {
  json document = document_with({{"EA", 1e6}, {"EI", 1.0}, {"mass", 2.0}, {"expansion", 1e-5}});
  document["model"].update(changes);
  return document;
}

TEST(LoadCases, AreLoadsWithTheirFactorAndPattern) {
  const json weight = {{"type", "self_weight"}, {"gravity", {0, -10}}};
  const json line = {
      {"type", "distributed"}, {"member", "m"}, {"force", {{"along", {{0, {0, 0}}, {1, {0, -2}}}}}}};
  const json document =
      frame_with({{"load_cases",
                   {{{"id", "dead"}, {"factor", 1.35}, {"loads", {weight}}},
                    {{"id", "snow"},
                     {"factor", 1.5},
                     {"grows", true},
                     {"loads", {line, {{"type", "pressure"}, {"member", "m"}, {"value", 4}}}}}}}});
  const ReadOutcome outcome = read_request(document.dump());
  ASSERT_TRUE(outcome.request) << write_findings(outcome.findings).dump();
  const Model& model = outcome.request->model;
  ASSERT_EQ(model.loads.size(), 4u);
  EXPECT_EQ(model.load_cases.size(), 2u);
  const auto& dead = std::get<SelfWeight>(model.loads[1]);
  EXPECT_DOUBLE_EQ(dead.gravity[1], -13.5);
  EXPECT_EQ(dead.pattern, Pattern::constant);
  const auto& snow = std::get<DistributedLoad>(model.loads[2]);
  EXPECT_DOUBLE_EQ(snow.force_along[1].second[1], -3.0);
  EXPECT_EQ(snow.pattern, Pattern::proportional);
  EXPECT_DOUBLE_EQ(std::get<PressureLoad>(model.loads[3]).value, 6.0);
}

/// The same loads written by hand have the same result.
TEST(LoadCases, ChangeNoAnswer) {
  const json by_cases =
      frame_with({{"loads", json::array()},
                  {"load_cases",
                   {{{"id", "one"},
                     {"factor", 3},
                     {"grows", true},
                     {"loads", {{{"type", "point"}, {"at", {{"node", "b"}}}, {"force", {0, -1}}}}}},
                    {{"id", "two"},
                     {"factor", 2},
                     {"loads", {{{"type", "pressure"}, {"member", "m"}, {"value", 0.1}}}}}}}});
  const json by_hand =
      frame_with({{"loads",
                   {{{"type", "point"}, {"at", {{"node", "b"}}}, {"force", {0, -3}}},
                    {{"type", "pressure"}, {"member", "m"}, {"value", 0.2}, {"pattern", "constant"}}}}});
  const auto answer = [](const json& document) {
    const ReadOutcome outcome = read_request(document.dump());
    EXPECT_TRUE(outcome.request) << write_findings(outcome.findings).dump();
    if (!outcome.request) return json();
    auto result =
        write_result(*outcome.request, solve(outcome.request->model, outcome.request->analysis), 0.0);
    return json(result["states"]);
  };
  EXPECT_EQ(answer(by_cases), answer(by_hand));
}

TEST(LoadCases, FindingsNameThePlaceInTheCase) {
  const auto finding_of = [](const json& changes) {
    const ReadOutcome outcome = read_request(frame_with(changes).dump());
    EXPECT_EQ(outcome.findings.size(), 1u) << write_findings(outcome.findings).dump();
    return outcome.findings.empty() ? std::string()
                                    : outcome.findings[0].pointer + " " + outcome.findings[0].code;
  };
  const json good = {{"type", "pressure"}, {"member", "m"}, {"value", 1}};
  json bad = good;
  bad["member"] = "n";
  const auto cases = [](const json& first, const json& second) {
    return json{
        {"load_cases", {{{"id", "one"}, {"loads", {first}}}, {{"id", "two"}, {"loads", {first, second}}}}}};
  };
  EXPECT_EQ(finding_of(cases(good, bad)), "/model/load_cases/1/loads/1/member unknown_reference");
  json with_pattern = good;
  with_pattern["pattern"] = "constant";
  EXPECT_EQ(finding_of(cases(good, with_pattern)), "/model/load_cases/1/loads/1/pattern ambiguous");
  json twice = cases(good, good);
  twice["load_cases"][1]["id"] = "one";
  EXPECT_EQ(finding_of(twice), "/model/load_cases/1/id duplicate_id");
  json kink = {
      {"type", "distributed"}, {"member", "m"}, {"force", {{"along", {{0.5, {0, 1}}, {0.4, {0, 1}}}}}}};
  EXPECT_EQ(finding_of({{"loads", {kink}}}), "/model/loads/0/force/along/1/0 not_increasing");
  EXPECT_EQ(finding_of({{"loads", {{{"type", "temperature"}, {"member", "m"}, {"change", 1e200}}}}}),
            "/model/loads/0/change out_of_range");
}

TEST(SectionData, IsMissingWhereALoadNeedsIt) {
  json document = document_with({{"EA", 1e6}, {"EI", 1.0}});
  document["model"]["loads"] = {{{"type", "self_weight"}, {"gravity", {0, -10}}},
                                {{"type", "temperature"}, {"member", "m"}, {"change", 3}}};
  const ReadOutcome outcome = read_request(document.dump());
  ASSERT_EQ(outcome.findings.size(), 2u);
  EXPECT_EQ(outcome.findings[0].pointer, "/model/sections/0/mass");
  EXPECT_EQ(outcome.findings[1].pointer, "/model/sections/0/expansion");
}

/// Derivatives by a dimension of a shape, the factor of a load case and the stiffness of a joint, against
/// differences of whole analyses.
TEST(Sensitivities, KnowTheNewFields) {
  json document = frame_with(json::object());
  document["model"]["sections"][0] = {
      {"id", "s"}, {"E", 1e4}, {"shape", {{"type", "rectangle"}, {"width", 0.3}, {"depth", 0.1}}}};
  document["model"]["members"][0]["release"] = {{"start", {{"rotation", 2.0}}}};
  document["model"]["loads"] = {{{"type", "point"}, {"at", {{"node", "b"}}}, {"force", {-1, 0}}}};
  document["model"]["load_cases"] = {
      {{"id", "more"},
       {"factor", 0.5},
       {"grows", true},
       {"loads", {{{"type", "point"}, {"at", {{"node", "b"}}}, {"force", {-1, 0}}}}}}};
  const json analysis = {{"type", "critical"}, {"discretization", {{"elements", 4}, {"order", 5}}}};
  document["analysis"] = analysis;
  const std::string pointers[] = {"/model/sections/0/shape/depth", "/model/load_cases/0/factor",
                                  "/model/members/0/release/start/rotation"};
  document["analysis"]["sensitivities"] = pointers;
  const auto result_of = [](const json& request) {
    const ReadOutcome outcome = read_request(request.dump());
    EXPECT_TRUE(outcome.request) << write_findings(outcome.findings).dump();
    return solve(outcome.request->model, outcome.request->analysis);
  };
  const Result result = result_of(document);
  ASSERT_EQ(result.critical_points.size(), 1u);
  document["analysis"] = analysis;
  for (std::size_t i = 0; i < std::size(pointers); ++i) {
    const json::json_pointer at(pointers[i]);
    const double value = document.at(at);
    const auto load_at = [&](double other) {
      json changed = document;
      changed[at] = other;
      return *result_of(changed).summary.critical_load_factor;
    };
    const double expected = (load_at(1.001 * value) - load_at(0.999 * value)) / (0.002 * value);
    EXPECT_NEAR(result.critical_points[0].sensitivities.at(i).derivative.value(), expected,
                1e-5 * std::abs(expected))
        << pointers[i];
  }
}

TEST(Releases, MayBeStiff) {
  json document = document_with({{"EA", 1e6}, {"EI", 1.0}});
  document["model"]["members"][0]["release"] = {{"start", {{"rotation", 5.0}}}, {"end", {"rotation"}}};
  const ReadOutcome outcome = read_request(document.dump());
  ASSERT_TRUE(outcome.request) << write_findings(outcome.findings).dump();
  const Member& member = outcome.request->model.members[0];
  EXPECT_TRUE(member.release_start_rotation && member.release_end_rotation);
  EXPECT_EQ(member.release_start_stiffness, 5.0);
  EXPECT_EQ(member.release_end_stiffness, 0.0);
  document["model"]["members"][0]["release"]["start"]["rotation"] = -1.0;
  const ReadOutcome refused = read_request(document.dump());
  ASSERT_EQ(refused.findings.size(), 1u);
  EXPECT_EQ(refused.findings[0].pointer, "/model/members/0/release/start/rotation");
}

}  // namespace
}  // namespace snapthrough::api
