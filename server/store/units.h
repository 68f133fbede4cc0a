#pragma once
/// @file
/// Decisions of drivers about units of sweeps, their rows, and work during which processes died.

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "server/jobs/sweep.h"

namespace snapthrough::server {

/// A sweep in the store: number of its row, state.
struct StoredSweep {
  std::int64_t row = 0;
  JobState state = JobState::accepted;
};

/// Units that a worker holds or held.
struct HeldUnits {
  std::int64_t sweep = 0;  ///< number of its row
  UnitRun units;
  std::int64_t crashes = 0;  ///< processes that died while they worked on these units
  std::int64_t unit_points = 1;

  [[nodiscard]] std::int64_t first_point() const {
    return static_cast<std::int64_t>(units.first) * unit_points;
  }
  [[nodiscard]] std::int64_t points() const { return static_cast<std::int64_t>(units.count) * unit_points; }
};

/// What rows add to the counts of their sweep.
struct RowCounts {
  std::int64_t successful = 0;
  std::int64_t failed = 0;
  std::int64_t reused = 0;  ///< successful rows that were taken from another sweep
  std::int64_t bytes = 0;   ///< bytes of outputs, codes and details

  void add(const PointRow& row);
};

/// Adds a unit to runs in order. @pre the unit comes after all of them
void add_unit(std::vector<UnitRun>& runs, std::uint64_t unit);
/// The units of a claim without rows, in order. @param rows all points of some of its units
[[nodiscard]] std::vector<UnitRun> units_without_rows(const UnitRun& claim, const std::vector<PointRow>& rows,
                                                      std::int64_t unit_points);

/// First point of a query and the one after its last, within the range of a 64-bit integer with sign.
[[nodiscard]] std::pair<std::int64_t, std::int64_t> points_of(const PointQuery& query);

/// @brief Largest claim of units during which a process has died that often. Each death makes it 64 times
/// smaller, so that one harmful unit of thousands is found with three deaths.
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
/// Decides about units as lost_job() does about a job, and counts the crash in `held`. Several units are not
/// given up: any of them may be the cause.
[[nodiscard]] LostLease lost_units(std::string_view holder, std::string_view rescuer, int max_crashes,
                                   HeldUnits& held);

/// The detail of the failure "crashed". @param what "job" or "point"
[[nodiscard]] std::string crashed_detail(std::int64_t crashes, std::string_view what);
/// The rows of units that are given up.
[[nodiscard]] std::vector<PointRow> crashed_rows(const HeldUnits& held);

}  // namespace snapthrough::server
