#pragma once
/// @file
/// What becomes of work during which processes died, for drivers of stores.

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "server/jobs/sweep.h"

namespace snapthrough::server {

/// @brief How many units a claim has at most, of units during which a process has died that often: each death
/// makes it 64 times smaller, so that one unit of thousands is found with three.
[[nodiscard]] std::uint64_t most_after_crashes(std::uint64_t most, std::int64_t crashes);

/// Whether a claim during which a process has died, its units' `crashes`-th time, is not tried again: often
/// enough, and it can't have been another unit's fault.
[[nodiscard]] bool is_given_up(const UnitRun& claim, std::int64_t crashes, int max_crashes);

/// The detail of the code "crashed". @param what the "job" or "point"
[[nodiscard]] std::string crashed_detail(std::int64_t crashes, std::string_view what);

/// Rows of units that are given up.
[[nodiscard]] std::vector<PointRow> crashed_rows(const UnitRun& units, std::int64_t unit_points,
                                                 std::int64_t crashes);

}  // namespace snapthrough::server
