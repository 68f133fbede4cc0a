/// Reading of sweep documents: what they expand to, and every mistake with its place.

#include "api/sweep.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "api/point_outcome.h"
#include "api/sweep_data.h"
#include "api/sweep_table.h"
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

TEST(Sweep, NumbersOfTheLawOfAJointAreParameters) {
  const std::string capacity = "/model/members/0/release/start/rotation/law/capacity";
  json document = sound_sweep();
  document["model"]["members"][0]["release"]["start"] = {
      {"rotation", {{"law", {{"type", "tanh"}, {"stiffness", 500.0}, {"capacity", 40.0}}}}}};
  document["parameters"] = {parameter("C", capacity, {20.0, 30.0})};
  const SweepOutcome outcome = read(document);
  ASSERT_THAT(outcome.findings, IsEmpty());
  const ReadOutcome second = read_request_document(outcome.sweep->document_at(1));
  ASSERT_THAT(second.findings, IsEmpty());
  EXPECT_EQ(second.request->model.members[0].release_start_law->capacity.constant, 30.0);
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
  EXPECT_EQ(value(2), 5.0);
  document["parameters"][0]["range"] = {{"from", 0}, {"to", 100}, {"count", 1001}};
  for (int i = 0; i <= 1000; i += 37) {
    EXPECT_EQ(value(static_cast<std::uint64_t>(i)), i / 10.0) << "the nearest number to the decimal";
  }
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

std::string one_row(const Sweep& sweep, TableForm form, std::uint64_t point, const PointOutcome& outcome) {
  TableWriter writer(sweep, form);
  std::string text;
  writer.append_row(point, outcome, text);
  return text;
}

TEST(Sweep, OutcomesHoldTheOutputsOrSayWhyNot) {
  const Sweep sweep = *read(sound_sweep()).sweep;
  EXPECT_THAT(sweep.columns(),
              ElementsAre("k", "a", "/summary/critical_load_factor", "/critical_points/0/type", "error"));
  const json result = {{"summary", {{"critical_load_factor", 2.5}}}, {"critical_points", json::array()}};
  EXPECT_EQ(sweep.outcome(result).outputs, "[2.5,null]") << "a list that ended is null";
  const json other = {{"summary", json::object()}, {"critical_points", json::array()}};
  EXPECT_EQ(sweep.outcome(other).code, "no_such_output") << "a field that is not there is an error";
}

TEST(Sweep, OutputsOfAPointAreBounded) {
  json document = sound_sweep();
  document["outputs"] = {"/summary/message"};
  const Sweep sweep = *read(document).sweep;
  json result = {{"summary", {{"message", std::string(kMaxOutputBytes - 4, 'x')}}}};
  EXPECT_EQ(sweep.outcome(result).code, "") << "brackets and quotes are the other four bytes";
  result["summary"]["message"] = std::string(kMaxOutputBytes - 3, 'x');
  EXPECT_EQ(sweep.outcome(result).code, "outputs_too_large");
}

TEST(Sweep, DocumentsWrittenOverOneAnotherAreThoseOfTheirPoints) {
  json swept = sound_sweep();
  swept["parameters"].push_back(
      parameter("all", "/model/supports", {json::array(), json::array({{{"node", "a"}, {"fixed", {"x"}}}})}));
  const Sweep sweep = *read_sweep_document(std::make_shared<json>(swept)).sweep;
  ASSERT_EQ(sweep.size(), 12U);
  std::shared_ptr<json> document;
  for (const std::uint64_t point : {3, 0, 11, 10, 1, 1, 7, 2}) {
    sweep.write_document(point, document);
    EXPECT_EQ(*document, *sweep.document_at(point)) << point;
  }
}

TEST(Sweep, SparesPlacesThatNoOutputLooksAt) {
  json document = sound_sweep();
  const auto places_for = [&](const char* output, const char* type) {
    document["analysis"] = {{"type", type}, {"output", {{"extremes", true}}}};
    document["outputs"] = {output};
    const SweepOutcome outcome = read(document);
    Analysis analysis;
    analysis.output.extremes = true;
    outcome.sweep->spare_unused(analysis);
    EXPECT_EQ(outcome.sweep->parts(), std::vector<std::string_view>{outcome.sweep->parts()[0]});
    return analysis.output.points_per_member;
  };
  EXPECT_EQ(places_for("/summary/critical_load_factor", "path"), 2);
  EXPECT_EQ(places_for("/buckling/load_factors/0", "buckling"), 2);
  EXPECT_EQ(places_for("/buckling/modes/0", "buckling"), 101);
  EXPECT_EQ(places_for("/buckling", "buckling"), 101);
  EXPECT_EQ(places_for("/states/0/load_factor", "static"), 101);
  EXPECT_EQ(places_for("/critical_points/0/type", "path"), 2);
  EXPECT_EQ(places_for("/critical_points/0/mode/members", "path"), 101);
  EXPECT_EQ(places_for("/extremes/members", "path"), 101);
}

TEST(Sweep, SparesModesAndExtremesThatNoOutputLooksAt) {
  json document = sound_sweep();
  document["analysis"]["output"]["extremes"] = true;
  const auto spared = [&](const char* output) {
    document["outputs"] = {output};
    Analysis analysis;
    analysis.output.extremes = true;
    read(document).sweep->spare_unused(analysis);
    return std::pair{analysis.output.modes, analysis.output.extremes};
  };
  EXPECT_EQ(spared("/summary/critical_load_factor"), std::pair(false, false));
  EXPECT_EQ(spared("/critical_points/0/load_factor"), std::pair(false, false));
  EXPECT_EQ(spared("/critical_points/0/mode/members"), std::pair(true, false));
  EXPECT_EQ(spared("/critical_points/0"), std::pair(true, false));
  EXPECT_EQ(spared("/extremes/members"), std::pair(false, true));
}

TEST(Sweep, DropsOnlyWhatNoOutputLooksInto) {
  Result full;
  full.critical_points.resize(2);
  full.contact_events.resize(1);
  full.branches.resize(1);
  full.states.resize(1);
  full.buckling = BucklingResult{{1.0, 2.0}, {1e-6, {}}, std::vector<Mode>(2)};
  Result result = full;
  (*read(sound_sweep()).sweep).drop_unused(result);
  EXPECT_EQ(result.critical_points.size(), 2U) << "/critical_points/0/type";
  EXPECT_TRUE(result.contact_events.empty() && result.branches.empty() && result.states.empty());
  EXPECT_TRUE(result.buckling->modes.empty());
  EXPECT_EQ(result.buckling->load_factors.size(), 2U);
  json document = sound_sweep();
  document["analysis"] = {{"type", "path"}};
  document["outputs"] = {"/states", "/branches/0/load_factor", "/contact_events/0"};
  result = full;
  (*read(document).sweep).drop_unused(result);
  EXPECT_TRUE(result.critical_points.empty());
  EXPECT_EQ(result.contact_events.size() + result.branches.size() + result.states.size(), 3U);
  EXPECT_TRUE(result.buckling->modes.empty());
  document["analysis"] = {{"type", "buckling"}};
  document["outputs"] = {"/buckling/modes/0/members"};
  result = full;
  (*read(document).sweep).drop_unused(result);
  EXPECT_EQ(result.buckling->modes.size(), 2U);
  document["outputs"] = {"/buckling"};
  result = full;
  (*read(document).sweep).drop_unused(result);
  EXPECT_EQ(result.buckling->modes.size(), 2U);
}

TEST(Sweep, TablesHoldValuesOutputsAndErrorInEveryForm) {
  const Sweep sweep = *read(sound_sweep()).sweep;
  const PointOutcome good{R"([2.5,"limit, \"max\""])", "", ""};
  const PointOutcome bad{"", "no_convergence", "step 3"};
  TableWriter writer(sweep, TableForm::json);
  std::string text = writer.head();
  writer.append_row(3, good, text);
  writer.append_row(0, bad, text);
  EXPECT_FALSE(writer.append_tail(text));
  EXPECT_EQ(json::parse(text), json::parse(R"({
    "columns": ["k", "a", "/summary/critical_load_factor", "/critical_points/0/type", "error"],
    "rows": [[5, 1e-4, 2.5, "limit, \"max\"", null],
             [3, 1e-4, null, null, {"code": "no_convergence", "detail": "step 3"}]],
    "points": [3, 0]})"));
  EXPECT_EQ(TableWriter(sweep, TableForm::csv).head(),
            "k,a,/summary/critical_load_factor,/critical_points/0/type,error\n");
  EXPECT_EQ(one_row(sweep, TableForm::csv, 3, good), "5,0.0001,2.5,\"limit, \"\"max\"\"\",\n");
  EXPECT_EQ(one_row(sweep, TableForm::csv, 0, bad),
            "3,0.0001,,,\"{\"\"code\"\":\"\"no_convergence\"\",\"\"detail\"\":\"\"step 3\"\"}\"\n");
  const json line = json::parse(one_row(sweep, TableForm::ndjson, 0, bad));
  EXPECT_EQ(line["k"], 3);
  EXPECT_TRUE(line["/critical_points/0/type"].is_null());
  EXPECT_EQ(line["error"]["code"], "no_convergence");
  EXPECT_EQ(line["point"], 0);
  EXPECT_EQ(json::parse(one_row(sweep, TableForm::ndjson, 3, good))["/summary/critical_load_factor"], 2.5);
}

