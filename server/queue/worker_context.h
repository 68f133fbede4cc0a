#pragma once
/// @file
/// What a worker, and whoever looks after workers, is given.

#include <atomic>
#include <cstdint>
#include <string>

#include "server/bell.h"
#include "server/environment.h"
#include "server/jobs/active_jobs.h"
#include "server/jobs/handoff.h"
#include "server/jobs/job_completions.h"
#include "server/jobs/job_metrics.h"
#include "server/jobs/limits.h"
#include "server/jobs/progress_topic.h"
#include "server/log/log.h"
#include "server/store/store.h"
#include "server/sweeps/sweep_work.h"

namespace snapthrough::server {

/// Where work comes from, where it is told, and where it ends. All parts are thread-safe.
struct WorkerContext {
  Store& store;
  const Environment& environment;
  Log& log;
  const JobLimits& limits;
  StoreHealth& health;
  std::atomic<std::int64_t>& waiting;  ///< jobs that wait, about
  JobCompletions& completions;
  HandoffQueue& handoffs;
  ActiveJobs& active;
  JobProgress& progress;
  SweepWork& sweeps;
  JobMetrics& metrics;
  Bell& bell;                  ///< for other processes
  const std::string instance;  ///< of the service: the name that leases bear

  /// A lease from now on.
  [[nodiscard]] Lease new_lease() const { return {instance, environment.now() + limits.lease}; }
};

}  // namespace snapthrough::server
