/// @file
/// What owners used and did, in every kind of store and over HTTP.

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "api/provenance.h"
#include "server/digest.h"
#include "tests/server/support/running_service.h"
#include "tests/server/support/store_driver.h"

namespace snapthrough::server::test {
namespace {

using nlohmann::json;
using std::chrono_literals::operator""h;
using std::chrono_literals::operator""s;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr int kHourSeconds = 3600;
const Lease kLease{"worker", at_second(10'000'000)};

class LedgerOfStore : public StoreTest {
 protected:
  [[nodiscard]] LedgerStore& ledger() const { return store_->ledger(); }
  [[nodiscard]] SweepStore& sweeps() const { return store_->sweeps(); }

  void add_job(int number, const std::string& owner, const std::string& label, int second) {
    NewJob job = new_job(id_number(number));
    job.owner = owner;
    job.created = at_second(second);
    job.annotations.label = label;
    job.request_sha256 = std::string(64, 'a');
    ASSERT_TRUE(store_->submit(job).ok());
  }
  void finish_next(const WorkUsage& usage, int second) {
    const auto claim = store_->claim(kLease, at_second(second));
    ASSERT_TRUE(claim.ok() && claim->has_value());
    ASSERT_TRUE(store_->finish(**claim, sample_result(), usage, at_second(second)).ok());
  }
  /// A sweep of two points with both rows.
  void add_sweep(int number, const std::string& owner, const WorkUsage& usage, int second) {
    NewSweep sweep{id_number(number), "", "{\"sweep\": 1}", 2, at_second(second), owner};
    ASSERT_TRUE(sweeps().submit(sweep).ok());
    for (std::uint64_t point = 0; point < 2; ++point) {
      const auto claim = sweeps().claim(sweep.id, 1, kLease, at_second(second));
      ASSERT_TRUE(claim.ok() && claim->has_value());
      ASSERT_TRUE(sweeps().put(**claim, {{point, {"[1.5]", "", ""}}}, usage, at_second(second)).ok());
    }
  }
  /// Events of an owner, oldest first, as "event kind number".
  [[nodiscard]] std::vector<std::string> events(const std::string& owner) const {
    const auto read = ledger().events({owner, {}, {}, {}, 1000});
    std::vector<std::string> texts;
    for (const AuditEntry& entry : read.ok() ? *read : std::vector<AuditEntry>()) {
      texts.insert(texts.begin(), std::string(to_string(entry.event)) + (entry.sweep ? " sweep " : " job ") +
                                      std::to_string(std::stoi(entry.id.substr(24))));
    }
    return texts;
  }
};

TEST_P(LedgerOfStore, ResultsSayWhatComputedThemAndWhatThatTook) {
  add_job(1, "ann", "", 1);
  const Job waiting = **store_->get(id_number(1));
  EXPECT_EQ(waiting.program, "");
  EXPECT_FALSE(waiting.usage.has_value());
  EXPECT_EQ(waiting.request_sha256, std::string(64, 'a'));
  finish_next({1'500'000, 4'096, 17}, 2);
  const Job done = **store_->get(id_number(1));
  EXPECT_EQ(done.program, api::program_text());
  EXPECT_EQ(done.usage, std::optional(WorkUsage{1'500'000, 4'096, 17}));
  add_sweep(2, "ann", {1'000, 2'048, 3}, 3);
  const SweepRecord sweep = **sweeps().get(id_number(2));
  EXPECT_EQ(sweep.program, api::program_text());
  EXPECT_EQ(sweep.usage, std::optional(WorkUsage{2'000, 2'048, 6}));
  EXPECT_EQ(sweep.state, JobState::successful);
}

TEST_P(LedgerOfStore, UsageIsCountedByOwnerHourAndLabelAndOutlivesTheWork) {
  add_job(1, "ann", "bridge", 10);
  finish_next({1'000, 100, 1}, 20);
  add_job(2, "ann", "bridge", 30);
  finish_next({2'000, 300, 2}, 40);
  add_job(3, "bob", "bridge", 50);
  finish_next({9'000, 100, 9}, 60);
  add_job(4, "ann", "", kHourSeconds);
  const Claim claim = **store_->claim(kLease, at_second(kHourSeconds));
  ASSERT_TRUE(
      store_->fail(claim, {"no_convergence", "", ""}, {}, {4'000, 200, 4}, at_second(kHourSeconds)).ok());
  add_sweep(5, "ann", {500, 50, 0}, kHourSeconds + 1);
  ASSERT_TRUE(*store_->remove(id_number(1), at_second(kHourSeconds + 2)));
  const auto rows = ledger().usage({"ann", at_second(0), at_second(3 * kHourSeconds)});
  ASSERT_TRUE(rows.ok()) << rows.status().message();
  ASSERT_EQ(rows->size(), 2u);
  EXPECT_EQ((*rows)[0].label, "bridge");
  EXPECT_EQ((*rows)[0].jobs, 2);
  EXPECT_EQ((*rows)[0].work, (WorkUsage{3'000, 300, 3}));
  EXPECT_EQ((*rows)[1].label, "");
  EXPECT_EQ((*rows)[1].hour, at_second(kHourSeconds));
  EXPECT_EQ((*rows)[1].jobs, 1);
  EXPECT_EQ((*rows)[1].points, 2);
  EXPECT_EQ((*rows)[1].work, (WorkUsage{5'000, 200, 4}));
  EXPECT_EQ(ledger().usage({"ann", at_second(1), at_second(kHourSeconds)})->size(), 0u)
      << "no hour begins there";
  EXPECT_EQ(ledger().usage({"ann", at_second(0), at_second(3 * kHourSeconds), "bridge"})->size(), 1u);
}

TEST_P(LedgerOfStore, EventsAreInTheirOrderAndOfTheirOwner) {
  add_job(1, "ann", "", 1);
  add_job(2, "bob", "", 2);
  ASSERT_TRUE(store_->dismiss(id_number(1), at_second(3)).ok());
  ASSERT_TRUE(*store_->remove(id_number(1), at_second(4)));
  add_sweep(3, "ann", {}, 5);
  ASSERT_TRUE(*sweeps().remove(id_number(3), at_second(6)));
  NewSweep sweep{id_number(4), "", "{}", 2, at_second(7), "ann"};
  ASSERT_TRUE(sweeps().submit(sweep).ok());
  ASSERT_TRUE(sweeps().dismiss(sweep.id, at_second(8))->changed);
  ASSERT_TRUE(sweeps().retry(sweep.id, {}, at_second(9))->changed);
  EXPECT_THAT(events("ann"),
              ElementsAre("submitted job 1", "dismissed job 1", "deleted job 1", "submitted sweep 3",
                          "deleted sweep 3", "submitted sweep 4", "dismissed sweep 4", "retried sweep 4"));
  EXPECT_THAT(events("bob"), ElementsAre("submitted job 2"));
  const auto deletion = ledger().deletion(id_number(1), "ann");
  ASSERT_TRUE(deletion.ok() && deletion->has_value());
  EXPECT_EQ((*deletion)->at, at_second(4));
  EXPECT_FALSE(ledger().deletion(id_number(1), "bob")->has_value()) << "nobody learns of others' work";
  EXPECT_FALSE(ledger().deletion(id_number(4), "ann")->has_value());
}

TEST_P(LedgerOfStore, EventsComeInPagesAndWithinTimes) {
  for (int number = 1; number <= 5; ++number) {
    add_job(number, "ann", "", number);
  }
  const auto first = *ledger().events({"ann", {}, {}, {}, 2});
  ASSERT_EQ(first.size(), 3u) << "one more than the limit: there are more";
  EXPECT_EQ(first[0].id, id_number(5));
  const auto second = *ledger().events({"ann", {}, {}, first[1].number, 2});
  EXPECT_EQ(second[0].id, id_number(3));
  const auto between = *ledger().events({"ann", at_second(2), at_second(4), {}, 10});
  ASSERT_EQ(between.size(), 2u);
  EXPECT_EQ(between[1].id, id_number(2));
}

TEST_P(LedgerOfStore, WhatIsRetiredIsNotedAndRecordsAreForgottenInTheirTime) {
  add_job(1, "ann", "", 1);
  finish_next({1'000, 100, 1}, 2);
  add_sweep(2, "ann", {}, 3);
  EXPECT_EQ(*store_->retire(10s, 10, at_second(1'000)), 1);
  EXPECT_EQ(*sweeps().retire(10s, at_second(1'000)), 1);
  EXPECT_THAT(events("ann"),
              ElementsAre("submitted job 1", "submitted sweep 2", "retired job 1", "retired sweep 2"));
  EXPECT_TRUE(*ledger().forget(100s, 1, at_second(1'050))) << "there are more";
  EXPECT_FALSE(*ledger().forget(100s, 10, at_second(1'050)));
  EXPECT_THAT(events("ann"), ElementsAre("retired job 1", "retired sweep 2"));
  EXPECT_EQ(ledger().usage({"ann", at_second(0), at_second(kHourSeconds)})->size(), 1u)
      << "the hour is not old";
  EXPECT_FALSE(*ledger().forget(2h, 10, at_second(4 * kHourSeconds)));
  EXPECT_THAT(events("ann"), IsEmpty());
  EXPECT_EQ(ledger().usage({"ann", at_second(0), at_second(kHourSeconds)})->size(), 0u);
}

TEST_P(LedgerOfStore, ABalanceHasWhatQuotasCount) {
  Quotas quotas;
  quotas.points_per_hour = 100;
  NewSweep sweep{id_number(1), "", "{}", 7, at_second(600), "ann"};
  sweep.quotas = quotas;
  ASSERT_TRUE(sweeps().submit(sweep).ok());
  add_job(2, "ann", "", 610);
  const auto balance = ledger().balance("ann", at_second(660));
  ASSERT_TRUE(balance.ok()) << balance.status().message();
  EXPECT_EQ(balance->has.jobs, 1);
  EXPECT_EQ(balance->has.points, 7);
  EXPECT_EQ(balance->has.points_this_hour, 7);
  EXPECT_GT(balance->has.bytes, 0);
  EXPECT_EQ(balance->until_more, 3540s) << "the minute of the submission counts for an hour";
  EXPECT_EQ(ledger().balance("bob", at_second(660))->has.points, 0);
}

INSTANTIATE_TEST_SUITE_P(Drivers, LedgerOfStore, testing::ValuesIn(store_drivers()), driver_name);

class LedgerOverHttp : public ServiceTest {
 protected:
  void start_with(const Quotas& quotas) {
    ServiceConfig own = config();
    own.jobs.quotas = quotas;
    own.keys = {{"ann", sha256_hex("key of ann")}, {"bob", sha256_hex("key of bob")}};
    service_ = std::make_unique<Service>(own, Environment::system(), local_runners(solve), log_);
    ASSERT_TRUE(service_->start().ok());
  }
  [[nodiscard]] Reply hand_in(const std::string& path, const std::string& body, Headers more = {}) const {
    more.insert(more.end(), {"Content-Type: application/json", "Authorization: Bearer key of ann"});
    return post(port(), path, body, more);
  }
  [[nodiscard]] Reply read(const std::string& path, const std::string& owner = "ann") const {
    return get(port(), path, {"Authorization: Bearer key of " + owner});
  }
};

TEST_F(LedgerOverHttp, AnswersNameProgramAndRequest) {
  start_with({});
  const json document = json::parse(column_request());
  const Reply reply = hand_in("/v1/jobs", column_request());
  ASSERT_EQ(reply.status, 200) << reply.body;
  const json result = json::parse(reply.body);
  EXPECT_EQ(result["kind"], "result");
  EXPECT_EQ(result["program"], api::program_json());
  EXPECT_EQ(result["request_sha256"], api::request_digest(document));
  const json status = json::parse(read(reply.header("Location")).body);
  EXPECT_EQ(status["kind"], "job");
  EXPECT_EQ(status["program"], api::program_json());
  EXPECT_EQ(status["request_sha256"], api::request_digest(document));
  EXPECT_GT(status["usage"]["cpu_seconds"], 0.0);
  EXPECT_EQ(status["usage"]["factorizations"], result["diagnostics"]["factorizations"]);
  const Reply table = read(reply.header("Location") + "/result?table=points");
  EXPECT_EQ(table.header("X-Request-SHA256"), api::request_digest(document)) << table.body;
  EXPECT_THAT(table.header("X-Program"), HasSubstr("snapthrough/"));
}

TEST_F(LedgerOverHttp, ASweepAndItsTableNameProgramAndDocument) {
  start_with({});
  const std::string sweep = hand_in("/v1/sweeps", column_sweep(2)).header("Location");
  const Headers waits{"Authorization: Bearer key of ann", "Prefer: wait=60"};
  const json status = json::parse(get(port(), sweep, waits).body);
  ASSERT_EQ(status["status"], "successful") << status;
  EXPECT_EQ(status["kind"], "sweep");
  EXPECT_GT(status["usage"]["cpu_seconds"], 0.0);
  EXPECT_GT(status["usage"]["factorizations"], 0);
  const json table = json::parse(read(sweep + "/table").body);
  EXPECT_EQ(table["kind"], "table");
  EXPECT_EQ(table["program"], api::program_json());
  EXPECT_EQ(table["request_sha256"], api::request_digest(json::parse(column_sweep(2))));
}

TEST_F(LedgerOverHttp, UsageIsOfTheOwnerWithItsBalance) {
  start_with({5, 0, 0, 100});
  const std::string labelled = R"({"label": "=sum", "request": )" + column_request() + "}";
  ASSERT_EQ(hand_in("/v1/jobs", labelled).status, 200);
  const json usage = json::parse(read("/v1/usage").body);
  EXPECT_EQ(usage["totals"]["jobs"], 1);
  EXPECT_GT(usage["totals"]["cpu_seconds"], 0.0);
  ASSERT_EQ(usage["rows"].size(), 1u);
  EXPECT_EQ(usage["count"], 1);
  EXPECT_EQ(usage["rows"][0]["label"], "=sum");
  EXPECT_EQ(usage["balance"]["points_per_hour"], (json{{"used", 0}, {"quota", 100}}));
  EXPECT_EQ(usage["balance"]["bytes_kept"]["quota"], nullptr);
  EXPECT_EQ(json::parse(read("/v1/usage", "bob").body)["totals"]["jobs"], 0);
  EXPECT_EQ(json::parse(read("/v1/usage?label=other").body)["count"], 0);
  const Reply csv = read("/v1/usage?format=csv");
  EXPECT_THAT(csv.body, HasSubstr(",'=sum,1,0,")) << "no formula";
  EXPECT_EQ(read("/v1/usage?form=csv").status, 400);
  EXPECT_EQ(read("/v1/usage?from=yesterday").status, 400);
}

TEST_F(LedgerOverHttp, SubmissionsSayWhatIsLeftOfQuotas) {
  start_with({5, 0, 0, 100});
  const Reply first = hand_in("/v1/sweeps", column_sweep(4));
  EXPECT_EQ(first.header("RateLimit-Policy"), "\"jobs-waiting\";q=5, \"points-per-hour\";q=100;w=3600");
  EXPECT_THAT(first.header("RateLimit"), HasSubstr("\"points-per-hour\";r=96;t="));
  EXPECT_THAT(hand_in("/v1/jobs", column_request()).header("RateLimit"), HasSubstr("\"jobs-waiting\";r=5"));
  const Reply refused = hand_in("/v1/sweeps", column_sweep(97, "large"));
  EXPECT_EQ(refused.status, 429);
  EXPECT_THAT(refused.header("RateLimit"), HasSubstr("\"points-per-hour\";r=96"));
}

TEST_F(LedgerOverHttp, WhatWasDeletedIsGoneAndTheAuditSaysWhen) {
  start_with({});
  const std::string job = hand_in("/v1/jobs", column_request()).header("Location");
  const std::string sweep = hand_in("/v1/sweeps", column_sweep(2)).header("Location");
  for (const std::string& path : {job, sweep}) {
    ASSERT_EQ(call(port(), "DELETE", path, "", {"Authorization: Bearer key of ann"}).status, 204);
    const Reply gone = read(path);
    EXPECT_EQ(gone.status, 410);
    EXPECT_THAT(gone.body, HasSubstr("by its owner"));
    EXPECT_EQ(read(path + "/request").status, 410);
    EXPECT_EQ(read(path, "bob").status, 404);
  }
  EXPECT_EQ(read("/v1/jobs/" + id_number(77)).status, 404);
  const json audit = json::parse(read("/v1/audit?limit=1").body);
  ASSERT_EQ(audit["count"], 1);
  EXPECT_EQ(audit["events"][0]["event"], "deleted");
  EXPECT_EQ(audit["events"][0]["kind"], "sweep");
  EXPECT_EQ(audit["events"][0]["owner"], "ann");
  const json next = json::parse(read(audit["links"][0]["href"].get<std::string>()).body);
  EXPECT_LT(next["events"][0]["time"], audit["events"][0]["time"]);
  EXPECT_EQ(json::parse(read("/v1/audit", "bob").body)["count"], 0);
  EXPECT_EQ(read("/v1/audit?limit=0").status, 400);
}

}  // namespace
}  // namespace snapthrough::server::test
