#include "server/store/ledger_rows.h"
#include "server/store/postgresql/parts.h"

namespace snapthrough::server::postgresql {

Balance balance_of(Connection& connection, std::string_view owner, std::int64_t most_jobs,
                   const std::optional<std::int64_t>& now) {
  static const std::string kSql =
      "SELECT (SELECT count(*) FROM (SELECT FROM jobs WHERE owner = $1 AND " + may(JobEvent::claim) +
      " LIMIT $2) AS few),"
      " (SELECT coalesce(sum(points - (SELECT sum(successful + failed) FROM sweep_counts WHERE sweep = "
      "seq)), 0)"
      "   FROM sweeps WHERE owner = $1 AND " +
      may(SweepEvent::dismiss) +
      " AND NOT removed)::bigint,"
      " (SELECT coalesce(sum(bytes), 0) FROM owner_bytes WHERE owner = $1)::bigint,"
      " coalesce(sum(points), 0)::bigint, min(minute), moment"
      " FROM (SELECT coalesce($3, snapthrough_now()) AS moment) AS clock"
      " LEFT JOIN owner_points ON owner = $1 AND minute > moment / 60000000 - 60 GROUP BY moment";
  const Rows rows = connection.run(kSql, Parameters().add(owner).add(most_jobs).add(now));
  const ResultRow row = rows[0];
  return {{row.integer(0), row.integer(1), row.integer(2), row.integer(3)},
          until_more(row.optional_integer(4), row.integer(5))};
}

Status admit(Connection& connection, std::string_view owner, const Quotas& quotas, const Usage& addition,
             const std::optional<std::int64_t>& now) {
  if (!quotas.any()) {
    return {};
  }
  connection.run("SELECT pg_advisory_xact_lock(hashtextextended($1, 2))", Parameters().add(owner));
  const Usage has = balance_of(connection, owner, quotas.jobs_waiting, now).has;
  Status status = check_quotas(quotas, has, addition);
  if (status.ok() && quotas.points_per_hour > 0 && addition.points > 0) {
    connection.run_all(std::vector<Statement>{
        {"DELETE FROM owner_points WHERE owner = $1 AND minute <= coalesce($2, snapthrough_now()) / 60000000 "
         "- 60",
         Parameters().add(owner).add(now)},
        {"INSERT INTO owner_points AS sums VALUES ($1, coalesce($3, snapthrough_now()) / 60000000, $2)"
         " ON CONFLICT (owner, minute) DO UPDATE SET points = sums.points + excluded.points",
         Parameters().add(owner).add(addition.points).add(now)}});
  }
  return status;
}

}  // namespace snapthrough::server::postgresql
