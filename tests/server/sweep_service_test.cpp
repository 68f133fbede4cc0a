/// @file
/// Sweeps over HTTP: rows, reuse, failures, dismissal, retry, refusals, independence of workers.

#include <gmock/gmock.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <ctime>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "api/sweep.h"
#include "tests/server/support/owners.h"
#include "tests/server/support/running_service.h"
#include "tests/server/support/sanitizer.h"

namespace snapthrough::server::test {
namespace {

using nlohmann::json;
using testing::ElementsAre;
using testing::HasSubstr;

/// A solver that counts, gives the stiffness as the critical load, and fails where it is told to.
class CountingSolver {
 public:
  Result operator()(const Model& model, const Analysis&, const Hooks&) {
    ++calls;
    Result result;
    const double stiffness = model.sections.front().EI.constant;
    if (stiffness == failing.load() || (failing_every > 0 && std::fmod(stiffness, failing_every) == 0.0)) {
      result.failure = Failure{"no_convergence", "as it was told"};
    }
    result.summary.critical_load_factor = stiffness;
    result.summary.critical_type = CriticalType::limit_max;
    result.summary.termination = "limit_points";
    return result;
  }
  std::atomic<int> calls = 0;
  std::atomic<double> failing = -1.0;
  std::atomic<int> failing_every = 0;
};

/// Processor time of all threads of this process, which are the service's, too, in seconds.
double processor_seconds() {
  timespec time{};
  ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

std::string read_text(const std::string& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), {}};
}

class SweepService : public ServiceTest {
 protected:
  void start_counting() { start(counting()); }
  /// The service's threads may outlive a test that fails.
  SolveFunction counting() const {
    return [solver = solver_](const Model& model, const Analysis& analysis, const Hooks& hooks) {
      return (*solver)(model, analysis, hooks);
    };
  }
  /// Starts with the owners ann, whose key is "alice", and bob.
  void start_keyed(SolveFunction solver) {
    ServiceConfig keyed = config();
    keyed.keys = ann_and_bob();
    service_ =
        std::make_unique<Service>(keyed, Environment::system(), local_runners(std::move(solver)), log_);
    ASSERT_TRUE(service_->start().ok());
  }
  std::string submit_sweep(const std::string& document, const Headers& more = {}) {
    Headers headers{"Content-Type: application/json"};
    headers.insert(headers.end(), more.begin(), more.end());
    const Reply reply = post(port(), "/v1/sweeps", document, headers);
    EXPECT_EQ(reply.status, 201) << reply.body;
    return reply.header("Location");
  }
  /// The status when it has ended.
  json ended(const std::string& sweep) {
    json status = json::object();
    for (int i = 0; i < 5 && status.value("progress", 0) < 100; ++i) {  // a sanitizer's build takes its time
      status = json::parse(get(port(), sweep, {"Prefer: wait=60"}).body);
    }
    return status;
  }
  json table(const std::string& sweep, const std::string& query = "") {
    return json::parse(get(port(), sweep + "/table" + query).body);
  }
  [[nodiscard]] int calls() const { return solver_->calls; }

