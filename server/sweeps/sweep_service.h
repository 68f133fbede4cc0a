#pragma once
/// @file
/// What a caller can do with sweeps, whatever the protocol, and where workers get units of them.

#include <atomic>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "server/environment.h"
#include "server/jobs/handoff.h"
#include "server/jobs/job_completions.h"
#include "server/jobs/job_metrics.h"
#include "server/jobs/limits.h"
#include "server/jobs/progress_topic.h"
#include "server/jobs/submission.h"
#include "server/log/log.h"
#include "server/store/sweep_store.h"
#include "server/sweeps/scheduler.h"

namespace snapthrough::server {

/// What sweeps share with jobs.
struct SweepSurroundings {
  SweepStore& store;
  const Environment& environment;
  Log& log;
  const JobLimits& limits;
  StoreHealth& health;
  HandoffQueue& handoffs;
  JobCompletions& completions;  ///< of sweeps, too
  JobMetrics& metrics;
};

/// @brief Where sweeps are handed in, asked for, and worked on. Thread-safe.
class SweepService {
 public:
  explicit SweepService(const SweepSurroundings& surroundings) : world_(surroundings) {}

  /// @brief Reads and checks a sweep document and, when nothing is wrong, stores it.
  /// The sweep is durable when this returns an id. `unavailable` when nothing can be stored at the moment.
  StatusOr<Submission> submit(const Order& order);
  /// The sweep, if there is one and it is the owner's.
  StatusOr<std::optional<SweepRecord>> get(const std::string& id, std::string_view owner);
  /// Dismisses a sweep and stops work on it; its rows stay. @pre get() found it
  StatusOr<SweepChange> dismiss(const std::string& id);
  /// Computes failed and missing points of a sweep that has ended again. `unavailable` or `stopping` when no
  /// work is taken at the moment. @pre get() found it
  StatusOr<SweepChange> retry(const std::string& id);
  /// Removes a sweep and its rows, after stopping work on it. @pre get() found it
  Status remove(const std::string& id);

  // For the workers.
  /// Units to compute, claimed; empty when there are none.
  std::optional<Chunk> take();
  /// @brief Stores what became of a chunk. @param rest units that were not computed: they are given out
  /// again
  /// @param seconds that the computed ones took
  /// `unavailable` when it could not be stored: the chunk is still the caller's then.
  Status settle(const Chunk& chunk, const std::vector<PointRow>& rows, const std::vector<std::uint64_t>& rest,
                double seconds);
  /// Whether take() may have something.
  [[nodiscard]] bool has_work() const { return scheduler_.has_units() || unloaded_; }

  [[nodiscard]] SweepStore& store() { return world_.store; }
  [[nodiscard]] SweepScheduler& scheduler() { return scheduler_; }
  [[nodiscard]] ProgressTopic<SweepRecord>& news() { return news_; }

 private:
  StatusOr<std::int64_t> unfinished();
  void load();
  bool load_one(const std::string& id);
  void stored(const SweepRecord& record, const std::vector<PointRow>& rows);
  void log_sweep(std::string_view id, std::string_view status, std::string_view detail = "");
  void wake();

  const SweepSurroundings world_;
  SweepScheduler scheduler_;
  ProgressTopic<SweepRecord> news_;
  std::mutex loading_;
  std::atomic<bool> unloaded_ = true;  ///< the store may have sweeps that the scheduler does not have
};

}  // namespace snapthrough::server
