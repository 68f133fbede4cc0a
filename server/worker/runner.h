#pragma once
/// @file
/// What computes for a worker: in a process of its own (child_runner.h) or in this one (local_runner.h).

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <stop_token>
#include <string>
#include <string_view>
#include <vector>

#include "api/sweep.h"
#include "server/jobs/job.h"
#include "solver/solve.h"

namespace snapthrough::server {

/// What an attempt at a job came to: exactly one of `result` and `failure` is set.
struct JobRun {
  std::optional<JobResult> result;
  std::optional<JobFailure> failure;
  StoredPath reached = {};      ///< with a failure
  std::int64_t peak_bytes = 0;  ///< most memory that it used at a time; 0: not known
};

/// Units of a sweep (server/worker/unit.h) that are computed one after the other.
struct UnitTask {
  const std::string& id;        ///< of the sweep
  const std::string& document;  ///< that `sweep` was read from
  const api::Sweep& sweep;
  std::span<const std::uint64_t> units;  ///< their numbers
  std::stop_token stop;
  /// Asked now and then: whether what is left may wait. At least one unit is computed.
  std::function<bool()> enough = {};
  /// Told the outcomes of each unit, in the order of the units.
  std::function<void(std::vector<api::PointOutcome>)> tell = {};
};

/// @brief Computes jobs and units of sweeps, one at a time. Whatever goes wrong is a value: a failure with a
/// code (of the solver's; "memory_limit", "crashed", "internal_error"). Asked to stop, what is computed ends
/// with the code "cancelled". One thread uses it.
class Runner {
 public:
  Runner() = default;
  Runner(const Runner&) = delete;
  Runner& operator=(const Runner&) = delete;
  Runner(Runner&&) = delete;
  Runner& operator=(Runner&&) = delete;
  virtual ~Runner() = default;

  /// @param request document of the job, as it was handed in
  [[nodiscard]] virtual JobRun run_job(std::string_view request, const Hooks& hooks) = 0;
  /// Ends early when it is enough, or after outcomes that were "cancelled".
  virtual void run_units(const UnitTask& task) = 0;
};

/// Called once by each worker, on its own thread.
using RunnerFactory = std::function<std::unique_ptr<Runner>()>;

}  // namespace snapthrough::server
