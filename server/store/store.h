#pragma once
/// @file
/// What the service needs from a database, as verbs. Each database has a driver in its own folder, which
/// holds all of its SQL; one conformance suite (tests/server/store_conformance.h) runs on every driver.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "server/jobs/job.h"
#include "server/status.h"

namespace snapthrough::server {

/// Which jobs to list.
struct JobQuery {
  int limit = 20;                      ///< > 0
  std::optional<std::int64_t> before;  ///< JobPage::next of the page before; empty: from the newest
  std::optional<JobState> state;       ///< only these
};

/// One page of jobs, newest first.
struct JobPage {
  std::vector<Job> jobs;
  std::optional<std::int64_t> next;  ///< where the next page starts; empty: this is the last
};

/// What was done about the jobs that a dead process left running.
struct Recovery {
  std::vector<std::string> requeued;
  std::vector<std::string> failed;  ///< they had been left so too often
};

/// @brief The stored jobs.
///
/// Thread safety: every verb may be called from any thread. Durability: a verb that returned ok survives the
/// death of the process and of the machine. Atomicity: each verb happens wholly or not at all. A verb with a
/// Claim is fenced: it returns `conflict` and changes nothing unless the job is running in that claim's
/// attempt. One process at a time owns a store.
class Store {
 public:
  Store() = default;
  Store(const Store&) = delete;
  Store& operator=(const Store&) = delete;
  Store(Store&&) = delete;
  Store& operator=(Store&&) = delete;
  virtual ~Store() = default;

  /// Adds a job in state accepted.
  virtual Status submit(const NewJob& job) = 0;

  /// Gives the oldest accepted job to the caller and makes it running; empty when none waits.
  virtual StatusOr<std::optional<Claim>> claim(Time now) = 0;

  /// Stores the result, path and critical points and makes the job successful.
  virtual Status finish(const Claim& claim, const JobResult& result, Time now) = 0;

  /// Stores why, the path that was reached if any, and makes the job failed.
  virtual Status fail(const Claim& claim, const JobFailure& failure, const StoredPath& reached, Time now) = 0;

  /// Gives a running job back, at its place in the queue; it does not count as a crash.
  virtual Status requeue(const Claim& claim) = 0;

  /// Deals with every job that is still running although its process is gone: back to the queue, or failed
  /// with code "crashed" when this was crash number `max_crashes`. To be called once, before the first claim.
  virtual StatusOr<Recovery> recover(int max_crashes, Time now) = 0;

  /// The job, or empty when there is none of that id.
  virtual StatusOr<std::optional<Job>> get(std::string_view id) = 0;
  virtual StatusOr<JobPage> list(const JobQuery& query) = 0;

  /// The request document; empty when there is no such job.
  virtual StatusOr<std::optional<std::string>> request(std::string_view id) = 0;
  /// The result document; empty when there is no such job or it is not successful.
  virtual StatusOr<std::optional<std::string>> result(std::string_view id) = 0;
  /// The path of a successful or failed job; empty lists when there is none.
  virtual StatusOr<StoredPath> path(std::string_view id) = 0;
};

}  // namespace snapthrough::server