json hypercube(int samples, int seed) {
  json document = sound_sweep();
  document["design"] = {{"latin_hypercube", {{"samples", samples}, {"seed", seed}}}};
  document["parameters"][0].erase("values");
  document["parameters"][0]["range"] = {{"from", 1e2}, {"to", 1e6}, {"spacing", "log"}};
  return document;
}

/// The definition: of n samples, exactly one lies in each of n equal parts of each range, and a list of
/// values gets its equal shares.
TEST(Sweep, ALatinHypercubeHasOneSampleInEachPart) {
  for (const int samples : {1, 2, 3, 17, 64, 999, 4096}) {
    const SweepOutcome outcome = read(hypercube(samples, 7));
    ASSERT_THAT(outcome.findings, IsEmpty());
    ASSERT_EQ(outcome.sweep->size(), static_cast<std::uint64_t>(samples));
    std::vector<int> parts(static_cast<std::size_t>(samples));
    std::map<double, int> shares;
    for (std::uint64_t i = 0; i < outcome.sweep->size(); ++i) {
      const json values = outcome.sweep->values(i);
      const double t = std::log(values[0].get<double>() / 1e2) / std::log(1e4);
      ++parts.at(static_cast<std::size_t>(t * samples));
      ++shares[values[1].get<double>()];
    }
    EXPECT_THAT(parts, ::testing::Each(1)) << samples;
    for (const auto& [value, count] : shares) {
      EXPECT_NEAR(count, samples / 3.0, 1.0) << value;
    }
  }
}

