#pragma once
/// @file
/// Verbs of a store of jobs. Each database has a driver in its own folder, which holds all of its SQL; the
/// tests in tests/server/store_conformance_test.cpp run on every driver.

#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "server/jobs/job.h"
#include "server/status.h"
#include "server/store/delivery_store.h"
#include "server/store/ledger_store.h"
#include "server/store/list_query.h"
#include "server/store/neighbour_store.h"
#include "server/store/sweep_store.h"

namespace snapthrough::server {

/// One page of jobs, newest first.
struct JobPage {
  std::vector<Job> jobs;
  std::optional<ListPlace> next;  ///< start of the next page; empty: this is the last page
};

/// Ids of the jobs that were taken back from dead or late workers.
struct Recovery {
  std::vector<std::string> requeued;
  std::vector<std::string> failed;  ///< given up with the code "crashed"
};

/// Outcome of dismissing a job.
struct Dismissal {
  bool found = false;
  JobState before = JobState::accepted;  ///< state before; see kJobTransitions
};

/// Piece of a document.
struct DocumentPiece {
  std::string bytes;
  std::size_t size = 0;  ///< bytes of the whole document
};

/// @brief Stored jobs.
///
/// Thread safety: every verb may be called from any thread. Durability: the effect of a verb that returned ok
/// survives the death of the process and of the machine. Atomicity: each verb happens wholly or not at all. A
/// verb with a Claim is fenced: it returns `conflict` and changes nothing unless the job is running in the
/// attempt of the claim, and (finish and fail) its lease has not run out.
///
/// Time: `now` is the time of the caller. A driver of a database that many hosts use takes the time of the
/// database instead, and only differences from the caller.
class Store {
 public:
  Store() = default;
  Store(const Store&) = delete;
  Store& operator=(const Store&) = delete;
  Store(Store&&) = delete;
  Store& operator=(Store&&) = delete;
  virtual ~Store() = default;

  /// Adds a job in state accepted (with a lease: running) unless its idempotency key is known or there is a
  /// result that it may reuse (see Submitted). `waiting_quota` or `storage_quota` when the job would exceed a
  /// quota of its owner. `queued` is called as soon as every later verb happens after this one, which may be
  /// before this one is durable.
  virtual StatusOr<Submitted> submit(const NewJob& job, const std::function<void()>& queued) = 0;
  StatusOr<Submitted> submit(const NewJob& job) {
    return submit(job, [] {});
  }

  /// Outcome of an earlier submission of the owner with the key; empty for a new key.
  virtual StatusOr<std::optional<Submitted>> find_key(const IdempotencyKey& key, std::string_view owner) = 0;
  /// Idempotency keys that stand for a job, sorted; none when there is no such job.
  virtual StatusOr<std::vector<UsedKey>> keys(std::string_view id) = 0;
  /// Lets a key stand for a job unless the owner has used the key.
  virtual Status add_key(std::string_view id, const UsedKey& key) = 0;

  /// Gives an accepted job to the caller and makes it running; empty when none waits. Owners take turns; the
  /// oldest job of an owner comes first. The claim survives the death of the process; after that of the
  /// machine the job may be accepted again.
  /// @param owners idle: those for whom no job runs in this store
  virtual StatusOr<std::optional<Claim>> claim(const Lease& lease, Time now, const OwnersInTurn& owners) = 0;
  StatusOr<std::optional<Claim>> claim(const Lease& lease, Time now) {
    return claim(lease, now, OwnersInTurn{});
  }

  /// Renews the leases of claims that hold; returns the ids of the others.
  virtual StatusOr<std::vector<std::string>> renew(const std::vector<Claim>& claims, Time until,
                                                   Time now) = 0;

  /// Stores the result with path and critical points, and makes the job successful.
  /// @param usage of computing it; counts for the owner (ledger())
  virtual Status finish(const Claim& claim, const JobResult& result, const WorkUsage& usage, Time now) = 0;
  Status finish(const Claim& claim, const JobResult& result, Time now) {
    return finish(claim, result, {}, now);
  }

  /// Stores the reason and the path that was reached, if any, and makes the job failed. @param usage as for
  /// finish()
  virtual Status fail(const Claim& claim, const JobFailure& failure, const StoredPath& reached,
                      const WorkUsage& usage, Time now) = 0;
  Status fail(const Claim& claim, const JobFailure& failure, const StoredPath& reached, Time now) {
    return fail(claim, failure, reached, {}, now);
  }

  /// Gives a running job back to its place in the queue; that does not count as a crash.
  virtual Status requeue(const Claim& claim) = 0;

