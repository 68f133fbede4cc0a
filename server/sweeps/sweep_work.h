#pragma once
/// @file
/// The work on sweeps: units are taken, looked up or computed, and the rows of their points stored.

#include <atomic>
#include <cstdint>
#include <mutex>
#include <optional>
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
#include "server/log/log.h"
#include "server/store/sweep_store.h"
#include "server/sweeps/scheduler.h"
#include "server/worker/runner.h"

namespace snapthrough::server {

/// What sweeps share with jobs.
struct SweepSurroundings {
  SweepStore& store;
  const Environment& environment;
  Log& log;
  const JobLimits& limits;
  StoreHealth& health;
  const std::atomic<std::int64_t>& waiting;  ///< jobs that wait, about
  HandoffQueue& handoffs;
  JobCompletions& completions;  ///< of sweeps, too
  JobMetrics& metrics;
  Bell& bell;
  const std::string instance;  ///< of the service: the name that leases bear
};

/// A line about a sweep that began, was stopped or removed.
void log_sweep(Log& log, std::string_view id, std::string_view status, std::string_view detail = "");

/// @brief What workers do with sweeps. Thread-safe.
class SweepWork {
 public:
  explicit SweepWork(const SweepSurroundings& surroundings) : world_(surroundings) {}

  /// @brief Works on units of the sweep that is next in turn, as many as take about a tenth of a second: a
  /// chunk. False when there are none.
  ///
  /// A unit whose points were all computed before is not computed again. A point that fails is a row like the
  /// others. A chunk ends early when jobs wait, when it takes long, or when the service stops: what was not
  /// computed is given out again. While the store can't be written, the rows are kept and tried again.
  bool do_next(Runner& runner, const std::stop_token& stop);
  /// Whether do_next() may find something.
  [[nodiscard]] bool is_left() const { return scheduler_.has_units() || unloaded_; }
  /// There is more: a worker that sleeps looks at the store, here and in other processes.
  void wake();
  /// There is more, as others know already.
  void look_again();
  /// Stops the sweep; its rows stay. Who works on it is asked to stop.
  StatusOr<SweepChange> dismiss(const std::string& id);
  /// Stops units that began before that time: they took longer than an analysis may.
  void stop_older(Time since) { scheduler_.stop_older(since); }
  /// Renews leases that are held since before that time; who works on one that was lost is asked to stop.
  void renew_leases(Time since, Time now);
  /// Takes units back whose lease has run out.
  void rescue(Time now);
  /// Sweeps that are worked on in turn.
  [[nodiscard]] std::size_t count() const { return scheduler_.count(); }
  /// Told each time that rows were stored.
  [[nodiscard]] ProgressTopic<SweepRecord>& news() { return news_; }

 private:
  void load();
  bool load_one(const std::string& id);
  std::optional<Chunk> take();
  Status settle(const Chunk& chunk, const std::vector<PointRow>& rows, double seconds);
  void stored(const SweepRecord& record, const std::vector<PointRow>& rows);

  const SweepSurroundings world_;
  SweepScheduler scheduler_;
  ProgressTopic<SweepRecord> news_;
  std::mutex loading_;
  std::atomic<bool> unloaded_ = true;  ///< the store may have sweeps that the scheduler does not have
};

}  // namespace snapthrough::server
