#pragma once
/// @file
/// Runs of units of a sweep, for drivers of stores.

#include <cstdint>
#include <vector>

#include "server/jobs/sweep.h"

namespace snapthrough::server {

/// Adds a unit to runs in order. @pre it comes after all of them
void add_unit(std::vector<UnitRun>& runs, std::uint64_t unit);

/// The units of a claim of which there are no rows, in order.
/// @param rows of all points of some of its units
/// @param unit_points points of a unit
[[nodiscard]] std::vector<UnitRun> units_without_rows(const UnitRun& claim, const std::vector<PointRow>& rows,
                                                      std::int64_t unit_points);

}  // namespace snapthrough::server
