#pragma once
/// @file
/// A runner in this process, without limits, for tests with their own solver and for the inside of a runner
/// process.

#include "server/worker/runner.h"
#include "server/worker/solve_job.h"

namespace snapthrough::server {

/// Computes with a function on the calling thread.
class LocalRunner final : public Runner {
 public:
  explicit LocalRunner(SolveFunction solve) : solve_(std::move(solve)) {}
  [[nodiscard]] JobRun run_job(std::string_view request, const Hooks& hooks) override;
  void run_units(const UnitTask& task) override;

 private:
  const SolveFunction solve_;
};

/// Returns a factory that creates a runner in this process for each worker.
[[nodiscard]] RunnerFactory local_runners(SolveFunction solve);

}  // namespace snapthrough::server
