/// Sweep documents as functions: what their inputs and outputs are, and what is made of values and results.

#include "api/component.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/api/documents.h"

namespace snapthrough::api {
namespace {

using nlohmann::json;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

json parameter(const std::string& name, const std::string& pointer, json values) {
  return {{"name", name}, {"targets", {{{"pointer", pointer}}}}, {"values", std::move(values)}};
}

json document_with(json parameters, json outputs = {"/summary/critical_load_factor"}) {
  json document = json::parse(testing::sound_document());
  document["parameters"] = std::move(parameters);
  document["design"] = "zip";
  document["outputs"] = std::move(outputs);
  return document;
}

Component component_of(const json& document) {
  const ComponentOutcome outcome = read_component(document.dump());
  EXPECT_THAT(outcome.findings, IsEmpty());
  return outcome.component.value();
}

std::vector<std::string> output_names(const json& document) {
  const Component component = component_of(document);
  std::vector<std::string> names;
  for (const ComponentOutput& output : component.outputs()) {
    names.push_back(output.name);
  }
  return names;
}

TEST(Component, TheFirstValueStandsAtTheBeginningAndSeveralBoundTheInput) {
  const json parameters =
      json::array({parameter("k", "/model/foundations/0/stiffness", {5, 3, 8}),
                   parameter("a", "/model/imperfections/0/amplitude", {1e-4, 2e-4, 3e-4})});
  const Component component = component_of(document_with(parameters));
  const ComponentInput& k = component.inputs()[0];
  EXPECT_EQ(k.initial, 5);
  EXPECT_EQ(k.least, 3.0);
  EXPECT_EQ(k.most, 8.0);
  EXPECT_EQ(k.type, PlugType::number);
  EXPECT_EQ(k.description, "Written to /model/foundations/0/stiffness; 3 to 8");
  const json one = json::array({parameter("k", "/model/foundations/0/stiffness", {5})});
  EXPECT_FALSE(component_of(document_with(one)).inputs()[0].least.has_value());
}

TEST(Component, ValuesAreWrittenIntoTheRequest) {
  const json parameters = json::array({parameter("k", "/model/foundations/0/stiffness", {5, 3}),
                                       parameter("a", "/model/imperfections/0/amplitude", {1e-4, 2e-4})});
  const Component component = component_of(document_with(parameters));
  const ComponentCall call = component.call({{"k", 4.5}, {"a", 1.5e-4}});
  ASSERT_THAT(call.findings, IsEmpty());
  EXPECT_EQ(call.document["model"]["foundations"][0]["stiffness"], 4.5);
  EXPECT_EQ(call.document["model"]["imperfections"][0]["amplitude"], 1.5e-4);
  EXPECT_FALSE(call.document.contains("parameters"));
  EXPECT_EQ(component.input_at("/model/foundations/0/stiffness"), "k");
  EXPECT_EQ(component.input_at("/model/foundations"), "k");
  EXPECT_EQ(component.input_at("/model/foundations/0/stiff"), "");
}

TEST(Component, EveryWrongValueIsReported) {
  const json parameters = json::array({parameter("k", "/model/foundations/0/stiffness", {5, 3}),
                                       parameter("a/b", "/model/imperfections/0/amplitude", {1e-4, 2e-4})});
  const ComponentCall call = component_of(document_with(parameters)).call({{"k", 5.5}});
  ASSERT_EQ(call.findings.size(), 2U);
  EXPECT_EQ(call.findings[0].pointer, "/k");
  EXPECT_EQ(call.findings[0].detail, "must be 3 to 5, got 5.5");
  EXPECT_EQ(call.findings[1].pointer, "/a~1b");
  EXPECT_TRUE(call.document.is_null());
}

TEST(Component, ALabelChoosesItsValue) {
  json feet = parameter("feet", "/model/supports", json::array());
  const json supports = document_with(json::array())["model"]["supports"];
  feet["values"] = {supports, supports};
  feet["label"] = {"one", "two"};
  const Component component = component_of(document_with(json::array({feet})));
  EXPECT_EQ(component.inputs()[0].type, PlugType::text);
  EXPECT_EQ(component.inputs()[0].initial, "one");
  EXPECT_EQ(component.call({{"feet", "two"}}).document["model"]["supports"], supports);
  EXPECT_THAT(component.call({{"feet", "three"}}).findings[0].detail, HasSubstr("one of one, two"));
  feet.erase("label");
  const ComponentOutcome bare = read_component(document_with(json::array({feet})).dump());
  ASSERT_EQ(bare.findings.size(), 1U);
  EXPECT_EQ(bare.findings[0].pointer, "/parameters/0/values");
}

TEST(Component, OutputsAreCalledByTheLastNameAndNeverTwiceTheSame) {
  const json parameters = json::array({parameter("k", "/model/foundations/0/stiffness", {3})});
  const json outputs{"/summary/critical_load_factor", "/critical_points/0/load_factor",
                     "/critical_points/1/load_factor", "/critical_points"};
  EXPECT_THAT(output_names(document_with(parameters, outputs)),
              ElementsAre("critical_load_factor", "load_factor", "1/load_factor", "critical_points", "path"));
}

TEST(Component, WhatIsDrawnDependsOnTheAnalysis) {
  const json parameters = json::array({parameter("k", "/model/foundations/0/stiffness", {3})});
  json document = document_with(parameters);
  document["model"]["monitors"] = json::array(
      {{{"id", "tip"}, {"at", {{"node", document["model"]["nodes"][1]["id"]}}}, {"component", "y"}}});
  const auto last_names = [&](const json& analysis) {
    document["analysis"] = analysis;
    const std::vector<std::string> names = output_names(document);
    return std::vector<std::string>(names.begin() + 1, names.end());
  };
  EXPECT_THAT(last_names({{"type", "path"}, {"stop", {{"limit_points", 1}}}}), ElementsAre("path", "shape"));
  EXPECT_THAT(last_names({{"type", "critical"}}), ElementsAre("shape"));
  EXPECT_THAT(last_names({{"type", "critical"}, {"output", {{"states", "none"}}}}), IsEmpty());
}

TEST(Component, PathsAndShapesAreLines) {
  const json parameters = json::array({parameter("k", "/model/foundations/0/stiffness", {3})});
  json document =
      document_with(parameters, {"/critical_points/0/load_factor", "/critical_points/1/load_factor"});
  document["model"]["monitors"] = json::array(
      {{{"id", "tip"}, {"at", {{"node", document["model"]["nodes"][1]["id"]}}}, {"component", "y"}}});
  document["analysis"] = {{"type", "path"}, {"stop", {{"limit_points", 1}}}};
  const json shape{{"x", {0.0, 1.0}}, {"y", {0.0, -0.5}}};
  const json result{
      {"branches", {{{"load_factor", {0, 1.5}}, {"monitors", {{"tip", {0.0, -0.25}}}}}}},
      {"states", {{{"members", {{"m", {{"x", {9.0}}, {"y", {9.0}}}}}}}, {{"members", {{"m", shape}}}}}},
      {"critical_points", {{{"load_factor", 1.25}, {"state", 1}}}}};
  const std::vector<ComponentValue> values = component_of(document).values(result);
  ASSERT_EQ(values.size(), 4U);
  EXPECT_EQ(values[0].value, 1.25);
  EXPECT_TRUE(values[1].value.is_null());
  EXPECT_THAT(values[2].lines[0].place, ElementsAre(0, 0));
  EXPECT_THAT(values[2].lines[0].points, ElementsAre(ElementsAre(0.0, 0.0), ElementsAre(-0.25, 1.5)));
  EXPECT_THAT(values[3].lines[0].points, ElementsAre(ElementsAre(0.0, 0.0), ElementsAre(1.0, -0.5)));
}

TEST(Component, ACurveIsNoComponent) {
  json document = document_with(json::array({parameter("k", "/model/foundations/0/stiffness", {3, 4})}));
  document["design"] = "grid";
  document["analysis"] = {{"type", "critical"}, {"discretization", {{"elements", 8}}}};
  document["outputs"] = {"/summary/critical_load_factor", "/summary/critical_type"};
  document["follow"] = "k";
  const ComponentOutcome outcome = read_component(document.dump());
  ASSERT_EQ(outcome.findings.size(), 1U);
  EXPECT_EQ(outcome.findings[0].pointer, "/follow");
}

}  // namespace
}  // namespace snapthrough::api
