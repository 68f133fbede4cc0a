/// Reading of sweep documents: what they expand to, and every mistake with its place.

#include "api/sweep.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/api/documents.h"

namespace snapthrough::api {
namespace {

using nlohmann::json;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

json parameter(const std::string& name, const std::string& pointer, json values) {
  return {{"name", name}, {"targets", {{{"pointer", pointer}}}}, {"values", std::move(values)}};
}

/// Two stiffnesses by three amplitudes over the sound request.
json sound_sweep() {
  json document = json::parse(testing::sound_document());
  document["parameters"] = {parameter("k", "/model/foundations/0/stiffness", {3, 5}),
                            parameter("a", "/model/imperfections/0/amplitude", {1e-4, 2e-4, 3e-4})};
  document["design"] = "grid";
  document["outputs"] = {"/summary/critical_load_factor", "/critical_points/0/type"};
  return document;
}

SweepOutcome read(const json& document) { return read_sweep(document.dump()); }

/// "pointer code" of each finding.
std::vector<std::string> mistakes(const json& document) {
  std::vector<std::string> result;
  for (const Finding& finding : read(document).findings) {
    result.push_back(finding.pointer + " " + finding.code);
  }
  return result;
}

/// The sound sweep with one value replaced.
std::vector<std::string> mistakes_with(const std::string& pointer, const json& value) {
  json document = sound_sweep();
  document[json::json_pointer(pointer)] = value;
  return mistakes(document);
}

TEST(Sweep, GridRunsThroughTheLastParameterFastest) {
  const SweepOutcome outcome = read(sound_sweep());
  ASSERT_THAT(outcome.findings, IsEmpty());
  ASSERT_EQ(outcome.sweep->size(), 6U);
  std::vector<std::pair<double, double>> points;
  for (std::uint64_t i = 0; i < 6; ++i) {
    const auto document = outcome.sweep->document_at(i);
    EXPECT_FALSE(document->contains("parameters"));
    ASSERT_THAT(read_request_document(document).findings, IsEmpty());
    points.emplace_back(document->at("/model/foundations/0/stiffness"_json_pointer),
                        document->at("/model/imperfections/0/amplitude"_json_pointer));
  }
  using P = std::pair<double, double>;
  EXPECT_THAT(points, ElementsAre(P{3, 1e-4}, P{3, 2e-4}, P{3, 3e-4}, P{5, 1e-4}, P{5, 2e-4}, P{5, 3e-4}));
}

TEST(Sweep, ZipTakesValuesInStep) {
  json document = sound_sweep();
  document["design"] = "zip";
  document["parameters"][0]["values"] = {3, 5, 7};
  const SweepOutcome outcome = read(document);
  ASSERT_THAT(outcome.findings, IsEmpty());
  ASSERT_EQ(outcome.sweep->size(), 3U);
  EXPECT_EQ(outcome.sweep->document_at(1)->at("/model/foundations/0/stiffness"_json_pointer), 5);
  EXPECT_EQ(outcome.sweep->document_at(1)->at("/model/imperfections/0/amplitude"_json_pointer), 2e-4);
}

TEST(Sweep, RangesHaveExactEndsAndEqualStepsOrRatios) {
  json document = sound_sweep();
  document["parameters"].erase(1);
  document["parameters"][0].erase("values");
  document["parameters"][0]["range"] = {{"from", 1e2}, {"to", 1e8}, {"count", 4}, {"spacing", "log"}};
  const auto value = [&](std::uint64_t i) {
    return read(document)
        .sweep->document_at(i)
        ->at("/model/foundations/0/stiffness"_json_pointer)
        .get<double>();
  };
  EXPECT_EQ(value(0), 1e2);
  EXPECT_DOUBLE_EQ(value(1), 1e4);
  EXPECT_EQ(value(3), 1e8);
  document["parameters"][0]["range"] = {{"from", 1}, {"to", 7}, {"count", 4}};
  EXPECT_DOUBLE_EQ(value(2), 5.0);
}

TEST(Sweep, WritesScaledValuesAtEveryTarget) {
  json document = sound_sweep();
  document["parameters"][0]["targets"] = {{{"pointer", "/model/foundations/0/stiffness"}, {"scale", 0.5}},
                                          {{"pointer", "/model/springs/0/stiffness"}, {"scale", 4}}};
  const SweepOutcome outcome = read(document);
  ASSERT_THAT(outcome.findings, IsEmpty());
  EXPECT_EQ(outcome.sweep->document_at(0)->at("/model/foundations/0/stiffness"_json_pointer), 1.5);
  EXPECT_EQ(outcome.sweep->document_at(0)->at("/model/springs/0/stiffness"_json_pointer), 12.0);
}

TEST(Sweep, RowsHoldValuesOutputsAndError) {
  const Sweep sweep = *read(sound_sweep()).sweep;
  EXPECT_THAT(sweep.columns(),
              ElementsAre("k", "a", "/summary/critical_load_factor", "/critical_points/0/type", "error"));
  const json result = {{"summary", {{"critical_load_factor", 2.5}}}, {"critical_points", json::array()}};
  EXPECT_EQ(sweep.row(3, result), json::parse("[5, 1e-4, 2.5, null, null]")) << "a list that ended is null";
  const json other = {{"summary", json::object()}, {"critical_points", json::array()}};
  EXPECT_EQ(sweep.row(3, other)[4].at("code"), "no_such_output") << "a field that is not there is an error";
  EXPECT_EQ(sweep.error_row(0, "c", "d"),
            json::parse(R"([3, 1e-4, null, null, {"code": "c", "detail": "d"}])"));
}

TEST(Sweep, CsvQuotesWhatNeedsIt) {
  EXPECT_EQ(csv_line(json::parse(R"([1.5, null, "a,b", "say \"x\"", {"code": 1}])")),
            "1.5,,\"a,b\",\"say \"\"x\"\"\",\"{\"\"code\"\":1}\"\n");
}

TEST(Sweep, SaysWhereAMistakeIs) {
  EXPECT_THAT(mistakes_with("/design", "gird"), ElementsAre("/design unknown_value"));
  EXPECT_THAT(mistakes_with("/design", {{"latin_hypercube", {{"samples", 10}, {"seed", 1}}}}),
              ElementsAre("/design not_supported"));
  EXPECT_THAT(mistakes_with("/outputs", json::array()), ElementsAre("/outputs wrong_type"));
  EXPECT_THAT(mistakes_with("/outputs/0", "summary"), ElementsAre("/outputs/0 invalid_pointer"));
  EXPECT_THAT(mistakes_with("/outputs/0", "/sumary/message"), ElementsAre("/outputs/0 unknown_field"));
  EXPECT_THAT(mistakes_with("/parameters", json::array()), ElementsAre("/parameters wrong_type"));
  EXPECT_THAT(mistakes_with("/parameters/1/name", "k"), ElementsAre("/parameters/1/name duplicate_name"));
  EXPECT_THAT(mistakes_with("/parameters/1/name", "error"), ElementsAre("/parameters/1/name invalid_name"));
  EXPECT_THAT(mistakes_with("/parameters/0/values", json::array()),
              ElementsAre("/parameters/0/values out_of_range"));
  EXPECT_THAT(mistakes_with("/parameters/0/range", {{"from", 1}, {"to", 2}, {"count", 3}}),
              ElementsAre("/parameters/0 excess_field"));
  EXPECT_THAT(mistakes_with("/parameters/0/value", 3), ElementsAre("/parameters/0/value unknown_field"));
  EXPECT_THAT(mistakes_with("/model/fundations", 3), ElementsAre("/model/fundations unknown_field"));
}

TEST(Sweep, SaysWhereATargetIsWrong) {
  const std::string first = "/parameters/0/targets/0/pointer";
  EXPECT_THAT(mistakes_with(first, "/modl/x"), ElementsAre(first + " invalid_pointer"));
  EXPECT_THAT(mistakes_with(first, "/model"), ElementsAre(first + " invalid_pointer"));
  EXPECT_THAT(mistakes_with(first, "/model/foundations/1/stiffness"), ElementsAre(first + " no_such_place"));
  EXPECT_THAT(mistakes_with(first, "/model/foundations/01/stiffness"), ElementsAre(first + " no_such_place"));
  EXPECT_THAT(mistakes_with(first, "/model/foundations/0/stifness"), ElementsAre(first + " unknown_field"));
  EXPECT_THAT(mistakes_with(first, "/model/imperfections/0"),
              ElementsAre("/parameters/1/targets/0/pointer overlapping_targets"));
  json document = sound_sweep();
  document["parameters"][0]["targets"][0]["scale"] = 2;
  document["parameters"][0]["values"] = {1, "x"};
  EXPECT_THAT(mistakes(document), ElementsAre("/parameters/0/values/1 wrong_type"));
}

TEST(Sweep, CountsBeforeItExpands) {
  json document = sound_sweep();
  for (json& one : document["parameters"]) {
    one.erase("values");
    one["range"] = {{"from", 1}, {"to", 2}, {"count", 2'000'000'000}};
  }
  EXPECT_THAT(mistakes(document), ElementsAre("/parameters too_many_points"));
  document["design"] = "zip";
  EXPECT_THAT(mistakes(document), ElementsAre("/parameters too_many_points"));
  document = sound_sweep();
  document["design"] = "zip";
  EXPECT_THAT(mistakes(document), ElementsAre("/parameters/1 unequal_counts"));
}

TEST(Sweep, LeavesMistakesOfSingleValuesToTheirPoints) {
  json document = sound_sweep();
  document["parameters"][0]["values"] = {-3, 5};
  const SweepOutcome outcome = read(document);
  ASSERT_THAT(outcome.findings, IsEmpty());
  EXPECT_FALSE(read_request_document(outcome.sweep->document_at(0)).findings.empty());
  EXPECT_THAT(read_request_document(outcome.sweep->document_at(3)).findings, IsEmpty());
}

}  // namespace
}  // namespace snapthrough::api
