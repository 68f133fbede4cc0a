#pragma once
/// @file
/// What a caller can do with jobs, whatever the protocol: hand one in, look at it, dismiss it.

#include <atomic>
#include <chrono>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "server/environment.h"
#include "server/jobs/submission.h"
#include "server/log/log.h"
#include "server/queue/worker_context.h"
#include "server/store/store.h"
#include "server/sweeps/sweep_service.h"
#include "solver/solve.h"

namespace snapthrough::server {

/// @brief Where jobs are handed in and asked for. Thread-safe; the parts it is given must outlive it.
class JobService {
 public:
  JobService(Store& store, const Environment& environment, Log& log, JobLimits limits = {});

  /// @brief Reads and checks a request document and, when nothing is wrong, stores it as a job.
  /// The job is durable when this returns an id. `unavailable` when nothing can be stored at the moment.
  StatusOr<Submission> submit(const Order& order);
  /// The job, if there is one and it is the owner's.
  StatusOr<std::optional<Job>> get(const std::string& id, std::string_view owner);
  /// Dismisses a job and stops its analysis. @pre get() found it
  StatusOr<Dismissal> dismiss(const std::string& id);
  /// Removes a job, after stopping its analysis. @pre get() found it
  Status remove(const std::string& id);

  /// Where the analysis of a running job stands; nothing before its first step. What runs in another process
  /// tells it once a second.
  [[nodiscard]] std::optional<Progress> progress(const Job& job) const;
  [[nodiscard]] Store& store() { return store_; }
  [[nodiscard]] const Environment& environment() const { return environment_; }
  [[nodiscard]] const JobLimits& limits() const { return limits_; }
  [[nodiscard]] SweepService& sweeps() { return sweeps_; }
  /// For the workers, and for whoever follows what they do.
  [[nodiscard]] const WorkerContext& context() const { return context_; }

 private:
  class KeyInUse;
  StatusOr<Submission> store_new(const Order& order, NewJob job);
  void log_new(const NewJob& job, JobState state, std::string_view request_id);

  Store& store_;
  const Environment& environment_;
  Log& log_;
  const JobLimits limits_;
  StoreHealth health_;
  std::atomic<std::int64_t> waiting_ = 0;
  std::mutex keys_mutex_;
  std::set<std::pair<std::string, std::string>> keys_in_use_;
  Bell bell_;
  JobCompletions completions_{bell_};
  HandoffQueue handoffs_;
  ActiveJobs active_;
  JobProgress progress_;
  JobMetrics metrics_;
  const std::string instance_;  ///< the name that leases bear
  SweepService sweeps_;
  const WorkerContext context_;
};

}  // namespace snapthrough::server
