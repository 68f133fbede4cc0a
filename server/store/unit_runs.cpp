#include "server/store/unit_runs.h"

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

}  // namespace snapthrough::server
