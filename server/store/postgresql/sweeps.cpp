/// What happens to sweeps as a whole: verbs that write. What happens to their units is in sweep_units.cpp.

#include "server/store/postgresql/sweeps.h"

#include <algorithm>
#include <utility>

#include "server/store/postgresql/quotas.h"
#include "server/store/postgresql/row_pack.h"
#include "server/store/unit_runs.h"

namespace snapthrough::server::postgresql {
namespace {

/// A sweep that is there, locked: row number and status.
struct Place {
  std::int64_t row = 0;
  JobState state = JobState::accepted;
};

/// @brief Locks the sweep against who would change it. Leases come first, as where units are stored, so that
/// two never wait for each other.
std::optional<Place> lock(Connection& connection, std::string_view id) {
  const Parameters sweep = Parameters().add(id);
  connection.run(
      "SELECT FROM sweep_leases JOIN sweeps ON seq = sweep WHERE id = $1 ORDER BY number FOR UPDATE OF "
      "sweep_leases",
      sweep);
  const Rows rows =
      connection.run("SELECT seq, status FROM sweeps WHERE id = $1 AND NOT removed FOR NO KEY UPDATE", sweep);
  return rows.empty() ? std::nullopt : std::optional(Place{rows.integer(0, 0), state_in(rows, 0, 1)});
}

constexpr std::string_view kKnownKey =
    "SELECT fingerprint, id FROM sweep_keys JOIN sweeps ON seq = sweep"
    " WHERE sweep_keys.owner = $1 AND key = $2 AND NOT removed";

void insert_sweep(Connection& connection, const NewSweep& sweep, const Clock& clock) {
  static constexpr std::string_view kSql =
      "WITH sweep AS (INSERT INTO sweeps (id, owner, title, reuse, points, created_us, analysis_type, label,"
      "  metadata, callback, unit_points)"
      "  VALUES ($1, $2, $3, $4, $5, coalesce($6, snapthrough_now()), $7, $8, $9, $10, $11) RETURNING seq),"
      " document AS (INSERT INTO sweep_documents (sweep, document) SELECT seq, $12 FROM sweep),"
      " units AS (INSERT INTO sweep_left (sweep, first, units) SELECT seq, 0, $5 / $11 FROM sweep)"
      " INSERT INTO sweep_counts (sweep, slot, owner, bytes) SELECT seq, -1, $2, octet_length($12) FROM "
      "sweep";
  const Annotations& notes = sweep.annotations;
  Parameters row;
  row.add(sweep.id).add(sweep.owner).add_bytes(sweep.title).add(sweep.reuse).add(sweep.points);
  row.add(clock.at(sweep.created)).add(sweep.analysis_type);
  row.add_bytes_or_null(notes.label).add_bytes_or_null(notes.metadata);
  row.add(notes.callback.empty() ? std::nullopt : std::optional<std::string_view>(notes.callback));
  row.add(sweep.unit_points).add_bytes(sweep.document);
  connection.run(kSql, row);
  if (sweep.idempotency) {
    Parameters key;
    key.add(sweep.owner).add(sweep.idempotency->key).add(sweep.idempotency->fingerprint).add(sweep.id);
    key.add(clock.at(sweep.created));
    connection.run(
        "INSERT INTO sweep_keys (owner, key, fingerprint, sweep, created_us)"
        " SELECT $1, $2, $3, seq, coalesce($5, snapthrough_now()) FROM sweeps WHERE id = $4"
        " ON CONFLICT (owner, key) DO UPDATE SET fingerprint = excluded.fingerprint, sweep = excluded.sweep,"
        " created_us = excluded.created_us",
        key);
  }
}

/// Units that anybody may have.
Statement insert_left(std::int64_t sweep, const UnitRun& run) {
  return {"INSERT INTO sweep_left (sweep, first, units) VALUES ($1, $2, $3)",
          Parameters()
              .add(sweep)
              .add(static_cast<std::int64_t>(run.first))
              .add(static_cast<std::int64_t>(run.count))};
}

/// Takes the failed rows out of what one lease came to, and gives their units out again; bytes that were
/// freed.
std::int64_t drop_failed(Connection& connection, std::int64_t sweep, std::int64_t unit_points,
                         std::int64_t first, std::string_view stored) {
  std::vector<PointRow> rows = unpack_rows(stored);
  std::vector<UnitRun> runs;
  std::int64_t freed = 0;
  for (const PointRow& row : rows) {
    const std::uint64_t unit = row.point / static_cast<std::uint64_t>(unit_points);
    if (row.outcome.failed()) {
      freed += static_cast<std::int64_t>(row.outcome.code.size() + row.outcome.detail.size());
      if (runs.empty() || unit >= runs.back().first + runs.back().count) {
        add_unit(runs, unit);
      }
    }
  }
  std::erase_if(rows, [](const PointRow& row) { return row.outcome.failed(); });
  std::vector<Statement> statements{
      {"UPDATE sweep_rows SET rows = $3, failed = 0 WHERE sweep = $1 AND first = $2",
       Parameters().add(sweep).add(first).add_bytes(pack_rows(rows))}};
  for (const UnitRun& run : runs) {
    statements.push_back(insert_left(sweep, run));
  }
  connection.run_all(statements);
  return freed;
}

/// Makes failed points of a sweep points that nobody has computed.
void forget_failures(Connection& connection, std::int64_t sweep, std::int64_t unit_points) {
  std::int64_t freed = 0;
  std::int64_t last = -1;
  for (;;) {
    const Rows next = connection.run(
        "SELECT first, rows FROM sweep_rows WHERE sweep = $1 AND first > $2 AND failed > 0 ORDER BY first "
        "LIMIT 1",
        Parameters().add(sweep).add(last));
    if (next.empty()) {
      break;
    }
    last = next.integer(0, 0);
    freed += drop_failed(connection, sweep, unit_points, last, next.text(0, 1));
  }
  const Parameters row = Parameters().add(sweep);
  connection.run_all(std::vector<Statement>{
      {"UPDATE sweep_counts SET failed = 0, bytes = bytes - CASE WHEN slot = -1 THEN $2 ELSE 0 END"
       " WHERE sweep = $1",
       Parameters().add(sweep).add(freed)},
      {"UPDATE sweep_left SET crashes = 0 WHERE sweep = $1", row},
      {"UPDATE sweeps SET status = 'accepted', finished_us = NULL WHERE seq = $1", row}});
}

/// What is not needed of sweeps that nobody finds any more: their units, and their counts, so that their
/// owners have the bytes back. `gone` is a table of their rows.
constexpr const char* kEndRemoved =
    ", counts AS (DELETE FROM sweep_counts WHERE sweep IN (SELECT seq FROM gone)),"
    " units AS (DELETE FROM sweep_left WHERE sweep IN (SELECT seq FROM gone)),"
    " leases AS (DELETE FROM sweep_leases WHERE sweep IN (SELECT seq FROM gone))"
    " SELECT count(*) FROM gone";

}  // namespace

StatusOr<Submitted> PostgresqlSweepStore::submit(const NewSweep& sweep) {
  return database_.write<Submitted>([&](Connection& connection) -> StatusOr<Submitted> {
    if (sweep.idempotency) {
      connection.run("SELECT pg_advisory_xact_lock(hashtextextended($1 || ' ' || $2, 3))",
                     Parameters().add(sweep.owner).add(sweep.idempotency->key));
      const Rows rows = connection.run(kKnownKey, Parameters().add(sweep.owner).add(sweep.idempotency->key));
      if (const std::optional<Submitted> known = known_key(rows, *sweep.idempotency)) {
        return *known;
      }
    }
    const Usage addition{0, sweep.points, static_cast<std::int64_t>(sweep.document.size())};
    if (Status status = admit(connection, sweep.owner, sweep.quotas, addition, clock_.at(sweep.created));
        !status.ok()) {
      return status;
    }
    insert_sweep(connection, sweep, clock_);
    return Submitted{Submitted::Kind::created, sweep.id};
  });
}

StatusOr<std::optional<Submitted>> PostgresqlSweepStore::find_key(const IdempotencyKey& key,
                                                                  std::string_view owner) {
  return database_.read<std::optional<Submitted>>([&](Connection& connection) {
    return known_key(connection.run(kKnownKey, Parameters().add(owner).add(key.key)), key);
  });
}

StatusOr<SweepChange> PostgresqlSweepStore::dismiss(std::string_view id, Time now) {
  return database_.write<SweepChange>([&](Connection& connection) -> StatusOr<SweepChange> {
    const std::optional<Place> place = lock(connection, id);
    if (!place) {
      return SweepChange{};
    }
    if (is_final(place->state)) {
      return SweepChange{place->state, false};
    }
    connection.run_all(std::vector<Statement>{
        {"UPDATE sweeps SET status = 'dismissed', finished_us = coalesce($2, snapthrough_now()) WHERE seq = "
         "$1",
         Parameters().add(place->row).add(clock_.at(now))},
        {"WITH ended AS (DELETE FROM sweep_leases WHERE sweep = $1 RETURNING sweep, first, units, crashes)"
         " INSERT INTO sweep_left (sweep, first, units, crashes) SELECT * FROM ended",
         Parameters().add(place->row)}});
    return SweepChange{place->state, true};
  });
}

StatusOr<SweepChange> PostgresqlSweepStore::retry(std::string_view id, const Quotas& quotas, Time now) {
  return database_.write<SweepChange>([&](Connection& connection) -> StatusOr<SweepChange> {
    const std::optional<Place> place = lock(connection, id);
    if (!place) {
      return SweepChange{};
    }
    if (place->state != JobState::failed && place->state != JobState::dismissed) {
      return SweepChange{place->state, false};
    }
    const Rows sweep = connection.run(
        "SELECT owner, unit_points, points - (SELECT sum(successful) FROM sweep_counts WHERE sweep = "
        "seq)::bigint"
        " FROM sweeps WHERE seq = $1",
        Parameters().add(place->row));
    if (Status status =
            admit(connection, sweep.text(0, 0), quotas, {0, sweep.integer(0, 2), 0}, clock_.at(now));
        !status.ok()) {
      return status;
    }
    forget_failures(connection, place->row, sweep.integer(0, 1));
    return SweepChange{place->state, true};
  });
}

StatusOr<bool> PostgresqlSweepStore::remove(std::string_view id) {
  static const std::string kSql =
      "WITH gone AS (UPDATE sweeps SET removed = true WHERE id = $1 AND NOT removed RETURNING seq)" +
      std::string(kEndRemoved);
  return database_.write<bool>([&](Connection& connection) -> StatusOr<bool> {
    lock(connection, id);
    return connection.run(kSql, Parameters().add(id)).integer(0, 0) > 0;
  });
}

StatusOr<int> PostgresqlSweepStore::retire(std::chrono::seconds age, Time now) {
  static const std::string kSql =
      "WITH old AS (SELECT seq FROM sweeps WHERE finished_us < coalesce($1, snapthrough_now()) - $2"
      "  AND NOT removed FOR UPDATE SKIP LOCKED),"
      " gone AS (UPDATE sweeps SET removed = true WHERE seq IN (SELECT seq FROM old) RETURNING seq)" +
      std::string(kEndRemoved);
  return database_.write_at_once<int>(
      {{kSql, Parameters().add(clock_.at(now)).add(microseconds(age))}}, Durability::synced,
      [](std::span<const Rows> all) -> StatusOr<int> { return static_cast<int>(all.front().integer(0, 0)); });
}

StatusOr<bool> PostgresqlSweepStore::purge(int most) {
  return database_.write<bool>([&](Connection& connection) -> StatusOr<bool> {
    const Rows removed =
        connection.run("SELECT seq FROM sweeps WHERE removed ORDER BY seq LIMIT 1 FOR UPDATE SKIP LOCKED");
    if (removed.empty()) {
      return false;
    }
    const std::int64_t sweep = removed.integer(0, 0);
    const Rows deleted = connection.run(
        "DELETE FROM sweep_rows WHERE sweep = $1 AND first IN (SELECT first FROM (SELECT first,"
        " sum(points) OVER (ORDER BY first) - points AS before FROM (SELECT first, points FROM sweep_rows"
        " WHERE sweep = $1 ORDER BY first LIMIT $2) AS next) AS sums WHERE before < $2)",
        Parameters().add(sweep).add(most));
    if (deleted.changed() == 0) {
      connection.run("DELETE FROM sweeps WHERE seq = $1", Parameters().add(sweep));
    }
    return true;
  });
}

Status PostgresqlSweepStore::forget_keys(std::chrono::seconds age, Time now) {
  return database_.write_at_once(
      {{"DELETE FROM sweep_keys WHERE created_us < coalesce($1, snapthrough_now()) - $2",
        Parameters().add(clock_.at(now)).add(microseconds(age))}});
}

}  // namespace snapthrough::server::postgresql
