/// What is known of sweeps: verbs that read.

#include <algorithm>
#include <set>
#include <unordered_map>
#include <utility>

#include "server/store/postgresql/list.h"
#include "server/store/postgresql/row_pack.h"
#include "server/store/postgresql/sweeps.h"

namespace snapthrough::server::postgresql {
namespace {

/// Leases' rows that are read at a time, at most: no transaction is open for long. It begins with one, since
/// who sends a table asks for little at a time.
constexpr int kReadAtOnce = 16;

/// Calls `use` with the rows that are asked for; false when it wants no more.
StatusOr<bool> use_rows(const std::string& pack, const PointQuery& query,
                        const std::function<bool(std::uint64_t, const api::PointOutcome&)>& use) try {
  for (const PointRow& row : unpack_rows(pack)) {
    const bool wanted = row.point >= query.first && row.point - query.first < query.count &&
                        (!query.failed || *query.failed == row.outcome.failed());
    if (wanted && !use(row.point, row.outcome)) {
      return false;
    }
  }
  return true;
} catch (const Error& error) {
  return to_status(error);
}
/// Keys of a sample, by which it is seen whether it is worth to look for all.
constexpr std::size_t kSample = 32;

/// Some of them, the first and the last among them.
std::vector<std::int64_t> sample(const std::vector<std::int64_t>& keys) {
  if (keys.size() <= kSample) {
    return keys;
  }
  std::vector<std::int64_t> some;
  for (std::size_t i = 0; i < kSample; ++i) {
    some.push_back(keys[i * (keys.size() - 1) / (kSample - 1)]);
  }
  return some;
}

/// @brief Where rows with these keys are stored: sweep and first point, each once. One search of the index of
/// keys for each, whatever the planner thinks: it takes no account of arrays that are stored apart, and
/// would rather read the table.
std::set<std::pair<std::int64_t, std::int64_t>> places_of(Connection& connection,
                                                          const std::vector<std::int64_t>& keys) {
  const std::vector<Rows> all = connection.run_all(std::vector<Statement>{
      {"SELECT set_config('enable_seqscan', 'off', true), set_config('enable_indexscan', 'off', true),"
       " set_config('enable_indexonlyscan', 'off', true)"},
      {"SELECT DISTINCT sweep, first FROM unnest($1) AS wanted (key) CROSS JOIN LATERAL"
       " (SELECT sweep, first FROM sweep_rows WHERE keys @> ARRAY[wanted.key] LIMIT 8) AS place"
       " WHERE NOT (SELECT removed FROM sweeps WHERE seq = sweep)",
       Parameters().add(keys)}});
  const Rows& rows = all.back();
  std::set<std::pair<std::int64_t, std::int64_t>> places;
  for (int row = 0; row < rows.count(); ++row) {
    places.emplace(rows.integer(row, 0), rows.integer(row, 1));
  }
  return places;
}

}  // namespace

StatusOr<std::int64_t> PostgresqlSweepStore::unfinished() {
  return database_.read<std::int64_t>([](Connection& connection) {
    return connection
        .run("SELECT count(*) FROM sweeps WHERE status IN ('accepted', 'running') AND NOT removed")
        .integer(0, 0);
  });
}

StatusOr<std::vector<std::string>> PostgresqlSweepStore::with_units() {
  return database_.read<std::vector<std::string>>([](Connection& connection) {
    return connection
        .run(
            "SELECT id FROM sweeps WHERE status IN ('accepted', 'running') AND NOT removed"
            " AND EXISTS (SELECT FROM sweep_left WHERE sweep = seq)"
            " ORDER BY row_number() OVER (PARTITION BY owner ORDER BY seq), seq")
        .texts(0);
  });
}

StatusOr<std::optional<OpenSweep>> PostgresqlSweepStore::open(std::string_view id) {
  return database_.read<std::optional<OpenSweep>>([&](Connection& connection) -> std::optional<OpenSweep> {
    const Rows rows = connection.run(
        "SELECT document, owner, reuse FROM sweeps JOIN sweep_documents ON sweep = seq"
        " WHERE id = $1 AND NOT removed AND status IN ('accepted', 'running')",
        Parameters().add(id));
    return rows.empty() ? std::nullopt
                        : std::optional(OpenSweep{rows.text(0, 0), rows.text(0, 1), rows.boolean(0, 2)});
  });
}

StatusOr<std::optional<SweepRecord>> PostgresqlSweepStore::get(std::string_view id) {
  static const std::string kSql =
      "SELECT " + std::string(kSweepColumns) + " FROM sweeps WHERE id = $1 AND NOT removed";
  return database_.read<std::optional<SweepRecord>>(
      [&](Connection& connection) -> std::optional<SweepRecord> {
        const Rows rows = connection.run(kSql, Parameters().add(id));
        return rows.empty() ? std::nullopt : std::optional(read_sweep(rows, 0));
      });
}

StatusOr<SweepPage> PostgresqlSweepStore::list(const ListQuery& query) {
  return database_.read<SweepPage>([&](Connection& connection) {
    static const ListedTable kSweeps{"sweeps", kSweepColumns, kSweepColumnCount, " AND NOT removed"};
    auto [sweeps, next] = read_page<SweepRecord>(connection, kSweeps, query, read_sweep);
    return SweepPage{std::move(sweeps), next};
  });
}

StatusOr<std::optional<std::string>> PostgresqlSweepStore::document(std::string_view id) {
  return database_.read<std::optional<std::string>>(
      [&](Connection& connection) -> std::optional<std::string> {
        const Rows rows = connection.run(
            "SELECT document FROM sweep_documents JOIN sweeps ON seq = sweep WHERE id = $1 AND NOT removed",
            Parameters().add(id));
        return rows.empty() ? std::nullopt : std::optional(rows.text(0, 0));
      });
}

Status PostgresqlSweepStore::each_row(
    std::string_view id, const PointQuery& query,
    const std::function<bool(std::uint64_t, const api::PointOutcome&)>& use) {
  static constexpr std::string_view kSql =
      "SELECT first, rows FROM sweep_rows WHERE sweep = (SELECT seq FROM sweeps WHERE id = $1 AND NOT "
      "removed)"
      " AND first >= coalesce((SELECT first FROM sweep_rows WHERE first <= $2"
      "   AND sweep = (SELECT seq FROM sweeps WHERE id = $1) ORDER BY first DESC LIMIT 1), 0)"
      " AND first > $3 AND first < $4 AND (failed > 0 OR NOT $5) ORDER BY first LIMIT $6";
  const auto largest = static_cast<std::uint64_t>(INT64_MAX);
  const std::uint64_t first = std::min(query.first, largest);
  const std::uint64_t end = first + std::min(query.count, largest - first);
  std::int64_t last = -1;
  for (int most = 1;; most = std::min(2 * most, kReadAtOnce)) {
    Parameters page;
    page.add(id).add(static_cast<std::int64_t>(first)).add(last).add(static_cast<std::int64_t>(end));
    page.add(query.failed.value_or(false)).add(most);
    const StatusOr<std::vector<std::string>> read =
        database_.read<std::vector<std::string>>([&](Connection& connection) {
          const Rows rows = connection.run(kSql, page);
          std::vector<std::string> packs;
          for (int row = 0; row < rows.count(); ++row) {
            last = rows.integer(row, 0);
            packs.push_back(rows.text(row, 1));
          }
          return packs;
        });
    if (!read.ok()) {
      return read.status();
    }
    for (const std::string& pack : *read) {
      const StatusOr<bool> more = use_rows(pack, {first, end - first, query.failed}, use);
      if (!more.ok() || !*more) {
        return more.status();
      }
    }
    if (read->size() < static_cast<std::size_t>(most)) {
      return {};
    }
  }
}

StatusOr<std::vector<std::optional<std::string>>> PostgresqlSweepStore::find_outputs(
    const std::vector<std::string>& keys) {
  std::unordered_multimap<std::string_view, std::size_t> wanted;
  std::vector<std::int64_t> some;
  for (std::size_t i = 0; i < keys.size(); ++i) {
    if (!keys[i].empty()) {
      wanted.emplace(keys[i], i);
      some.push_back(short_key(keys[i]));
    }
  }
  using Found = std::vector<std::optional<std::string>>;
  return database_.read<Found>([&](Connection& connection) {
    Found found(keys.size());
    if (places_of(connection, sample(some)).empty()) {
      return found;  // where none of a sample is known, they are computed
    }
    for (const auto& [sweep, first] : places_of(connection, some)) {
      const Rows rows = connection.run("SELECT rows FROM sweep_rows WHERE sweep = $1 AND first = $2",
                                       Parameters().add(sweep).add(first));
      for (const PointRow& point : rows.empty() ? std::vector<PointRow>() : unpack_rows(rows.text(0, 0))) {
        const auto [begin, end] = wanted.equal_range(point.key);
        for (auto place = begin; place != end && !point.outcome.failed(); ++place) {
          found[place->second] = point.outcome.outputs;
        }
      }
    }
    return found;
  });
}

}  // namespace snapthrough::server::postgresql
