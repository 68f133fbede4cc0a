#pragma once
/// @file
/// Pages of lists of jobs and of sweeps.

#include <string>
#include <utility>
#include <vector>

#include "server/store/postgresql/connection.h"

namespace snapthrough::server::postgresql {

/// @brief The rows of a page, one more than the limit; created_us and seq follow the columns. Rows come in
/// order from an index, one run of it for each state merged, so a page costs as much as its rows.
[[nodiscard]] Rows list_rows(Connection& connection, const ListedTable& table, const ListQuery& query);

/// Reads a page. @param read makes an entry of a row
template <class Entry, class Read>
std::pair<std::vector<Entry>, std::optional<ListPlace>> read_page(Connection& connection,
                                                                  const ListedTable& table,
                                                                  const ListQuery& query, const Read& read) {
  const Rows rows = list_rows(connection, table, query);
  std::vector<Entry> page;
  const int count = std::min(rows.count(), query.limit);
  page.reserve(static_cast<std::size_t>(count));
  for (int row = 0; row < count; ++row) {
    page.push_back(read(rows[row]));
  }
  if (rows.count() <= query.limit) {
    return {std::move(page), std::nullopt};
  }
  const ListPlace last{rows[count - 1].time(table.count), rows[count - 1].integer(table.count + 1)};
  return {std::move(page), last};
}

}  // namespace snapthrough::server::postgresql
