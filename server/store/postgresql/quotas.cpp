#include "server/store/postgresql/parts.h"

namespace snapthrough::server::postgresql {

Status admit(Connection& connection, std::string_view owner, const Quotas& quotas, const Usage& addition,
             const std::optional<std::int64_t>& now) {
  if (!quotas.any()) {
    return {};
  }
  connection.run("SELECT pg_advisory_xact_lock(hashtextextended($1, 2))", Parameters().add(owner));
  // Jobs are counted up to the quota.
  static const std::string kSql =
      "SELECT (SELECT count(*) FROM (SELECT FROM jobs WHERE owner = $1 AND " + may(JobEvent::claim) +
      " LIMIT $2) AS few),"
      " (SELECT coalesce(sum(points - (SELECT sum(successful + failed) FROM sweep_counts WHERE sweep = "
      "seq)), 0)"
      "   FROM sweeps WHERE owner = $1 AND " +
      may(SweepEvent::dismiss) +
      " AND NOT removed)::bigint,"
      " (SELECT coalesce(sum(bytes), 0) FROM owner_bytes WHERE owner = $1)::bigint,"
      " (SELECT coalesce(sum(points), 0) FROM owner_points WHERE owner = $1"
      "   AND minute > coalesce($3, snapthrough_now()) / 60000000 - 60)::bigint";
  const Rows rows = connection.run(kSql, Parameters().add(owner).add(quotas.jobs_waiting).add(now));
  const Usage has{rows[0].integer(0), rows[0].integer(1), rows[0].integer(2), rows[0].integer(3)};
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
