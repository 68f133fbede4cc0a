#pragma once
/// @file
/// A runner in this process, without limits, for tests with their own solver and for the inside of a runner
/// process.

#include <memory>
#include <utility>

#include "server/worker/sweep_item.h"

namespace snapthrough::server {

/// Computes with a function on the calling thread.
class LocalRunner final : public Runner {
 public:
  explicit LocalRunner(SolveFunction solve) : solve_(std::move(solve)) {}
  [[nodiscard]] JobRun run_job(std::string_view request, const Hooks& hooks) override {
    return solve_job(request, solve_, hooks);
  }
  WorkUsage run_items(const ItemTask& task) override { return compute_items(task, solve_); }

 private:
  const SolveFunction solve_;
};

/// Returns a factory that creates a runner in this process for each worker.
[[nodiscard]] inline RunnerFactory local_runners(SolveFunction solve) {
  return [solve = std::move(solve)] { return std::make_unique<LocalRunner>(solve); };
}

}  // namespace snapthrough::server
