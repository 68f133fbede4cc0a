#pragma once
/// @file
/// Server-sent events about a job or a sweep.

#include <cstdint>
#include <memory>
#include <string>

#include "server/queue/job_service.h"
#include "server/resources/message.h"

namespace snapthrough::server::http {

/// Ids of the last event, `end`, of a job and of a sweep. A client that received it need not reconnect.
inline constexpr std::uint64_t kEndOfJob = 2'000'000'000'000'000'000;
inline constexpr std::uint64_t kEndOfSweep = 1'000'000'000'000;

/// @brief Streams the events of a job. `status` comes at once. While the analysis runs: `progress` and
/// `points` of the path (at most 20 a second each, older points as far as kept), and `critical_point` for
/// each one found, earlier ones included. At the end: `critical_point` events as in the result (`final`:
/// true), then `end`, the last event.
///
/// Event ids increase; events up to `last_id` (from Last-Event-ID) are not repeated.
[[nodiscard]] std::shared_ptr<StreamSource> follow_job(JobService& jobs, const std::string& id,
                                                       std::uint64_t last_id, Stream::Push push);

/// @brief Streams the events of a sweep: `status` at once, `progress` (counts) during computation, `end`.
[[nodiscard]] std::shared_ptr<StreamSource> follow_sweep(JobService& jobs, const std::string& id,
                                                         std::uint64_t last_id, Stream::Push push);

}  // namespace snapthrough::server::http
