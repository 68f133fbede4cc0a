#include "server/store/crashes.h"

#include <algorithm>

namespace snapthrough::server {

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
