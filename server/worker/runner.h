#pragma once
/// @file
/// What computes for a worker: a process of its own (isolated_runner.h) or this process (local_runner.h).

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <stop_token>
#include <string>
#include <string_view>
#include <vector>

#include "api/point_outcome.h"
#include "api/sweep.h"
#include "server/jobs/job.h"
#include "solver/solve.h"

namespace snapthrough::server {

/// Outcome of an attempt at a job; exactly one of `result` and `failure` is set.
struct JobRun {
  std::optional<JobResult> result;
  std::optional<JobFailure> failure;
  StoredPath reached = {};  ///< path up to the failure
  WorkUsage usage = {};
};

/// Items of a sweep (server/worker/sweep_item.h) that are computed in sequence.
struct ItemTask {
  const std::string& id;        ///< id of the sweep
  const std::string& document;  ///< document of the sweep
  const api::Sweep& sweep;
  std::span<const std::uint64_t> items;  ///< numbers of the items
  std::stop_token stop;
  /// Asked now and then whether the remaining items may wait. At least one item is computed.
  std::function<bool()> enough = {};
  /// Called with the outcomes of each item, in the order of items.
  std::function<void(std::vector<api::PointOutcome>)> tell = {};
};

/// @brief Computes jobs and items of sweeps, one at a time, on one thread. Errors are values: failures with a
/// code of the solver, "memory_limit", "crashed" or "internal_error". After a stop request, the current
/// computation ends with the code "cancelled".
class Runner {
 public:
  Runner() = default;
  Runner(const Runner&) = delete;
  Runner& operator=(const Runner&) = delete;
  Runner(Runner&&) = delete;
  Runner& operator=(Runner&&) = delete;
  virtual ~Runner() = default;

  /// @param request submitted document of the job
  [[nodiscard]] virtual JobRun run_job(std::string_view request, const Hooks& hooks) = 0;
  /// Computes items; ends early when `enough` returns true, or after "cancelled" outcomes.
  /// @return what that took; the part of a process that died is not known
  virtual WorkUsage run_items(const ItemTask& task) = 0;
  /// Lets all later tasks have a low priority, if what computes has a priority of its own.
  virtual void give_way() {}
};

/// Called once by each worker, on the worker's thread.
using RunnerFactory = std::function<std::unique_ptr<Runner>()>;

}  // namespace snapthrough::server