/// Correlations of independent permutations have variance 1/(n - 1): six deviations hardly ever happen.
TEST(Sweep, ALatinHypercubeIsNotCorrelatedAndDependsOnItsSeed) {
  json document = hypercube(4000, 1);
  document["parameters"][0]["range"] = {{"from", 0}, {"to", 1}};
  document["parameters"][1].erase("values");
  document["parameters"][1]["range"] = {{"from", 0}, {"to", 1}};
  const auto points = [](const json& of) {
    const Sweep sweep = *read(of).sweep;
    std::vector<std::pair<double, double>> all;
    for (std::uint64_t i = 0; i < sweep.size(); ++i) {
      const json values = sweep.values(i);
      all.emplace_back(values[0].get<double>(), values[1].get<double>());
    }
    return all;
  };
  const auto first = points(document);
  double across = 0.0;
  double along = 0.0;
  double next = 0.0;
  for (std::size_t i = 0; i < first.size(); ++i) {
    const auto [x, y] = first[i];
    across += (x - 0.5) * (y - 0.5) * 12.0 / 4000.0;
    along += (x - 0.5) * (static_cast<double>(i) / 4000.0 - 0.5) * 12.0 / 4000.0;
    next += (x - 0.5) * (first[(i + 1) % 4000].first - 0.5) * 12.0 / 4000.0;
  }
  const double bound = 6.0 / std::sqrt(3999.0);
  EXPECT_LT(std::abs(across), bound);
  EXPECT_LT(std::abs(along), bound);
  EXPECT_LT(std::abs(next), bound);
  EXPECT_EQ(points(document), first);
  document["design"]["latin_hypercube"]["seed"] = 2;
  EXPECT_NE(points(document), first);
}

