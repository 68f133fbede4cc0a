#include "server/store/sqlite/list.h"

#include <algorithm>
#include <cstdint>

namespace snapthrough::server::sqlite {
namespace {

/// Rows of one status in order.
std::string run_sql(const ListedTable& table, const ListQuery& query, JobState state) {
  std::string sql = "SELECT " + std::string(table.columns) + ", created_us, seq FROM " + table.name;
  sql += " WHERE owner = ?1 AND status = " + literal(state) + table.condition;
  sql += " AND created_us > ?2 AND (created_us, seq) < (?3, ?4)";
  sql += query.label ? " AND label = ?6" : "";
  sql += query.analysis ? " AND analysis_type = ?7" : "";
  return sql;
}

}  // namespace

std::string list_sql(const ListedTable& table, const ListQuery& query) {
  std::string sql;
  for (const JobState state : kJobStates) {
    if (!query.state || *query.state == state) {
      sql += (sql.empty() ? "" : " UNION ALL ") + run_sql(table, query, state);
    }
  }
  return sql + " ORDER BY created_us DESC, seq DESC LIMIT ?5";
}

void bind_list(Statement& rows, const ListQuery& query) {
  using Place = std::pair<std::int64_t, std::int64_t>;
  const Place last =
      query.before ? Place(to_row(query.before->created), query.before->number) : Place(INT64_MAX, INT64_MAX);
  const Place end =
      query.created_before ? std::min(last, Place(to_row(*query.created_before), INT64_MIN)) : last;
  rows.bind(query.owner)
      .bind(query.created_after ? to_row(*query.created_after) : INT64_MIN)
      .bind(end.first)
      .bind(end.second)
      .bind(query.limit + 1);  // one more, to see whether another page follows
  if (query.label || query.analysis) {
    rows.bind(query.label);
  }
  if (query.analysis) {
    rows.bind(query.analysis);
  }
}

}  // namespace snapthrough::server::sqlite
