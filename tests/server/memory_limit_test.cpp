/// @file
/// The bound on the memory of one analysis: what is refused beforehand, what is stopped on its way, and that
/// nobody else notices.

#include <gmock/gmock.h>

#include <Eigen/Core>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <thread>

#include "api/api.h"
#include "server/jobs/least_memory.h"
#include "server/worker/bounded_run.h"
#include "server/worker/memory_meter.h"
#include "tests/server/support/running_service.h"

namespace snapthrough::server::test {
namespace {

using nlohmann::json;
using testing::HasSubstr;

constexpr std::int64_t kMegabyte = 1 << 20;

TEST(MemoryMeter, CountsWhatIsInUseAndTheMostOfIt) {
  MemoryMeter meter(10 * kMegabyte);
  {
    const std::vector<double> one(kMegabyte / 8);
    const Eigen::VectorXd two(kMegabyte / 8);  // malloc
    struct alignas(64) Block {
      std::array<char, 64> bytes;
    };
    const std::vector<Block> three(kMegabyte / 64);  // new with an alignment
    EXPECT_GE(meter.peak(), 3 * kMegabyte);
  }
  EXPECT_LE(meter.peak(), 3 * kMegabyte + 100'000);
  const std::vector<double> again(2 * kMegabyte / 8);
  EXPECT_LE(meter.peak(), 3 * kMegabyte + 100'000) << "what was freed is not in use";
  EXPECT_FALSE(meter.exceeded());
}

TEST(MemoryMeter, RefusesWhatGoesBeyondTheLimitOfThisThreadOnly) {
  MemoryMeter meter(kMegabyte);
  EXPECT_THROW(static_cast<void>(std::vector<char>(2U * kMegabyte)), std::bad_alloc);
  EXPECT_THROW(static_cast<void>(Eigen::VectorXd::Zero(kMegabyte).eval()), std::bad_alloc);
  Eigen::VectorXd growing(1000);
  EXPECT_THROW(growing.conservativeResize(kMegabyte), std::bad_alloc);
  EXPECT_EQ(std::calloc(kMegabyte, 8), nullptr);
  EXPECT_TRUE(meter.exceeded());
  EXPECT_LT(meter.peak(), kMegabyte / 2) << "nothing of it was allocated";
  bool elsewhere = false;
  {
    const MemoryMeter::Pause pause;
    std::thread([&] { elsewhere = std::vector<char>(4 * kMegabyte).size() > 0; }).join();
  }
  EXPECT_TRUE(elsewhere);
  const MemoryMeter::Pause pause;
  EXPECT_EQ(std::vector<char>(4 * kMegabyte).size(), 4U * kMegabyte);
}

std::string example(const std::string& name) {
  std::ifstream file(std::string(SNAPTHROUGH_SOURCE_DIR) + "/examples/" + name);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// The result document in so much memory; empty when that is not enough.
std::string solved_within(std::int64_t memory, const api::Request& request, std::int64_t& peak) {
  std::string document;
  const BoundedRun run = run_bounded(memory, [&] {
    document = api::write_result(request, solve(request.model, request.analysis), 0.0).dump();
  });
  peak = run.peak_bytes;
  if (!run.mishap) {
    return document;
  }
  EXPECT_EQ(run.mishap->code, "memory_limit") << run.mishap->detail;
  return "";
}

// Each limit makes another allocation the first that is refused.
TEST(MemoryLimit, WhereverItStrikesNothingIsLeftAndTheNextRunIsRight) {
  for (const char* name : {"column_winkler.json", "arch_no_base.json", "arch_outside_base_k1e7.json"}) {
    const api::ReadOutcome read = api::read_request(example(name));
    ASSERT_TRUE(read.request) << name;
    std::int64_t whole = 0;
    const std::string right = solved_within(kNoMemoryLimit, *read.request, whole);
    ASSERT_FALSE(right.empty());
    int refused = 0;
    constexpr int kLimits = 150;
    for (int i = 1; i <= kLimits; ++i) {
      std::int64_t peak = 0;
      const std::int64_t limit = whole * i / kLimits;
      const std::string document = solved_within(limit, *read.request, peak);
      EXPECT_LE(peak, limit + 4096) << "beyond the limit by more than the heap rounds up";
      EXPECT_TRUE(document.empty() || document == right) << name << " " << i;
      refused += document.empty() ? 1 : 0;
    }
    EXPECT_GT(refused, kLimits * 3 / 4) << name;
    std::int64_t peak = 0;
    EXPECT_EQ(solved_within(kNoMemoryLimit, *read.request, peak), right);
  }
}

/// The column of samples.h with other things in its analysis.
json column(const json& analysis) {
  json request = json::parse(column_request());
  request["analysis"] = analysis;
  return request;
}

TEST(MemoryLimit, TheLeastIsBelowEveryPeak) {
  for (const char* type : {"critical", "buckling", "static"}) {
    for (int order = 1; order <= kMaxOrder; ++order) {
      json analysis{{"type", type}, {"discretization", {{"elements", 2400 / order}, {"order", order}}}};
      analysis["output"] = {{"points_per_member", 2}};
      if (std::string(type) == "static") {
        analysis["load_factors"] = {0.1};
        analysis["geometry"] = "linear";
        analysis.erase("output");
      }
      const api::ReadOutcome read = api::read_request(column(analysis).dump());
      ASSERT_TRUE(read.request) << type << (read.findings.empty() ? "" : read.findings[0].detail);
      std::int64_t peak = 0;
      solved_within(kNoMemoryLimit, *read.request, peak);
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
    const SolveFunction solver = [](const Model& model, const Analysis& analysis, const Hooks& hooks) {
      return solve(model, analysis, hooks);
    };
    service_ = std::make_unique<Service>(small, Environment::system(), solver, log_);
    ASSERT_TRUE(service_->start().ok());
  }
};

/// A path whose states take about 1 MB each.
json many_states() {
  return column({{"type", "path"},
                 {"discretization", {{"elements", 4}, {"order", 2}}},
                 {"stop", {{"steps", 40}}},
                 {"output", {{"states", "all"}, {"points_per_member", 20'000}}}});
}

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
  EXPECT_EQ(json::parse(get(port(), path, {"Prefer: wait=30"}).body)["status"], "failed");
  const json rows = json::parse(get(port(), path + "/table").body)["rows"];
  ASSERT_EQ(rows.size(), 3U);
  EXPECT_EQ(rows[0][3], nullptr);
  EXPECT_EQ(rows[1][3]["code"], "memory_limit");
  EXPECT_EQ(rows[2][3], nullptr);
}

}  // namespace
}  // namespace snapthrough::server::test
