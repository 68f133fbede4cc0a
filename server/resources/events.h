#pragma once
/// @file
/// What happens to a job, as server-sent events.

#include <cstdint>
#include <memory>
#include <string>

#include "server/queue/job_service.h"
#include "server/resources/message.h"

namespace snapthrough::server::http {

/// Ids of the last events there are: `end` of a job, and of a sweep. Who has seen it need not come back.
inline constexpr std::uint64_t kEndOfJob = 2'000'000'000'000'000'000;
inline constexpr std::uint64_t kEndOfSweep = 1'000'000'000'000;

/// @brief Sends `status` at once; while the analysis runs `progress` and `points` of the path (at most 20 a
/// second each) and each `critical_point` as it is found, those that were found before among them, and what
/// is kept of the points before; when the job has ended its `critical_point` events as the result has them
/// (`final`: true) and `end`, which is the last.
///
/// Event ids grow; what a client has seen (`last_id`, from Last-Event-ID) is not sent again.
[[nodiscard]] std::shared_ptr<StreamSource> follow_job(JobService& jobs, const std::string& id,
                                                       std::uint64_t last_id, Stream::Push push);

/// @brief The same for a sweep: `status` at once, `progress` (counts) while points are computed, `end`.
[[nodiscard]] std::shared_ptr<StreamSource> follow_sweep(JobService& jobs, const std::string& id,
                                                         std::uint64_t last_id, Stream::Push push);

}  // namespace snapthrough::server::http
