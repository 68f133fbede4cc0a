#pragma once
/// @file
/// Bounds of the service on jobs and sweeps, and the health of its store.

#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "server/jobs/job.h"
#include "server/status.h"

namespace snapthrough::server {

/// Least bytes of memory that an analysis may be bounded to.
inline constexpr std::int64_t kLeastJobMemory = 1 << 20;

/// Bounds of the service on jobs and sweeps.
struct JobLimits {
  int queue = 100'000;                     ///< accepted jobs, >= 1
  std::chrono::seconds lease{30};          ///< duration of a lease that is not renewed
  std::chrono::seconds longest_run{3600};  ///< longest run of one job, or of one item of a sweep
  int spare_workers = 8;  ///< most analyses beside those of the workers, see WorkerPool; >= 0
  /// Time for which all workers are at the same work until spare workers begin.
  std::chrono::milliseconds spare_after{20};
  std::int64_t job_memory = std::int64_t{1} << 30;  ///< memory of one analysis in bytes, >= kLeastJobMemory
  int max_crashes = 3;                              ///< crashes after which a job or item is given up
  std::chrono::seconds keep_jobs{30 *
                                 86400};  ///< time that jobs and sweeps are kept after their end; 0: for ever
  std::chrono::seconds keep_keys{86400};  ///< time that idempotency keys are kept
  std::chrono::seconds keep_records{90 *
                                    86400};  ///< time that usage and events of owners are kept; 0: for ever
  int sweeps = 1000;                         ///< unfinished sweeps, >= 1
  int sweep_points = 100'000;                ///< points of one sweep, 1 to api::kMaxSweepPoints
  int table_rows = 250'000;                  ///< rows in one response, >= 1
  std::size_t json_keys = 300'000;           ///< keys in a document, >= 1
  Quotas quotas;                             ///< bounds of each owner
  std::vector<std::string>
      callback_hosts;  ///< hosts that callbacks may have, `host[:port]`; see jobs/callback.h
};

/// Health of the store. Thread-safe.
struct StoreHealth {
  std::atomic<bool> writable = true;   ///< outcome of the latest write that tells
  std::atomic<bool> has_space = true;  ///< the disk has room for new jobs
  std::atomic<bool> draining = false;  ///< the service has begun to stop
  /// Bytes of the disk that new documents may still take until it is looked at again.
  std::atomic<std::int64_t> room = std::numeric_limits<std::int64_t>::max();

  /// @brief Takes room for a document; `unavailable` when there is none. Many documents can arrive between
  /// two looks at the disk.
  [[nodiscard]] Status take_room(std::size_t document);
  /// Ok when the service takes new work; else `stopping` or `unavailable`.
  [[nodiscard]] Status takes_work() const;
};

}  // namespace snapthrough::server
