#include "server/front/gateway.h"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>
#include <sstream>

#include "server/resources/job_key.h"
#include "tests/server/support/failing_delivery_store.h"
#include "tests/server/support/failing_ledger_store.h"
#include "tests/server/support/failing_sweep_store.h"
#include "tests/server/support/samples.h"

namespace snapthrough::server::http {
namespace {

using testing::HasSubstr;
using testing::Not;

/// A store of which each verb that HTTP uses fails as it is told to.
class FailingStore : public Store {
 public:
  explicit FailingStore(StatusCode code) : code_(code) {}

  StatusOr<Submitted> submit(const NewJob&, const std::function<void()>&) override { return status(); }
  StatusOr<std::optional<Submitted>> find_key(const IdempotencyKey&, std::string_view) override {
    return status();
  }
  StatusOr<std::vector<UsedKey>> keys(std::string_view) override { return status(); }
  Status add_key(std::string_view, const UsedKey&) override { return status(); }
  StatusOr<std::optional<Claim>> claim(const Lease&, Time, const OwnersInTurn&) override { return status(); }
  StatusOr<std::vector<std::string>> renew(const std::vector<Claim>&, Time, Time) override {
    return status();
  }
  StatusOr<Recovery> rescue(std::string_view, int, Time) override { return status(); }
  StatusOr<Dismissal> dismiss(std::string_view, Time) override { return status(); }
  StatusOr<bool> remove(std::string_view, std::optional<Time>) override { return status(); }
  StatusOr<bool> set_key(std::string_view, std::string_view) override { return status(); }
  StatusOr<std::optional<std::string>> owner_by_key(std::string_view, std::string_view) override {
    return status();
  }
  StatusOr<int> retire(std::chrono::seconds, int, Time) override { return status(); }
  Status forget_keys(std::chrono::seconds, Time) override { return status(); }
  Status probe(Time) override { return status(); }
  StatusOr<std::optional<std::string>> find_result(std::string_view, std::string_view) override {
    return status();
  }
  StatusOr<std::vector<std::string>> owners() override { return status(); }
  StatusOr<std::int64_t> waiting() override { return status(); }
  StatusOr<std::optional<Time>> oldest_waiting(Time /*now*/) override { return status(); }
  Status finish(const Claim&, const JobResult&, const WorkUsage&, Time) override { return status(); }
  Status fail(const Claim&, const JobFailure&, const StoredPath&, const WorkUsage&, Time) override {
    return status();
  }
  Status requeue(const Claim&) override { return status(); }
  StatusOr<Recovery> recover(int, Time) override { return status(); }
  StatusOr<std::optional<Job>> get(std::string_view id) override {
    if (id == "there") {
      return std::optional<Job>(Job{});
    }
    return status();
  }
  StatusOr<JobPage> list(const ListQuery&) override { return status(); }
  StatusOr<std::optional<std::string>> request(std::string_view) override {
    throw std::runtime_error("secret");
  }
  StatusOr<DocumentPiece> result_piece(std::string_view, std::size_t, std::size_t) override {
    return status();
  }
  SweepStore& sweeps() override { return sweeps_; }
  DeliveryStore& deliveries() override { return deliveries_; }
  LedgerStore& ledger() override { return ledger_; }
  StatusOr<StoredPath> path(std::string_view) override { return status(); }

 private:
  [[nodiscard]] Status status() const { return {code_, "the disk /dev/secret is full"}; }
  StatusCode code_;
  test::FailingSweepStore sweeps_{code_};
  test::FailingDeliveryStore deliveries_{code_};
  test::FailingLedgerStore ledger_{code_};
};

/// A store whose one result is deleted by somebody as soon as it was found.
class StoreOfADeletedResult final : public FailingStore {
 public:
  using FailingStore::FailingStore;

  StatusOr<std::optional<std::string>> find_result(std::string_view, std::string_view) override {
    return std::optional<std::string>("deleted");
  }
  StatusOr<Submitted> submit(const NewJob& job, const std::function<void()>& queued) override {
    queued();
    return Submitted{job.reuse ? Submitted::Kind::reused : Submitted::Kind::created,
                     job.reuse ? "deleted" : job.id};
  }
  StatusOr<std::optional<Job>> get(std::string_view id) override {
    if (id == "deleted") {
      return std::optional<Job>();
    }
    Job job;
    job.id = id;
    return std::optional<Job>(job);
  }
};

template <class StoreType = FailingStore>
struct Bench {
  explicit Bench(StatusCode code) : store(code) {}
  Response serve(const std::string& method, const std::string& path) {
    Request request;
    request.method = method;
    request.path = path;
    request.headers = {{"Content-Type", "application/json"}, {"Prefer", "respond-async"}};
    request.body = test::column_request();
    return gateway.serve(request);
  }

