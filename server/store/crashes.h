#pragma once
/// @file
/// Decisions of drivers of stores about work during which processes died.

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "server/store/items.h"

namespace snapthrough::server {

/// @brief Largest claim of items during which a process has died that often. Each death makes it 64 times
/// smaller, so that one harmful item of thousands is found with three deaths.
[[nodiscard]] std::uint64_t most_after_crashes(std::uint64_t most, std::int64_t crashes);

/// Fate of work whose lease has run out. A worker that rescues its own lease is alive, only slow: that is no
/// crash.
struct LostLease {
  bool crashed = false;  ///< the process that held the lease counts as dead
  bool given_up = false;
};
/// @param holder the worker that held the lease
/// @param rescuer the worker that takes the work back; empty: every holder is known to be dead
/// @param crashes earlier crashes of the job
[[nodiscard]] LostLease lost_job(std::string_view holder, std::string_view rescuer, std::int64_t crashes,
                                 int max_crashes);
/// Decides about items as lost_job() does about a job, and counts the crash in `held`. Several items are not
/// given up: any of them may be the cause.
[[nodiscard]] LostLease lost_items(std::string_view holder, std::string_view rescuer, int max_crashes,
                                   HeldItems& held);

/// The detail of the failure "crashed". @param what "job" or "point"
[[nodiscard]] std::string crashed_detail(std::int64_t crashes, std::string_view what);
/// The rows of items that are given up.
[[nodiscard]] std::vector<PointRow> crashed_rows(const HeldItems& held);

}  // namespace snapthrough::server