  std::shared_ptr<CountingSolver> solver_ = std::make_shared<CountingSolver>();
};

TEST_F(SweepService, EveryPointHasItsRowInEveryForm) {
  start_counting();
  const std::string sweep = submit_sweep(column_sweep(1000));
  const json status = ended(sweep);
  EXPECT_EQ(status["status"], "successful");
  EXPECT_EQ(status["progress"], 100);
  EXPECT_EQ(status["counts"], json::parse(R"({"successful":1000,"failed":0,"reused":0,"remaining":0})"));
  EXPECT_EQ(calls(), 1000);
  const json all = table(sweep);
  EXPECT_EQ(all["columns"],
            json::parse(R"(["EI", "/summary/critical_load_factor", "/summary/termination", "error"])"));
  ASSERT_EQ(all["rows"].size(), 1000U);
  for (int i = 0; i < 1000; ++i) {
    EXPECT_EQ(all["rows"][i][0], 1.0 + i);
    EXPECT_EQ(all["rows"][i][1], 1.0 + i);
  }
  const Reply csv = get(port(), sweep + "/table?format=csv&first=998");
  EXPECT_EQ(csv.header("X-Complete"), "true");
  EXPECT_EQ(csv.body,
            "EI,/summary/critical_load_factor,/summary/termination,error\n999.0,999.0,limit_points,\n"
            "1000.0,1000.0,limit_points,\n");
  const Reply lines = get(port(), sweep + "/table?count=1", {"Accept: application/x-ndjson"});
  EXPECT_EQ(json::parse(lines.body)["/summary/critical_load_factor"], 1.0);
  EXPECT_EQ(get(port(), sweep + "/table?format=csv",
                {"If-None-Match: " + get(port(), sweep + "/table?format=csv").header("ETag")})
                .status,
            304);
}

TEST_F(SweepService, WhatWasComputedIsNotComputedAgain) {
  start_counting();
  ended(submit_sweep(column_sweep(300)));
  EXPECT_EQ(calls(), 300);
  EXPECT_EQ(ended(submit_sweep(column_sweep(300)))["counts"]["reused"], 300);
  EXPECT_EQ(calls(), 300);
  const std::string wider = submit_sweep(column_sweep(400));
  EXPECT_EQ(ended(wider)["counts"]["reused"], 300);
  EXPECT_EQ(calls(), 400);
  EXPECT_EQ(table(wider)["rows"][299][1], 300.0);
  ended(submit_sweep(column_sweep(300), {"Cache-Control: no-cache"}));
  EXPECT_EQ(calls(), 700);
  ended(submit_sweep(column_sweep(300, "another model")));
  EXPECT_EQ(calls(), 1000);
}

/// They are claimed with the points between them, whose rows the store has.
TEST_F(SweepService, OfManyFailedPointsNoOtherIsComputedAgain) {
  start_counting();
  solver_->failing_every = 7;
  const std::string sweep = submit_sweep(column_sweep(700), {"Cache-Control: no-cache"});
  EXPECT_EQ(ended(sweep)["counts"]["failed"], 100);
  solver_->failing_every = 0;
  EXPECT_EQ(post(port(), sweep + "/retry", "").status, 200);
  EXPECT_EQ(ended(sweep)["counts"], json::parse(R"({"successful":700,"failed":0,"reused":0,"remaining":0})"));
  EXPECT_EQ(calls(), 800);
}

TEST_F(SweepService, AFailedPointIsARowAndIsTriedAgain) {
  start_counting();
  solver_->failing = 7.0;
  const std::string sweep = submit_sweep(column_sweep(20));
  const json status = ended(sweep);
  EXPECT_EQ(status["status"], "failed");
  EXPECT_EQ(status["counts"]["failed"], 1);
  const json failed = table(sweep, "?status=failed")["rows"];
  ASSERT_EQ(failed.size(), 1U);
  EXPECT_EQ(table(sweep, "?status=failed")["points"], json({6})) << "its number in the design";
  EXPECT_EQ(failed[0][0], 7.0);
  EXPECT_EQ(failed[0][3]["code"], "no_convergence");
  EXPECT_EQ(table(sweep)["rows"].size(), 20U);
  solver_->failing = -1.0;
  const Reply retried = post(port(), sweep + "/retry?status=failed", "");
  EXPECT_EQ(retried.status, 200);
  EXPECT_EQ(ended(sweep)["status"], "successful");
  EXPECT_EQ(calls(), 21);
  EXPECT_EQ(table(sweep)["rows"][6][1], 7.0);
  EXPECT_EQ(post(port(), sweep + "/retry", "").status, 409);
}

TEST_F(SweepService, APointWhoseModelIsInvalidIsARow) {
  start_counting();
  json document = json::parse(column_sweep(3));
  document["parameters"][0].erase("range");
  document["parameters"][0]["values"] = {1, -5, 2};
  const std::string sweep = submit_sweep(document.dump());
  EXPECT_EQ(ended(sweep)["status"], "failed");
  const json rows = table(sweep)["rows"];
  EXPECT_EQ(rows[1][3]["code"], "wrong_request");
  EXPECT_THAT(rows[1][3]["detail"].get<std::string>(), HasSubstr("/model/sections/0/EI"));
  EXPECT_EQ(rows[2][1], 2.0);
}

/// The real solver: the same bytes whatever the workers, the order, and the grouping by restarts.
TEST_F(SweepService, RowsDoNotDependOnWorkersAndInterruptions) {
  std::string first;
  for (const int workers : {1, 2, 3}) {
    workers_ = workers;
    start(solve);
    const std::string sweep = submit_sweep(column_sweep(40), {"Cache-Control: no-cache"});
    if (workers == 3) {
      service_.reset();  // SIGTERM does the same
      start(solve);
    }
    EXPECT_EQ(ended(sweep)["status"], "successful");
    const std::string csv = get(port(), sweep + "/table?format=csv").body;
    first = first.empty() ? csv : first;
    EXPECT_EQ(csv, first);
    service_.reset();
  }
  EXPECT_THAT(first, HasSubstr("\n1.0,2.46"));  // pi^2 / 4, P_cr of a clamped-free column
}

/// Half a ring in a medium that only presses, five stiffnesses: as traced one by one, and computed once.
TEST_F(SweepService, AFollowedCurveIsOneItemOfWork) {
  start(solve);
  json document = json::parse(read_text(SNAPTHROUGH_SOURCE_DIR "/examples/sweeps/ring_followed.json"));
  document["analysis"]["discretization"]["elements"] = 16;
  document["parameters"][0]["range"] = {{"from", 1e3}, {"to", 2e3}, {"count", 5}, {"spacing", "log"}};
  const std::string followed = submit_sweep(document.dump());
  EXPECT_EQ(ended(followed)["status"], "successful");
  EXPECT_EQ(ended(submit_sweep(document.dump()))["counts"]["reused"], 5);
  json alone = document;
  alone.erase("follow");
  const std::string traced = submit_sweep(alone.dump());
  EXPECT_EQ(ended(traced)["counts"]["reused"], 0) << "last digits differ";
  const json rows = table(followed)["rows"];
  const json others = table(traced)["rows"];
  ASSERT_EQ(rows.size(), 5U);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    EXPECT_NEAR(rows[i][1].get<double>() / others[i][1].get<double>(), 1.0, 2e-8);
    EXPECT_EQ(rows[i][2], others[i][2]);
  }
}