  test::FakeWorld world;
  Environment environment = world.environment();
  std::ostringstream log_text;
  Log log{LogLevel::debug, environment.now, log_text};
  StoreType store;
  JobService jobs{store, environment, log};
  Routes routes{jobs, {}};
  RequestMetrics metrics;
  KeyRing keys;
  Gateway gateway{routes, environment, log, keys, metrics};
};

const std::string kJob = "/v1/jobs/00000000-0000-7000-8000-000000000001";

TEST(Gateway, AStoreThatIsUnavailableIs503) {
  Bench<> bench(StatusCode::unavailable);
  for (const auto& [method, path] : {std::pair<const char*, std::string>("POST", "/v1/jobs"),
                                     {"GET", "/v1/jobs"},
                                     {"GET", kJob},
                                     {"GET", kJob + "/result"}}) {
    const Response response = bench.serve(method, path);
    EXPECT_EQ(response.status, 503) << method << path;
    EXPECT_THAT(response.headers, testing::Contains(testing::Pair("Retry-After", "5")));
  }
}

TEST(Gateway, AKeyOfAJobThatTheStoreCannotCompareOpensNothing) {
  Bench<> bench(StatusCode::unavailable);
  const KeyRing keys({{"ann", std::string(64, '0')}});
  Gateway gateway{bench.routes, bench.environment, bench.log, keys, bench.metrics};
  for (const char* part : {"", "/result", "/table.csv", "/request", "/events"}) {
    Request request;
    request.method = "GET";
    request.path = kJob + part;
    request.headers = {{"Authorization", "Bearer " + new_job_key(bench.environment)}};
    EXPECT_EQ(gateway.serve(request).status, 503) << part;
  }
}

/// Whatever bytes it has: the broken store is not asked.
TEST(Gateway, WhatIsNoIdIsNotThere) {
  Bench<> bench(StatusCode::io_error);
  for (const std::string& id :
       {std::string("x"), std::string("a\0b", 3), std::string("\xff"), std::string("%00")}) {
    for (const char* list : {"/v1/jobs/", "/v1/sweeps/"}) {
      const Response response = bench.serve("GET", list + id);
      EXPECT_EQ(response.status, 404) << list << id;
    }
  }
}

TEST(Gateway, ADescriptionIsFoundAtItsUsualAddress) {
  Bench<> bench(StatusCode::io_error);
  const Response response = bench.serve("GET", "/openapi.json");
  EXPECT_EQ(response.status, 308);
  EXPECT_THAT(response.headers, testing::Contains(testing::Pair("Location", "/v1/openapi.json")));
}

TEST(Gateway, AStoreThatIsBrokenIs500WithoutParticulars) {
  Bench<> bench(StatusCode::io_error);
  const Response response = bench.serve("GET", "/v1/jobs");
  EXPECT_EQ(response.status, 500);
  EXPECT_THAT(response.body, Not(HasSubstr("secret")));
  EXPECT_THAT(bench.log_text.str(), HasSubstr("/dev/secret"));
}

TEST(Gateway, AnExceptionIs500AndItsTextIsInTheLogOnly) {
  Bench<> bench(StatusCode::io_error);
  const Response response = bench.serve("GET", kJob + "/request");
  EXPECT_EQ(response.status, 500);
  EXPECT_THAT(response.body, Not(HasSubstr("secret")));
  EXPECT_THAT(bench.log_text.str(), HasSubstr("secret"));
  EXPECT_EQ(nlohmann::json::parse(response.body)["type"], "urn:snapthrough:problem:internal-error");
}

TEST(Gateway, AnalysesAgainWhatIsDeletedAsItIsReused) {
  Bench<StoreOfADeletedResult> bench(StatusCode::io_error);
  const Response response = bench.serve("POST", "/v1/jobs");
  EXPECT_EQ(response.status, 201) << response.body;
  EXPECT_THAT(response.headers, testing::Contains(testing::Pair("X-Cache", "miss")));
}

}  // namespace
}  // namespace snapthrough::server::http
