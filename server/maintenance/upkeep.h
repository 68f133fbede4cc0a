#pragma once
/// @file
/// Periodic tasks of the service: leases, retention, monitoring of the disk.

#include <optional>
#include <thread>
#include <utility>

#include "server/log/log.h"
#include "server/maintenance/disk_guard.h"
#include "server/queue/worker_context.h"

namespace snapthrough::server {

/// @brief The periodic tasks. run_once() is for one thread; the constructor's arguments must outlive it.
class Upkeep {
 public:
  /// @param guard guard of the store's disk; nullopt: the store is not a file
  Upkeep(const WorkerContext& context, std::optional<DiskGuard> guard)
      : context_(context),
        guard_(std::move(guard)),
        started_(context.environment.now()),
        started_steady_(steady_time(context.environment)),
        now_(started_),
        steady_(started_steady_) {}

  /// Runs the tasks that are due.
  void run_once();

 private:
  void look_at_clocks(Time now, Time steady);
  void keep_leases(Time now, Time steady);
  bool renew_leases(Time since, Time until, Time now);
  void rescue(Time now);
  void look_at_disk(Time now);
  void retire(Time now);
  void retire_sweeps(Time now);
  void count_waiting();

  const WorkerContext& context_;
  std::optional<DiskGuard> guard_;
  const Time started_;         ///< begin, by the wall clock
  const Time started_steady_;  ///< begin, by steady_time()
  Time now_;                   ///< wall clock at the last look
  Time steady_;                ///< steady_time() at the last look
  /// By how much the wall clock was set since all leases were renewed as of an earlier clock.
  std::chrono::microseconds moved_{0};
  // Next tasks, by steady_time().
  Time next_renewal_{};
  Time next_rescue_{};
  Time next_retirement_{};
};

/// Runs the upkeep every second on its own thread during its lifetime.
class UpkeepThread {
 public:
  explicit UpkeepThread(Upkeep& upkeep);

 private:
  std::jthread thread_;
};

/// Writes a log line for each recovered job.
void log_recovery(Log& log, const Recovery& recovery, std::string_view why);

}  // namespace snapthrough::server
