#pragma once
/// @file
/// Threads that claim, solve and complete jobs and chunks of sweeps.

#include <stop_token>
#include <thread>
#include <vector>

#include "server/queue/worker_context.h"
#include "server/worker/runner.h"

namespace snapthrough::server {

/// @brief Solves a claimed job and stores the outcome.
///
/// A numerical failure or an exception fails the job. A stop of the service that interrupts the analysis
/// gives the job back to the queue. Under a lost claim nothing is stored. While the store can't be written,
/// the outcome is kept and stored later, as long as the lease holds.
void work_on(const Claim& claim, const WorkerContext& context, Runner& runner, const std::stop_token& stop);

/// Solves a job while it is being stored; stores the outcome if the job was stored.
void work_on(const Handoff& handoff, const WorkerContext& context, Runner& runner,
             const std::stop_token& stop);

/// A fixed number of working threads. Thread-safe. REQUIRES: the context outlives it.
class WorkerPool {
 public:
  /// @param make makes the runner of a thread; called once on each
  WorkerPool(int threads, const WorkerContext& context, RunnerFactory make);
  /// Calls stop().
  ~WorkerPool();
  WorkerPool(const WorkerPool&) = delete;
  WorkerPool& operator=(const WorkerPool&) = delete;
  WorkerPool(WorkerPool&&) = delete;
  WorkerPool& operator=(WorkerPool&&) = delete;

  /// Asks running analyses to stop and returns when their jobs are back in the queue. May be called again.
  void stop();

 private:
  void run(const std::stop_token& stop);
  bool claim_and_work(Runner& runner, const std::stop_token& stop);

  const WorkerContext& context_;
  RunnerFactory make_;
  std::vector<std::jthread> threads_;
};

}  // namespace snapthrough::server
