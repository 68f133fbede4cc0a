/// @file
/// The bound on the memory of one analysis: what is refused beforehand, what is stopped on its way, and that
/// nobody else notices.

#include <gmock/gmock.h>

#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <thread>

#include "api/api.h"
#include "server/jobs/memory.h"
#include "server/worker/isolated_runner.h"
#include "tests/server/support/running_service.h"
#include "tests/server/support/sanitizer.h"

namespace snapthrough::server::test {
namespace {

using nlohmann::json;
using testing::HasSubstr;

constexpr std::int64_t kMegabyte = 1 << 20;
constexpr std::int64_t kNoLimit = std::int64_t{1} << 40;

/// The column of samples.h with other things in its analysis.
json column(const json& analysis) {
  json request = json::parse(column_request());
  request["analysis"] = analysis;
  return request;
}

/// A path of 40 states.
/// @param points that each is given at: 20 000 take about 1 MB
json many_states(int points = 20'000) {
  return column({{"type", "path"},
                 {"discretization", {{"elements", 4}, {"order", 2}}},
                 {"stop", {{"steps", 40}}},
                 {"output", {{"states", "all"}, {"points_per_member", points}}}});
}

/// What a process of its own makes of a request in so much memory.
JobRun solved_within(std::int64_t memory, const std::string& request) {
  RunnerCounters counters;
  IsolatedRunner runner({SNAPTHROUGH_EXECUTABLE, memory}, counters);
  return runner.run_job(request, {});
}

// Each limit makes another allocation the first that is refused.
TEST(MemoryLimit, WhereverItStrikesOneAnalysisFailsAndTheNextIsRight) {
  SKIP_WITHOUT_MEMORY_BOUND();
  const std::string request = many_states(3000).dump();
  const JobRun whole = solved_within(kNoLimit, request);
  ASSERT_TRUE(whole.result);
  ASSERT_GT(whole.usage.peak_bytes, 8 * kMegabyte);
  const auto summary = [](const JobRun& run) { return json::parse(run.result->document)["summary"]; };
  RunnerCounters counters;
  int refused = 0;
  constexpr int kLimits = 16;
  for (int i = 1; i <= kLimits; ++i) {
    IsolatedRunner runner({SNAPTHROUGH_EXECUTABLE, 3 * whole.usage.peak_bytes * i / kLimits}, counters);
    const JobRun run = runner.run_job(request, {});
    if (run.failure) {
      ++refused;
      EXPECT_EQ(run.failure->code, "memory_limit") << i << ": " << run.failure->detail;
    } else {
      EXPECT_EQ(summary(run), summary(whole)) << i;
    }
  }
  EXPECT_GT(refused, kLimits / 4);
  EXPECT_LT(refused, kLimits);
  EXPECT_EQ(counters.out_of_memory, refused);
  EXPECT_EQ(counters.crashed, 0);
}

TEST(MemoryLimit, TheLeastIsBelowEveryPeak) {
  SKIP_WITHOUT_MEMORY_BOUND();
  for (const char* type : {"critical", "buckling", "static"}) {
    for (int order = 1; order <= kMaxOrder; ++order) {
      json analysis{{"type", type}, {"discretization", {{"elements", 2400 / order}, {"order", order}}}};
      analysis["output"] = {{"points_per_member", 2}};
      if (std::string(type) == "static") {
        analysis["load_factors"] = {0.1};
        analysis["geometry"] = "linear";
        analysis.erase("output");
      }
      const std::string text = column(analysis).dump();
      const api::ReadOutcome read = api::read_request(text);
      ASSERT_TRUE(read.request) << type << (read.findings.empty() ? "" : read.findings[0].detail);
      const std::int64_t peak = solved_within(kNoLimit, text).usage.peak_bytes;
      const std::int64_t least = least_memory(read.request->model, read.request->analysis);
      EXPECT_LT(least, peak) << type << " order " << order;
      EXPECT_GT(least, peak / 10) << type << " order " << order << ": a bound that bounds nothing";
    }
  }
}

class MemoryOverHttp : public ServiceTest {
 protected:
  void start_with(std::int64_t memory) {
    ServiceConfig small = config();
    small.jobs.job_memory = memory;
    small.runner_executable = SNAPTHROUGH_EXECUTABLE;
    service_ = std::make_unique<Service>(small, Environment::system(), RunnerFactory(), log_);
    ASSERT_TRUE(service_->start().ok());
  }
};

TEST_F(MemoryOverHttp, AMeshThatCannotFitIsRefusedBeforeAnythingIsStored) {
  start_with(8 * kMegabyte);
  EXPECT_EQ(json::parse(get(port(), "/v1/limits").body)["max_job_memory_bytes"], 8 * kMegabyte);
  const std::string large =
      column({{"type", "critical"}, {"discretization", {{"elements", 50'000}, {"order", 2}}}}).dump();
  const Reply reply = post(port(), "/v1/jobs", large);
  EXPECT_EQ(reply.status, 422);
  const json problem = json::parse(reply.body);
  EXPECT_EQ(problem["type"], "urn:snapthrough:problem:invalid-request");
  ASSERT_EQ(problem["errors"].size(), 1U);
  EXPECT_EQ(problem["errors"][0]["pointer"], "/analysis/discretization/elements");
  EXPECT_EQ(problem["errors"][0]["code"], "memory_limit");
  EXPECT_THAT(problem["errors"][0]["detail"].get<std::string>(), HasSubstr("8388608"));
  EXPECT_TRUE(json::parse(get(port(), "/v1/jobs").body)["jobs"].empty());
  const json checked = json::parse(post(port(), "/v1/check", large).body);
  EXPECT_EQ(checked["valid"], false);
  EXPECT_EQ(checked["errors"], problem["errors"]);
}

TEST_F(MemoryOverHttp, AnAnalysisThatGrowsBeyondItIsStoppedAndTheOthersGoOn) {
  SKIP_WITHOUT_MEMORY_BOUND();
  workers_ = 2;
  start_with(8 * kMegabyte);
  std::atomic<bool> over = false;
  int answered = 0;
  std::jthread others([&] {
    while (!over || answered == 0) {
      const Reply reply = post(port(), "/v1/jobs", column_request("c" + std::to_string(answered)));
      ASSERT_EQ(reply.status, 200) << reply.body;
      ++answered;
    }
  });
  for (int i = 0; i < 3; ++i) {
    const Reply reply = post(port(), "/v1/jobs", many_states().dump(),
                             {"Content-Type: application/json", "Cache-Control: no-cache"});
    EXPECT_EQ(reply.status, 422) << reply.body.substr(0, 300);
    const json problem = json::parse(reply.body);
    EXPECT_EQ(problem["type"], "urn:snapthrough:problem:analysis-failed");
    EXPECT_EQ(problem["code"], "memory_limit");
    EXPECT_EQ(problem["detail"], "the analysis needs more than 8388608 bytes of memory");
    EXPECT_EQ(json::parse(get(port(), reply.header("Location")).body)["error"]["code"], "memory_limit");
  }
  over = true;
}

TEST_F(MemoryOverHttp, APointOfASweepThatGrowsBeyondItIsARow) {
  SKIP_WITHOUT_MEMORY_BOUND();
  start_with(8 * kMegabyte);
  json sweep = many_states();
  sweep["parameters"] = {{{"name", "points"},
                          {"targets", {{{"pointer", "/analysis/output/points_per_member"}}}},
                          {"values", {11, 20'000, 12}}}};
  sweep["design"] = "grid";
  // states that no output looks into are not kept at so many points
  sweep["outputs"] = {"/summary/termination", "/states/0/members/m/x/0"};
  const Reply created = post(port(), "/v1/sweeps", sweep.dump());
  ASSERT_EQ(created.status, 201) << created.body;
  const std::string path = created.header("Location");
  EXPECT_EQ(json::parse(get(port(), path, {"Prefer: wait=60"}).body)["status"], "failed");
  const json rows = json::parse(get(port(), path + "/table").body)["rows"];
  ASSERT_EQ(rows.size(), 3U);
  EXPECT_EQ(rows[0][3], nullptr);
  EXPECT_EQ(rows[1][3]["code"], "memory_limit");
  EXPECT_EQ(rows[2][3], nullptr);
}

}  // namespace
}  // namespace snapthrough::server::test
