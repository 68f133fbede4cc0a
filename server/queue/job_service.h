#pragma once
/// @file
/// Jobs for any protocol: submit, get, dismiss, remove.

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

/// Takes jobs in and answers questions about them. Thread-safe. REQUIRES: the parts of the constructor
/// outlive it.
class JobService {
 public:
  JobService(Store& store, const Environment& environment, Log& log, JobLimits limits = {});

  /// @brief Checks a request document and stores it as a job if it has no findings. The job is durable when
  /// an id is returned. @return `unavailable` or `stopping` while the service takes no work
  StatusOr<Submission> submit(const Order& order);
  /// The job of that id and owner, or nothing.
  StatusOr<std::optional<Job>> get(const std::string& id, std::string_view owner);
  /// Dismisses a job and stops its analysis. @pre get() found the job
  StatusOr<Dismissal> dismiss(const std::string& id);
  /// Stops the analysis of a job and removes the job. @pre get() found the job
  Status remove(const std::string& id);

  /// Progress of a running job; nothing before its first step. Another process tells its progress once a
  /// second.
  [[nodiscard]] std::optional<Progress> progress(const Job& job) const;
  [[nodiscard]] Store& store() { return store_; }
  [[nodiscard]] const Environment& environment() const { return environment_; }
  [[nodiscard]] const JobLimits& limits() const { return limits_; }
  [[nodiscard]] SweepService& sweeps() { return sweeps_; }
  /// The parts that workers, upkeep and followers use.
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
  WaitingCount waiting_;
  std::mutex keys_mutex_;
  std::set<std::pair<std::string, std::string>> keys_in_use_;
  Bell bell_;
  JobCompletions completions_{bell_};
  HandoffQueue handoffs_;
  ActiveJobs active_;
  JobProgress progress_;
  JobMetrics metrics_;
  const std::string instance_;  ///< name of this instance of the service, in leases
  SweepService sweeps_;
  const WorkerContext context_;
};

}  // namespace snapthrough::server
