#pragma once
/// @file
/// Parts that workers, Upkeep and Neighbours share.

#include <string>

#include "server/bell.h"
#include "server/environment.h"
#include "server/jobs/active_jobs.h"
#include "server/jobs/handoff.h"
#include "server/jobs/job_completions.h"
#include "server/jobs/job_metrics.h"
#include "server/jobs/limits.h"
#include "server/jobs/progress_topic.h"
#include "server/jobs/waiting_count.h"
#include "server/log/log.h"
#include "server/store/store.h"
#include "server/sweeps/sweep_work.h"

namespace snapthrough::server {

/// Parts that workers, Upkeep and Neighbours share. All are thread-safe.
struct WorkerContext {
  Store& store;
  const Environment& environment;
  Log& log;
  const JobLimits& limits;
  StoreHealth& health;
  WaitingCount& waiting;  ///< accepted jobs
  JobCompletions& completions;
  HandoffQueue& handoffs;
  ActiveJobs& active;
  JobProgress& progress;
  SweepWork& sweeps;
  JobMetrics& metrics;
  Bell& bell;                  ///< wakes the thread that rings other processes
  const std::string instance;  ///< name of this instance of the service, in leases

  /// A lease of this instance that begins now.
  [[nodiscard]] Lease new_lease() const { return {instance, environment.now() + limits.lease}; }
};

}  // namespace snapthrough::server
