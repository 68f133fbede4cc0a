#pragma once
/// @file
/// Work on sweeps: claims items, finds or computes their rows, and stores them.

#include <atomic>
#include <cstdint>
#include <mutex>
#include <optional>
#include <set>
#include <stop_token>
#include <string>
#include <string_view>
#include <vector>

#include "server/bell.h"
#include "server/environment.h"
#include "server/jobs/handoff.h"
#include "server/jobs/job_completions.h"
#include "server/jobs/job_metrics.h"
#include "server/jobs/limits.h"
#include "server/jobs/progress_topic.h"
#include "server/jobs/waiting_count.h"
#include "server/log/log.h"
#include "server/store/sweep_store.h"
#include "server/sweeps/scheduler.h"
#include "server/worker/runners.h"

namespace snapthrough::server {

/// What sweeps share with jobs. All parts are thread-safe.
struct SweepSurroundings {
  SweepStore& store;
  const Environment& environment;
  Log& log;
  const JobLimits& limits;
  StoreHealth& health;
  const WaitingCount& waiting;  ///< accepted jobs
  HandoffQueue& handoffs;
  JobCompletions& completions;  ///< ends of jobs and sweeps
  JobMetrics& metrics;
  Bell& bell;
  const std::string instance;  ///< name of this instance of the service, in leases
};

/// Logs a change of a sweep.
void log_sweep(Log& log, std::string_view id, std::string_view status, std::string_view detail = "");

/// What workers and upkeep do with sweeps. Thread-safe.
class SweepWork {
 public:
  explicit SweepWork(const SweepSurroundings& surroundings) : world_(surroundings) {}

  /// @brief Works on a chunk of the sweep that is next in turn: items that take about 0.1 s. Returns false
  /// without items.
  ///
  /// A sweep whose document this version can't read is left to workers of other versions and logged once. An
  /// item whose points were all computed before is not computed again. The row of a point that fails has an
  /// error. A chunk ends early when jobs wait, when it takes long, or when the service stops; items without
  /// rows are given out again. While the store can't be written, the chunk waits and tries to store its rows
  /// again.
  bool do_next(Runners& runners, const std::stop_token& stop, const OwnersInTurn& owners = {});
  /// Whether do_next() may find something.
  [[nodiscard]] bool is_left() const { return scheduler_.has_items() || unloaded_; }
  /// Announces new items: wakes a worker of this process and, by the bell, other processes.
  void wake();
  /// Wakes a worker of this process; other processes know of the items.
  void look_again();
  /// Dismisses the sweep and asks its workers to stop; its rows stay.
  StatusOr<SweepChange> dismiss(const std::string& id);
  /// Stops items that began before `since` (steady_time()), for the time limit.
  void stop_older(Time since) { scheduler_.stop_older(since); }
  /// @brief Renews, until `until`, leases that are held since `since` (steady_time()) or longer and have not
  /// run out at `now`; asks workers whose lease was lost to stop. @return whether the store did it
  bool renew_leases(Time since, Time until, Time now);
  /// Gives items out again whose lease has run out.
  void rescue(Time now);
  /// Number of sweeps in the scheduler.
  [[nodiscard]] std::size_t count() const { return scheduler_.count(); }
  /// News of unfinished sweeps, one each time that rows were stored.
  [[nodiscard]] ProgressTopic<SweepRecord>& news() { return news_; }

 private:
  void load();
  bool load_one(const std::string& id);
  void leave(const std::string& id, const Finding& finding);
  std::optional<Chunk> take(const OwnersInTurn& owners);
  /// Stores rows and ends the chunk. @param done items that need no more work
  Status settle(const Chunk& chunk, const std::vector<PointRow>& rows, const WorkUsage& usage,
                std::uint64_t done, double seconds);
  void stored(const SweepRecord& record, const std::vector<PointRow>& rows);

  const SweepSurroundings world_;
  SweepScheduler scheduler_;
  ProgressTopic<SweepRecord> news_;
  std::mutex loading_;
  std::set<std::string> foreign_;  ///< sweeps with items whose document this version can't read; by loading_
  std::atomic<bool> unloaded_ = true;  ///< the store may have sweeps that the scheduler does not have
};

}  // namespace snapthrough::server
