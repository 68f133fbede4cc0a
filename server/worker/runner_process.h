#pragma once
/// @file
/// The inside of a runner's process.

#include "server/worker/solve_job.h"

namespace snapthrough::server {

/// The name of the subcommand that makes a process a runner; not for users.
inline constexpr const char* kRunnerCommand = "runner";
/// How a runner ends when memory could not be had.
inline constexpr int kOutOfMemoryStatus = 77;

/// Descriptors of a runner: tasks and answers; what is wanted of the task at hand.
inline constexpr int kTaskSocket = 0;
inline constexpr int kControlPipe = 3;

/// @brief Computes what frames on kTaskSocket ask for, one after the other, until the other side is gone.
/// @param parent process that it ends with
/// @param solve  what solves jobs and points; curves are followed as SweepUnit::compute() says
/// @return exit status of the process
[[nodiscard]] int run_runner(int parent, const SolveFunction& solve);

}  // namespace snapthrough::server
