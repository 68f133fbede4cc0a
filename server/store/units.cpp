#include "server/store/units.h"

#include <algorithm>

namespace snapthrough::server {
namespace {

/// Largest number of units with rows between two runs that are joined.
constexpr std::uint64_t kLargestGap = 1024;

}  // namespace

void RowCounts::add(const PointRow& row) {
  (row.outcome.failed() ? failed : successful) += 1;
  reused += row.reused ? 1 : 0;
  bytes += static_cast<std::int64_t>(row.outcome.outputs.size() + row.outcome.code.size() +
                                     row.outcome.detail.size());
}

void add_unit(std::vector<UnitRun>& runs, std::uint64_t unit) {
  if (!runs.empty() && runs.back().first + runs.back().count == unit) {
    ++runs.back().count;
  } else {
    runs.push_back({unit, 1});
  }
}

UnitRows::UnitRows(const UnitRun& units, std::int64_t unit_points)
    : units_(units),
      unit_points_(static_cast<std::uint64_t>(unit_points)),
      has_row_(units.count * unit_points_) {}

void UnitRows::add(std::uint64_t point) {
  const std::uint64_t first = units_.first * unit_points_;
  if (point >= first && point - first < has_row_.size()) {
    has_row_[point - first] = true;
  }
}

bool UnitRows::done(std::uint64_t unit) const {
  const auto begin = has_row_.begin() + static_cast<std::ptrdiff_t>((unit - units_.first) * unit_points_);
  const auto end = begin + static_cast<std::ptrdiff_t>(unit_points_);
  return std::find(begin, end, false) == end;
}

std::vector<UnitRun> UnitRows::left() const {
  std::vector<UnitRun> runs;
  for (std::uint64_t unit = units_.first; unit < units_.first + units_.count; ++unit) {
    if (!done(unit)) {
      add_unit(runs, unit);
    }
  }
  return runs;
}

std::vector<UnitRun> joined(const std::vector<UnitRun>& runs) {
  std::vector<UnitRun> all;
  for (const UnitRun& run : runs) {
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