/// A refined curve counts as one; its rows lead to requests, and an equal sweep is read from the store.
TEST_F(SweepService, ARefinedCurveIsOneItemOfWork) {
  start(solve);
  json document = json::parse(read_text(SNAPTHROUGH_SOURCE_DIR "/examples/gallery/charts/film.json"));
  document["parameters"][0]["targets"] = {{{"pointer", "/model/foundations/0/stiffness"}, {"scale", 1e-4}}};
  document["parameters"][0]["range"] = {{"from", 10}, {"to", 1000}, {"count", 5}, {"spacing", "log"}};
  document["refine"] = {{"output", "/buckling/load_factors/0"}, {"within", 0.01}};
  const std::string refined = submit_sweep(document.dump());
  const json status = ended(refined);
  EXPECT_EQ(status["status"], "successful");
  EXPECT_EQ(status["points"], 1);
  const json first = table(refined);
  ASSERT_GT(first["rows"].size(), 10U);
  EXPECT_EQ(first["columns"][2], "piece");
  const std::string point = refined + "/points/" + first["points"].back().dump() + "/request";
  const json request = json::parse(get(port(), point).body);
  EXPECT_NEAR(request["model"]["foundations"][0]["stiffness"].get<double>(), 0.1, 1e-12);
  EXPECT_EQ(get(port(), refined + "/points/4097/request").status, 404);
  const std::string again = submit_sweep(document.dump());
  EXPECT_EQ(ended(again)["counts"]["reused"], 1);
  EXPECT_EQ(table(again)["rows"], first["rows"]);
  document["refine"]["within"] = 0.02;
  EXPECT_EQ(ended(submit_sweep(document.dump()))["counts"]["reused"], 0);
}

