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

std::uint64_t most_after_crashes(std::uint64_t most, std::int64_t crashes) {
  constexpr std::int64_t kHalvings = 6;
  return std::max<std::uint64_t>(1, most >> std::min<std::int64_t>(63, kHalvings * crashes));
}

LostLease lost_job(std::string_view holder, std::string_view rescuer, std::int64_t crashes, int max_crashes) {
  const bool crashed = rescuer.empty() || holder != rescuer;
  return {crashed, crashed && crashes + 1 >= max_crashes};
}

LostLease lost_units(std::string_view holder, std::string_view rescuer, int max_crashes, HeldUnits& held) {
  const bool crashed = rescuer.empty() || holder != rescuer;
  held.crashes += crashed ? 1 : 0;
  return {crashed, crashed && held.crashes >= max_crashes && held.units.count == 1};
}

std::string crashed_detail(std::int64_t crashes, std::string_view what) {
  return "the service died " + std::to_string(crashes) + " times while it worked on this " +
         std::string(what) + "; it is not tried again";
}

std::vector<PointRow> crashed_rows(const HeldUnits& held) {
  const std::string detail = crashed_detail(held.crashes, "point");
  std::vector<PointRow> rows;
  const auto first = static_cast<std::uint64_t>(held.first_point());
  for (std::uint64_t point = first; point < first + static_cast<std::uint64_t>(held.points()); ++point) {
    rows.push_back({point, {"", "crashed", detail}});
  }
  return rows;
}

}  // namespace snapthrough::server
