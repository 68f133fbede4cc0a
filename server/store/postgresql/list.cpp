#include "server/store/postgresql/list.h"

namespace snapthrough::server::postgresql {
Rows list_rows(Connection& connection, const ListedTable& table, const ListQuery& query) {
  const auto run = [&](JobState state) {
    std::string sql = "(SELECT seq, created_us FROM " + std::string(table.name);
    sql += " WHERE owner = $1 AND status = " + literal(state) + table.condition;
    sql += " AND created_us > $2 AND (created_us, seq) < ($3, $4)";
    sql += query.label ? " AND label = $6" : "";
    sql += query.analysis ? " AND analysis_type = $7" : "";
    return sql + " ORDER BY created_us DESC, seq DESC LIMIT $5)";
  };
  const std::string runs = union_of_states(query, run);
  const std::string name = table.name;
  const std::string sql = "SELECT " + std::string(table.columns) + ", " + name + ".created_us, " + name +
                          ".seq FROM (SELECT seq FROM (" + runs +
                          ") AS run ORDER BY created_us DESC, seq DESC LIMIT $5) AS page JOIN " + name +
                          " ON " + name + ".seq = page.seq ORDER BY " + name + ".created_us DESC, " + name +
                          ".seq DESC";
  const ListBounds bounds = bounds_of(query);
  Parameters wanted;
  wanted.add(query.owner).add(bounds.after).add(bounds.end.first).add(bounds.end.second);
  wanted.add(query.limit + 1);  // one more, to see whether another page follows
  if (query.label) {
    wanted.add_bytes(*query.label);
  } else {
    wanted.add_bytes_or_null("");
  }
  wanted.add(query.analysis);
  return connection.run(sql, wanted);
}

}  // namespace snapthrough::server::postgresql
