#pragma once
/// @file
/// Units of sweeps and counts of their rows, for drivers of stores.

#include <cstdint>
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

/// Increments of a sweep's stored counters by rows that are added to it.
struct RowCounts {
  std::int64_t successful = 0;
  std::int64_t failed = 0;
  std::int64_t reused = 0;  ///< successful rows that were taken from another sweep
  std::int64_t bytes = 0;   ///< bytes of outputs, codes and details

  void add(const PointRow& row);
};

/// Adds a unit to runs in order. @pre the unit comes after all of them
void add_unit(std::vector<UnitRun>& runs, std::uint64_t unit);

/// Points of consecutive units that have a row. A unit is done when each of its points has a row.
class UnitRows {
 public:
  UnitRows(const UnitRun& units, std::int64_t unit_points);
  /// Notes that the point has a row. Points of other units are ignored.
  void add(std::uint64_t point);
  /// Whether the unit is done. @pre it is one of the units
  [[nodiscard]] bool done(std::uint64_t unit) const;
  /// The units that are not done, in order.
  [[nodiscard]] std::vector<UnitRun> left() const;

 private:
  UnitRun units_;
  std::uint64_t unit_points_;
  std::vector<bool> has_row_;
};

/// @brief Joins runs of units that are near to each other; the units between them have rows. Many failures
/// that lie apart are then tried again with few claims. A claim costs as much as reading the rows of about a
/// thousand units.
/// @param runs in order
[[nodiscard]] std::vector<UnitRun> joined(const std::vector<UnitRun>& runs);

/// First point of a query and the one after its last, within the range of a 64-bit integer with sign.
[[nodiscard]] std::pair<std::int64_t, std::int64_t> points_of(const PointQuery& query);

}  // namespace snapthrough::server
