#pragma once
/// @file
/// Some points of a sweep, worked on by one thread.

#include "server/jobs/worker_context.h"
#include "server/worker/runner.h"

namespace snapthrough::server {

/// @brief Computes the points of a chunk and stores their rows.
///
/// Points of the same content that were solved before are not solved again. A point that fails is a row like
/// the others. It ends early when jobs wait, when it takes long, or when the service stops: what was not
/// computed is given out again. While the store can't be written, the rows are kept and tried again.
void work_on(const Chunk& chunk, const WorkerContext& context, Runner& runner, const std::stop_token& stop);

}  // namespace snapthrough::server