  /// Takes back every running job, since its process is known to be gone: to the queue, or failed with the
  /// code "crashed" at crash number `max_crashes`. REQUIRES: called once, before the first claim. In a store
  /// that several processes use it does nothing: rescue() finds the jobs of dead processes.
  virtual StatusOr<Recovery> recover(int max_crashes, Time now) = 0;

  /// Takes back running jobs whose lease has run out: to the queue, or failed with the code "crashed" at
  /// crash number `max_crashes`. Leases of `worker`, which is alive, do not count as crashes.
  virtual StatusOr<Recovery> rescue(std::string_view worker, int max_crashes, Time now) = 0;

  /// Dismisses an accepted or running job.
  virtual StatusOr<Dismissal> dismiss(std::string_view id, Time now) = 0;
  /// Removes a job in any state with all that belongs to it; false when there is none.
  /// @param noted time of the deletion, which is noted (ledger()); empty: it is not, since the job was
  /// incomplete
  virtual StatusOr<bool> remove(std::string_view id, std::optional<Time> noted) = 0;
  StatusOr<bool> remove(std::string_view id) { return remove(id, std::nullopt); }
  /// Gives a job a key, of which it gets the SHA-256, in the place of an earlier one; false when there is no
  /// such job. The key goes with the job.
  virtual StatusOr<bool> set_key(std::string_view id, std::string_view sha256) = 0;
  /// Owner of the job of that id if its key has that SHA-256; empty for another key, and without such a job.
  virtual StatusOr<std::optional<std::string>> owner_by_key(std::string_view id, std::string_view sha256) = 0;
  /// Removes at most `most` jobs that ended longer than `age` ago, the oldest first; returns their number.
  virtual StatusOr<int> retire(std::chrono::seconds age, int most, Time now) = 0;
  /// Removes idempotency keys that were first used longer than `age` ago.
  virtual Status forget_keys(std::chrono::seconds age, Time now) = 0;
  /// Ok when the store can be written.
  virtual Status probe(Time now) = 0;
  /// @brief Gives unused space inside the store's file back to the file system, a part at each call.
  /// @return bytes inside the file that are unused after it: new work takes them before the file grows. Zero
  /// for a store that is not a file.
  virtual StatusOr<std::uint64_t> give_back_space() { return std::uint64_t{0}; }

  /// Id of the newest successful job of that owner and content, without annotations if possible; or empty.
  virtual StatusOr<std::optional<std::string>> find_result(std::string_view content_key,
                                                           std::string_view owner) = 0;
  /// Number of accepted jobs.
  virtual StatusOr<std::int64_t> waiting() = 0;
  /// Time of submission of the oldest accepted job by the clock of the caller; empty when none waits.
  virtual StatusOr<std::optional<Time>> oldest_waiting(Time now) = 0;
  /// Appends metrics of the driver in the text format of Prometheus.
  virtual void write_metrics(std::string& /*text*/) const {}

  /// Owners with jobs or sweeps, sorted.
  virtual StatusOr<std::vector<std::string>> owners() = 0;
  /// The job of that id, or empty.
  virtual StatusOr<std::optional<Job>> get(std::string_view id) = 0;
  virtual StatusOr<JobPage> list(const ListQuery& query) = 0;

  /// The request document; empty when there is no such job.
  virtual StatusOr<std::optional<std::string>> request(std::string_view id) = 0;
  /// At most `most` bytes of the result document from `offset` on; none behind its end or without a document.
  /// Bytes before `offset` are not read into memory.
  virtual StatusOr<DocumentPiece> result_piece(std::string_view id, std::size_t offset, std::size_t most) = 0;
  /// The path of a successful or failed job; empty lists when there is none.
  virtual StatusOr<StoredPath> path(std::string_view id) = 0;

  /// What owners used and did; it lives as long as this store.
  virtual LedgerStore& ledger() = 0;
  /// The stored sweeps; they live as long as this store.
  virtual SweepStore& sweeps() = 0;
  /// The deliveries to callbacks; they live as long as this store.
  virtual DeliveryStore& deliveries() = 0;
  /// Messages between processes that share the store; null: one process at a time owns the store. Lives as
  /// long as this store.
  virtual NeighbourStore* neighbours() { return nullptr; }

  /// Bounds the time of every verb, for a service that stops: a verb returns `unavailable` after at most 10 s
  /// when the database does not answer. Without this call a verb waits until the connection is lost.
  virtual void hurry() {}
};

}  // namespace snapthrough::server
