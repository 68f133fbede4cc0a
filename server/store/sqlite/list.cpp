#include "server/store/sqlite/list.h"

namespace snapthrough::server::sqlite {

std::string list_sql(const ListedTable& table, const ListQuery& query) {
  const auto run = [&](JobState state) {
    std::string sql = "SELECT " + std::string(table.columns) + ", created_us, seq FROM " + table.name;
    sql += " WHERE owner = ?1 AND status = " + literal(state) + table.condition;
    sql += " AND created_us > ?2 AND (created_us, seq) < (?3, ?4)";
    sql += query.label ? " AND label = ?6" : "";
    sql += query.analysis ? " AND analysis_type = ?7" : "";
    return sql;
  };
  return union_of_states(query, run) + " ORDER BY created_us DESC, seq DESC LIMIT ?5";
}

void add_bounds(Statement& rows, const ListQuery& query) {
  const ListBounds bounds = bounds_of(query);
  rows.add(query.owner).add(bounds.after).add(bounds.end.first).add(bounds.end.second);
  rows.add(query.limit + 1);  // one more, to see whether another page follows
  if (query.label || query.analysis) {
    rows.add(query.label);
  }
  if (query.analysis) {
    rows.add(query.analysis);
  }
}

}  // namespace snapthrough::server::sqlite
