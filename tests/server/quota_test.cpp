/// @file
/// What one owner may have: how it is counted, and what is refused.

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>
#include <random>
#include <set>
#include <thread>

#include "server/digest.h"
#include "server/store/sqlite/parts.h"
#include "server/store/sqlite/sqlite_store.h"
#include "tests/server/support/running_service.h"
#include "tests/server/support/store_driver.h"

namespace snapthrough::server::test {
namespace {

using nlohmann::json;
using std::chrono_literals::operator""s;
using testing::HasSubstr;

const Lease kLease{"worker", at_second(1'000'000)};

class Quota : public StoreTest {
 protected:
  [[nodiscard]] SweepStore& sweeps() const { return store_->sweeps(); }
  StatusCode add_job(int number, const std::string& owner, const Quotas& quotas = {},
                     const std::string& document = "{}") {
    NewJob job = new_job(id_number(number));
    job.owner = owner;
    job.quotas = quotas;
    job.document = document;
    return store_->submit(job).status().code();
  }
  StatusCode add_sweep(int number, const std::string& owner, std::int64_t points, const Quotas& quotas = {}) {
    NewSweep sweep{id_number(number), "", "{\"sweep\": 1}", points, at_second(number), owner};
    sweep.quotas = quotas;
    return sweeps().submit(sweep).status().code();
  }
  /// Stores a row for each of the next points if there are any, failed ones for odd numbers.
  void put_rows(const std::string& id, std::uint64_t most) {
    const auto claim = sweeps().claim(id, most, kLease, at_second(5));
    ASSERT_TRUE(claim.ok());
    if (!*claim) {
      return;
    }
    std::vector<PointRow> rows;
    const ItemRun& items = (*claim)->items;
    for (std::uint64_t point = items.first; point < items.first + items.count; ++point) {
      rows.push_back(point % 2 == 0 ? PointRow{point, {"[1.5]", "", ""}}
                                    : PointRow{point, {"", "no_convergence", "step \xc3\xa4"}});
    }
    ASSERT_TRUE(sweeps().put(**claim, rows, at_second(6)).ok());
  }
};

TEST_P(Quota, JobsThatWaitAreBoundedForEachOwner) {
  const Quotas two{2, 0, 0};
  EXPECT_EQ(add_job(1, "ann", two), StatusCode::ok);
  EXPECT_EQ(add_job(2, "ann", two), StatusCode::ok);
  EXPECT_EQ(add_job(3, "ann", two), StatusCode::waiting_quota);
  EXPECT_FALSE(store_->get(id_number(3))->has_value()) << "nothing was stored";
  EXPECT_EQ(add_job(4, "bob", two), StatusCode::ok);
  const Claim claim = **store_->claim(kLease, at_second(1));
  EXPECT_EQ(add_job(5, "ann", two), StatusCode::ok) << "the first does not wait any more";
  ASSERT_TRUE(store_->requeue(claim).ok());
  EXPECT_EQ(add_job(6, "ann", two), StatusCode::waiting_quota);
  EXPECT_TRUE(store_->dismiss(id_number(1), at_second(2)).ok());
  EXPECT_EQ(add_job(6, "ann", two), StatusCode::waiting_quota) << "two of three are left";
  EXPECT_TRUE(store_->dismiss(id_number(2), at_second(2)).ok());
  EXPECT_EQ(add_job(6, "ann", two), StatusCode::ok);
}

TEST_P(Quota, AKnownIdempotencyKeyIsAnsweredAtTheQuotaToo) {
  NewJob job = new_job(id_number(1));
  job.quotas = {1, 0, 0};
  job.idempotency = IdempotencyKey{"key", "print"};
  ASSERT_TRUE(store_->submit(job).ok());
  const auto again = store_->submit(job);
  ASSERT_TRUE(again.ok()) << again.status().message();
  EXPECT_EQ(again->kind, Submitted::Kind::repeated);
}

TEST_P(Quota, PointsThatWaitAreBoundedAlsoWhenASweepIsTriedAgain) {
  const Quotas ten{0, 10, 0};
  EXPECT_EQ(add_sweep(1, "ann", 6, ten), StatusCode::ok);
  EXPECT_EQ(add_sweep(2, "ann", 5, ten), StatusCode::waiting_quota);
  put_rows(id_number(1), 2);
  EXPECT_EQ(add_sweep(2, "ann", 5, ten), StatusCode::ok) << "points with a row do not wait";
  ASSERT_TRUE(sweeps().dismiss(id_number(1), at_second(7))->changed);
  EXPECT_EQ(add_sweep(3, "ann", 6, ten), StatusCode::waiting_quota);
  EXPECT_EQ(add_sweep(3, "ann", 5, ten), StatusCode::ok);
  EXPECT_EQ(sweeps().retry(id_number(1), ten, at_second(200)).status().code(), StatusCode::waiting_quota);
  EXPECT_EQ((*sweeps().get(id_number(1)))->failed, 1) << "it is as it was";
  ASSERT_TRUE(*sweeps().remove(id_number(3)));
  EXPECT_TRUE(sweeps().retry(id_number(1), ten, at_second(200))->changed);
}

TEST_P(Quota, PointsOfAnHourAreBoundedWhateverBecomesOfThem) {
  Quotas quotas;
  quotas.points_per_hour = 10;
  const auto add = [&](int number, std::int64_t points, int minutes) {
    NewSweep sweep{id_number(number), "", "{}", points, at_second(60 * minutes), "ann"};
    sweep.quotas = quotas;
    return sweeps().submit(sweep).status().code();
  };
  EXPECT_EQ(add(1, 6, 100), StatusCode::ok);
  put_rows(id_number(1), 6);
  EXPECT_EQ(add(2, 5, 101), StatusCode::rate_quota) << "six points are done, and count";
  EXPECT_EQ(add(2, 4, 130), StatusCode::ok);
  ASSERT_TRUE(*sweeps().remove(id_number(2)));
  EXPECT_EQ(add(3, 1, 131), StatusCode::rate_quota) << "so do those that were removed";
  EXPECT_EQ(add_sweep(4, "bob", 9, quotas), StatusCode::ok);
  EXPECT_EQ(add(5, 6, 161), StatusCode::ok) << "an hour after the first";
  EXPECT_EQ(add(6, 1, 161), StatusCode::rate_quota);
  EXPECT_EQ(sweeps().retry(id_number(1), quotas, at_second(60 * 162)).status().code(),
            StatusCode::rate_quota);
  EXPECT_TRUE(sweeps().retry(id_number(1), quotas, at_second(60 * 300))->changed) << "three points failed";
  EXPECT_EQ(add(7, 8, 301), StatusCode::rate_quota);
  EXPECT_EQ(add(7, 7, 301), StatusCode::ok);
}

TEST_P(Quota, BytesThatAreKeptAreBounded) {
  const Quotas quotas{0, 0, 10'000};
  const std::string document(4'000, 'x');
  EXPECT_EQ(add_job(1, "ann", quotas, document), StatusCode::ok);
  JobResult result = sample_result();
  result.document = std::string(9'000, 'y');
  EXPECT_TRUE(store_->finish(**store_->claim(kLease, at_second(1)), result, at_second(2)).ok())
      << "what was accepted is stored";
  EXPECT_EQ(add_job(2, "ann", quotas, "{}"), StatusCode::storage_quota);
  EXPECT_EQ(add_sweep(3, "ann", 1, quotas), StatusCode::storage_quota);
  EXPECT_EQ(add_job(4, "bob", quotas, document), StatusCode::ok);
  ASSERT_TRUE(*store_->remove(id_number(1)));
  EXPECT_EQ(add_job(2, "ann", quotas, document), StatusCode::ok);
  EXPECT_EQ(add_job(5, "ann", quotas, document), StatusCode::ok);
  EXPECT_EQ(add_job(6, "ann", quotas, document), StatusCode::storage_quota);
}

TEST_P(Quota, ManyAtATimeDoNotPassIt) {
  std::atomic<int> stored = 0;
  std::vector<std::jthread> clients;
  for (int client = 0; client < 8; ++client) {
    clients.emplace_back([&, client] {
      for (int i = 0; i < 10; ++i) {
        stored += add_job(1 + client * 10 + i, "ann", {7, 0, 0}) == StatusCode::ok ? 1 : 0;
      }
    });
  }
  clients.clear();
  EXPECT_EQ(stored, 7);
}

/// Of SQLite, whose counts are read.
class RandomQuota : public Quota {
 protected:
  /// "owner jobs points bytes" of each owner that has anything, as the store counted it, or counted anew.
  std::set<std::string> usage(bool anew) const {
    static const char* const kCounted =
        "SELECT owner, jobs_waiting, points_waiting, bytes_kept FROM owners"
        " WHERE jobs_waiting <> 0 OR points_waiting <> 0 OR bytes_kept <> 0";
    static const char* const kAnew =
        "WITH held (owner, jobs, points, bytes) AS ("
        " SELECT owner, status = 'accepted', 0, 0 FROM jobs UNION ALL"
        " SELECT owner, 0, 0, length(CAST(document AS BLOB)) FROM requests JOIN jobs ON seq = job UNION ALL"
        " SELECT owner, 0, 0, length(CAST(document AS BLOB)) FROM results JOIN jobs ON seq = job UNION ALL"
        " SELECT owner, 0, 0, ifnull(length(CAST(reached AS BLOB)), 0) FROM failures JOIN jobs ON seq = job"
        " UNION ALL SELECT owner, 0, iif(status IN ('accepted', 'running'), points - (SELECT count(*) FROM"
        "   sweep_points WHERE sweep = seq), 0), length(CAST(document AS BLOB))"
        "   FROM sweeps JOIN sweep_documents ON sweep = seq WHERE removed = 0 UNION ALL"
        " SELECT owner, 0, 0, length(CAST(ifnull(outputs, code || detail) AS BLOB)) FROM sweep_points"
        "   JOIN sweeps ON seq = sweep WHERE removed = 0)"
        "SELECT owner, sum(jobs), sum(points), sum(bytes) FROM held GROUP BY owner"
        " HAVING sum(jobs) + sum(points) + sum(bytes) > 0";
    const sqlite::Connection connection(folder_.file("store.db"), sqlite::Access::read_only);
    sqlite::Statement row = connection.prepare(anew ? kAnew : kCounted);
    std::set<std::string> all;
    while (row.step()) {
      all.insert(row.text(0) + " " + std::to_string(row.integer(1)) + " " + std::to_string(row.integer(2)) +
                 " " + std::to_string(row.integer(3)));
    }
    return all;
  }

  int draw(int below) { return std::uniform_int_distribution<int>(0, below - 1)(random_); }
  std::string owner() { return draw(2) == 0 ? "ann" : "b\xc3\xb6\xc3\xb6"; }
  std::string some() { return id_number(1 + draw(made_ + 1)); }

  Status end_some_job() {
    const auto claim = store_->claim(kLease, at_second(1));
    if (!claim.ok() || !claim->has_value()) {
      return claim.status();
    }
    switch (draw(4)) {
      case 0:
        return store_->finish(**claim, sample_result(), at_second(2));
      case 1:
        return store_->fail(**claim, {"code", "why", "{\"reached\": 1}"}, {}, at_second(2));
      case 2:
        return store_->requeue(**claim);
      default:
        return {};  // it stays running
    }
  }
  Status change_some_job() {
    switch (draw(6)) {
      case 0:
      case 1:
        ++made_;
        add_job(made_, owner(), {}, "{\"\xc3\xa4\": " + std::to_string(made_) + "}");
        return {};
      case 2:
        return store_->dismiss(some(), at_second(3)).status();
      case 3:
        return draw(3) > 0 ? Status() : store_->remove(some()).status();
      case 4:
        return draw(9) > 0 ? Status() : store_->recover(2, at_second(9)).status();
      default:
        return draw(9) > 0 ? end_some_job() : store_->retire(0s, 1, at_second(3)).status();
    }
  }
  Status change_some_sweep() {
    const std::string id = some();
    const auto sweep = sweeps().get(id);
    switch (draw(7)) {
      case 0:
        add_sweep(++made_, owner(), 4);
        return {};
      case 1:
      case 2:
        if (sweep->has_value() && !is_final((*sweep)->state)) {
          put_rows(id, draw(2) == 0 ? 2 : 3);
        }
        return {};
      case 3:
        return sweeps().dismiss(id, at_second(4)).status();
      case 4:
        return sweeps().retry(id, {}, at_second(200)).status();
      case 5:
        return draw(3) > 0 ? Status() : sweeps().remove(id).status();
      default:
        return draw(9) > 0 ? sweeps().purge(3).status() : sweeps().retire(0s, at_second(5)).status();
    }
  }

  unsigned seed_ = std::random_device()();
  std::mt19937 random_{seed_};
  int made_ = 0;
};

/// Whatever happens to jobs and sweeps, the counts are those of a scan.
TEST_P(RandomQuota, CountsAreThoseOfAScan) {
  SCOPED_TRACE("seed " + std::to_string(seed_));
  for (int step = 0; step < 400; ++step) {
    const Status status = draw(2) == 0 ? change_some_job() : change_some_sweep();
    ASSERT_TRUE(status.ok()) << status.message();
    ASSERT_EQ(usage(false), usage(true)) << "step " << step;
  }
  EXPECT_FALSE(usage(false).empty());
}

INSTANTIATE_TEST_SUITE_P(Drivers, Quota, testing::ValuesIn(store_drivers()), driver_name);
INSTANTIATE_TEST_SUITE_P(Sqlite, RandomQuota, testing::Values(store_drivers().front()), driver_name);

TEST(QuotaMigration, WhatWaitsInAnOlderStoreCountsAndWhatItKeepsDoesNot) {
  const TempDir folder;
  const std::string path = folder.file("old.db");
  {
    sqlite::Connection old(path, sqlite::Access::read_write);
    ASSERT_TRUE(sqlite::migrate(old, std::span(sqlite::embedded_migrations()).first(4), at_second(0)).ok());
    old.execute("INSERT INTO jobs (id, owner, analysis_type, created_us) VALUES ('" + id_number(1) +
                "', 'ann', 'path', 1); INSERT INTO requests VALUES (1, '{}')");
    old.execute(
        "INSERT INTO jobs (id, owner, status, attempt, started_us, lease_until_us, worker, analysis_type,"
        " created_us) VALUES ('" +
        id_number(2) + "', 'bob', 'running', 1, 1, 1, 'w', 'path', 1)");
    old.execute("INSERT INTO sweeps (id, owner, points, successful, created_us) VALUES ('" + id_number(3) +
                "', 'ann', 9, 2, 1)");
  }
  auto opened = sqlite::open_store(path, at_second(1));
  ASSERT_TRUE(opened.ok()) << opened.status().message();
  const std::unique_ptr<Store> store = std::move(opened).value();
  ASSERT_TRUE(store->recover(3, at_second(2)).ok());
  NewJob job = new_job(id_number(4));
  job.owner = "bob";
  job.quotas = {1, 0, 0};
  EXPECT_EQ(store->submit(job).status().code(), StatusCode::waiting_quota)
      << "its job went back to the queue";
  NewSweep sweep{id_number(5), "", "{}", 4, at_second(2), "ann"};
  sweep.quotas = {0, 10, 0};
  EXPECT_EQ(store->sweeps().submit(sweep).status().code(), StatusCode::waiting_quota) << "seven wait";
  ASSERT_TRUE(*store->remove(id_number(1)));
  job.id = id_number(6);
  job.owner = "ann";
  job.quotas = {1, 0, 100};
  EXPECT_TRUE(store->submit(job).ok());
}

class QuotaOverHttp : public ServiceTest {
 protected:
  void start_with(const Quotas& quotas) {
    ServiceConfig own = config();
    own.workers = 1;
    own.jobs.quotas = quotas;
    own.keys = {{"ann", sha256_hex("key of ann")}, {"bob", sha256_hex("key of bob")}};
    service_ = std::make_unique<Service>(own, Environment::system(), local_runners(gated(solver_)), log_);
    ASSERT_TRUE(service_->start().ok());
  }
  [[nodiscard]] Reply hand_in(const std::string& owner, const std::string& path,
                              const std::string& body) const {
    return post(
        port(), path, body,
        {"Content-Type: application/json", "Prefer: respond-async", "Authorization: Bearer key of " + owner});
  }
  static void expect_problem(const Reply& reply, int status, const std::string& type,
                             const std::string& quota) {
    EXPECT_EQ(reply.status, status) << reply.body;
    const json problem = json::parse(reply.body);
    EXPECT_EQ(problem["type"], "urn:snapthrough:problem:" + type);
    EXPECT_THAT(problem["detail"].get<std::string>(), HasSubstr(quota));
  }

  std::shared_ptr<GatedSolver> solver_ = std::make_shared<GatedSolver>();
};

TEST_F(QuotaOverHttp, WaitingWorkBeyondItIs429AndNamesIt) {
  start_with({1, 4, 0, 12});
  EXPECT_EQ(hand_in("ann", "/v1/jobs", column_request("running")).status, 201);
  solver_->wait_started(1);
  EXPECT_EQ(hand_in("ann", "/v1/jobs", column_request("waiting")).status, 201);
  const Reply refused = hand_in("ann", "/v1/jobs", column_request("one more"));
  expect_problem(refused, 429, "waiting-quota", "quota_jobs_waiting (see /v1/limits) is 1");
  EXPECT_FALSE(refused.header("Retry-After").empty());
  EXPECT_EQ(hand_in("bob", "/v1/jobs", column_request("of bob")).status, 201);
  expect_problem(hand_in("ann", "/v1/sweeps", column_sweep(5)), 429, "waiting-quota", "quota_points_waiting");
  const std::string sweep = hand_in("ann", "/v1/sweeps", column_sweep(4)).header("Location");
  const Headers key{"Authorization: Bearer key of ann"};
  EXPECT_EQ(call(port(), "POST", sweep + "/dismiss", "", key).status, 200);
  EXPECT_EQ(hand_in("ann", "/v1/sweeps", column_sweep(3, "other")).status, 201);
  expect_problem(call(port(), "POST", sweep + "/retry", "", key), 429, "waiting-quota",
                 "quota_points_waiting");
  const json limits = json::parse(get(port(), "/v1/limits", key).body);
  EXPECT_EQ(limits["quota_points_per_hour"], 12);
  EXPECT_EQ(limits["quota_jobs_waiting"], 1);
  EXPECT_EQ(limits["quota_points_waiting"], 4);
  EXPECT_EQ(limits["quota_bytes_kept"], 0);
}

TEST_F(QuotaOverHttp, PointsBeyondThoseOfAnHourAre429) {
  start_with({0, 0, 0, 5});
  EXPECT_EQ(hand_in("ann", "/v1/sweeps", column_sweep(4)).status, 201);
  const Reply refused = hand_in("ann", "/v1/sweeps", column_sweep(3, "another"));
  expect_problem(refused, 429, "rate-quota", "quota_points_per_hour (see /v1/limits) is 5: this owner has 4");
  EXPECT_FALSE(refused.header("Retry-After").empty());
  EXPECT_EQ(hand_in("bob", "/v1/sweeps", column_sweep(3)).status, 201);
}

TEST_F(QuotaOverHttp, MoreThanMayBeKeptIs403UntilSomethingIsRemoved) {
  solver_->open();
  start_with({0, 0, 3'000});
  std::string job;
  Reply reply;
  for (int i = 0; i < 10 && reply.status != 403; ++i) {
    job = reply.header("Location");
    reply = hand_in("ann", "/v1/jobs", column_request("job " + std::to_string(i)));
    const Headers waits{"Authorization: Bearer key of ann", "Prefer: wait=60"};
    EXPECT_TRUE(reply.status != 201 || get(port(), reply.header("Location"), waits).status == 200);
  }
  expect_problem(reply, 403, "storage-quota", "quota_bytes_kept (see /v1/limits) is 3000");
  EXPECT_EQ(hand_in("bob", "/v1/jobs", column_request()).status, 201);
  EXPECT_EQ(call(port(), "DELETE", job, "", {"Authorization: Bearer key of ann"}).status, 204);
  EXPECT_EQ(hand_in("ann", "/v1/jobs", column_request("again")).status, 201);
}

}  // namespace
}  // namespace snapthrough::server::test
