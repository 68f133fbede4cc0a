/// Models that failed once. Each line of regressions.jsonl is a request with what it must give, a test of its
/// own: see README.md.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "api/api.h"
#include "api/names.h"
#include "tests/stress/stress_run.h"

namespace snapthrough::testing {
namespace {

using nlohmann::json;

/// The documents of regressions.jsonl by their names.
const std::map<std::string, json>& documents() {
  static const std::map<std::string, json> all = [] {
    std::map<std::string, json> out;
    std::ifstream in(SNAPTHROUGH_SOURCE_DIR "/tests/regressions/regressions.jsonl");
    for (std::string line; std::getline(in, line);) {
      json document = json::parse(line);
      std::string name = document.at("name");
      if (!out.emplace(name, std::move(document)).second) {
        throw std::runtime_error("regressions.jsonl has two models of the name " + name);
      }
    }
    return out;
  }();
  return all;
}

std::vector<std::string> names() {
  std::vector<std::string> out;
  for (const auto& [name, document] : documents()) out.push_back(name);
  return out;
}

class Regression : public ::testing::TestWithParam<std::string> {};

/// How many broken bifurcations a path passes by, and where, depends on its steps: takes out those before the
/// last point.
std::vector<CriticalPoint> without_broken_before_last(std::vector<CriticalPoint> points) {
  if (points.empty()) return points;
  points.erase(std::remove_if(
                   points.begin(), points.end() - 1,
                   [](const CriticalPoint& point) { return point.type == CriticalType::broken_bifurcation; }),
               points.end() - 1);
  return points;
}

void expect_points(const std::vector<CriticalPoint>& all, const json& expected) {
  const std::vector<CriticalPoint> found =
      expected.value("broken_before_last", false) ? without_broken_before_last(all) : all;
  const json& points = expected.at("critical_points");
  if (expected.value("more", false)) {
    ASSERT_GE(found.size(), points.size());
  } else {
    ASSERT_EQ(found.size(), points.size());
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    SCOPED_TRACE("critical point " + std::to_string(i));
    EXPECT_EQ(api::name_of(api::kCriticalTypes, found[i].type), points[i].at("type").get<std::string>());
    EXPECT_EQ(found[i].branch, points[i].value("branch", 0));
    if (!points[i].contains("load_factor")) continue;
    const double load = points[i].at("load_factor");
    EXPECT_NEAR(found[i].load_factor, load, expected.at("relative_tolerance").get<double>() * std::abs(load));
  }
}

TEST_P(Regression, EndsAsItMust) {
  constexpr double kMostSeconds = 120.0;  // twice what the longest takes
  const json& document = documents().at(GetParam());
  SCOPED_TRACE(document.at("failed_once").get<std::string>());
  const json& expected = document.at("expected");
  const api::ReadOutcome read =
      api::read_request_document(std::make_shared<const json>(document.at("request")));
  ASSERT_TRUE(read.request) << read.findings.front().pointer << " " << read.findings.front().detail;
  const StressOutcome out = run_request({read.request->model, read.request->analysis}, kMostSeconds);
  const json& ends = expected.at("termination");
  EXPECT_TRUE(ends.is_array() ? std::ranges::count(ends, json(out.termination)) > 0 : ends == out.termination)
      << out.termination << ", expected " << ends << "; " << out.detail;
  for (const std::string& what : out.check.failures) ADD_FAILURE() << what << "\n" << out.features;
  if (expected.contains("critical_points")) expect_points(out.critical_points, expected);
  if (expected.contains("end_load_factor")) {
    const double load = expected.at("end_load_factor");
    EXPECT_NEAR(out.end_load_factor, load, expected.at("relative_tolerance").get<double>() * std::abs(load));
  }
  if (expected.contains("imbalance")) {
    EXPECT_GT(out.check.points, 0) << "no state was summed";
    EXPECT_LT(out.check.imbalance, expected.at("imbalance").get<double>());
  }
}

INSTANTIATE_TEST_SUITE_P(Models, Regression, ::testing::ValuesIn(names()), [](const auto& p) {
  std::string name = p.param;
  std::ranges::replace(name, '-', '_');
  return name;
});

/// Without models the tests above would pass.
TEST(Regressions, AreThere) { EXPECT_GE(names().size(), 50U); }

}  // namespace
}  // namespace snapthrough::testing