TEST(Sweep, SaysWhatIsWrongWithALatinHypercube) {
  const auto with = [](const std::string& pointer, const json& value) {
    json document = hypercube(10, 1);
    document[json::json_pointer(pointer)] = value;
    return mistakes(document);
  };
  const std::string design = "/design/latin_hypercube";
  EXPECT_THAT(with(design, json::object()),
              ElementsAre(design + "/samples missing_field", design + "/seed missing_field"));
  EXPECT_THAT(with(design + "/samples", 0), ElementsAre(design + "/samples out_of_range"));
  EXPECT_THAT(with(design + "/samples", 2'000'000), ElementsAre(design + "/samples too_many_points"));
  EXPECT_THAT(with(design + "/samples", 1e12), ElementsAre(design + "/samples out_of_range"));
  EXPECT_THAT(with(design + "/seed", -1), ElementsAre(design + "/seed out_of_range"));
  EXPECT_THAT(with(design + "/sead", 1), ElementsAre(design + "/sead unknown_field"));
  EXPECT_THAT(with("/design", {{"latin_square", 1}}),
              ElementsAre("/design/latin_hypercube missing_field", "/design/latin_square unknown_field"));
  EXPECT_THAT(with("/parameters/0/range/count", 3), ElementsAre("/parameters/0/range/count excess_field"));
}

TEST(Sweep, SaysWhereAMistakeIs) {
  EXPECT_THAT(mistakes_with("/design", "gird"), ElementsAre("/design unknown_value"));
  EXPECT_THAT(mistakes_with("/outputs", json::array()), ElementsAre("/outputs wrong_type"));
  EXPECT_THAT(mistakes_with("/outputs/0", "summary"), ElementsAre("/outputs/0 invalid_pointer"));
  EXPECT_THAT(mistakes_with("/outputs/0", "/critical_points/0/type"),
              ElementsAre("/outputs/1 duplicate_name"));
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
  EXPECT_THAT(mistakes_with("/parameters/0/values", {1, "rigid", 2.5, nullptr}),
              ElementsAre("/parameters/0/values/3 wrong_type"));
  EXPECT_THAT(mistakes_with("/parameters/1/targets/0/pointer", "/model/members/0/section"),
              ElementsAre("/parameters/1/values/0 wrong_type", "/parameters/1/values/1 wrong_type",
                          "/parameters/1/values/2 wrong_type"));
  EXPECT_THAT(mistakes_with("/parameters/0/targets", json(std::vector<int>(65))),
              ElementsAre("/parameters/0/targets out_of_range"));
  json document = sound_sweep();
  document["parameters"][0]["targets"][0]["scale"] = 2;
  document["parameters"][0]["values"] = {1, "x"};
  EXPECT_THAT(mistakes(document), ElementsAre("/parameters/0/values/1 wrong_type"));
}

/// The sound sweep as one whose critical point is followed along the amplitude.
json followed() {
  json document = sound_sweep();
  document["analysis"] = {{"type", "critical"}, {"discretization", {{"elements", 4}, {"order", 2}}}};
  document["follow"] = "a";
  document["outputs"] = {"/summary/critical_load_factor"};
  return document;
}

TEST(Sweep, FollowsTheLastParameter) {
  const SweepOutcome outcome = read(followed());
  ASSERT_THAT(outcome.findings, IsEmpty());
  EXPECT_TRUE(outcome.sweep->follows());
  EXPECT_EQ(outcome.sweep->item_size(), 3U);
  EXPECT_FALSE(outcome.sweep->follows_logarithm());
  const auto between = outcome.sweep->document_between(3, 1.5e-4);
  EXPECT_EQ(between->at("/model/foundations/0/stiffness"_json_pointer), 5);
  EXPECT_EQ(between->at("/model/imperfections/0/amplitude"_json_pointer), 1.5e-4);
  EXPECT_EQ(outcome.sweep->curve_text(3), outcome.sweep->curve_text(5));
  EXPECT_EQ(read(sound_sweep()).sweep->item_size(), 1U);
}