TEST_F(SweepService, DismissalStopsItAndKeepsRows) {
  const auto solver = std::make_shared<GatedSolver>();
  start(gated(solver));
  const std::string sweep = submit_sweep(column_sweep(100));
  solver->wait_started(2);
  EXPECT_EQ(post(port(), sweep + "/dismiss", "").status, 200);
  EXPECT_EQ(post(port(), sweep + "/dismiss", "").status, 200);
  const std::string job = submit();
  solver->wait_started(3);  // by a worker whose analysis was stopped: the gate is still shut
  solver->open();
  EXPECT_EQ(json::parse(get(port(), job, {"Prefer: wait=60"}).body)["status"], "successful");
  EXPECT_EQ(json::parse(get(port(), sweep).body)["status"], "dismissed");
  EXPECT_EQ(get(port(), sweep + "/table").header("X-Complete"), "false");
  EXPECT_EQ(post(port(), sweep + "/retry", "").status, 200);
  EXPECT_EQ(ended(sweep)["status"], "successful");
  EXPECT_EQ(post(port(), sweep + "/dismiss", "").status, 409);
  EXPECT_EQ(call(port(), "DELETE", sweep, "", {}).status, 204);
  EXPECT_EQ(get(port(), sweep).status, 410);
}

/// An analysis that does not hear that it shall stop, until its gate is opened.
class DeafSolver {
 public:
  Result operator()(const Model&, const Analysis&, const Hooks&) {
    std::unique_lock lock(mutex_);
    const int number = ++started_;
    changed_.notify_all();
    changed_.wait_for(lock, kPatience, [&] { return number <= open_; });
    Result result;
    result.summary.termination = "steps";
    return result;
  }
  /// Lets the first so many analyses end.
  void open(int first) {
    const std::lock_guard guard(mutex_);
    open_ = first;
    changed_.notify_all();
  }
  void wait_started(int count) {
    std::unique_lock lock(mutex_);
    EXPECT_TRUE(changed_.wait_for(lock, kPatience, [&] { return started_ >= count; }));
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  int started_ = 0;
  int open_ = 0;
};

/// A worker that still has points of the sweep as it was before the dismissal says so after it was taken up
/// again: that ended the new work, and the sweep stayed `running` for ever.
TEST_F(SweepService, DismissedWhileAPointIsComputedAndTriedAgainItGoesOn) {
  const auto solver = std::make_shared<DeafSolver>();
  start([solver](const Model& model, const Analysis& analysis, const Hooks& hooks) {
    return (*solver)(model, analysis, hooks);
  });
  workers_ = 2;
  const std::string sweep = submit_sweep(column_sweep(40));
  solver->wait_started(2);  // both workers have points of it
  EXPECT_EQ(post(port(), sweep + "/dismiss", "").status, 200);
  EXPECT_EQ(post(port(), sweep + "/retry", "").status, 200);
  solver->open(1);  // one of them takes up the new work
  solver->wait_started(3);
  solver->open(2);  // the other one settles the old
  std::this_thread::sleep_for(std::chrono::milliseconds(100));
  solver->open(1'000);
  EXPECT_EQ(json::parse(get(port(), sweep, {"Prefer: wait=60"}).body)["status"], "successful");
}

TEST_F(SweepService, EventsTellHowFarItIs) {
  const auto solver = std::make_shared<GatedSolver>();
  start(gated(solver));
  const std::string text = all_events(*solver, submit_sweep(column_sweep(200)));
  EXPECT_THAT(text, HasSubstr("event: status\ndata: {\"id\""));
  EXPECT_THAT(text, HasSubstr("event: progress\ndata: {\"points\":200"));
  EXPECT_THAT(text, HasSubstr("event: end\ndata: {\"id\""));
  EXPECT_THAT(text, HasSubstr("\"status\":\"successful\""));
  std::vector<std::uint64_t> ids;
  for (std::size_t at = text.find("id: "); at != std::string::npos; at = text.find("\nid: ", at + 1)) {
    ids.push_back(std::stoull(text.substr(text.find_first_of("0123456789", at))));
  }
  EXPECT_GE(ids.size(), 3U);
  EXPECT_EQ(std::adjacent_find(ids.begin(), ids.end(), std::greater_equal<>()), ids.end()) << text;
}

/// EventSource comes back after the end of a stream, unless it is told not to.
TEST_F(SweepService, WhoHasSeenTheEndIsToldNotToComeBack) {
  start_counting();
  const std::string sweep = submit_sweep(column_sweep(3));
  ended(sweep);
  const std::string job = post(port(), "/v1/jobs", column_request()).header("Location");
  for (const std::string& path : {sweep, job}) {
    Socket stream(port());
    follow(stream, path, "1");
    const std::string text = stream.rest();
    const std::size_t end = text.find("event: end");
    ASSERT_NE(end, std::string::npos) << text;
    const std::size_t id = text.rfind("id: ", end) + 4;
    const std::string last = text.substr(id, text.find('\n', id) - id);
    const Reply again = get(port(), path + "/events", {"Last-Event-ID: " + last});
    EXPECT_EQ(again.status, 204) << path;
    EXPECT_EQ(again.body, "");
  }
}

TEST_F(SweepService, JobsAreAnsweredWhileASweepRuns) {
  workers_ = 1;
  start([](const Model&, const Analysis&, const Hooks&) {
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
    Result result;
    result.summary.termination = "steps";
    return result;
  });
  const std::string sweep = submit_sweep(column_sweep(50'000));  // four minutes; a job is waited for for one
  for (int i = 0; i < 5; ++i) {
    EXPECT_EQ(post(port(), "/v1/jobs", column_request("job " + std::to_string(i))).status, 200);
  }
  EXPECT_EQ(json::parse(get(port(), sweep).body)["status"], "running");
  EXPECT_TRUE(eventually([&] { return json::parse(get(port(), sweep).body)["counts"]["successful"] > 0; }));
}

/// Processor time, best of three, since the machine may be busy: the refusals themselves take well below a
/// millisecond.
TEST_F(SweepService, WrongSweepsAreRefusedAtOnceWithPointers) {
  start_counting();
  const auto refused = [&](const json& document) {
    double best = 1e9;
    Reply reply;
    for (int i = 0; i < 3; ++i) {
      const double start = processor_seconds();
      reply = post(port(), "/v1/sweeps", document.dump());
      best = std::min(best, processor_seconds() - start);
    }
    EXPECT_EQ(reply.status, 422);
    EXPECT_LT(best, 0.010 * kSlowdown);
    std::vector<std::string> all;
    const json problem = json::parse(reply.body);
    for (const json& error : problem["errors"]) {
      all.push_back(error["pointer"].get<std::string>() + " " + error["code"].get<std::string>());
    }
    return all;
  };
  json huge = json::parse(column_sweep(2));
  huge["parameters"][0]["range"]["count"] = 1'000'000;
  huge["parameters"].push_back(huge["parameters"][0]);
  huge["parameters"][1]["name"] = "EA";
  huge["parameters"][1]["targets"][0]["pointer"] = "/model/sections/0/EA";
  EXPECT_THAT(refused(huge), ElementsAre("/parameters too_many_points"));
  json missing = json::parse(column_sweep(2));
  missing["parameters"][0]["targets"][0]["pointer"] = "/model/springs/0/stiffness";
  EXPECT_THAT(refused(missing), ElementsAre("/parameters/0/targets/0/pointer no_such_place"));
  json typed = json::parse(column_sweep(2));
  typed["parameters"][0]["targets"][0]["pointer"] = "/model/nodes/1/x";
  typed["parameters"][0].erase("range");
  typed["parameters"][0]["values"] = {1, "stiff"};
  EXPECT_THAT(refused(typed), ElementsAre("/parameters/0/values/1 wrong_type"));
  json twice = json::parse(column_sweep(2));
  twice["parameters"].push_back(twice["parameters"][0]);
  twice["parameters"][1]["name"] = "same";
  EXPECT_THAT(refused(twice), ElementsAre("/parameters/1/targets/0/pointer overlapping_targets"));
  EXPECT_EQ(calls(), 0);
}

TEST_F(SweepService, AnIdempotencyKeyIsOneSweepAndTheSecondAnswerSaysSo) {
  start_counting();
  const Headers keyed{"Content-Type: application/json", "Idempotency-Key: one"};
  const Reply first = post(port(), "/v1/sweeps", column_sweep(5), keyed);
  EXPECT_EQ(first.status, 201);
  const Reply second = post(port(), "/v1/sweeps", column_sweep(5), keyed);
  EXPECT_EQ(second.status, 200);
  EXPECT_EQ(second.header("Location"), first.header("Location"));
}

/// What a row's link leads to: the request of that point, and its whole result.
TEST_F(SweepService, EveryRowOpensAsARequestAndAsAJob) {
  start_counting();
  const std::string sweep = submit_sweep(column_sweep(5));
  ended(sweep);
  const json links = table(sweep)["links"];
  EXPECT_EQ(links["request"], sweep + "/points/{point}/request");
  EXPECT_EQ(links["job"], sweep + "/points/{point}/job");
  const Reply csv = get(port(), sweep + "/table?format=csv&links=true&first=3&count=1");
  EXPECT_EQ(
      csv.body,
      "EI,/summary/critical_load_factor,/summary/termination,error,point,request\n4.0,4.0,limit_points,,3," +
          sweep + "/points/3/request\n");
  const Reply request = get(port(), sweep + "/points/3/request");
  EXPECT_EQ(request.status, 200);
  const json document = json::parse(request.body);
  EXPECT_EQ(document["model"]["sections"][0]["EI"], 4.0);
  EXPECT_FALSE(document.contains("parameters"));
  const Reply job = post(port(), sweep + "/points/3/job", "", {"Prefer: wait=60"});
  EXPECT_EQ(job.status, 200) << job.body;
  EXPECT_EQ(json::parse(job.body)["summary"]["critical_load_factor"], 4.0);
  const std::string location = job.header("Location");
  EXPECT_EQ(json::parse(get(port(), location + "/request").body), document);
  const Reply async =
      post(port(), sweep + "/points/2/job", "", {"Prefer: respond-async", "Idempotency-Key: one"});
  EXPECT_EQ(async.status, 201) << async.body;
  const Reply again =
      post(port(), sweep + "/points/2/job", "", {"Prefer: respond-async", "Idempotency-Key: one"});
  EXPECT_EQ(again.header("Location"), async.header("Location"));
  EXPECT_EQ(post(port(), sweep + "/points/1/job", "", {"Idempotency-Key: one"}).status, 422);
}

TEST_F(SweepService, APointThatADesignDoesNotHaveIsNotThere) {
  start_counting();
  const std::string sweep = submit_sweep(column_sweep(5));
  for (const char* point : {"5", "-1", "one", "18446744073709551616", "01", ""}) {
    const Reply reply = get(port(), sweep + "/points/" + point + "/request");
    EXPECT_EQ(reply.status, 404) << point;
    EXPECT_EQ(post(port(), sweep + "/points/" + point + "/job", "").status, 404) << point;
  }
  EXPECT_THAT(get(port(), sweep + "/points/5/request").body, HasSubstr("no-such-point"));
  EXPECT_EQ(get(port(), "/v1/sweeps/none/points/0/request").status, 404);
  EXPECT_EQ(call(port(), "DELETE", sweep + "/points/0/request", "", {}).status, 405);
}

TEST_F(SweepService, APointWhoseModelIsInvalidIsRefusedAsAJob) {
  start_counting();
  json document = json::parse(column_sweep(3));
  document["parameters"][0].erase("range");
  document["parameters"][0]["values"] = {1, -5, 2};
  const std::string sweep = submit_sweep(document.dump());
  EXPECT_EQ(get(port(), sweep + "/points/1/request").status, 200);
  const Reply reply = post(port(), sweep + "/points/1/job", "");
  EXPECT_EQ(reply.status, 422);
  EXPECT_EQ(json::parse(reply.body)["errors"][0]["pointer"], "/model/sections/0/EI");
}

TEST_F(SweepService, LargeTablesAreAskedForInParts) {
  ServiceConfig small = config();
  small.jobs.table_rows = 10;
  service_ = std::make_unique<Service>(small, Environment::system(), local_runners(counting()), log_);
  ASSERT_TRUE(service_->start().ok());
  const std::string sweep = submit_sweep(column_sweep(15));
  ended(sweep);
  const Reply whole = get(port(), sweep + "/table");
  EXPECT_EQ(whole.status, 400);
  EXPECT_THAT(whole.body, HasSubstr("table-too-large"));
  EXPECT_EQ(table(sweep, "?first=0&count=10")["rows"].size(), 10U);
  EXPECT_EQ(table(sweep, "?first=10&count=10")["rows"].size(), 5U);
}

/// One owner's sweeps have all places, and points for minutes.
TEST_F(SweepService, AnotherOwnersSweepIsNotKeptWaiting) {
  start_keyed([](const Model&, const Analysis&, const Hooks&) {
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
    Result result;
    result.summary.termination = "steps";
    return result;
  });
  std::vector<std::string> long_ones;
  for (int i = 0; i < 12; ++i) {
    long_ones.push_back(
        submit_sweep(column_sweep(20'000, std::to_string(i)), {"Authorization: Bearer alice"}));
  }
  const std::string other = submit_sweep(column_sweep(6), {"Authorization: Bearer bob"});
  const Reply reply = get(port(), other, {"Prefer: wait=60", "Authorization: Bearer bob"});
  EXPECT_EQ(json::parse(reply.body)["status"], "successful") << reply.body;
  for (const std::string& sweep : long_ones) {
    EXPECT_NE(json::parse(get(port(), sweep, {"Authorization: Bearer alice"}).body)["status"], "successful");
  }
}

TEST_F(SweepService, AStrangersSweepIsNotThere) {
  start_keyed(counting());
  const std::string sweep = submit_sweep(column_sweep(5), {"Authorization: Bearer alice"});
  for (const std::string& target :
       {sweep, sweep + "/table", sweep + "/request", sweep + "/events", sweep + "/points/0/request"}) {
    EXPECT_EQ(get(port(), target, {"Authorization: Bearer bob"}).status, 404) << target;
  }
  EXPECT_EQ(post(port(), sweep + "/points/0/job", "", {"Authorization: Bearer bob"}).status, 404);
  EXPECT_EQ(call(port(), "DELETE", sweep, "", {"Authorization: Bearer bob"}).status, 404);
  EXPECT_EQ(call(port(), "POST", sweep + "/dismiss", "", {"Authorization: Bearer bob"}).status, 404);
  get(port(), sweep, {"Prefer: wait=60", "Authorization: Bearer alice"});
  const std::string same = submit_sweep(column_sweep(5), {"Authorization: Bearer bob"});
  const Reply status = get(port(), same, {"Prefer: wait=60", "Authorization: Bearer bob"});
  EXPECT_EQ(json::parse(status.body)["counts"]["reused"], 0) << "results of others are not told";
}

}  // namespace
}  // namespace snapthrough::server::test
