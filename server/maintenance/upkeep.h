#pragma once
/// @file
/// What has to be done again and again, whatever the requests: leases, retention, the state of the disk.

#include <optional>
#include <thread>
#include <utility>

#include "server/log/log.h"
#include "server/maintenance/disk_guard.h"
#include "server/queue/worker_context.h"

namespace snapthrough::server {

/// @brief The recurring work. run_once() from one thread; the parts it is given must outlive it.
class Upkeep {
 public:
  /// @param guard of the disk of a store that is a file here
  Upkeep(const WorkerContext& context, std::optional<DiskGuard> guard)
      : context_(context), guard_(std::move(guard)) {}

  /// Does what is due at that time.
  void run_once(Time now);

 private:
  void renew_leases(Time since, Time now);
  void rescue(Time now);
  void look_at_disk(Time now);
  void retire(Time now);
  void retire_sweeps(Time now);
  void count_waiting();

  const WorkerContext& context_;
  std::optional<DiskGuard> guard_;
  Time next_renewal_{};
  Time next_rescue_{};
  Time next_retirement_{};
};

/// Runs the upkeep every second on a thread of its own for as long as it exists.
class UpkeepThread {
 public:
  UpkeepThread(Upkeep& upkeep, const Environment& environment);

 private:
  std::jthread thread_;
};

/// One log line a job that was taken back.
void log_recovery(Log& log, const Recovery& recovery, std::string_view why);

}  // namespace snapthrough::server
