#include "server/store/postgresql/quotas.h"

namespace snapthrough::server::postgresql {

Status check_quotas(Connection& connection, std::string_view owner, const Quotas& quotas,
                    const Usage& addition) {
  if (!quotas.any()) {
    return {};
  }
  connection.run("SELECT pg_advisory_xact_lock(hashtextextended($1, 2))", Parameters().add(owner));
  // Jobs are counted no further than matters.
  static constexpr std::string_view kSql =
      "SELECT (SELECT count(*) FROM (SELECT FROM jobs WHERE owner = $1 AND status = 'accepted' LIMIT $2) AS "
      "few),"
      " (SELECT coalesce(sum(points - (SELECT sum(successful + failed) FROM sweep_counts WHERE sweep = "
      "seq)), 0)"
      "   FROM sweeps WHERE owner = $1 AND status IN ('accepted', 'running') AND NOT removed)::bigint,"
      " (SELECT coalesce(sum(bytes), 0) FROM owner_bytes WHERE owner = $1)::bigint";
  const Rows rows = connection.run(kSql, Parameters().add(owner).add(quotas.jobs_waiting));
  const Usage has{rows.integer(0, 0), rows.integer(0, 1), rows.integer(0, 2)};
  return server::check_quotas(quotas, has, addition);
}

}  // namespace snapthrough::server::postgresql
