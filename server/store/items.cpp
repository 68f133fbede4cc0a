#include "server/store/items.h"

#include <algorithm>

namespace snapthrough::server {
namespace {

/// Largest number of items with rows between two runs that are joined.
constexpr std::uint64_t kLargestGap = 1024;

}  // namespace

void RowCounts::add(const PointRow& row) {
  (row.outcome.failed() ? failed : successful) += 1;
  reused += row.reused ? 1 : 0;
  bytes += static_cast<std::int64_t>(row.outcome.outputs.size() + row.outcome.code.size() +
                                     row.outcome.detail.size());
}

void add_item(std::vector<ItemRun>& runs, std::uint64_t item) {
  if (!runs.empty() && runs.back().first + runs.back().count == item) {
    ++runs.back().count;
  } else {
    runs.push_back({item, 1});
  }
}

ItemRows::ItemRows(const ItemRun& items, std::int64_t item_points)
    : items_(items),
      item_points_(static_cast<std::uint64_t>(item_points)),
      has_row_(items.count * item_points_) {}

void ItemRows::add(std::uint64_t point) {
  const std::uint64_t first = items_.first * item_points_;
  if (point >= first && point - first < has_row_.size()) {
    has_row_[point - first] = true;
  }
}

bool ItemRows::done(std::uint64_t item) const {
  const auto begin = has_row_.begin() + static_cast<std::ptrdiff_t>((item - items_.first) * item_points_);
  const auto end = begin + static_cast<std::ptrdiff_t>(item_points_);
  return std::find(begin, end, false) == end;
}

std::vector<ItemRun> ItemRows::left() const {
  std::vector<ItemRun> runs;
  for (std::uint64_t item = items_.first; item < items_.first + items_.count; ++item) {
    if (!done(item)) {
      add_item(runs, item);
    }
  }
  return runs;
}

std::vector<ItemRun> joined(const std::vector<ItemRun>& runs) {
  std::vector<ItemRun> all;
  for (const ItemRun& run : runs) {
    if (!all.empty() && run.first - (all.back().first + all.back().count) <= kLargestGap) {
      all.back().count = run.first + run.count - all.back().first;
    } else {
      all.push_back(run);
    }
  }
  return all;
}

std::pair<std::int64_t, std::int64_t> points_of(const PointQuery& query) {
  const auto largest = static_cast<std::uint64_t>(INT64_MAX);
  const std::uint64_t first = std::min(query.first, largest);
  const std::uint64_t end = first + std::min(query.count, largest - first);
  return {static_cast<std::int64_t>(first), static_cast<std::int64_t>(end)};
}

}  // namespace snapthrough::server