TEST(Sweep, FollowsANamedPointOrTheWholeLocus) {
  json document = followed();
  document["follow"] = {{"parameter", "a"}, {"point", 1}};
  document["outputs"] = {"/summary/critical_load_factor", "/curve/none_up_to", "/curve/events"};
  const SweepOutcome named = read(document);
  ASSERT_THAT(named.findings, IsEmpty());
  EXPECT_TRUE(named.sweep->follows());
  EXPECT_EQ(named.sweep->data().followed.point, 1);
  document["follow"] = {{"parameter", "a"}, {"locus", true}};
  document["outputs"] = {"/curve/critical_points/1/load_factor", "/curve/events/0/value"};
  const SweepOutcome locus = read(document);
  ASSERT_THAT(locus.findings, IsEmpty());
  EXPECT_TRUE(locus.sweep->data().followed.locus);
  // the store knows rows of a curve by this text: a named point, a locus and the first point have rows of
  // their own
  EXPECT_NE(named.sweep->curve_text(0), locus.sweep->curve_text(0));
  EXPECT_NE(named.sweep->curve_text(0), read(followed()).sweep->curve_text(0));
}

TEST(Sweep, SaysWhatIsWrongWithAPointOrALocus) {
  const auto with = [](const json& follow, const std::string& output) {
    json document = followed();
    document["follow"] = follow;
    document["outputs"] = {output};
    return mistakes(document);
  };
  const std::string load = "/summary/critical_load_factor";
  EXPECT_THAT(with({{"point", 0}}, load), ElementsAre("/follow/parameter missing_field"));
  EXPECT_THAT(with({{"parameter", "k"}, {"point", 0}}, load), ElementsAre("/follow unknown_reference"));
  EXPECT_THAT(with({{"parameter", "a"}, {"point", -1}}, load), ElementsAre("/follow/point out_of_range"));
  EXPECT_THAT(with({{"parameter", "a"}, {"point", "first"}}, load), ElementsAre("/follow/point wrong_type"));
  EXPECT_THAT(with({{"parameter", "a"}, {"locus", 1}}, load), ElementsAre("/follow/locus wrong_type"));
  EXPECT_THAT(with({{"parameter", "a"}, {"loci", true}}, load), ElementsAre("/follow/loci unknown_field"));
  EXPECT_THAT(with({{"parameter", "a"}, {"locus", true}, {"point", 0}}, "/curve/events"),
              ElementsAre("/follow excess_field"));
  EXPECT_THAT(with({{"parameter", "a"}, {"locus", true}}, load), ElementsAre("/follow not_supported"));
  EXPECT_THAT(with({{"parameter", "a"}, {"locus", true}}, "/curve/folds"),
              ElementsAre("/follow not_supported"));
  json alone = sound_sweep();
  alone["outputs"] = {"/curve/events"};
  EXPECT_THAT(mistakes(alone), ElementsAre("/outputs/0 unknown_field"));
}

TEST(Sweep, SaysWhatCannotBeFollowed) {
  const auto with = [](const std::string& pointer, const json& value) {
    json document = followed();
    document[json::json_pointer(pointer)] = value;
    return mistakes(document);
  };
  EXPECT_THAT(with("/follow", "k"), ElementsAre("/follow unknown_reference"));
  EXPECT_THAT(with("/follow", 1), ElementsAre("/follow wrong_type"));
  EXPECT_THAT(with("/design", "zip"), ::testing::Contains("/follow not_supported"));
  EXPECT_THAT(with("/model/loads/0/follows", true), ElementsAre("/follow not_supported"));
  EXPECT_THAT(with("/model/loads/0/fixed_line", true), ElementsAre("/follow not_supported"));
  EXPECT_THAT(with("/parameters/1/values", {1e-4, 3e-4, 2e-4}), ElementsAre("/follow not_supported"));
  EXPECT_THAT(with("/analysis/type", "path"), ElementsAre("/follow not_supported"));
  EXPECT_THAT(with("/outputs/0", "/summary/message"), ElementsAre("/follow not_supported"));
  EXPECT_THAT(with("/model/imperfections/0", {{"type", "worst"}, {"norm", "max"}, {"amplitude", 1e-3}}),
              ElementsAre("/follow not_supported"));
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
