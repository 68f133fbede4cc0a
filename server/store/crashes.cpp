#include "server/store/crashes.h"

#include <algorithm>

namespace snapthrough::server {

std::uint64_t most_after_crashes(std::uint64_t most, std::int64_t crashes) {
  constexpr std::int64_t kHalvings = 6;
  return std::max<std::uint64_t>(1, most >> std::min<std::int64_t>(63, kHalvings * crashes));
}

LostLease lost_job(std::string_view holder, std::string_view rescuer, std::int64_t crashes, int max_crashes) {
  const bool crashed = rescuer.empty() || holder != rescuer;
  return {crashed, crashed && crashes + 1 >= max_crashes};
}

LostLease lost_items(std::string_view holder, std::string_view rescuer, int max_crashes, HeldItems& held) {
  const bool crashed = rescuer.empty() || holder != rescuer;
  held.crashes += crashed ? 1 : 0;
  return {crashed, crashed && held.crashes >= max_crashes && held.items.count == 1};
}

std::string crashed_detail(std::int64_t crashes, std::string_view what) {
  return "the service died " + std::to_string(crashes) + " times while it worked on this " +
         std::string(what) + "; it is not tried again";
}

std::vector<PointRow> crashed_rows(const HeldItems& held) {
  const std::string detail = crashed_detail(held.crashes, "point");
  std::vector<PointRow> rows;
  const auto first = static_cast<std::uint64_t>(held.first_point());
  for (std::uint64_t point = first; point < first + static_cast<std::uint64_t>(held.points()); ++point) {
    rows.push_back({point, {"", "crashed", detail}});
  }
  return rows;
}

}  // namespace snapthrough::server
