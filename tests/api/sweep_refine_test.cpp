/// Refined sweeps: what their documents must have, and their rows against closed forms.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "api/point_outcome.h"
#include "api/solved_point.h"
#include "api/sweep.h"
#include "api/sweep_item.h"
#include "api/sweep_table.h"
#include "solver/solve.h"

namespace snapthrough::api {
namespace {

using nlohmann::json;
using ::testing::ElementsAre;

/// A pinned column of length 10 on an elastic foundation of stiffness K/10^4, EI = 1: its loads are those of
/// length 1 and stiffness K, over 100.
json film() {
  std::ifstream file(SNAPTHROUGH_SOURCE_DIR "/examples/gallery/charts/film.json");
  json document = json::parse(file);
  document["parameters"][0]["targets"] = {{{"pointer", "/model/foundations/0/stiffness"}, {"scale", 1e-4}}};
  document["parameters"][0]["range"] = {{"from", 10}, {"to", 100000}, {"count", 9}, {"spacing", "log"}};
  document["refine"] = {{"output", "/buckling/load_factors/0"}, {"within", 0.01}};
  return document;
}

/// Timoshenko: n^2 pi^2 + K/(n^2 pi^2), the least over the number of half-waves n.
double load_of(double stiffness) {
  double least = INFINITY;
  for (int n = 1; n < 12; ++n) {
    const double square = std::pow(n * std::numbers::pi, 2);
    least = std::min(least, square + stiffness / square);
  }
  return least / 100.0;
}

json table_of(const json& document, std::string* outcome_code = nullptr) {
  const SweepOutcome read = read_sweep(document.dump());
  EXPECT_TRUE(read.findings.empty()) << read.findings[0].detail;
  const SolvePoint solve = [](const Model& model, const Analysis& analysis, const Hooks& hooks) {
    return TimedResult{snapthrough::solve(model, analysis, hooks), 0.0};
  };
  std::shared_ptr<json> scratch;
  TableWriter writer(*read.sweep, TableForm::json);
  std::string text = writer.head();
  for (std::uint64_t item = 0; item < read.sweep->items(); ++item) {
    for (const PointOutcome& outcome : item_outcomes(*read.sweep, item, solve, {}, scratch)) {
      writer.append_row(item, outcome, text);
      if (outcome_code != nullptr) {
        *outcome_code = outcome.code;
      }
    }
  }
  writer.append_tail(text);
  return json::parse(text);
}

TEST(SweepRefine, LinesAreWithinAPercentOfTheClosedForm) {
  const json table = table_of(film());
  EXPECT_THAT(table["columns"].get<std::vector<std::string>>(),
              ElementsAre("K L^4/EI", "/buckling/load_factors/0", "piece", "change", "error"));
  const json& rows = table["rows"];
  for (std::size_t i = 1; i < rows.size(); ++i) {
    const double from = rows[i - 1][0];
    const double to = rows[i][0];
    ASSERT_LT(from, to);
    EXPECT_NEAR(rows[i][1].get<double>() / load_of(to), 1.0, 1e-6);
    for (const double t : {0.1, 0.3, 0.5, 0.7, 0.9}) {
      const double line = (1.0 - t) * rows[i - 1][1].get<double>() + t * rows[i][1].get<double>();
      EXPECT_NEAR(line / load_of(from * std::pow(to / from, t)), 1.0, 0.01) << from << ' ' << to;
    }
  }
}

/// The number of half-waves goes from n to n + 1 at K = n^2 (n + 1)^2 pi^4.
TEST(SweepRefine, ModesChangeWhereTheirLoadsMeet) {
  const json rows = table_of(film())["rows"];
  const double place = std::pow(1e4, 1.0 / 4096.0);  // ratio of neighbouring stiffnesses
  int changes = 0;
  for (std::size_t i = 1; i < rows.size(); ++i) {
    if (rows[i][2] == rows[i - 1][2]) {
      EXPECT_TRUE(rows[i][3].is_null());
      continue;
    }
    ++changes;
    const double meet = std::pow(changes * (changes + 1.0), 2) * std::pow(std::numbers::pi, 4);
    EXPECT_LE(rows[i - 1][0].get<double>(), meet);
    EXPECT_GE(rows[i][0].get<double>(), meet);
    EXPECT_NEAR(rows[i][0].get<double>() / rows[i - 1][0].get<double>(), place, 1e-9);
    EXPECT_EQ(rows[i][3],
              "mode: " + std::to_string(changes) + " to " + std::to_string(changes + 1) + " turning points");
  }
  EXPECT_EQ(changes, 5);
}

/// Each row leads to the request of its point.
TEST(SweepRefine, PointsOfRowsHaveTheirRequests) {
  const json document = film();
  const SweepOutcome read = read_sweep(document.dump());
  ASSERT_TRUE(read.sweep);
  EXPECT_EQ(read.sweep->size(), 1U);
  EXPECT_EQ(read.sweep->places(), 4097U);
  const json table = table_of(document);
  ASSERT_EQ(table["points"].size(), table["rows"].size());
  for (std::size_t i = 0; i < table["points"].size(); i += 10) {
    const auto point = table["points"][i].get<std::uint64_t>();
    EXPECT_EQ(read.sweep->values(point)[0], table["rows"][i][0]);
    EXPECT_NEAR((*read.sweep->document_at(point))["model"]["foundations"][0]["stiffness"].get<double>() *
                    1e4 / table["rows"][i][0].get<double>(),
                1.0, 1e-12);
  }
}

TEST(SweepRefine, TooFewPointsAreAFailureThatSaysWhere) {
  json document = film();
  document["refine"]["most"] = 20;
  std::string code;
  const json rows = table_of(document, &code)["rows"];
  EXPECT_EQ(code, "refinement_limit");
  ASSERT_EQ(rows.size(), 1U);
  EXPECT_TRUE(rows[0][0].is_null());
  EXPECT_THAT(rows[0][4]["detail"].get<std::string>(), ::testing::HasSubstr("between K L^4/EI = "));
}

/// "pointer code" of each finding about the film with other members.
std::vector<std::string> mistakes_with(const json& patch) {
  json document = film();
  document.merge_patch(patch);
  std::vector<std::string> found;
  for (const Finding& finding : read_sweep(document.dump()).findings) {
    found.push_back(finding.pointer + " " + finding.code);
  }
  return found;
}

TEST(SweepRefine, MistakesAreNamed) {
  EXPECT_THAT(mistakes_with({{"refine", {{"output", "/summary/message"}}}}),
              ElementsAre("/refine unknown_reference"));
  EXPECT_THAT(mistakes_with({{"refine", {{"within", 0.0}}}}), ElementsAre("/refine/within out_of_range"));
  EXPECT_THAT(mistakes_with({{"refine", {{"within", "1 %"}}}}), ElementsAre("/refine/within wrong_type"));
  EXPECT_THAT(mistakes_with({{"refine", {{"parameters", 3}}}}),
              ElementsAre("/refine/parameters out_of_range"));
  EXPECT_THAT(mistakes_with({{"refine", {{"parameters", 2}}}}), ElementsAre("/refine out_of_range"));
  EXPECT_THAT(mistakes_with({{"refine", {{"most", 2}}}}), ElementsAre("/refine/most out_of_range"));
  EXPECT_THAT(mistakes_with({{"refine", {{"points", 2}}}}), ElementsAre("/refine/points unknown_field"));
  EXPECT_THAT(mistakes_with({{"design", "zip"}}), ElementsAre("/refine not_supported"));
  json values = film();
  values["parameters"][0].erase("range");
  values["parameters"][0]["values"] = {10, 20};
  EXPECT_EQ(read_sweep(values.dump()).findings[0].code, "not_supported");
  json named = film();
  named["parameters"][0]["name"] = "piece";
  EXPECT_EQ(read_sweep(named.dump()).findings[0].code, "invalid_name");
  EXPECT_EQ(read_sweep(film().dump(), 999).findings[0].code, "too_many_points");
}

}  // namespace
}  // namespace snapthrough::api
