#pragma once
/// @file
/// The threads that claim, solve and complete jobs and points of sweeps.

#include <stop_token>
#include <thread>
#include <vector>

#include "server/queue/worker_context.h"
#include "server/worker/runner.h"

namespace snapthrough::server {

/// @brief Works on one claimed job to its end and stores the outcome.
///
/// A numerical failure or an exception makes the job failed; a stop of the service that interrupts the
/// analysis gives the job back to the queue. A claim that was lost meanwhile changes nothing. While the store
/// can't be written, the outcome is kept and tried again as long as the lease may hold.
void work_on(const Claim& claim, const WorkerContext& context, Runner& runner, const std::stop_token& stop);

/// The same for a job that is still being stored.
void work_on(const Handoff& handoff, const WorkerContext& context, Runner& runner,
             const std::stop_token& stop);

/// @brief A fixed number of working threads. Thread-safe; the parts it is given must outlive it.
class WorkerPool {
 public:
  /// @param make called once on each thread
  WorkerPool(int threads, const WorkerContext& context, RunnerFactory make);
  /// Stops first if need be.
  ~WorkerPool();
  WorkerPool(const WorkerPool&) = delete;
  WorkerPool& operator=(const WorkerPool&) = delete;
  WorkerPool(WorkerPool&&) = delete;
  WorkerPool& operator=(WorkerPool&&) = delete;

  /// Asks running analyses to stop, and returns when their jobs are back in the queue. Repeatable.
  void stop();

 private:
  void run(const std::stop_token& stop);
  bool claim_and_work(Runner& runner, const std::stop_token& stop);

  const WorkerContext& context_;
  RunnerFactory make_;
  std::vector<std::jthread> threads_;
};

}  // namespace snapthrough::server
