#include "server/store/postgresql/list.h"

#include <algorithm>
#include <cstdint>

namespace snapthrough::server::postgresql {
namespace {

/// The first rows of one status in order.
std::string run_sql(const ListedTable& table, const ListQuery& query, JobState state) {
  std::string sql = "(SELECT seq, created_us FROM " + std::string(table.name);
  sql += " WHERE owner = $1 AND status = " + literal(state) + table.condition;
  sql += " AND created_us > $2 AND (created_us, seq) < ($3, $4)";
  sql += query.label ? " AND label = $6" : "";
  sql += query.analysis ? " AND analysis_type = $7" : "";
  return sql + " ORDER BY created_us DESC, seq DESC LIMIT $5)";
}

}  // namespace

Rows list_rows(Connection& connection, const ListedTable& table, const ListQuery& query) {
  std::string runs;
  for (const JobState state : kJobStates) {
    if (!query.state || *query.state == state) {
      runs += (runs.empty() ? "" : " UNION ALL ") + run_sql(table, query, state);
    }
  }
  const std::string name = table.name;
  const std::string sql = "SELECT " + std::string(table.columns) + ", " + name + ".created_us, " + name +
                          ".seq FROM (SELECT seq FROM (" + runs +
                          ") AS run ORDER BY created_us DESC, seq DESC LIMIT $5) AS page JOIN " + name +
                          " ON " + name + ".seq = page.seq ORDER BY " + name + ".created_us DESC, " + name +
                          ".seq DESC";
  using Place = std::pair<std::int64_t, std::int64_t>;
  const auto micro = [](Time time) { return std::int64_t{time.time_since_epoch().count()}; };
  const Place last =
      query.before ? Place(micro(query.before->created), query.before->number) : Place(INT64_MAX, INT64_MAX);
  const Place end =
      query.created_before ? std::min(last, Place(micro(*query.created_before), INT64_MIN)) : last;
  Parameters bounds;
  bounds.add(query.owner).add(query.created_after ? micro(*query.created_after) : INT64_MIN);
  bounds.add(end.first).add(end.second);
  bounds.add(query.limit + 1);  // one more, to see whether another page follows
  if (query.label) {
    bounds.add_bytes(*query.label);
  } else {
    bounds.add_bytes_or_null("");
  }
  bounds.add(query.analysis);
  return connection.run(sql, bounds);
}

}  // namespace snapthrough::server::postgresql
