#pragma once
/// @file
/// Solves a job on the calling thread; failures are values.

#include <functional>
#include <string_view>

#include "server/jobs/job.h"
#include "server/worker/runner.h"
#include "solver/solve.h"

namespace snapthrough::server {

/// Runs an analysis: snapthrough::solve, or a replacement in tests. Must be reentrant.
using SolveFunction = std::function<Result(const Model&, const Analysis&, const Hooks&)>;

/// Failure codes of a failed allocation, and of a stop request (same as the solver's).
inline constexpr const char* kOutOfMemory = "out_of_memory";
inline constexpr const char* kCancelled = "cancelled";

/// Returns the current exception as a failure ("internal_error", or kOutOfMemory).
[[nodiscard]] JobFailure mishap_now();

/// @brief Returns the outcome of a job. All errors become failures. Thread-safe if `solve` is.
/// @param request submitted document of the job
[[nodiscard]] JobRun solve_job(std::string_view request, const SolveFunction& solve, const Hooks& hooks);

}  // namespace snapthrough::server
