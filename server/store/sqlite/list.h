#pragma once
/// @file
/// Pages of lists of jobs and of sweeps.

#include <string>
#include <utility>
#include <vector>

#include "server/store/sqlite/connection.h"

namespace snapthrough::server::sqlite {

/// @brief The statement that reads a page, one row more than the limit; created_us and seq follow the
/// columns. Rows come in order from an index for each set of filters, so a page costs as much as its rows. A
/// page of all states merges one run of the index for each state.
[[nodiscard]] std::string list_sql(const ListedTable& table, const ListQuery& query);

/// Gives a statement of list_sql() its parameters.
void add_bounds(Statement& rows, const ListQuery& query);

/// Reads a page. @param read makes an entry of the current row
template <class Entry, class Read>
std::pair<std::vector<Entry>, std::optional<ListPlace>> read_page(const Connection& connection,
                                                                  const ListedTable& table,
                                                                  const ListQuery& query, const Read& read) {
  Statement rows = connection.prepare(list_sql(table, query));
  add_bounds(rows, query);
  std::vector<Entry> page;
  ListPlace last;
  while (rows.step()) {
    if (static_cast<int>(page.size()) == query.limit) {
      return {std::move(page), last};
    }
    page.push_back(read(rows));
    last = {rows.time(table.count), rows.integer(table.count + 1)};
  }
  return {std::move(page), std::nullopt};
}

}  // namespace snapthrough::server::sqlite
