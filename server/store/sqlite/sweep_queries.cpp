/// What is known of sweeps: verbs that read.

#include <utility>

#include "server/store/sqlite/list.h"
#include "server/store/sqlite/rows.h"
#include "server/store/sqlite/sweeps.h"

namespace snapthrough::server::sqlite {
const char* const kSweepColumns =
    "sweeps.id, sweeps.status, sweeps.owner, sweeps.title, sweeps.points, sweeps.successful, sweeps.failed,"
    " sweeps.reused, sweeps.created_us, sweeps.started_us, sweeps.finished_us, sweeps.analysis_type,"
    " sweeps.label, sweeps.metadata, sweeps.callback";

SweepRecord read_sweep_record(const Statement& row) {
  SweepRecord sweep;
  sweep.id = row.text(0);
  sweep.state = state_in(row, 1);
  sweep.owner = row.text(2);
  sweep.title = row.text(3);
  sweep.points = row.integer(4);
  sweep.successful = row.integer(5);
  sweep.failed = row.integer(6);
  sweep.reused = row.integer(7);
  sweep.created = time_in(row, 8);
  sweep.started = optional_time_in(row, 9);
  sweep.finished = optional_time_in(row, 10);
  sweep.analysis_type = row.text(11);
  sweep.annotations = annotations_in(row, 12);
  return sweep;
}

StatusOr<std::int64_t> SqliteSweepStore::unfinished() {
  return database_.read<std::int64_t>([](const Connection& connection) {
    static const std::string kSql =
        "SELECT count(*) FROM sweeps WHERE " + unfinished_condition() + " AND removed = 0";
    Statement row = connection.prepare(kSql);
    row.step();
    return row.integer(0);
  });
}

StatusOr<std::vector<std::string>> SqliteSweepStore::with_units() {
  return database_.read<std::vector<std::string>>([](const Connection& connection) {
    static const std::string kSql = "SELECT id FROM sweeps WHERE " + unfinished_condition() +
                                    " AND removed = 0 AND EXISTS (SELECT 1 FROM sweep_left WHERE sweep = seq)"
                                    " ORDER BY row_number() OVER (PARTITION BY owner ORDER BY seq), seq";
    Statement rows = connection.prepare(kSql);
    std::vector<std::string> ids;
    while (rows.step()) {
      ids.push_back(rows.text(0));
    }
    return ids;
  });
}

StatusOr<std::optional<OpenSweep>> SqliteSweepStore::open(std::string_view id) {
  return database_.read<std::optional<OpenSweep>>(
      [&](const Connection& connection) -> std::optional<OpenSweep> {
        static const std::string kSql =
            "SELECT document, owner, reuse FROM sweeps JOIN sweep_documents ON sweep = seq"
            " WHERE id = ? AND removed = 0 AND " +
            unfinished_condition();
        Statement row = connection.prepare(kSql);
        row.bind(id);
        return row.step() ? std::optional(OpenSweep{row.text(0), row.text(1), row.integer(2) == 1})
                          : std::nullopt;
      });
}

StatusOr<std::optional<SweepRecord>> SqliteSweepStore::get(std::string_view id) {
  return database_.read<std::optional<SweepRecord>>(
      [&](const Connection& connection) -> std::optional<SweepRecord> {
        Statement row = connection.prepare("SELECT " + std::string(kSweepColumns) +
                                           " FROM sweeps WHERE id = ? AND removed = 0");
        row.bind(id);
        return row.step() ? std::optional(read_sweep_record(row)) : std::nullopt;
      });
}

StatusOr<SweepPage> SqliteSweepStore::list(const ListQuery& query) {
  return database_.read<SweepPage>([&](const Connection& connection) {
    static const ListedTable kListedSweeps{"sweeps", kSweepColumns, " AND removed = 0"};
    auto [sweeps, next] =
        read_page<SweepRecord>(connection, kListedSweeps, kSweepColumnCount, query, read_sweep_record);
    return SweepPage{std::move(sweeps), next};
  });
}

StatusOr<std::optional<std::string>> SqliteSweepStore::document(std::string_view id) {
  return database_.read<std::optional<std::string>>(
      [&](const Connection& connection) -> std::optional<std::string> {
        Statement row = connection.prepare(
            "SELECT document FROM sweep_documents JOIN sweeps ON seq = sweep WHERE id = ? AND removed = 0");
        row.bind(id);
        return row.step() ? std::optional(row.text(0)) : std::nullopt;
      });
}

Status SqliteSweepStore::each_row(std::string_view id, const PointQuery& query,
                                  const std::function<bool(std::uint64_t, const api::PointOutcome&)>& use) {
  const auto largest = static_cast<std::uint64_t>(INT64_MAX);
  const std::uint64_t first = std::min(query.first, largest);
  const std::uint64_t end = first + std::min(query.count, largest - first);
  const StatusOr<bool> read = database_.read<bool>([&](const Connection& connection) {
    std::string sql =
        "SELECT point, outputs, code, detail FROM sweep_points"
        " WHERE sweep = (SELECT seq FROM sweeps WHERE id = ? AND removed = 0) AND point >= ? AND point < ?";
    if (query.failed) {
      sql += *query.failed ? " AND code IS NOT NULL" : " AND code IS NULL";
    }
    Statement rows = connection.prepare(sql + " ORDER BY point");
    rows.bind(id).bind(static_cast<std::int64_t>(first)).bind(static_cast<std::int64_t>(end));
    while (rows.step() &&
           use(static_cast<std::uint64_t>(rows.integer(0)), {rows.text(1), rows.text(2), rows.text(3)})) {
    }
    return true;
  });
  return read.status();
}

StatusOr<std::vector<std::optional<std::string>>> SqliteSweepStore::find_outputs(
    const std::vector<std::string>& keys) {
  using Found = std::vector<std::optional<std::string>>;
  return database_.read<Found>([&](const Connection& connection) {
    Found found;
    for (const std::string& key : keys) {
      Statement row = connection.prepare(
          "SELECT outputs FROM sweep_points WHERE content_key = ? AND outputs IS NOT NULL LIMIT 1");
      row.bind(key);
      found.push_back(row.step() ? std::optional(row.text(0)) : std::nullopt);
    }
    return found;
  });
}

}  // namespace snapthrough::server::sqlite
