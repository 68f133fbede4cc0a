/// Expected processor time of a check: how it grows, what sweeps make of it, and its place in the document.

#include "api/expected_time.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "api/check_document.h"
#include "api/names.h"
#include "tests/api/documents.h"

namespace snapthrough::api {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;

json sound() { return json::parse(testing::sound_document()); }

CheckedDocument checked(const json& document) {
  const auto shared = std::make_shared<const json>(document);
  return is_sweep(document) ? check_sweep(shared) : check_request(shared);
}

/// Expected time of a valid document; zeros when it has none.
ExpectedTime time_of(const json& document) {
  const CheckedDocument found = checked(document);
  EXPECT_TRUE(found.findings.empty()) << write_check(found);
  EXPECT_TRUE(found.expected) << write_check(found);
  return found.expected.value_or(ExpectedTime());
}

/// The request as a sweep over the numbers of elements.
json sweep_over_elements(json request, const json& elements) {
  request["parameters"] = {{{"name", "n"},
                            {"targets", {{{"pointer", "/analysis/discretization/elements"}}}},
                            {"values", elements}}};
  request["design"] = "grid";
  request["outputs"] = {"/summary/critical_load_factor"};
  return request;
}

TEST(ExpectedTime, GrowsWithTheUnknownsOfEveryType) {
  const ReadOutcome read = read_request(testing::sound_document());
  ASSERT_TRUE(read.request);
  Analysis analysis = read.request->analysis;
  for (const Named<AnalysisType>& type : kAnalysisTypes) {
    analysis.type = type.value;
    double last = 0.0;
    for (const int unknowns : {0, 1, 30, 100, 1000, 30'000, 3'000'000}) {
      const ExpectedTime time = expected_time(read.request->model, analysis, unknowns);
      EXPECT_TRUE(unknowns <= 1 ? time.cpu_seconds > 0.0 : time.cpu_seconds > last)
          << type.name << ' ' << unknowns;
      EXPECT_TRUE(std::isfinite(time.high)) << type.name << ' ' << unknowns;
      EXPECT_LT(0.0, time.low) << type.name << ' ' << unknowns;
      EXPECT_LT(time.low, time.high) << type.name << ' ' << unknowns;
      last = time.cpu_seconds;
    }
  }
}

TEST(ExpectedTime, SaysThatItIsFittedAndHowFarItWasOff) {
  const std::string model = time_of(sound()).model;
  EXPECT_THAT(model, HasSubstr("fitted"));
  EXPECT_THAT(model, HasSubstr("path"));
  EXPECT_THAT(model, HasSubstr("held back"));
  EXPECT_THAT(model, ::testing::Not(HasSubstr("more unknowns")));
  json large = sound();
  large["analysis"]["discretization"] = {{"elements", 100'000}, {"order", 1}};
  EXPECT_THAT(time_of(large).model, HasSubstr("more unknowns"));
}

TEST(ExpectedTime, ASweepTakesAllItsPoints) {
  const double one = time_of(sound()).cpu_seconds;
  const ExpectedTime six = time_of(sweep_over_elements(sound(), {8, 8, 8, 8, 8, 8}));
  EXPECT_NEAR(six.cpu_seconds, 6.0 * one, 1e-9 * one);
  EXPECT_LT(six.low, six.cpu_seconds);
  EXPECT_GT(six.high, six.cpu_seconds);
  json many = json::array();
  for (int i = 0; i < 1000; ++i) {
    many.push_back(8);
  }
  EXPECT_NEAR(time_of(sweep_over_elements(sound(), many)).cpu_seconds, 1000.0 * one, 1e-6 * one);
}

TEST(ExpectedTime, ASweepIsJudgedByItsMedianPoint) {
  json middle = sound();
  middle["analysis"]["discretization"]["elements"] = 32;
  const double one = time_of(middle).cpu_seconds;
  EXPECT_NEAR(time_of(sweep_over_elements(sound(), {4, 512, 32})).cpu_seconds, 3.0 * one, 1e-9 * one);
  EXPECT_NEAR(time_of(sweep_over_elements(sound(), {4, 0, 512, 32})).cpu_seconds, 4.0 * one, 1e-9 * one)
      << "no elements are no valid point";
}

TEST(ExpectedTime, OfALargeDocumentOnePointIsRead) {
  json request = sound();
  json& loads = request["model"]["loads"];
  for (int i = 0; i < 7'000; ++i) {
    loads.push_back(loads[0]);
  }
  const double first = time_of(request).cpu_seconds;
  EXPECT_NEAR(time_of(sweep_over_elements(request, {8, 512, 512})).cpu_seconds, 3.0 * first, 1e-9 * first);
}

TEST(ExpectedTime, ACurveThatIsFollowedTakesLessThanItsPointsAlone) {
  json request = sound();
  request["analysis"] = {{"type", "critical"}, {"discretization", {{"elements", 8}, {"order", 2}}}};
  json values = json::array();
  for (int i = 0; i < 200; ++i) {
    values.push_back(3.0 + 0.01 * i);
  }
  request["parameters"] = {
      {{"name", "k"}, {"targets", {{{"pointer", "/model/foundations/0/stiffness"}}}}, {"values", values}}};
  request["design"] = "grid";
  request["outputs"] = {"/summary/critical_load_factor"};
  const ExpectedTime alone = time_of(request);
  request["follow"] = "k";
  const ExpectedTime followed = time_of(request);
  EXPECT_LT(followed.cpu_seconds, 0.5 * alone.cpu_seconds);
  EXPECT_THAT(followed.model, HasSubstr("followed"));
}

/// A refined sweep has as many points as its curves need.
TEST(ExpectedTime, IsMissingForARefinedSweep) {
  json document = sweep_over_elements(sound(), {8, 16});
  document["parameters"].push_back({{"name", "EA"},
                                    {"targets", {{{"pointer", "/model/sections/0/EA"}}}},
                                    {"range", {{"from", 1e4}, {"to", 1e5}, {"count", 3}}}});
  EXPECT_TRUE(checked(document).expected);
  document["refine"] = {{"output", document["outputs"][0]}};
  const CheckedDocument refined = checked(document);
  EXPECT_TRUE(refined.findings.empty());
  EXPECT_FALSE(refined.expected);
}

TEST(ExpectedTime, StandsInTheSizeOfAValidDocument) {
  const json document = json::parse(write_check(checked(sound())));
  ASSERT_TRUE(document.at("size").is_object()) << document;
  EXPECT_EQ(document["size"].size(), 3U);
  const json& expected = document["size"].at("expected");
  EXPECT_EQ(expected.size(), 4U);
  EXPECT_LT(expected.at("low"), expected.at("cpu_seconds"));
  EXPECT_LT(expected.at("cpu_seconds"), expected.at("high"));
  EXPECT_TRUE(expected.at("model").is_string());
}

TEST(ExpectedTime, IsMissingWhereNothingIsValid) {
  json wrong = sound();
  wrong["analysis"]["discretization"]["elements"] = 0;
  EXPECT_FALSE(checked(wrong).expected);
  EXPECT_TRUE(json::parse(write_check(checked(wrong)))["size"].is_null());
  const json document = json::parse(write_check(checked(sweep_over_elements(sound(), {0, -1}))));
  EXPECT_EQ(document["valid"], true) << "mistakes of single points are found when these are computed";
  EXPECT_EQ(document["size"]["unknowns"], 0);
  EXPECT_TRUE(document["size"]["expected"].is_null());
}

}  // namespace
}  // namespace snapthrough::api
