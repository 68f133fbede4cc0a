#pragma once
/// @file
/// Runs an analysis so that whatever goes wrong in it is a value.

#include <cstdint>
#include <functional>
#include <limits>
#include <optional>

#include "server/jobs/job.h"

namespace snapthrough::server {

/// For analyses that may take what there is.
inline constexpr std::int64_t kNoMemoryLimit = std::numeric_limits<std::int64_t>::max();

/// How a run went.
struct BoundedRun {
  std::optional<JobFailure> mishap;  ///< empty when it returned
  std::int64_t peak_bytes = 0;       ///< the most memory it used at a time
};

/// @brief Calls `analyse` on this thread. A mishap is an exception ("internal_error"), memory beyond the
/// limit
/// ("memory_limit"), or beyond what the service has ("out_of_memory").
/// @param memory bytes, > 0
[[nodiscard]] BoundedRun run_bounded(std::int64_t memory, const std::function<void()>& analyse);

}  // namespace snapthrough::server
