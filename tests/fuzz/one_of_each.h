#pragma once
/// @file
/// A store for the HTTP fuzzer: one successful job, one sweep that has ended and one that runs, and no room
/// for more.

#include <optional>
#include <string>
#include <vector>

#include "server/store/store.h"
#include "tests/server/support/failing_delivery_store.h"
#include "tests/server/support/samples.h"

namespace snapthrough::server::test {

/// The ids that requests have to name; tests/fuzz/http.dict has them.
inline constexpr const char* kFuzzedJob = "01a1fd46-0260-71e7-9e0a-767a2c28bb66";
inline constexpr const char* kFuzzedSweep = "01a1fd46-0260-71e7-9e0a-767a2c28bb67";
inline constexpr const char* kRunningSweep = "01a1fd46-0260-71e7-9e0a-767a2c28bb68";

inline Status store_is_full() { return {StatusCode::unavailable, "full"}; }

/// Of three points the second failed.
class FuzzedSweeps final : public SweepStore {
 public:
  StatusOr<Submitted> submit(const NewSweep&) override { return store_is_full(); }
  StatusOr<std::optional<Submitted>> find_key(const IdempotencyKey&, std::string_view) override {
    return std::optional<Submitted>();
  }
  StatusOr<std::vector<UsedKey>> keys(std::string_view) override { return std::vector<UsedKey>(); }
  Status add_key(std::string_view, const UsedKey&) override { return store_is_full(); }
  StatusOr<std::int64_t> unfinished() override { return 0; }
  StatusOr<std::vector<std::string>> with_items() override { return std::vector<std::string>(); }
  StatusOr<std::optional<OpenSweep>> open(std::string_view) override { return std::optional<OpenSweep>(); }
  StatusOr<std::optional<ItemClaim>> claim(std::string_view, std::uint64_t, const Lease&, Time) override {
    return store_is_full();
  }
  StatusOr<std::vector<std::int64_t>> renew(const std::vector<ItemClaim>&, Time, Time) override {
    return store_is_full();
  }
  StatusOr<SweepRecord> put(const ItemClaim&, const std::vector<PointRow>&, const WorkUsage&, Time) override {
    return store_is_full();
  }
  StatusOr<std::int64_t> recover(int, Time) override { return 0; }
  StatusOr<std::int64_t> rescue(std::string_view, int, Time) override { return 0; }
  StatusOr<SweepChange> dismiss(std::string_view id, Time) override { return changed(id); }
  StatusOr<SweepChange> retry(std::string_view id, const Quotas&, Time) override { return changed(id); }
  StatusOr<bool> remove(std::string_view id, std::optional<Time>) override { return record(id).has_value(); }
  StatusOr<int> retire(std::chrono::seconds, Time) override { return 0; }
  StatusOr<bool> purge(int) override { return false; }
  Status forget_keys(std::chrono::seconds, Time) override { return {}; }
  StatusOr<std::optional<SweepRecord>> get(std::string_view id) override { return record(id); }
  StatusOr<SweepPage> list(const ListQuery& query) override {
    SweepPage page;
    if (!query.state || *query.state == JobState::failed) {
      page.sweeps.push_back(*record(kFuzzedSweep));
      page.next = query.before ? std::nullopt : std::optional(ListPlace{at_second(1), 7});
    }
    return page;
  }
  StatusOr<std::optional<std::string>> document(std::string_view) override {
    return std::optional<std::string>(document_);
  }
  Status each_row(std::string_view, const PointQuery& query,
                  const std::function<bool(std::uint64_t, const api::PointOutcome&)>& use) override {
    for (std::uint64_t point = query.first; point < 3 && point - query.first < query.count; ++point) {
      if ((!query.failed || *query.failed == rows_[point].failed()) && !use(point, rows_[point])) {
        break;
      }
    }
    return {};
  }
  StatusOr<std::vector<std::optional<std::string>>> find_outputs(
      const std::vector<std::string>& keys) override {
    return std::vector<std::optional<std::string>>(keys.size());
  }

