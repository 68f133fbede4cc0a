#pragma once
/// @file
/// Main function of a runner process.

#include "server/worker/solve_job.h"

namespace snapthrough::server {

/// Internal subcommand that starts a runner process.
inline constexpr const char* kRunnerCommand = "runner";
/// Exit status of a runner without memory.
inline constexpr int kOutOfMemoryStatus = 77;

/// Descriptors of a runner: socket for tasks and answers; pipe for requests about the current task.
inline constexpr int kTaskSocket = 0;
inline constexpr int kControlPipe = 3;

/// @brief Computes the tasks of frames from kTaskSocket in sequence, until the service disconnects.
/// @param parent process with which the runner ends
/// @param solve solves jobs and points; SweepItem::compute() follows curves
/// @return exit status of the process
[[nodiscard]] int run_runner(int parent, const SolveFunction& solve);

}  // namespace snapthrough::server
