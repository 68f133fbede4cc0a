/// @file
/// Runners: processes that are killed, crash, run out of memory or do not stop, and what the jobs and points
/// come to that they had.

#include <gmock/gmock.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <initializer_list>
#include <iterator>
#include <nlohmann/json.hpp>
#include <thread>

#include "server/worker/isolated_runner.h"
#include "server/worker/record.h"
#include "tests/server/support/running_service.h"
#include "tests/server/support/sanitizer.h"

namespace snapthrough::server::test {
namespace {

using nlohmann::json;
using std::chrono::milliseconds;
using testing::HasSubstr;

constexpr std::int64_t kMegabyte = 1 << 20;
constexpr std::int64_t kEnough = 512 * kMegabyte;

class RunnerTest : public testing::Test {
 protected:
  [[nodiscard]] IsolatedRunnerOptions options(std::int64_t memory = kEnough, int max_crashes = 2) const {
    return {SNAPTHROUGH_EXECUTABLE, memory, max_crashes};
  }
  RunnerCounters counters_;
};

/// The system starts no process for the moment: the job waits, and it is nobody's crash.
TEST_F(RunnerTest, AJobWaitsForAProcessThatCannotBeStartedYet) {
  const TempDir folder;
  IsolatedRunnerOptions missing = options();
  missing.executable = folder.file("snapthrough");
  IsolatedRunner runner(missing, counters_);
  JobRun run;
  std::jthread job([&] { run = runner.run_job(column_request(), {}); });
  while (counters_.without_process == 0) {
    std::this_thread::sleep_for(milliseconds(5));
  }
  std::filesystem::create_symlink(SNAPTHROUGH_EXECUTABLE, missing.executable);
  job.join();
  EXPECT_TRUE(run.result.has_value());
  EXPECT_EQ(counters_.crashed, 0);
  EXPECT_EQ(counters_.without_process, 0);
}

TEST_F(RunnerTest, OneThatGivesWayHasALowPriorityAndKeepsItsProcess) {
  const int mine = ::getpriority(PRIO_PROCESS, 0);
  IsolatedRunner runner(options(), counters_);
  ASSERT_TRUE(runner.run_job(column_request(), {}).result.has_value());
  EXPECT_EQ(::getpriority(PRIO_PROCESS, static_cast<id_t>(runner.process())), mine);
  runner.give_way();
  const int low = ::getpriority(PRIO_PROCESS, static_cast<id_t>(runner.process()));
  EXPECT_GT(low, mine);
  const pid_t before = runner.process();
  ASSERT_TRUE(runner.run_job(column_request(), {}).result.has_value());
  EXPECT_EQ(runner.process(), before);
  ASSERT_EQ(::kill(before, SIGKILL), 0);
  ASSERT_TRUE(runner.run_job(column_request(), {}).result.has_value()) << "a new process";
  EXPECT_EQ(::getpriority(PRIO_PROCESS, static_cast<id_t>(runner.process())), low);
}

TEST_F(RunnerTest, AJobThatWaitsForAProcessCanBeStopped) {
  const TempDir folder;
  IsolatedRunnerOptions missing = options();
  missing.executable = folder.file("snapthrough");
  IsolatedRunner runner(missing, counters_);
  std::stop_source stop;
  JobRun run;
  std::jthread job([&] { run = runner.run_job(column_request(), {.stop = stop.get_token()}); });
  while (counters_.without_process == 0) {
    std::this_thread::sleep_for(milliseconds(5));
  }
  stop.request_stop();
  job.join();
  ASSERT_TRUE(run.failure.has_value());
  EXPECT_EQ(run.failure->code, kCancelled);
}

TEST_F(RunnerTest, AJobIsSolvedAsInThisProcess) {
  IsolatedRunner runner(options(), counters_);
  const JobRun there = runner.run_job(column_request(), {});
  const JobRun here = local_runners(solve_checked)()->run_job(column_request(), {});
  ASSERT_TRUE(there.result && here.result);
  const auto without_time = [](const JobRun& run) {
    json document = json::parse(run.result->document);
    document["diagnostics"].erase("wall_time_s");
    return document;
  };
  EXPECT_EQ(without_time(there), without_time(here));
  EXPECT_EQ(there.result->summary.message, here.result->summary.message);
  const auto path_bytes = [](const JobRun& run) {
    std::string bytes;
    RecordWriter(bytes).put(run.result->branches);
    RecordWriter(bytes).put(run.result->critical_points);
    return bytes;
  };
  EXPECT_EQ(path_bytes(there), path_bytes(here)) << "every field that is sent";
}

TEST_F(RunnerTest, ARequestThatIsNoneIsAFailure) {
  IsolatedRunner runner(options(), counters_);
  const JobRun run = runner.run_job("{}", {});
  ASSERT_TRUE(run.failure);
  EXPECT_EQ(run.failure->code, "invalid_request");
  EXPECT_EQ(counters_.started, 1);
}

TEST_F(RunnerTest, OneThatIsKilledIsReplacedAndTheJobTriedAgain) {
  IsolatedRunner runner(options(), counters_);
  for (int i = 0; i < 20; ++i) {
    ::kill(runner.process(), SIGKILL);
    EXPECT_TRUE(runner.run_job(column_request(), {}).result) << i;
  }
  EXPECT_EQ(counters_.crashed, 20);
  EXPECT_EQ(counters_.started, 21);
}

TEST_F(RunnerTest, AJobThatKillsItsRunnersIsGivenUp) {
  IsolatedRunner runner(options(), counters_);
  const JobRun run =
      runner.run_job(endless_request(), {{}, [&](const Progress&) { ::kill(runner.process(), SIGABRT); }});
  ASSERT_TRUE(run.failure);
  EXPECT_EQ(run.failure->code, "crashed");
  EXPECT_THAT(run.failure->detail, HasSubstr("2 times"));
  EXPECT_TRUE(runner.run_job(column_request(), {}).result);
}

/// One that did not hear of the stop would be killed after its grace.
TEST_F(RunnerTest, OneThatStopsIsKept) {
  IsolatedRunnerOptions patient = options();
  patient.grace = kPatience;
  IsolatedRunner runner(patient, counters_);
  std::stop_source stop;
  const JobRun run =
      runner.run_job(endless_request(), {stop.get_token(), [&](const Progress&) { stop.request_stop(); }});
  ASSERT_TRUE(run.failure);
  EXPECT_EQ(run.failure->code, "cancelled");
  EXPECT_EQ(counters_.killed, 0);
  EXPECT_EQ(counters_.started, 1);
}

/// What is heard of a stop by nobody: the process itself is stopped.
TEST_F(RunnerTest, OneThatDoesNotStopIsKilledAfterItsGrace) {
  IsolatedRunnerOptions brief = options();
  brief.grace = milliseconds(300);
  IsolatedRunner runner(brief, counters_);
  std::stop_source stop;
  const JobRun run = runner.run_job(endless_request(), {stop.get_token(), [&](const Progress&) {
                                                          ::kill(runner.process(), SIGSTOP);
                                                          stop.request_stop();
                                                        }});
  ASSERT_TRUE(run.failure);
  EXPECT_EQ(run.failure->code, "cancelled");
  EXPECT_EQ(counters_.killed, 1);
  EXPECT_TRUE(runner.run_job(column_request(), {}).result);
}

/// Its priority is lower until it ends; then another process takes its place.
TEST_F(RunnerTest, OneThatTakesLongGivesWayAndIsReplaced) {
  IsolatedRunner runner(options(), counters_);
  const auto first = static_cast<id_t>(runner.process());
  constexpr int kLower = 10;
  std::stop_source stop;
  const JobRun run = runner.run_job(endless_request(), {stop.get_token(), [&](const Progress&) {
                                                          if (::getpriority(PRIO_PROCESS, first) == kLower) {
                                                            stop.request_stop();
                                                          }
                                                        }});
  ASSERT_TRUE(run.failure);
  EXPECT_EQ(run.failure->code, "cancelled");
  EXPECT_NE(static_cast<id_t>(runner.process()), first);
  EXPECT_LT(::getpriority(PRIO_PROCESS, static_cast<id_t>(runner.process())), kLower);
  EXPECT_EQ(counters_.started, 2);
  EXPECT_EQ(counters_.killed, 0);
}

TEST_F(RunnerTest, NewsOfALongAnalysisArriveWhileItRuns) {
  IsolatedRunner runner(options(), counters_);
  std::stop_source stop;
  int news = 0;
  const JobRun run = runner.run_job(endless_request(), {stop.get_token(), [&](const Progress& progress) {
                                                          EXPECT_GE(progress.step, news);
                                                          if (++news == 5) {
                                                            stop.request_stop();
                                                          }
                                                        }});
  ASSERT_TRUE(run.failure);
  EXPECT_EQ(run.failure->code, "cancelled");
  EXPECT_GE(news, 5);
}

/// A program that does this in place of computing.
std::string program_in(const TempDir& folder, const std::string& commands) {
  std::string program = folder.file("program");
  std::ofstream(program) << "#!/bin/sh\n" << commands << "\n";
  EXPECT_EQ(::chmod(program.c_str(), 0700), 0);
  return program;
}

/// A process that was led astray may send anything; the service believes none of it.
TEST_F(RunnerTest, OneThatTalksNonsenseIsOneThatCrashed) {
  const TempDir folder;
  for (const char* bytes : {"head -c 64 /dev/zero | tr '\\0' '\\377'", "head -c 64 /dev/zero"}) {
    IsolatedRunnerOptions astray = options();
    astray.executable = program_in(folder, "{ " + std::string(bytes) + "; } >&0\nexec sleep 3600");
    IsolatedRunner runner(astray, counters_);
    const JobRun run = runner.run_job(column_request(), {});
    ASSERT_TRUE(run.failure);
    EXPECT_EQ(run.failure->code, "crashed") << bytes;
  }
}

/// It held its worker for good: the service waited for the rest of the frame, and looked at nothing else.
TEST_F(RunnerTest, OneThatSendsHalfAFrameIsKilledAfterItsGrace) {
  const TempDir folder;
  IsolatedRunnerOptions half = options();
  half.executable =
      program_in(folder, R"(printf '\350\003\0\0\0\0\0\0\010\0\0\0\0\0\0\0part' >&0; exec sleep 3600)");
  half.grace = milliseconds(300);
  IsolatedRunner runner(half, counters_);
  std::stop_source stop;
  std::jthread stopper([&] {
    std::this_thread::sleep_for(milliseconds(300));
    stop.request_stop();
  });
  const JobRun run = runner.run_job(column_request(), {stop.get_token()});
  ASSERT_TRUE(run.failure);
  EXPECT_EQ(run.failure->code, "cancelled");
  EXPECT_EQ(counters_.killed, 1);
}

/// It held its worker for good: a request that no socket's buffer takes was never read.
TEST_F(RunnerTest, OneThatDoesNotTakeItsTaskIsOneThatCrashed) {
  const TempDir folder;
  IsolatedRunnerOptions deaf = options(kEnough, 1);
  deaf.executable = program_in(folder, "exec sleep 3600");
  IsolatedRunner runner(deaf, counters_);
  const JobRun run = runner.run_job(column_request() + std::string(4 * kMegabyte, ' '), {});
  ASSERT_TRUE(run.failure);
  EXPECT_EQ(run.failure->code, "crashed");
}

template <class T>
T read_as(std::initializer_list<char> bytes) {
  return RecordReader(std::string(bytes)).get<T>();
}

TEST(Record, BytesThatAreNoValueOfTheirTypeAreRefused) {
  EXPECT_TRUE(read_as<bool>({1}));
  EXPECT_THROW(read_as<bool>({2}), std::runtime_error);
  EXPECT_EQ(read_as<CriticalType>({5, 0, 0, 0}), CriticalType::capacity);
  EXPECT_THROW(read_as<CriticalType>({6, 0, 0, 0}), std::runtime_error);
  EXPECT_THROW(read_as<CriticalCause>({-1, -1, -1, -1}), std::runtime_error);
  EXPECT_THROW(read_as<int>({1, 0, 0}), std::runtime_error);
  EXPECT_THROW(read_as<std::vector<double>>({0, 0, 0, 0, 0, 0, 0, 32}), std::runtime_error)
      << "2^61 numbers are 2^64 bytes";
}

/// A sweep over the points at which states are given: some need more than 16 MB.
json hungry_sweep(const std::vector<int>& points) {
  json sweep = json::parse(column_request("hungry"));
  sweep["analysis"] = {{"type", "path"},
                       {"discretization", {{"elements", 4}, {"order", 2}}},
                       {"stop", {{"steps", 40}}},
                       {"output", {{"states", "all"}, {"points_per_member", 11}}}};
  sweep["parameters"] = {{{"name", "points"},
                          {"targets", {{{"pointer", "/analysis/output/points_per_member"}}}},
                          {"values", points}}};
  sweep["design"] = "grid";
  sweep["outputs"] = {"/summary/termination", "/states/0/members/m/x/0"};
  return sweep;
}

TEST_F(RunnerTest, ThePointsThatNeedTooMuchAreTheOnesThatFail) {
  SKIP_WITHOUT_MEMORY_BOUND();
  IsolatedRunner runner(options(16 * kMegabyte), counters_);
  const std::string id = "s";
  const std::string document = hungry_sweep({11, 12, 20'000, 13, 20'000, 20'000, 14}).dump();
  const api::SweepOutcome read = api::read_sweep(document);
  ASSERT_TRUE(read.sweep);
  const std::vector<std::uint64_t> items{0, 1, 2, 3, 4, 5, 6};
  std::vector<std::string> codes;
  runner.run_items(
      {id, document, *read.sweep, items, {}, {}, [&](const std::vector<api::PointOutcome>& outcomes) {
         codes.push_back(outcomes.at(0).code);
       }});
  EXPECT_THAT(codes, testing::ElementsAre("", "", "memory_limit", "", "memory_limit", "memory_limit", ""));
  EXPECT_EQ(counters_.out_of_memory, 3);
}

TEST_F(RunnerTest, PointsOfAKilledRunnerAreComputedAgainAndNoneIsBlamed) {
  IsolatedRunner runner(options(), counters_);
  const std::string id = "s";
  const std::string document = hungry_sweep({5001, 5002, 5003, 5004, 5005, 5006, 5007, 5008}).dump();
  const api::SweepOutcome read = api::read_sweep(document);
  ASSERT_TRUE(read.sweep);
  const std::vector<std::uint64_t> items{0, 1, 2, 3, 4, 5, 6, 7};
  int told = 0;
  runner.run_items(
      {id, document, *read.sweep, items, {}, {}, [&](const std::vector<api::PointOutcome>& outcomes) {
         EXPECT_EQ(outcomes.at(0).code, "") << outcomes.at(0).detail;
         if (++told == 3) {
           ::kill(runner.process(), SIGKILL);
         }
       }});
  EXPECT_EQ(told, 8);
}

/// Curves of so many points, one for each mesh.
json curves(const std::vector<int>& elements, int points) {
  json sweep = json::parse(followed_sweep(points));
  const json mesh{{"name", "elements"},
                  {"targets", {{{"pointer", "/analysis/discretization/elements"}}}},
                  {"values", elements}};
  sweep["parameters"].insert(sweep["parameters"].begin(), mesh);
  return sweep;
}

TEST_F(RunnerTest, ACurveThatNeedsTooMuchFailsWhollyAndAlone) {
  SKIP_WITHOUT_MEMORY_BOUND();
  IsolatedRunner runner(options(16 * kMegabyte), counters_);
  const std::string id = "s";
  const std::string document = curves({4, 20'000, 5}, 3).dump();
  const api::SweepOutcome read = api::read_sweep(document);
  ASSERT_TRUE(read.sweep);
  const std::vector<std::uint64_t> items{0, 1, 2};
  std::vector<std::string> codes;
  runner.run_items(
      {id, document, *read.sweep, items, {}, {}, [&](const std::vector<api::PointOutcome>& outcomes) {
         EXPECT_EQ(outcomes.size(), 3U);
         for (const api::PointOutcome& outcome : outcomes) {
           codes.push_back(outcome.code);
         }
       }});
  EXPECT_THAT(codes,
              testing::ElementsAre("", "", "", "memory_limit", "memory_limit", "memory_limit", "", "", ""));
  EXPECT_EQ(counters_.out_of_memory, 1);
}

TEST_F(RunnerTest, CurvesOfAKilledRunnerAreComputedAgainAndWholly) {
  IsolatedRunner runner(options(), counters_);
  const std::string id = "s";
  const std::string document = curves({20, 21, 22, 23}, 100).dump();
  const api::SweepOutcome read = api::read_sweep(document);
  ASSERT_TRUE(read.sweep);
  const std::vector<std::uint64_t> items{0, 1, 2, 3};
  int told = 0;
  runner.run_items(
      {id, document, *read.sweep, items, {}, {}, [&](const std::vector<api::PointOutcome>& outcomes) {
         ASSERT_EQ(outcomes.size(), 100U);
         for (const api::PointOutcome& outcome : outcomes) {
           EXPECT_EQ(outcome.code, "") << outcome.detail;
         }
         if (++told == 1) {
           ::kill(runner.process(), SIGKILL);
         }
       }});
  EXPECT_EQ(told, 4);
}

class RunnerService : public ServiceTest {
 protected:
  void start_with(std::int64_t memory) {
    ServiceConfig own = config();
    own.runner_executable = SNAPTHROUGH_EXECUTABLE;
    own.jobs.job_memory = memory;
    service_ = std::make_unique<Service>(own, Environment::system(), RunnerFactory(), log_);
    ASSERT_TRUE(service_->start().ok());
  }
};

/// 808 bytes that ended the whole service by SIGABRT after 21 s: the refused allocation passed through code
/// that must not throw while the result was unwound.
TEST_F(RunnerService, TheRequestThatEndedTheServiceIsOneFailedJob) {
  SKIP_WITHOUT_MEMORY_BOUND();
  start_with(64 * kMegabyte);
  json bomb = json::parse(column_request("bomb"));
  bomb["analysis"] = {{"type", "path"},
                      {"discretization", {{"elements", 8}, {"order", 3}}},
                      {"step", {{"initial", 1e-3}, {"max", 1e-3}}},
                      {"stop", {{"steps", 4000}}},
                      {"output", {{"states", "all"}, {"points_per_member", 2001}}}};
  const std::string innocent = submit("innocent");
  const Reply reply =
      post(port(), "/v1/jobs", bomb.dump(), {"Content-Type: application/json", "Prefer: wait=60"});
  EXPECT_EQ(reply.status, 422) << reply.body.substr(0, 300);
  EXPECT_EQ(json::parse(reply.body)["code"], "memory_limit");
  EXPECT_EQ(json::parse(get(port(), innocent, {"Prefer: wait=60"}).body)["status"], "successful");
  EXPECT_EQ(get(port(), "/livez").status, 200);
}

}  // namespace
}  // namespace snapthrough::server::test
