#pragma once
/// @file
/// What the service needs from a database, as verbs. Each database has a driver in its own folder, which
/// holds all of its SQL; one conformance suite (tests/server/store_conformance.h) runs on every driver.

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
#include "server/store/list_query.h"
#include "server/store/neighbour_store.h"
#include "server/store/sweep_store.h"

namespace snapthrough::server {

/// One page of jobs, newest first.
struct JobPage {
  std::vector<Job> jobs;
  std::optional<ListPlace> next;  ///< where the next page starts; empty: this is the last
};

/// What was done about the jobs that a dead process left running.
struct Recovery {
  std::vector<std::string> requeued;
  std::vector<std::string> failed;  ///< they had been left so too often
};

/// What dismissing a job met.
struct Dismissal {
  bool found = false;
  JobState before = JobState::accepted;  ///< accepted and running jobs are dismissed now
};

/// Part of a document.
struct DocumentPiece {
  std::string bytes;
  std::size_t size = 0;  ///< of the whole document
};

/// @brief The stored jobs.
///
/// Thread safety: every verb may be called from any thread. Durability: a verb that returned ok survives the
/// death of the process and of the machine. Atomicity: each verb happens wholly or not at all. A verb with a
/// Claim is fenced: it returns `conflict` and changes nothing unless the job is running in that claim's
/// attempt, and (finish and fail) its lease has not run out.
///
/// Time: `now` is the caller's clock. A driver of a database that many hosts use goes by the database's clock
/// instead, and takes from the caller's only how long something lasts.
class Store {
 public:
  Store() = default;
  Store(const Store&) = delete;
  Store& operator=(const Store&) = delete;
  Store(Store&&) = delete;
  Store& operator=(Store&&) = delete;
  virtual ~Store() = default;

  /// Adds a job in state accepted (running when it comes with a lease), unless its idempotency key is known
  /// or there is a result that it may reuse (see Submitted); `waiting_quota` or `storage_quota` when its
  /// owner would have more than its quotas then. `queued` is called when any verb that is called from then on
  /// comes after this one; that may be before this one is durable.
  virtual StatusOr<Submitted> submit(const NewJob& job, const std::function<void()>& queued) = 0;
  StatusOr<Submitted> submit(const NewJob& job) {
    return submit(job, [] {});
  }

  /// What is known of an idempotency key of an owner; empty when it is new.
  virtual StatusOr<std::optional<Submitted>> find_key(const IdempotencyKey& key, std::string_view owner) = 0;

  /// Gives an accepted job to the caller and makes it running; empty when none waits. Owners take turns; of
  /// one owner it is the oldest. It survives
  /// the death of the process, not that of the machine: the job is accepted again then.
  virtual StatusOr<std::optional<Claim>> claim(const Lease& lease, Time now) = 0;

  /// Renews the leases of claims that still hold; the ids of those that don't.
  virtual StatusOr<std::vector<std::string>> renew(const std::vector<Claim>& claims, Time until,
                                                   Time now) = 0;

  /// Stores the result, path and critical points and makes the job successful.
  virtual Status finish(const Claim& claim, const JobResult& result, Time now) = 0;

  /// Stores why, the path that was reached if any, and makes the job failed.
  virtual Status fail(const Claim& claim, const JobFailure& failure, const StoredPath& reached, Time now) = 0;

  /// Gives a running job back, at its place in the queue; it does not count as a crash.
  virtual Status requeue(const Claim& claim) = 0;

  /// Deals with every job that is still running although its process is known to be gone: back to the queue,
  /// or failed with code "crashed" when this was crash number `max_crashes`. To be called once, before the
  /// first claim. Where other processes may use the store, none is known to be gone: rescue() finds them.
  virtual StatusOr<Recovery> recover(int max_crashes, Time now) = 0;

  /// Takes running jobs back whose lease has run out: to the queue, or failed like recover() when that
  /// happened `max_crashes` times. Leases of `worker` itself cost nothing: it is alive, only slow.
  virtual StatusOr<Recovery> rescue(std::string_view worker, int max_crashes, Time now) = 0;

  /// Makes an accepted or running job dismissed.
  virtual StatusOr<Dismissal> dismiss(std::string_view id, Time now) = 0;
  /// Removes a job and all that belongs to it, in whatever state; false when there is none.
  virtual StatusOr<bool> remove(std::string_view id) = 0;
  /// Removes at most `most` jobs that ended longer ago than that, the oldest first; how many.
  virtual StatusOr<int> retire(std::chrono::seconds age, int most, Time now) = 0;
  /// Forgets idempotency keys that were first used longer ago than that.
  virtual Status forget_keys(std::chrono::seconds age, Time now) = 0;
  /// Finds out whether writing works.
  virtual Status probe(Time now) = 0;

  /// A successful job of that owner and content, the newest (of those without annotations, if there are
  /// any); empty when there is none.
  virtual StatusOr<std::optional<std::string>> find_result(std::string_view content_key,
                                                           std::string_view owner) = 0;
  /// How many jobs are accepted.
  virtual StatusOr<std::int64_t> waiting() = 0;
  /// When the oldest accepted job was handed in; empty when none waits.
  virtual StatusOr<std::optional<Time>> oldest_waiting() = 0;
  /// Appends what the driver measures of itself, in the text format of Prometheus.
  virtual void write_metrics(std::string& /*text*/) const {}

  /// Who has jobs or sweeps, in order.
  virtual StatusOr<std::vector<std::string>> owners() = 0;
  /// The job, or empty when there is none of that id.
  virtual StatusOr<std::optional<Job>> get(std::string_view id) = 0;
  virtual StatusOr<JobPage> list(const ListQuery& query) = 0;

  /// The request document; empty when there is no such job.
  virtual StatusOr<std::optional<std::string>> request(std::string_view id) = 0;
  /// At most `most` bytes of the result document from there on: nothing when there is no such document or it
  /// is no longer than that. What is before them is not read into memory.
  virtual StatusOr<DocumentPiece> result_piece(std::string_view id, std::size_t offset, std::size_t most) = 0;
  /// The path of a successful or failed job; empty lists when there is none.
  virtual StatusOr<StoredPath> path(std::string_view id) = 0;

  /// What is kept of sweeps; lives as long as this.
  virtual SweepStore& sweeps() = 0;
  /// Who is still to be told of an end; lives as long as this.
  virtual DeliveryStore& deliveries() = 0;
  /// What processes that share the store tell each other; lives as long as this. Null: one process at a time
  /// owns the store.
  virtual NeighbourStore* neighbours() { return nullptr; }
};

}  // namespace snapthrough::server
