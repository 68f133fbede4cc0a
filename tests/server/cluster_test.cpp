/// @file
/// Processes that share a store: one that answers and one that works. Here they are two services of one
/// process.

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>
#include <thread>

#include "server/store/open_store.h"
#include "server/store/postgresql/connection.h"
#include "server/sweeps/scheduler.h"
#include "tests/server/support/postgresql.h"
#include "tests/server/support/running_service.h"

namespace snapthrough::server::test {
namespace {

using nlohmann::json;
using namespace std::chrono_literals;
using testing::HasSubstr;

class ClusterTest : public ServiceTest {
 protected:
  void SetUp() override {
    ServiceConfig front = config();
    front.store_path = location_;
    front.workers = 0;
    service_ = std::make_unique<Service>(front, Environment::system(), local_runners(gated(solver_)), log_);
    const Status status = service_->start();
    ASSERT_TRUE(status.ok()) << status.message();
  }
  void start_worker(const Environment& environment = Environment::system()) {
    ServiceConfig config = this->config();
    config.store_path = location_;
    config.front = false;
    config.observe = {"127.0.0.1", 0};
    worker_ = std::make_unique<Service>(config, environment, local_runners(gated(solver_)), log_);
    const Status status = worker_->start();
    ASSERT_TRUE(status.ok()) << status.message();
  }
  /// What a job or sweep says of itself once that holds; the last when it does not within kPatience.
  json when(const std::string& path, const std::function<bool(const json&)>& holds) const {
    json status;
    (void)eventually([&] { return holds(status = json::parse(get(port(), path).body)); });
    return status;
  }
  std::string submit_sweep(int points) const {
    const Reply reply = post(port(), "/v1/sweeps", column_sweep(points));
    EXPECT_EQ(reply.status, 201) << reply.body;
    return reply.header("Location");
  }