 private:
  static std::optional<SweepRecord> record(std::string_view id) {
    if (id != kFuzzedSweep && id != kRunningSweep) {
      return std::nullopt;
    }
    SweepRecord sweep;
    sweep.id = id;
    sweep.state = JobState::running;
    sweep.title = "a title";
    sweep.analysis_type = "path";
    sweep.points = 3;
    sweep.successful = 1;
    sweep.created = at_second(1);
    sweep.started = at_second(2);
    if (id == kFuzzedSweep) {
      sweep.state = JobState::failed;
      sweep.successful = 2;
      sweep.failed = 1;
      sweep.finished = at_second(3);
    }
    return sweep;
  }
  static SweepChange changed(std::string_view id) {
    const std::optional<SweepRecord> sweep = record(id);
    return sweep ? SweepChange{sweep->state, sweep->state == JobState::running} : SweepChange{};
  }
  const std::string document_ = column_sweep(3, "a \\\"title\\\", with a comma");
  const std::vector<api::PointOutcome> rows_{{"[2.5,\"limit_points\"]", "", ""},
                                             {"", "no_convergence", "at 3, \"why\""},
                                             {"[null,\"steps\"]", "", ""}};
};

/// One of each kind of record.
class FuzzedLedger final : public LedgerStore {
 public:
  StatusOr<std::vector<UsageRow>> usage(const UsageQuery&) override {
    return std::vector<UsageRow>{{at_second(0), "a \"label\"", 1, 2, {3, 4, 5}}};
  }
  StatusOr<std::vector<AuditEntry>> events(const AuditQuery&) override {
    return std::vector<AuditEntry>{{2, at_second(2), AuditEvent::deleted, true, kFuzzedSweep},
                                   {1, at_second(1), AuditEvent::submitted, false, kFuzzedJob}};
  }
  StatusOr<std::optional<AuditEntry>> deletion(std::string_view, std::string_view) override {
    return std::optional<AuditEntry>();
  }
  StatusOr<Balance> balance(std::string_view, Time) override { return Balance{}; }
  StatusOr<bool> forget(std::chrono::seconds, int, Time) override { return false; }
};

class FuzzedStore final : public Store {
 public:
  StatusOr<Submitted> submit(const NewJob&, const std::function<void()>&) override { return store_is_full(); }
  StatusOr<std::optional<Submitted>> find_key(const IdempotencyKey&, std::string_view) override {
    return std::optional<Submitted>();
  }
  StatusOr<std::vector<UsedKey>> keys(std::string_view) override { return std::vector<UsedKey>(); }
  Status add_key(std::string_view, const UsedKey&) override { return store_is_full(); }
  StatusOr<std::optional<Claim>> claim(const Lease&, Time, const OwnersInTurn&) override {
    return std::optional<Claim>();
  }
  StatusOr<std::vector<std::string>> renew(const std::vector<Claim>&, Time, Time) override {
    return store_is_full();
  }
  Status finish(const Claim&, const JobResult&, const WorkUsage&, Time) override { return store_is_full(); }
  Status fail(const Claim&, const JobFailure&, const StoredPath&, const WorkUsage&, Time) override {
    return store_is_full();
  }
  Status requeue(const Claim&) override { return store_is_full(); }
  StatusOr<Recovery> recover(int, Time) override { return store_is_full(); }
  StatusOr<Recovery> rescue(std::string_view, int, Time) override { return store_is_full(); }
  StatusOr<Dismissal> dismiss(std::string_view id, Time) override {
    return Dismissal{id == kFuzzedJob, JobState::successful};
  }
  StatusOr<bool> remove(std::string_view id, std::optional<Time>) override { return id == kFuzzedJob; }
  StatusOr<bool> set_key(std::string_view id, std::string_view) override { return id == kFuzzedJob; }
  StatusOr<std::optional<std::string>> owner_by_key(std::string_view, std::string_view) override {
    return std::optional<std::string>();
  }
  StatusOr<int> retire(std::chrono::seconds, int, Time) override { return 0; }
  Status forget_keys(std::chrono::seconds, Time) override { return store_is_full(); }
  Status probe(Time) override { return store_is_full(); }
  StatusOr<std::optional<std::string>> find_result(std::string_view, std::string_view) override {
    return std::optional<std::string>();
  }
  StatusOr<std::int64_t> waiting() override { return 0; }
  StatusOr<std::vector<std::string>> owners() override { return std::vector<std::string>(); }
  StatusOr<std::optional<Time>> oldest_waiting(Time /*now*/) override { return std::optional<Time>(); }
  StatusOr<std::optional<Job>> get(std::string_view id) override {
    return id == kFuzzedJob ? std::optional(job()) : std::nullopt;
  }
  StatusOr<JobPage> list(const ListQuery& query) override {
    JobPage page;
    page.jobs.push_back(job());
    page.next = query.before ? std::nullopt : std::optional(ListPlace{at_second(1), 7});
    return page;
  }
  StatusOr<std::optional<std::string>> request(std::string_view) override {
    return std::optional<std::string>(column_request());
  }
  StatusOr<DocumentPiece> result_piece(std::string_view, std::size_t offset, std::size_t most) override {
    return DocumentPiece{result_.document.substr(std::min(offset, result_.document.size()), most),
                         result_.document.size()};
  }
  SweepStore& sweeps() override { return sweeps_; }
  DeliveryStore& deliveries() override { return deliveries_; }
  LedgerStore& ledger() override { return ledger_; }
  StatusOr<StoredPath> path(std::string_view) override {
    return StoredPath{result_.branches, result_.critical_points};
  }

 private:
  static Job job() {
    Job job;
    job.id = kFuzzedJob;
    job.state = JobState::successful;
    job.attempt = 1;
    job.title = "a title";
    job.analysis_type = "path";
    job.created = at_second(1);
    job.started = at_second(2);
    job.finished = at_second(3);
    return job;
  }
  const JobResult result_ = sample_result();
  FuzzedSweeps sweeps_;
  FailingDeliveryStore deliveries_{StatusCode::unavailable};
  FuzzedLedger ledger_;
};

}  // namespace snapthrough::server::test
