#pragma once
/// @file
/// A runner in this process: no bound holds its analyses. For tests with a solver of their own, and inside
/// the runner's own process.

#include "server/worker/point.h"
#include "server/worker/runner.h"

namespace snapthrough::server {

/// @brief The outcome of one job, solved on this thread. Whatever goes wrong is a failure.
[[nodiscard]] JobRun solve_job(std::string_view request, const SolveFunction& solve, const Hooks& hooks);

/// Computes with a function on the thread that calls it.
class LocalRunner final : public Runner {
 public:
  explicit LocalRunner(SolveFunction solve) : solve_(std::move(solve)) {}
  [[nodiscard]] JobRun run_job(std::string_view request, const Hooks& hooks) override;
  void run_points(const PointTask& task) override;
  [[nodiscard]] std::vector<api::PointOutcome> run_curve(const PointTask& task) override;

 private:
  const SolveFunction solve_;
};

/// A runner of its own for each worker, in this process.
[[nodiscard]] RunnerFactory local_runners(SolveFunction solve);

}  // namespace snapthrough::server