  const std::string location_ = postgresql_location(folder_.name());
  std::shared_ptr<GatedSolver> solver_ = std::make_shared<GatedSolver>();
  std::unique_ptr<Service> worker_;
};

TEST_F(ClusterTest, WhoWaitsIsAnsweredWhenAnotherProcessHasTheResult) {
  solver_->open();
  start_worker();
  const Reply reply =
      post(port(), "/v1/jobs", column_request("t"), {"Content-Type: application/json", "Prefer: wait=60"});
  EXPECT_EQ(reply.status, 200) << reply.body;
  EXPECT_EQ(json::parse(reply.body)["summary"]["termination"], "steps");
}

/// The time of submission is that of the database; the clock of this host is an hour ahead.
TEST_F(ClusterTest, AgesInMetricsAreThoseOfOneClock) {
  Environment ahead = Environment::system();
  ahead.now = [] { return Environment::system().now() + std::chrono::hours(1); };
  solver_->open();
  start_worker(ahead);
  const std::string job = submit();
  EXPECT_EQ(when(job, [](const json& status) { return status["status"] == "successful"; })["status"],
            "successful");
  const auto value = [&](const char* name) {
    const std::string text = get(worker_->port(), "/metrics").body;
    const std::string line = "\n" + std::string(name) + " ";
    const std::size_t found = text.find(line);
    return found == std::string::npos ? -1.0 : std::stod(text.substr(found + line.size()));
  };
  EXPECT_EQ(value("snapthrough_job_waiting_seconds_count"), 1);
  EXPECT_LT(value("snapthrough_job_waiting_seconds_sum"), 1800.0) << "not by an hour more";
  EXPECT_GE(value("snapthrough_job_waiting_seconds_sum"), 0.0);
  worker_.reset();
  submit("waits");
  const StatusOr<std::unique_ptr<Store>> store = open_store(location_, 1, ahead.now());
  ASSERT_TRUE(store.ok()) << store.status().message();
  const StatusOr<std::optional<Time>> oldest = (*store)->oldest_waiting(ahead.now());
  ASSERT_TRUE(oldest.ok() && *oldest);
  EXPECT_LT(ahead.now() - **oldest, std::chrono::minutes(30));
}

/// During an upgrade a newer host accepts documents that an older worker can't read.
TEST_F(ClusterTest, ASweepOfANewerVersionIsLeftToOthers) {
  const StatusOr<std::unique_ptr<Store>> store = open_store(location_, 1, Environment::system().now());
  ASSERT_TRUE(store.ok()) << store.status().message();
  json document = json::parse(column_sweep(2));
  document["field_of_a_newer_version"] = 1;
  NewSweep newer{new_id(Environment::system()), "", document.dump(), 2, Environment::system().now()};
  ASSERT_TRUE((*store)->sweeps().submit(newer).ok());
  solver_->open();
  start_worker();
  for (int i = 1; i <= 3; ++i) {  // each makes the worker look at all sweeps
    const std::string path = submit_sweep(10 + i);
    EXPECT_EQ(when(path, [](const json& status) { return status["progress"] == 100; })["status"],
              "successful");
  }
  EXPECT_EQ((*(*store)->sweeps().get(newer.id))->state, JobState::accepted);
  const std::string log = log_text_.text();
  const std::size_t told = log.find("not_readable");
  ASSERT_NE(told, std::string::npos) << log;
  EXPECT_THAT(log.substr(told), HasSubstr("field_of_a_newer_version"));
  EXPECT_EQ(log.find("not_readable", told + 1), std::string::npos) << "it is told once";
  const Lease lease{"newer", Environment::system().now() + std::chrono::seconds(30)};
  const auto claim = (*store)->sweeps().claim(newer.id, 2, lease, Environment::system().now());
  ASSERT_TRUE(claim.ok() && claim->has_value()) << "a worker of that version takes it";
  const api::PointOutcome outcome{"[1.0, \"steps\"]", "", ""};
  EXPECT_EQ((*store)->sweeps().put(**claim, {{0, outcome}, {1, outcome}}, Environment::system().now())->state,
            JobState::successful);
}

TEST_F(ClusterTest, EventsTellWhatAnotherProcessDoes) {
  start_worker();
  const std::string job = submit();
  solver_->wait_started(1);
  Socket stream(port());
  follow(stream, job);
  EXPECT_THAT(stream.read_until("event: progress"), HasSubstr("event: status"));
  EXPECT_THAT(stream.read_until("\n\n"), HasSubstr("\"load_factor\":3.5"));
  EXPECT_THAT(std::string(json::parse(get(port(), job).body)["message"]), HasSubstr("3.5"));
  solver_->open();
  EXPECT_THAT(stream.rest(), testing::AllOf(HasSubstr("event: critical_point"), HasSubstr("event: end")));
}

TEST_F(ClusterTest, ADismissalReachesTheProcessThatWorks) {
  start_worker();
  const std::string job = submit();
  solver_->wait_started(1);
  const std::string second = submit("another");
  solver_->wait_started(2);  // both workers are busy, and the gate is shut
  EXPECT_EQ(post(port(), job + "/dismiss", "").status, 200);
  submit("a third");
  solver_->wait_started(3);  // by the worker whose analysis was stopped: the gate is still shut
  EXPECT_EQ(json::parse(get(port(), job).body)["status"], "dismissed");
}

TEST_F(ClusterTest, ASweepIsComputedElsewhereAndItsEndIsToldHere) {
  solver_->open();
  const std::string sweep = submit_sweep(300);
  start_worker();
  const Reply ended = get(port(), sweep, {"Prefer: wait=60"});
  EXPECT_EQ(json::parse(ended.body)["status"], "successful") << ended.body;
  EXPECT_EQ(json::parse(get(port(), sweep + "/table").body)["rows"].size(), 300U);
}

TEST_F(ClusterTest, AProcessThatOnlyWorksTellsHowItIsAndNothingElse) {
  solver_->open();
  start_worker();
  const std::string job = submit();
  when(job, [](const json& now) { return now["status"] == "successful"; });
  EXPECT_EQ(get(worker_->port(), "/livez").status, 200);
  EXPECT_EQ(get(worker_->port(), "/readyz").status, 200);
  EXPECT_THAT(get(worker_->port(), "/metrics").body,
              HasSubstr("snapthrough_jobs_ended_total{code=\"successful\"} 1"));
  for (const char* path : {"/", "/v1/jobs", "/v1/openapi.json"}) {
    EXPECT_EQ(get(worker_->port(), path).status, 404) << path;
  }
  EXPECT_EQ(get(worker_->port(), job).status, 404);
}

/// Its leases neither hold for an hour nor are over at once, and what it writes is on time.
TEST_F(ClusterTest, TheClockOfAProcessDoesNotMatter) {
  postgresql::Connection database(location_);
  const auto microseconds_left = [&] {
    return database.run(
        "SELECT (until_us - extract(epoch FROM clock_timestamp()) * 1e6)::bigint FROM job_leases");
  };
  const auto lease_end = [&] { return database.run("SELECT until_us FROM job_leases")[0].integer(0); };
  for (const int hours : {-1, 1}) {
    Environment skewed = Environment::system();
    skewed.now = [now = skewed.now, hours] { return now() + std::chrono::hours(hours); };
    start_worker(skewed);
    const std::string job = submit("at " + std::to_string(hours));
    solver_->wait_started(hours < 0 ? 1 : 2);
    const std::int64_t first_end = lease_end();
    EXPECT_TRUE(eventually([&] { return lease_end() > first_end; })) << "it is renewed";
    const std::int64_t left = microseconds_left()[0].integer(0);
    EXPECT_GT(left, 0);
    EXPECT_LE(left, std::chrono::microseconds(config().jobs.lease).count());
    json status = json::parse(get(port(), job).body);
    EXPECT_EQ(status["status"], "running");
    EXPECT_EQ(status["attempt"], 1);
    // in UTC and in one form, so that texts compare as times do
    const std::string started = status["started"];
    EXPECT_GE(started, rfc3339(Environment::system().now() - std::chrono::minutes(1)));
    EXPECT_LE(started, rfc3339(Environment::system().now() + std::chrono::minutes(1)));
    worker_->stop();
    status = when(job, [](const json& now) { return now["status"] == "accepted"; });
    EXPECT_EQ(status["status"], "accepted") << "it was given back";
    EXPECT_EQ(call(port(), "DELETE", job, "", {}).status / 100, 2);
  }
}

/// A job that a worker began before the database has it holds no lease yet: none can be lost.
TEST_F(ClusterTest, AJobThatTheDatabaseTakesLateIsNotLost) {
  ServiceConfig alone = config();
  alone.store_path = location_;
  const auto solve = [gate = solver_](const Model& model, const Analysis& analysis, const Hooks& hooks) {
    return model.title == "first" ? Result{} : (*gate)(model, analysis, hooks);
  };
  service_ = std::make_unique<Service>(alone, Environment::system(), local_runners(solve), log_);
  ASSERT_TRUE(service_->start().ok());
  // a worker is there for the next job, which it gets before the database has it
  EXPECT_EQ(post(port(), "/v1/jobs", column_request("first")).status, 200);
  postgresql::Connection database(location_);
  database.run("BEGIN");
  database.run("LOCK TABLE requests IN EXCLUSIVE MODE");
  Reply reply;
  std::jthread client([&] {
    reply = post(port(), "/v1/jobs", column_request("late"),
                 {"Content-Type: application/json", "Prefer: wait=20"});
  });
  std::this_thread::sleep_for(std::chrono::milliseconds(2500));  // leases are renewed each second
  database.run("COMMIT");
  solver_->open();
  client.join();
  EXPECT_EQ(reply.status, 200) << reply.body;
}

TEST_F(ClusterTest, WithoutAWorkerAJobWaits) {
  const std::string job = submit();
  EXPECT_EQ(json::parse(get(port(), job).body)["status"], "accepted");
  solver_->open();
  start_worker();
  EXPECT_EQ(when(job, [](const json& now) { return now["status"] == "successful"; })["attempt"], 1);
}

/// Others have what is left of as many sweeps as one process works on in turn: the next one is not kept
/// waiting.
TEST(SharedSweeps, ThoseThatOthersWorkOnLeaveRoom) {
  SweepScheduler scheduler;
  const auto add = [&](int number) {
    const std::string document = column_sweep(4);
    return scheduler.add(std::make_shared<ActiveSweep>(id_number(number), *api::read_sweep(document).sweep,
                                                       OpenSweep{document, "", true}));
  };
  for (int number = 0; number < static_cast<int>(SweepScheduler::kMost); ++number) {
    ASSERT_TRUE(add(number));
    scheduler.exhausted(*scheduler.next(0.1));
  }
  EXPECT_FALSE(scheduler.has_items());
  scheduler.refresh();
  EXPECT_EQ(scheduler.count(), 0U);
  EXPECT_TRUE(add(100));
  EXPECT_EQ(scheduler.next(0.1)->sweep->id, id_number(100));
}

/// A sweep that is put aside has no turns, and goes on when its turn comes again; the items in work stay.
TEST(SharedSweeps, OnesPutAsideWaitAndGoOn) {
  SweepScheduler scheduler;
  const std::string document = column_sweep(4);
  const auto add = [&](int number) {
    const auto sweep = std::make_shared<ActiveSweep>(id_number(number), *api::read_sweep(document).sweep,
                                                     OpenSweep{document, "", true});
    scheduler.add(sweep);
    return sweep;
  };
  const std::shared_ptr<ActiveSweep> held = add(1);
  add(2);
  scheduler.give_turns_to({id_number(2)});
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(scheduler.next(0.1)->sweep->id, id_number(2));
  }
  scheduler.refresh();
  EXPECT_TRUE(scheduler.has(id_number(1))) << "a worker has items of it";
  scheduler.give_turns_to({id_number(1)});
  EXPECT_EQ(scheduler.next(0.1)->sweep->id, id_number(1));
  scheduler.give_turns_to({});
  EXPECT_FALSE(scheduler.has_items());
  EXPECT_FALSE(scheduler.next(0.1).has_value());
}

/// Who waits for the store half of the time asks it less often.
TEST(SharedSweeps, ASlowerStoreGivesMoreItemsAtATime) {
  SweepScheduler scheduler;
  EXPECT_DOUBLE_EQ(scheduler.chunk_seconds(), 0.1);
  scheduler.store_took(0.002);
  EXPECT_DOUBLE_EQ(scheduler.chunk_seconds(), 0.1);
  scheduler.store_took(0.018);
  EXPECT_DOUBLE_EQ(scheduler.chunk_seconds(), 0.2) << "it takes a twentieth of that, in the mean";
  scheduler.store_took(10.0);
  EXPECT_DOUBLE_EQ(scheduler.chunk_seconds(), 1.0);
  const std::string document = column_sweep(100'000);
  const auto sweep = std::make_shared<ActiveSweep>(id_number(1), *api::read_sweep(document).sweep,
                                                   OpenSweep{document, "", true});
  scheduler.add(sweep);
  scheduler.give_back({sweep, {1, id_number(1), {0, 2}}}, 2, 2e-3);
  EXPECT_EQ(scheduler.next(0.1)->most, 100U) << "a millisecond each";
  EXPECT_EQ(scheduler.next(1.0)->most, 1000U);
}

/// All statements may go well, and their transaction not: then nothing is stored.
TEST(SharedStore, StatementsWhoseCommitFailsHaveFailed) {
  const TempDir folder;
  postgresql::Connection connection(postgresql_location(folder.name()));
  connection.execute(
      "CREATE TABLE things (number integer);"
      "CREATE FUNCTION refuse() RETURNS trigger LANGUAGE plpgsql AS"
      " $$ BEGIN RAISE EXCEPTION 'at the commit' USING ERRCODE = '53100'; END $$;"
      "CREATE CONSTRAINT TRIGGER refuses AFTER INSERT ON things DEFERRABLE INITIALLY DEFERRED"
      " FOR EACH ROW EXECUTE FUNCTION refuse();");
  const std::vector<postgresql::Statement> insert{{"INSERT INTO things VALUES (1)"}};
  try {
    connection.run_all(insert);
    ADD_FAILURE() << "it was not stored";
  } catch (const postgresql::Error& error) {
    EXPECT_EQ(error.state(), "53100");
    EXPECT_THAT(error.what(), HasSubstr("at the commit"));
  }
  EXPECT_EQ(connection.run("SELECT count(*) FROM things")[0].integer(0), 0);

  const std::vector<postgresql::Statement> end{{"SELECT pg_terminate_backend(pg_backend_pid())"}};
  EXPECT_THROW(connection.run_all(end), postgresql::Error);
  EXPECT_FALSE(connection.good());
}

/// PostgreSQL delivers a process's notifications to its own listening connection, too; those of other
/// processes alone end its wait().
TEST(SharedStore, AProcessDoesNotWakeAtItsOwnRings) {
  const TempDir folder;
  const std::string location = postgresql_database(folder.name());
  const auto own = open_store(location, 1, at_second(0));
  const auto other = open_store(location, 1, at_second(0));
  ASSERT_TRUE(own.ok()) << own.status().message();
  ASSERT_TRUE(other.ok()) << other.status().message();
  const auto is_rung = [&](std::chrono::milliseconds longest) {
    return (*own)->neighbours()->wait(longest, std::stop_token());
  };
  EXPECT_FALSE(is_rung(100ms)) << "it listens from now on";
  ASSERT_TRUE((*own)->neighbours()->ring().ok());
  EXPECT_FALSE(is_rung(500ms));
  ASSERT_TRUE((*other)->neighbours()->ring().ok());
  EXPECT_TRUE(is_rung(10s));
}

/// A server that ends a connection while a pipeline waits: who asked is told, and not kept waiting.
TEST(SharedStore, AConnectionThatIsEndedWhileItWaitsIsLost) {
  const TempDir folder;
  const std::string location = postgresql_location(folder.name());
  postgresql::Connection connection(location);
  postgresql::Connection other(location);
  const std::int64_t server = connection.run("SELECT pg_backend_pid()::bigint")[0].integer(0);
  std::jthread ends([&] {
    const std::string process = std::to_string(server);
    EXPECT_TRUE(eventually([&] {
      return other
                 .run("SELECT count(*) FROM pg_stat_activity WHERE wait_event = 'PgSleep' AND pid = " +
                      process)[0]
                 .integer(0) == 1;
    }));
    other.run("SELECT pg_terminate_backend(" + process + ")");
  });
  const std::vector<postgresql::Statement> waits{{"SELECT 1"}, {"SELECT pg_sleep(3600)"}, {"SELECT 2"}};
  try {
    connection.run_all(waits);
    ADD_FAILURE();
  } catch (const postgresql::Error& error) {
    EXPECT_TRUE(error.lost()) << error.state();
  }
  EXPECT_FALSE(connection.good());
}

/// Claims and stores until nobody has any items left to give.
void work_on(SweepStore& sweeps, const std::string& id) {
  const Time now = Environment::system().now();
  while (true) {
    const auto claim = sweeps.claim(id, 1, {"worker", now + std::chrono::hours(1)}, now);
    if (!claim.ok() || !claim->has_value()) {
      return;
    }
    const std::uint64_t point = (*claim)->items.first;
    EXPECT_TRUE(sweeps.put(**claim, {{point, {"[1]", "", ""}, ""}}, now).ok());
  }
}

/// The last items may be claimed while those before are being stored, and be stored before those are: one of
/// those who store has to see that nothing is left. Commits are made slow, so that they meet.
TEST(SharedSweeps, WhoeverStoresTheLastItemEndsTheSweep) {
  const TempDir folder;
  const std::string location = postgresql_location(folder.name());
  const auto store = open_store(location, 4, at_second(0));
  ASSERT_TRUE(store.ok()) << store.status().message();
  postgresql::Connection(location).execute(
      "CREATE FUNCTION slow() RETURNS trigger LANGUAGE plpgsql AS"
      " $$ BEGIN PERFORM pg_sleep(0.02 * random()); RETURN NULL; END $$;"
      "CREATE CONSTRAINT TRIGGER slow_claim AFTER INSERT ON sweep_leases DEFERRABLE INITIALLY DEFERRED"
      " FOR EACH ROW EXECUTE FUNCTION slow();"
      "CREATE CONSTRAINT TRIGGER slow_put AFTER INSERT ON sweep_rows DEFERRABLE INITIALLY DEFERRED"
      " FOR EACH ROW EXECUTE FUNCTION slow();");
  SweepStore& sweeps = (*store)->sweeps();
  for (int number = 1; number <= 40; ++number) {
    NewSweep sweep{id_number(number), "", "{}", 3, at_second(number), ""};
    ASSERT_TRUE(sweeps.submit(sweep).ok());
    {
      std::vector<std::jthread> workers;
      for (int i = 0; i < 3; ++i) {
        workers.emplace_back([&] { work_on(sweeps, sweep.id); });
      }
    }
    EXPECT_EQ((*sweeps.get(sweep.id))->state, JobState::successful) << number;
  }
}

/// Between the look at what is left and its share of the lock the last items may be taken: it looks again.
TEST(SharedSweeps, WhoWaitsForItsShareOfASweepLooksAgain) {
  const TempDir folder;
  const std::string location = postgresql_location(folder.name());
  const auto store = open_store(location, 1, at_second(0));
  ASSERT_TRUE(store.ok()) << store.status().message();
  ASSERT_TRUE((*store)->sweeps().submit({id_number(1), "", "{}", 3, at_second(1), ""}).ok());
  postgresql::Connection holder(location);
  postgresql::Connection waiter(location);
  postgresql::Connection other(location);
  const std::string sweep = std::to_string(other.run("SELECT seq FROM sweeps")[0].integer(0));
  holder.execute("BEGIN; SELECT pg_advisory_xact_lock(1, " + sweep + ")");
  std::string state;
  {
    const std::jthread waits([&] {
      try {
        waiter.run("SELECT hold_claims(" + sweep + ")");
      } catch (const postgresql::Error& error) {
        state = error.state();
      }
    });
    const std::string waiting =
        "SELECT count(*) FROM pg_locks WHERE locktype = 'advisory' AND NOT granted AND objid = " + sweep;
    EXPECT_TRUE(eventually([&] { return other.run(waiting)[0].integer(0) > 0; }));
    other.execute("DELETE FROM sweep_left");
    holder.execute("COMMIT");
  }
  EXPECT_EQ(state, "40001") << "it is tried again, and has the sweep alone then";
  EXPECT_TRUE(waiter.run("SELECT hold_claims(" + sweep + ")")[0].boolean(0));
}

/// Keys are arrays that are stored apart from their rows, which the planner doesn't count: it would read them
/// all for each key, and a sweep of a million points took hours.
TEST(SharedSweeps, WhatIsKnownIsFoundByItsIndex) {
  const TempDir folder;
  const std::string location = postgresql_location(folder.name());
  const auto store = open_store(location, 1, at_second(0));
  ASSERT_TRUE(store.ok()) << store.status().message();
  SweepStore& sweeps = (*store)->sweeps();
  const NewSweep sweep{id_number(1), "", "{}", 3, at_second(1), ""};
  ASSERT_TRUE(sweeps.submit(sweep).ok());
  const Time now = Environment::system().now();
  const auto claim = sweeps.claim(sweep.id, 3, {"worker", now + std::chrono::hours(1)}, now);
  ASSERT_TRUE(claim.ok() && claim->has_value());
  const std::string key(64, 'a');
  ASSERT_TRUE(sweeps.put(**claim, {{1, {"[1.5]", "", ""}, key}}, now).ok());
  postgresql::Connection other(location);
  const auto scans = [&](const std::string& what) {
    return other.run("SELECT " + what + "::bigint")[0].integer(0);
  };
  const std::string by_index =
      "(SELECT idx_scan FROM pg_stat_user_indexes WHERE indexrelid = 'sweep_rows_by_key'::regclass)";
  const std::string whole = "(SELECT seq_scan FROM pg_stat_user_tables WHERE relid = 'sweep_rows'::regclass)";
  const std::int64_t before = scans(whole);
  EXPECT_EQ(scans(by_index), 0);
  EXPECT_TRUE(eventually([&] {  // what was counted is told a second later
    EXPECT_THAT(*sweeps.find_outputs({key}), testing::ElementsAre(testing::Optional(std::string("[1.5]"))));
    return scans(by_index) > 0;
  }));
  EXPECT_EQ(scans(whole), before);
}

TEST(ClusterConfig, LocationsAreShownWithoutPasswords) {
  EXPECT_EQ(shown_location("postgresql://u:secret@h:5432/n?sslmode=require"),
            "postgresql://u@h:5432/n?sslmode=require");
  EXPECT_EQ(shown_location("postgresql://u@h/n?password=secret&sslpassword=secret&user=u"),
            "postgresql://u@h/n?password=&sslpassword=&user=u");
  EXPECT_EQ(shown_location("/data/a:b@c.db"), "/data/a:b@c.db");
  const auto wrong = open_store("postgresql://u:sec%ret@h/n", 1, at_second(0));
  EXPECT_THAT(wrong.status().message(), testing::Not(HasSubstr("sec%ret")));
}

TEST(ClusterConfig, OnlyASharedStoreMayDoWithoutWorkersOrFront) {
  ServiceConfig config;
  config.workers = 0;
  ASSERT_EQ(config.check().size(), 1U);
  EXPECT_EQ(config.check()[0].field, "workers");
  config.store_path = "postgresql://host/name";
  EXPECT_TRUE(config.check().empty());
  config.front = false;
  EXPECT_EQ(config.check().size(), 1U) << "it would do nothing";
  config.workers = 1;
  EXPECT_TRUE(config.check().empty());
  config.observe = {"0.0.0.0", 9464};
  ASSERT_EQ(config.check().size(), 1U) << "there are no keys";
  EXPECT_EQ(config.check()[0].field, "observe");
  config.observe.reset();
  config.store_path = "store.db";
  ASSERT_EQ(config.check().size(), 1U);
  EXPECT_THAT(config.check()[0].detail, HasSubstr("postgresql://"));
}

}  // namespace
}  // namespace snapthrough::server::test
