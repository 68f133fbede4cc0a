#pragma once
/// @file
/// Some units of a sweep, worked on by one thread.

#include "server/jobs/worker_context.h"
#include "server/worker/runner.h"

namespace snapthrough::server {

/// @brief Computes the units of a chunk and stores the rows of their points.
///
/// A unit whose points were all computed before is not computed again. A point that fails is a row like
/// the others. It ends early when jobs wait, when it takes long, or when the service stops: what was not
/// computed is given out again. While the store can't be written, the rows are kept and tried again.
void work_on(const Chunk& chunk, const WorkerContext& context, Runner& runner, const std::stop_token& stop);

}  // namespace snapthrough::server
