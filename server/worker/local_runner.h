#pragma once
/// @file
/// A runner in this process: no bound holds its analyses. For tests with a solver of their own, and inside
/// the runner's own process.

#include "server/worker/runner.h"
#include "server/worker/solve_job.h"

namespace snapthrough::server {

/// Computes with a function on the thread that calls it.
class LocalRunner final : public Runner {
 public:
  explicit LocalRunner(SolveFunction solve) : solve_(std::move(solve)) {}
  [[nodiscard]] JobRun run_job(std::string_view request, const Hooks& hooks) override;
  void run_units(const UnitTask& task) override;

 private:
  const SolveFunction solve_;
};

/// A runner of its own for each worker, in this process.
[[nodiscard]] RunnerFactory local_runners(SolveFunction solve);

}  // namespace snapthrough::server
