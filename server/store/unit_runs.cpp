#include "server/store/unit_runs.h"

#include <algorithm>

namespace snapthrough::server {

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

std::uint64_t most_after_crashes(std::uint64_t most, std::int64_t crashes) {
  constexpr std::int64_t kHalvings = 6;
  return std::max<std::uint64_t>(1, most >> std::min<std::int64_t>(63, kHalvings * crashes));
}

bool is_given_up(const UnitRun& claim, std::int64_t crashes, int max_crashes) {
  return crashes >= max_crashes && claim.count == 1;
}

std::string crashed_detail(std::int64_t crashes, std::string_view what) {
  return "the service died " + std::to_string(crashes) + " times while it worked on this " +
         std::string(what) + "; it is not tried again";
}

std::vector<PointRow> crashed_rows(const UnitRun& units, std::int64_t unit_points, std::int64_t crashes) {
  const auto size = static_cast<std::uint64_t>(unit_points);
  const std::string detail = crashed_detail(crashes, "point");
  std::vector<PointRow> rows;
  for (std::uint64_t point = units.first * size; point < (units.first + units.count) * size; ++point) {
    rows.push_back({point, {"", "crashed", detail}});
  }
  return rows;
}

}  // namespace snapthrough::server
