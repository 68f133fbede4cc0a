#include "server/store/units.h"

#include <algorithm>

namespace snapthrough::server {

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

std::vector<UnitRun> units_without_rows(const UnitRun& claim, const std::vector<PointRow>& rows,
                                        std::int64_t unit_points) {
  std::vector<bool> done(claim.count);
  for (const PointRow& row : rows) {
    done.at(row.point / static_cast<std::uint64_t>(unit_points) - claim.first) = true;
  }
  std::vector<UnitRun> runs;
  for (std::size_t i = 0; i < done.size(); ++i) {
    if (!done[i]) {
      add_unit(runs, claim.first + i);
    }
  }
  return runs;
}

std::pair<std::int64_t, std::int64_t> points_of(const PointQuery& query) {
  const auto largest = static_cast<std::uint64_t>(INT64_MAX);
  const std::uint64_t first = std::min(query.first, largest);
  const std::uint64_t end = first + std::min(query.count, largest - first);
  return {static_cast<std::int64_t>(first), static_cast<std::int64_t>(end)};
}

}  // namespace snapthrough::server
