#pragma once
/// @file
/// One analysis on the thread that asks for it, and what is said when it can't be completed.

#include <functional>
#include <string_view>

#include "server/jobs/job.h"
#include "server/worker/runner.h"
#include "solver/solve.h"

namespace snapthrough::server {

/// What runs one analysis: snapthrough::solve, or a test's stand-in. Must be reentrant.
using SolveFunction = std::function<Result(const Model&, const Analysis&, const Hooks&)>;

/// The code of a failure where memory could not be had, and of what was asked to stop (the solver's).
inline constexpr const char* kOutOfMemory = "out_of_memory";
inline constexpr const char* kCancelled = "cancelled";

/// The exception that is being handled as a failure ("internal_error", or kOutOfMemory).
[[nodiscard]] JobFailure mishap_now();

/// @brief The outcome of one job. Whatever goes wrong is a failure. Thread-safe if `solve` is.
/// @param request document of the job, as it was handed in
[[nodiscard]] JobRun solve_job(std::string_view request, const SolveFunction& solve, const Hooks& hooks);

}  // namespace snapthrough::server
