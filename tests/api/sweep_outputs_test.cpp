/// Outputs, powers and labels of sweeps: what is refused before anything is computed, and what tables show.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "api/openapi/document.h"
#include "api/point_outcome.h"
#include "api/result_schema.h"
#include "api/sweep.h"
#include "api/sweep_table.h"
#include "tests/api/documents.h"

namespace snapthrough::api {
namespace {

using nlohmann::json;
using ::testing::ElementsAre;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

json parameter(const std::string& name, const std::string& pointer, json values) {
  const json targets = json::array({json::object({{"pointer", pointer}})});
  return {{"name", name}, {"targets", targets}, {"values", std::move(values)}};
}

json sound_sweep() {
  json document = json::parse(testing::sound_document());
  document["parameters"] = json::array({parameter("k", "/model/foundations/0/stiffness", {3, 5})});
  document["design"] = "grid";
  document["outputs"] = json::array({"/summary/critical_load_factor"});
  return document;
}

std::vector<Finding> findings(const json& document) { return read_sweep(document.dump()).findings; }

/// The sound sweep with one output, of an analysis of that type.
std::vector<Finding> findings_of_output(const std::string& output, const std::string& type) {
  json document = sound_sweep();
  document["analysis"] = {{"type", type}};
  document["outputs"] = json::array({output});
  return findings(document);
}

/// "code detail" of the only finding.
std::string refusal(const std::string& output, const std::string& type = "path") {
  const std::vector<Finding> all = findings_of_output(output, type);
  EXPECT_EQ(all.size(), 1U) << output;
  return all.empty() ? "" : all.front().pointer + " " + all.front().code + " " + all.front().detail;
}

TEST(SweepOutputs, AMisspeltFieldIsRefusedWithTheOneThatWasMeant) {
  EXPECT_EQ(refusal("/summary/critical_load"),
            "/outputs/0 unknown_field a result has no /summary/critical_load; did you mean "
            "/summary/critical_load_factor?");
  EXPECT_THAT(refusal("/sumary/message"), EndsWith("did you mean /summary/message?"));
  EXPECT_THAT(refusal("/nothing"), HasSubstr("known here: "));
  EXPECT_THAT(refusal("/summary/message/0"), HasSubstr("there is nothing inside /summary/message"));
  EXPECT_THAT(refusal("/critical_points/first/type"), HasSubstr("is a list"));
  EXPECT_THAT(refusal("/critical_points/-1/type"), HasSubstr("is a list"));
}

TEST(SweepOutputs, PlacesThatResultsMayHaveAreTaken) {
  for (const char* output :
       {"/summary", "/summary/critical_load_factor", "/critical_points/17/load_factor", "/critical_points",
        "/branches/0/load_factor/3", "/states/0/load_factor", "/contact_events/0/load_factor",
        "/discretization/elements", "/diagnostics/steps"}) {
    EXPECT_THAT(findings_of_output(output, "path"), IsEmpty()) << output;
  }
  EXPECT_THAT(findings_of_output("/buckling/load_factors/0", "buckling"), IsEmpty());
}

TEST(SweepOutputs, NamesInsideAreThoseOfTheModel) {
  EXPECT_EQ(refusal("/critical_points/0/monitors/midd"),
            "/outputs/0 unknown_reference the model has nothing named midd for /critical_points/0/monitors; "
            "did you "
            "mean /critical_points/0/monitors/mid?");
  EXPECT_THAT(refusal("/states/0/members/ab/bending_momen"),
              EndsWith("did you mean /states/0/members/ab/bending_moment?"));
  EXPECT_THAT(refusal("/states/0/supports/c/fx"), HasSubstr("unknown_reference"));
  EXPECT_THAT(refusal("/states/0/supports/a/fz"), HasSubstr("unknown_field"));
  EXPECT_THAT(refusal("/branches/0/contact_fraction/s1/0"), HasSubstr("known here: soil"));
  EXPECT_THAT(refusal("/states/0/foundations/soil/contact/0/2"), HasSubstr("is a list"));
  for (const char* output : {"/critical_points/0/monitors/mid", "/states/2/members/ab/bending_moment/50",
                             "/states/0/supports/b/fy", "/states/0/springs/s1/force",
                             "/states/0/foundations/soil/contact/0/1", "/branches/0/monitors/mid/7",
                             "/branches/0/contact_fraction/soil", "/critical_points/0/mode/members/ab/u"}) {
    EXPECT_THAT(findings_of_output(output, "path"), IsEmpty()) << output;
  }
}

/// A list that a parameter replaces has other ids at each point.
TEST(SweepOutputs, NamesThatAreSweptAreNotJudged) {
  json document = sound_sweep();
  document["analysis"] = {{"type", "path"}};
  const json monitor = json::array({{{"id", "other"}, {"at", {{"node", "b"}}}, {"component", "x"}}});
  document["parameters"].push_back(parameter("m", "/model/monitors", json::array({monitor})));
  document["outputs"] = json::array({"/critical_points/0/monitors/other"});
  EXPECT_THAT(findings(document), IsEmpty());
}

TEST(SweepOutputs, ExtremesAreAskedForBeforeTheyAreLookedInto) {
  EXPECT_THAT(refusal("/extremes/members/ab/bending_moment/max/value"),
              HasSubstr("wrong_analysis extremes are"));
  EXPECT_THAT(refusal("/extremes/members/ab/bending_moment/largest"), HasSubstr("unknown_field"));
  EXPECT_THAT(refusal("/failure/code"), HasSubstr("column error"));
}

TEST(SweepOutputs, WhatBelongsToAnotherAnalysisIsRefused) {
  EXPECT_THAT(refusal("/buckling/load_factors/0"),
              HasSubstr("wrong_analysis only an analysis of type buckling"));
  EXPECT_THAT(refusal("/branches/0/load_factor", "critical"), HasSubstr("of type path has /branches"));
  EXPECT_THAT(refusal("/critical_points/0/type", "buckling"), HasSubstr("critical or path"));
  EXPECT_THAT(refusal("/critical_points/0/type", "static"), HasSubstr("wrong_analysis"));
  json document = sound_sweep();
  document["outputs"] = {"/states/0/load_factor"};
  document["analysis"] = {{"type", "path"}, {"output", {{"states", "none"}}}};
  EXPECT_EQ(findings(document).front().code, "wrong_analysis");
}

TEST(SweepOutputs, AnAnalysisThatIsSweptIsNotJudged) {
  json document = sound_sweep();
  document["parameters"].push_back(parameter("type", "/analysis/type", {"path", "buckling"}));
  document["outputs"] = {"/buckling/load_factors/0"};
  EXPECT_THAT(findings(document), IsEmpty());
}

TEST(SweepOutputs, ATargetMayHaveAPower) {
  json document = sound_sweep();
  document["parameters"] = json::array({parameter("t", "/model/sections/0/EA", {0.5, 2})});
  document["parameters"][0]["targets"] = {{{"pointer", "/model/sections/0/EA"}, {"scale", 1e6}},
                                          {{"pointer", "/model/sections/0/EI"}, {"scale", 12}, {"power", 3}}};
  const SweepOutcome outcome = read_sweep(document.dump());
  ASSERT_THAT(outcome.findings, IsEmpty());
  EXPECT_EQ(outcome.sweep->document_at(0)->at("/model/sections/0/EA"_json_pointer), 0.5e6);
  EXPECT_EQ(outcome.sweep->document_at(0)->at("/model/sections/0/EI"_json_pointer), 1.5);
  EXPECT_EQ(outcome.sweep->document_at(1)->at("/model/sections/0/EI"_json_pointer), 96.0);
}

/// Codes of a sweep of one target with that power and these values or this range.
std::vector<std::string> mistakes_of_power(double power, const char* key, const json& values) {
  json document = sound_sweep();
  document["parameters"][0].erase("values");
  document["parameters"][0]["targets"][0]["power"] = power;
  document["parameters"][0][key] = values;
  std::vector<std::string> all;
  for (const Finding& finding : findings(document)) {
    all.push_back(finding.pointer + " " + finding.code);
  }
  return all;
}

TEST(SweepOutputs, ANumberThatAPowerCannotGiveIsRefused) {
  const std::string at = "/parameters/0";
  EXPECT_THAT(mistakes_of_power(0.5, "values", {1, 4}), IsEmpty());
  EXPECT_THAT(mistakes_of_power(3, "values", {1, "thick"}), ElementsAre(at + "/values/1 wrong_type"));
  EXPECT_THAT(mistakes_of_power(0.5, "values", {1, -4}), ElementsAre(at + "/values/1 out_of_range"));
  EXPECT_THAT(mistakes_of_power(-1, "values", {0, 2}), ElementsAre(at + "/values/0 out_of_range"));
  EXPECT_THAT(mistakes_of_power(3, "values", {1e120, 2}), ElementsAre(at + "/values/0 out_of_range"));
  const auto range = [](double from, double to) { return json{{"from", from}, {"to", to}, {"count", 3}}; };
  EXPECT_THAT(mistakes_of_power(-1, "range", range(1, 2)), IsEmpty());
  EXPECT_THAT(mistakes_of_power(-1, "range", range(-1, 1)), ElementsAre(at + "/range out_of_range"));
  EXPECT_THAT(mistakes_of_power(0.5, "range", range(-1, 1)), ElementsAre(at + "/range out_of_range"));
  EXPECT_THAT(mistakes_of_power(3, "range", range(1, 1e120)), ElementsAre(at + "/range out_of_range"));
}

json labelled() {
  json document = sound_sweep();
  const json roller = {{{"node", "a"}, {"fixed", {"x", "y"}}}, {{"node", "c"}, {"fixed", {"y"}}}};
  json clamped = roller;
  clamped[0]["fixed"] = {"x", "y", "rotation"};
  document["parameters"].push_back(parameter("ends", "/model/supports", {roller, clamped}));
  document["parameters"][1]["label"] = {"pinned", "clamped, left"};
  return document;
}

TEST(SweepOutputs, LabelsNameValuesInTables) {
  const SweepOutcome outcome = read_sweep(labelled().dump());
  ASSERT_THAT(outcome.findings, IsEmpty());
  const PointOutcome good{"[2.5]", "", ""};
  std::string csv;
  TableWriter(*outcome.sweep, TableForm::csv).append_row(1, good, csv);
  EXPECT_EQ(csv, "3,\"clamped, left\",2.5,\n");
  std::string row;
  TableWriter(*outcome.sweep, TableForm::ndjson).append_row(2, good, row);
  EXPECT_EQ(json::parse(row).at("ends"), "pinned");
  row.clear();
  TableWriter(*outcome.sweep, TableForm::json).append_row(2, good, row);
  EXPECT_EQ(json::parse(row), json::parse(R"([5, "pinned", 2.5, null])"));
  EXPECT_EQ(outcome.sweep->document_at(1)->at("/model/supports/0/fixed/2"_json_pointer), "rotation");
}

TEST(SweepOutputs, LabelsAreOneForEachValueAndDiffer) {
  const auto with = [](const json& label) {
    json document = labelled();
    document["parameters"][1]["label"] = label;
    const std::vector<Finding> all = findings(document);
    return all.empty() ? "" : all.front().pointer + " " + all.front().code;
  };
  const std::string at = "/parameters/1/label";
  EXPECT_EQ(with({"one"}), at + " unequal_counts");
  EXPECT_EQ(with({"one", "one"}), at + "/1 duplicate_name");
  EXPECT_EQ(with({"one", ""}), at + "/1 invalid_name");
  EXPECT_EQ(with({"one", 2}), at + "/1 wrong_type");
  EXPECT_EQ(with("one"), at + " wrong_type");
  json document = sound_sweep();
  document["parameters"][0].erase("values");
  document["parameters"][0]["range"] = {{"from", 1}, {"to", 2}, {"count", 2}};
  document["parameters"][0]["label"] = {"a", "b"};
  EXPECT_EQ(findings(document).front().code, "excess_field");
}

TEST(SweepOutputs, TablesOfAServiceSayWhereThePointsAre) {
  const Sweep sweep = *read_sweep(sound_sweep().dump()).sweep;
  const PointLinks links{"/v1/sweeps/S/points/{point}/request", "/v1/sweeps/S/points/{point}/job"};
  const PointOutcome bad{"", "no_convergence", "step 3"};
  TableWriter writer(sweep, TableForm::json, links);
  std::string text = writer.head();
  writer.append_row(1, bad, text);
  EXPECT_FALSE(writer.append_tail(text));
  const json table = json::parse(text);
  EXPECT_EQ(table.at("links").at("request"), links.request);
  EXPECT_EQ(table.at("rows")[0].size(), table.at("columns").size());
  EXPECT_EQ(table.at("points"), json({1}));
  TableWriter csv(sweep, TableForm::csv, links);
  text = csv.head();
  csv.append_row(1, {"[2.5]", "", ""}, text);
  EXPECT_EQ(text,
            "k,/summary/critical_load_factor,error,point,request\n"
            "5,2.5,,1,/v1/sweeps/S/points/1/request\n");
}

}  // namespace
}  // namespace snapthrough::api
