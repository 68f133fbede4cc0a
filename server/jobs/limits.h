#pragma once
/// @file
/// Bounds on what is kept and worked on, and whether the store takes anything at the moment.

#include <atomic>
#include <chrono>
#include <cstdint>
#include <string>
#include <vector>

#include "server/jobs/job.h"
#include "server/status.h"

namespace snapthrough::server {

/// With less no analysis would get far.
inline constexpr std::int64_t kLeastJobMemory = 1 << 20;

/// Bounds on what is kept and worked on.
struct JobLimits {
  int queue = 100'000;                              ///< jobs that may wait, >= 1
  std::chrono::seconds lease{30};                   ///< a worker that is silent for so long has lost its job
  std::chrono::seconds longest_run{3600};           ///< of one job, or of one point of a sweep
  std::int64_t job_memory = std::int64_t{1} << 30;  ///< bytes of one analysis, >= kLeastJobMemory
  int max_crashes = 3;  ///< a job (or point) during which the service died so often is given up
  std::chrono::seconds keep_jobs{30 * 86400};  ///< jobs and sweeps after their end; 0: for ever
  std::chrono::seconds keep_keys{86400};       ///< idempotency keys
  int sweeps = 1000;                           ///< sweeps that may be unfinished, >= 1
  int sweep_points = 100'000;                  ///< of one sweep, 1 to api::kMaxSweepPoints
  int table_rows = 250'000;                    ///< in one response, >= 1
  Quotas quotas;                               ///< of each owner
  std::vector<std::string> callback_hosts;  ///< that may be told of ends, `host[:port]`; see jobs/callback.h
};

/// Whether writing to the store works. Thread-safe.
struct StoreHealth {
  std::atomic<bool> writable = true;   ///< the latest write that tells
  std::atomic<bool> has_space = true;  ///< enough for new jobs
  std::atomic<bool> draining = false;  ///< the service is about to stop

  /// Ok when new work may be handed in; else `stopping` or `unavailable`.
  [[nodiscard]] Status takes_work() const {
    if (draining) {
      return {StatusCode::stopping, "The service is stopping."};
    }
    return has_space ? Status() : Status(StatusCode::unavailable, "the disk is full");
  }
};

}  // namespace snapthrough::server
