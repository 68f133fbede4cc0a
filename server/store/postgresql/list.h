#pragma once
/// @file
/// Pages of lists of jobs and of sweeps.

#include <string>
#include <utility>
#include <vector>

#include "server/store/list_query.h"
#include "server/store/postgresql/rows.h"

namespace snapthrough::server::postgresql {

/// What is listed.
struct ListedTable {
  const char* name;       ///< has the columns seq, owner, status, label, analysis_type, created_us
  const char* columns;    ///< for SELECT
  int count;              ///< of the columns
  const char* condition;  ///< of every row that is listed: " AND ...", or ""
};

/// @brief The rows of a page, one more than the limit; created_us and seq follow the columns. They come in
/// order from an index, merged from a run of it for each status, so a page costs what its rows cost.
[[nodiscard]] Rows list_rows(Connection& connection, const ListedTable& table, const ListQuery& query);

/// @brief Reads a page. @param read makes an entry of a row
template <class Entry, class Read>
std::pair<std::vector<Entry>, std::optional<ListPlace>> read_page(Connection& connection,
                                                                  const ListedTable& table,
                                                                  const ListQuery& query, const Read& read) {
  const Rows rows = list_rows(connection, table, query);
  std::vector<Entry> page;
  const int count = std::min(rows.count(), query.limit);
  page.reserve(static_cast<std::size_t>(count));
  for (int row = 0; row < count; ++row) {
    page.push_back(read(rows, row));
  }
  if (rows.count() <= query.limit) {
    return {std::move(page), std::nullopt};
  }
  const ListPlace last{time_in(rows, count - 1, table.count), rows.integer(count - 1, table.count + 1)};
  return {std::move(page), last};
}

}  // namespace snapthrough::server::postgresql
