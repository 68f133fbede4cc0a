#pragma once
/// @file
/// Worker threads, which claim, solve and complete jobs and points of sweeps.

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <shared_mutex>
#include <stop_token>
#include <thread>
#include <vector>

#include "server/queue/worker_context.h"
#include "server/worker/runners.h"

namespace snapthrough::server {

/// @brief Solves a claimed job and stores its outcome.
///
/// A numerical failure or an exception fails the job; a stop of the service requeues it. A claim that was
/// lost in the meantime changes nothing. While the store is not writable, the outcome is kept and storing is
/// repeated as long as the lease may hold.
void work_on(const Claim& claim, const WorkerContext& context, Runners& runners, const std::stop_token& stop);

/// Solves a job that is still being stored, and stores its outcome.
void work_on(const Handoff& handoff, const WorkerContext& context, Runners& runners,
             const std::stop_token& stop);

/// @brief A fixed number of worker threads, and spare ones. Thread-safe; the constructor's arguments must
/// outlive the object.
///
/// While all workers have been busy for JobLimits::spare_after, spare ones work for owners for whom nothing
/// of the kind (jobs, sweeps) runs: the long work of some owners does not stop the others. While half of the
/// spare workers are at work that has taken longer than kShort, none of them begins the work of an owner who
/// uses much processor time. A spare worker has a runner from its first work on.
class WorkerPool {
 public:
  /// @param make makes the runner of a thread; called once on each
  WorkerPool(int threads, const WorkerContext& context, RunnerFactory make);
  /// Calls stop() if necessary.
  ~WorkerPool();
  WorkerPool(const WorkerPool&) = delete;
  WorkerPool& operator=(const WorkerPool&) = delete;
  WorkerPool(WorkerPool&&) = delete;
  WorkerPool& operator=(WorkerPool&&) = delete;

  /// Stops running analyses, and returns when their jobs are requeued. May be called repeatedly.
  void stop();

 private:
  void run(std::size_t number, const std::stop_token& stop);
  void run_spare(std::size_t number, const std::stop_token& stop);
  [[nodiscard]] bool are_few_spares_at_long_work() const;
  void wait_as_spare(std::uint64_t& seen, const std::stop_token& stop);
  [[nodiscard]] bool is_left() const;
  bool claim_and_work(Runners& runners, const std::stop_token& stop, const OwnersInTurn& owners = {});
  [[nodiscard]] bool are_busy() const;
  [[nodiscard]] double now() const { return context_.environment.monotonic_seconds(); }

  const WorkerContext& context_;
  RunnerFactory make_;
  /// Second of the monotonic clock since which each worker has been busy; infinite: it waits for work.
  std::vector<std::atomic<double>> busy_since_;
  /// Second of the monotonic clock at which each spare worker began its present work; infinite: it waits for
  /// work.
  std::vector<std::atomic<double>> spare_began_;
  RecentUse use_;       ///< processor time that computing for each owner took
  std::mutex on_duty_;  ///< one spare worker at a time looks for work
  /// Once stop() has set it, no claim begins; those under way hold `claims_`. So none takes what another
  /// gives back when the pool stops.
  std::atomic<bool> stopping_ = false;
  std::shared_mutex claims_;
  std::stop_source stop_;  ///< one for all threads
  std::vector<std::jthread> threads_;
};

}  // namespace snapthrough::server
