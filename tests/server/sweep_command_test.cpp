/// The sweep command: rows, exit statuses, independence of the number of threads.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <nlohmann/json.hpp>
#include <sstream>

#include "server/cli/app.h"
#include "server/cli/progress_bar.h"
#include "server/cli/streams.h"

namespace snapthrough::server::cli {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;

/// A pinned column on a bonded base, three stiffnesses.
json column_sweep() {
  return json::parse(R"({
    "model": {
      "nodes": [{"id": "foot", "x": 0, "y": 0}, {"id": "head", "x": 0, "y": 1}],
      "sections": [{"id": "shaft", "EA": 1e9, "EI": 1}],
      "members": [{"id": "column", "start": "foot", "end": "head", "section": "shaft"}],
      "supports": [{"node": "foot", "fixed": ["x", "y"]}, {"node": "head", "fixed": ["x"]}],
      "foundations": [{"id": "soil", "member": "column", "stiffness": 0}],
      "loads": [{"type": "point", "at": {"node": "head"}, "force": [0, -9.869604401089358]}]
    },
    "analysis": {"type": "buckling", "discretization": {"elements": 8, "order": 5}},
    "parameters": [{"name": "k", "targets": [{"pointer": "/model/foundations/0/stiffness", "scale": 97.40909103400244}],
                    "values": [0, 1, 2]}],
    "design": "grid",
    "outputs": ["/buckling/load_factors/0"]
  })");
}

struct Outcome {
  int exit_status;
  std::string out;
  std::string err;
};

Outcome run_sweep(const json& document, std::vector<const char*> options = {}) {
  std::istringstream in(document.dump());
  std::ostringstream out;
  std::ostringstream err;
  options.insert(options.begin(), {"snapthrough", "sweep", "-"});
  const int status = run(static_cast<int>(options.size()), options.data(), {in, out, err});
  return {status, out.str(), err.str()};
}

/// P / P_e = 1 + k for one half wave, k = K L^4 / (pi^4 EI) up to 4.
TEST(SweepCommand, GivesARowForEachPoint) {
  const Outcome outcome = run_sweep(column_sweep());
  ASSERT_EQ(outcome.exit_status, kDone) << outcome.err;
  const json table = json::parse(outcome.out);
  EXPECT_EQ(table.at("columns"), json::parse(R"(["k", "/buckling/load_factors/0", "error"])"));
  ASSERT_EQ(table.at("rows").size(), 3U);
  for (int k = 0; k < 3; ++k) {
    EXPECT_EQ(table["rows"][k][0], k);
    EXPECT_NEAR(table["rows"][k][1].get<double>(), 1.0 + k, 1e-6);
    EXPECT_TRUE(table["rows"][k][2].is_null());
    EXPECT_EQ(table["points"][k], k);
  }
}

TEST(SweepCommand, RowsDoNotDependOnTheNumberOfThreads) {
  const Outcome one = run_sweep(column_sweep(), {"--csv", "--threads", "1"});
  const Outcome five = run_sweep(column_sweep(), {"--csv", "--threads", "5"});
  EXPECT_THAT(one.out, HasSubstr("k,/buckling/load_factors/0,error\n0,"));
  EXPECT_EQ(one.out, five.out);
}

TEST(SweepCommand, GivesALineForEachPointAsNdjson) {
  const Outcome outcome = run_sweep(column_sweep(), {"--ndjson"});
  ASSERT_EQ(outcome.exit_status, kDone) << outcome.err;
  std::istringstream lines(outcome.out);
  int k = 0;
  for (std::string line; std::getline(lines, line); ++k) {
    const json row = json::parse(line);
    EXPECT_EQ(row.at("k"), k);
    EXPECT_NEAR(row.at("/buckling/load_factors/0").get<double>(), 1.0 + k, 1e-6);
    EXPECT_TRUE(row.at("error").is_null());
  }
  EXPECT_EQ(k, 3);
  EXPECT_EQ(run_sweep(column_sweep(), {"--ndjson", "--csv"}).exit_status, kOther);
}

TEST(SweepCommand, CheckTakesSweepsToo) {
  std::istringstream in(column_sweep().dump());
  std::ostringstream out;
  std::ostringstream err;
  const std::array<const char*, 3> arguments{"snapthrough", "check", "-"};
  EXPECT_EQ(run(3, arguments.data(), {in, out, err}), kDone) << err.str();
  EXPECT_THAT(out.str(), HasSubstr("3 points"));
}

TEST(ProgressLine, TellsRateAndTimeLeft) {
  EXPECT_EQ(progress_line(0, 0, 600, 0.0), "[..............................] 0/600");
  EXPECT_EQ(progress_line(200, 0, 600, 100.0),
            "[##########....................] 200/600, 2 points/s, 03:20 left");
  EXPECT_EQ(progress_line(600, 3, 600, 6000.0),
            "[##############################] 600/600, 0.1 points/s, 00:00 left, 3 failed");
  EXPECT_THAT(progress_line(1, 0, 2, 4000.0), HasSubstr("1:06:40 left"));
}

TEST(SweepCommand, AFailedPointKeepsTheOthers) {
  json document = column_sweep();
  document["parameters"][0]["values"] = {0, -1, 1};
  const Outcome outcome = run_sweep(document);
  EXPECT_EQ(outcome.exit_status, kNotCompleted);
  EXPECT_THAT(outcome.err, HasSubstr("1 of 3 points"));
  const json rows = json::parse(outcome.out).at("rows");
  EXPECT_TRUE(rows[1][1].is_null());
  EXPECT_EQ(rows[1][2].at("code"), "wrong_request");
  EXPECT_THAT(rows[1][2].at("detail").get<std::string>(), HasSubstr("/model/foundations/0/stiffness"));
  EXPECT_NEAR(rows[2][1].get<double>(), 2.0, 1e-6);
}

TEST(SweepCommand, RefusesAWrongDocumentWithPointers) {
  json document = column_sweep();
  document["design"] = "grod";
  const Outcome outcome = run_sweep(document);
  EXPECT_EQ(outcome.exit_status, kWrongRequest);
  EXPECT_THAT(outcome.err, ::testing::StartsWith("/design: "));
  EXPECT_EQ(outcome.out, "");
}

}  // namespace
}  // namespace snapthrough::server::cli
