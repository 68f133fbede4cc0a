/// Rows of followed curves: critical points, special points between rows, and loads without critical points.

#include <gtest/gtest.h>

#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "api/point_outcome.h"
#include "api/sweep.h"
#include "api/sweep_item.h"

namespace snapthrough::api {
namespace {

using nlohmann::json;

json arch_locus() {
  std::ifstream file(SNAPTHROUGH_SOURCE_DIR "/examples/sweeps/arch_locus.json");
  return json::parse(file);
}

std::vector<json> rows_of(const json& document) {
  const SweepOutcome read = read_sweep(document.dump());
  EXPECT_TRUE(read.findings.empty());
  if (!read.sweep) {
    return {};
  }
  std::shared_ptr<json> scratch;
  std::vector<json> rows;
  for (const PointOutcome& outcome : item_outcomes(*read.sweep, 0, {}, {}, scratch)) {
    EXPECT_EQ(outcome.code, "") << outcome.detail;
    rows.push_back(outcome.failed() ? json() : json::parse(outcome.outputs));
  }
  return rows;
}

/// The figures are those of tests/verification/data/arch_critical_locus.csv.
TEST(SweepCurve, LocusHasBothFoldsAndItsSpecialPoints) {
  const std::vector<json> rows = rows_of(arch_locus());
  ASSERT_EQ(rows.size(), 8U);
  // a bifurcation and a limit point of each half of the path at EI = 40
  ASSERT_EQ(rows[1][0].size(), 4U);
  ASSERT_EQ(rows[2][0].size(), 2U);
  EXPECT_EQ(rows[2][0][0]["type"], "limit_max");
  EXPECT_NEAR(rows[2][0][0]["load_factor"], 0.238395743181, 1e-8);
  EXPECT_EQ(rows[2][0][1]["type"], "limit_min");
  EXPECT_NEAR(rows[2][0][1]["load_factor"], 0.0449665081445, 1e-8);
  ASSERT_EQ(rows[6][1].size(), 1U);
  EXPECT_EQ(rows[6][1][0]["type"], "cusp");
  EXPECT_NEAR(rows[6][1][0]["value"], 254.153035909, 1e-5);
  EXPECT_NEAR(rows[6][1][0]["load_factor"], 0.459814849519, 1e-8);
  EXPECT_TRUE(rows[6][2].is_null());
  EXPECT_TRUE(rows[7][0].empty());
  EXPECT_GT(rows[7][2], 100.0);
}

TEST(SweepCurve, NamedPointEndsWhereItVanishes) {
  json document = arch_locus();
  // from EI = 80 the path has no bifurcation: 0 is the maximum, 1 the minimum
  document["parameters"][0]["values"] = {80, 160, 240, 280};
  document["follow"] = {{"parameter", "EI"}, {"point", 1}};
  document["outputs"] = {"/summary/critical_load_factor", "/summary/critical_type", "/curve/none_up_to"};
  const std::vector<json> rows = rows_of(document);
  ASSERT_EQ(rows.size(), 4U);
  EXPECT_NEAR(rows[1][0], 0.249611608292, 1e-8);
  EXPECT_EQ(rows[1][1], "limit_min");
  EXPECT_NEAR(rows[2][0], 0.431833666309, 1e-8);
  EXPECT_TRUE(rows[3][0].is_null());
  EXPECT_GT(rows[3][2], 100.0);
}

TEST(SweepCurve, FirstPointSaysUpToWhichLoadThereIsNone) {
  json document = arch_locus();
  document["follow"] = "EI";
  document["outputs"] = {"/summary/critical_load_factor", "/curve/none_up_to"};
  const std::vector<json> rows = rows_of(document);
  ASSERT_EQ(rows.size(), 8U);
  EXPECT_NEAR(rows[6][0], 0.436435362809, 1e-8);
  EXPECT_TRUE(rows[6][1].is_null());
  EXPECT_TRUE(rows[7][0].is_null());
  EXPECT_GT(rows[7][1], 100.0);
}

}  // namespace
}  // namespace snapthrough::api
