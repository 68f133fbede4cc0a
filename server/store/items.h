#pragma once
/// @file
/// Items of sweeps and counts of their rows, for drivers of stores.

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

/// Items that a worker holds or held.
struct HeldItems {
  std::int64_t sweep = 0;  ///< number of its row
  ItemRun items;
  std::int64_t crashes = 0;  ///< processes that died while they worked on these items
  std::int64_t item_points = 1;

  [[nodiscard]] std::int64_t first_point() const {
    return static_cast<std::int64_t>(items.first) * item_points;
  }
  [[nodiscard]] std::int64_t points() const { return static_cast<std::int64_t>(items.count) * item_points; }
};

/// Increments of a sweep's stored counters by rows that are added to it.
struct RowCounts {
  std::int64_t successful = 0;
  std::int64_t failed = 0;
  std::int64_t reused = 0;  ///< successful rows that were taken from another sweep
  std::int64_t bytes = 0;   ///< bytes of outputs, codes and details

  void add(const PointRow& row);
};

/// Adds an item to ascending runs of items. @pre its number is greater than those in the runs
void add_item(std::vector<ItemRun>& runs, std::uint64_t item);

/// Points of consecutive items that have a row. An item is done when each of its points has a row.
class ItemRows {
 public:
  ItemRows(const ItemRun& items, std::int64_t item_points);
  /// Notes that the point has a row. Points of other items are ignored.
  void add(std::uint64_t point);
  /// Whether the item is done. @pre it is one of the items
  [[nodiscard]] bool done(std::uint64_t item) const;
  /// The items that are not done, in order.
  [[nodiscard]] std::vector<ItemRun> left() const;

 private:
  ItemRun items_;
  std::uint64_t item_points_;
  std::vector<bool> has_row_;
};

/// @brief Joins runs of items that are near to each other; the items between them have rows. Many failures
/// that lie apart are then tried again with few claims. A claim costs as much as reading the rows of about a
/// thousand items.
/// @param runs in order
[[nodiscard]] std::vector<ItemRun> joined(const std::vector<ItemRun>& runs);

/// First point of a query and the one after its last, within the range of a 64-bit integer with sign.
[[nodiscard]] std::pair<std::int64_t, std::int64_t> points_of(const PointQuery& query);

}  // namespace snapthrough::server
