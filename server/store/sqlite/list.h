#pragma once
/// @file
/// Pages of lists of jobs and of sweeps.

#include <string>
#include <utility>
#include <vector>

#include "server/store/list_query.h"
#include "server/store/sqlite/connection.h"
#include "server/store/sqlite/rows.h"

namespace snapthrough::server::sqlite {

/// What is listed.
struct ListedTable {
  const char* name;       ///< has the columns seq, owner, status, label, analysis_type, created_us
  const char* columns;    ///< for SELECT
  const char* condition;  ///< of every row that is listed: " AND ...", or ""
};

/// @brief The statement that reads a page, one row more than the limit; created_us and seq follow the
/// columns. Rows come in order from an index whatever the filters are, so a page costs what its rows cost.
/// With all statuses it merges one run of the index for each.
[[nodiscard]] std::string list_sql(const ListedTable& table, const ListQuery& query);

/// Binds a statement of list_sql().
void bind_list(Statement& rows, const ListQuery& query);

/// @brief Reads a page.
/// @param count of the columns
/// @param read makes an entry of the current row
template <class Entry, class Read>
std::pair<std::vector<Entry>, std::optional<ListPlace>> read_page(const Connection& connection,
                                                                  const ListedTable& table, int count,
                                                                  const ListQuery& query, const Read& read) {
  Statement rows = connection.prepare(list_sql(table, query));
  bind_list(rows, query);
  std::vector<Entry> page;
  ListPlace last;
  while (rows.step()) {
    if (static_cast<int>(page.size()) == query.limit) {
      return {std::move(page), last};
    }
    page.push_back(read(rows));
    last = {time_in(rows, count), rows.integer(count + 1)};
  }
  return {std::move(page), std::nullopt};
}

}  // namespace snapthrough::server::sqlite
