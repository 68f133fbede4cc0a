#include "server/store/sqlite/parts.h"

namespace snapthrough::server::sqlite {
namespace {

std::int64_t minute_of(Time now) {
  return std::chrono::duration_cast<std::chrono::minutes>(now.time_since_epoch()).count();
}

void add_points(Connection& connection, std::string_view owner, std::int64_t minute, std::int64_t points) {
  connection.run("DELETE FROM owner_points WHERE owner = ? AND minute <= ?", owner, minute - 60);
  connection.run(
      "INSERT INTO owner_points (owner, minute, points) VALUES (?, ?, ?)"
      " ON CONFLICT (owner, minute) DO UPDATE SET points = points + excluded.points",
      owner, minute, points);
}

}  // namespace

Usage usage_of(const Connection& connection, std::string_view owner) {
  Statement row =
      connection.query("SELECT jobs_waiting, points_waiting, bytes_kept FROM owners WHERE owner = ?", owner);
  return row.step() ? Usage{row.integer(0), row.integer(1), row.integer(2)} : Usage{};
}

HourOfPoints points_of_hour(const Connection& connection, std::string_view owner, Time now) {
  Statement row = connection.query(
      "SELECT ifnull(sum(points), 0), min(minute) FROM owner_points WHERE owner = ? AND minute > ?", owner,
      minute_of(now) - 60);
  row.step();
  return {row.integer(0), row.optional_integer(1)};
}

Status admit(Connection& connection, std::string_view owner, const Quotas& quotas, const Usage& addition,
             Time now) {
  if (!quotas.any()) {
    return {};
  }
  Usage has = usage_of(connection, owner);
  const bool by_hour = quotas.points_per_hour > 0 && addition.points > 0;
  has.points_this_hour = by_hour ? points_of_hour(connection, owner, now).points : 0;
  Status status = check_quotas(quotas, has, addition);
  if (status.ok() && by_hour) {
    add_points(connection, owner, minute_of(now), addition.points);
  }
  return status;
}

}  // namespace snapthrough::server::sqlite
