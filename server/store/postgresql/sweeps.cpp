/// Sweeps in PostgreSQL.

#include <algorithm>
#include <set>
#include <unordered_map>
#include <utility>

#include "api/provenance.h"
#include "server/store/crashes.h"
#include "server/store/postgresql/list.h"
#include "server/store/postgresql/parts.h"
#include "server/store/postgresql/sweep_rows.h"

namespace snapthrough::server::postgresql {
namespace {

/// Columns of read_record().
const std::string& columns() {
  static const std::string kColumns =
      std::string(kSweepColumns) +
      ", (SELECT ARRAY[sum(successful), sum(failed), sum(reused)]::bigint[] FROM sweep_counts"
      " WHERE sweep = sweeps.seq), (SELECT max(program) FROM sweep_counts WHERE sweep = sweeps.seq),"
      " (SELECT sum(cpu_us)::bigint FROM sweep_counts WHERE sweep = sweeps.seq),"
      " (SELECT max(peak_bytes) FROM sweep_counts WHERE sweep = sweeps.seq),"
      " (SELECT sum(factorizations)::bigint FROM sweep_counts WHERE sweep = sweeps.seq)";
  return kColumns;
}
constexpr int kColumnCount = kSweepColumnCount + 5;

SweepRecord read_record(const ResultRow& row) {
  SweepRecord sweep = read_sweep(row);
  const std::vector<std::int64_t> counts = row.integers(kSweepColumnCount);
  sweep.successful = counts.at(0);
  sweep.failed = counts.at(1);
  sweep.reused = counts.at(2);
  sweep.program = row.text(kSweepColumnCount + 1);
  sweep.usage = read_work_usage(row, kSweepColumnCount + 2);
  return sweep;
}

/// Columns sweep, first, units, crashes, unit_points of a lease.
HeldItems read_held(const Row& row) {
  return {row.integer(0), {row.number(1), row.number(2)}, row.integer(3), row.integer(4)};
}

/// @brief Locks the sweep against changes by other transactions. Leases are locked first, as where rows are
/// stored, so that no deadlock arises.
std::optional<StoredSweep> lock(Connection& connection, std::string_view id) {
  const Parameters sweep = Parameters().add(id);
  connection.run(
      "SELECT FROM sweep_leases JOIN sweeps ON seq = sweep WHERE id = $1 ORDER BY number FOR UPDATE OF "
      "sweep_leases",
      sweep);
  const Rows rows =
      connection.run("SELECT seq, status FROM sweeps WHERE id = $1 AND NOT removed FOR NO KEY UPDATE", sweep);
  return rows.empty() ? std::nullopt : std::optional(StoredSweep{rows[0].integer(0), rows[0].state(1)});
}

constexpr std::string_view kKnownKey =
    "SELECT fingerprint, id FROM sweep_keys JOIN sweeps ON seq = sweep"
    " WHERE sweep_keys.owner = $1 AND key = $2 AND NOT removed";

void insert_sweep(Connection& connection, const NewSweep& sweep, const Clock& clock) {
  static constexpr std::string_view kSql =
      "WITH sweep AS (INSERT INTO sweeps (id, owner, title, reuse, points, created_us, analysis_type, label,"
      "  metadata, callback, unit_points, request_sha256)"
      "  VALUES ($1, $2, $3, $4, $5, coalesce($6, snapthrough_now()), $7, $8, $9, $10, $11, $13)"
      "  RETURNING seq),"
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
  row.add(sweep.item_points).add_bytes(sweep.document).add(text_or_null(sweep.request_sha256));
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

/// @brief Removes the failed rows from a pack (the rows of one lease) and gives out the pack's items that
/// lack a row; returns the bytes that were freed. No run of items reaches beyond the pack, so that each is
/// stored in it. @param pack items of the pack, and number of its sweep
std::int64_t drop_failed(Connection& connection, const HeldItems& pack, std::string_view stored) {
  std::vector<PointRow> rows = unpack_rows(stored);
  std::int64_t freed = 0;
  for (const PointRow& row : rows) {
    freed += row.outcome.failed()
                 ? static_cast<std::int64_t>(row.outcome.code.size() + row.outcome.detail.size())
                 : 0;
  }
  std::erase_if(rows, [](const PointRow& row) { return row.outcome.failed(); });
  ItemRows items(pack.items, pack.item_points);
  for (const PointRow& row : rows) {
    items.add(row.point);
  }
  std::vector<Statement> statements{
      {"UPDATE sweep_rows SET rows = $3, failed = 0 WHERE sweep = $1 AND first = $2",
       Parameters().add(pack.sweep).add(pack.first_point()).add_bytes(pack_rows(rows))},
      {"DELETE FROM sweep_left WHERE sweep = $1 AND first >= $2 AND first < $2 + $3",
       Parameters()
           .add(pack.sweep)
           .add(static_cast<std::int64_t>(pack.items.first))
           .add(static_cast<std::int64_t>(pack.items.count))}};
  for (const ItemRun& run : joined(items.left())) {
    statements.push_back(insert_left(pack.sweep, run, 0));
  }
  connection.run_all(statements);
  return freed;
}

/// Removes all failed rows of a sweep, gives its items out again, and makes the sweep accepted.
void forget_failures(Connection& connection, std::int64_t sweep, std::int64_t item_points) {
  static const std::string kAgain =
      "UPDATE sweeps SET " + becomes(SweepEvent::retry) + ", finished_us = NULL WHERE seq = $1";
  std::int64_t freed = 0;
  std::int64_t last = -1;
  for (;;) {
    const Rows next = connection.run(
        "SELECT first, points, rows FROM sweep_rows WHERE sweep = $1 AND first > $2 AND failed > 0 ORDER BY "
        "first "
        "LIMIT 1",
        Parameters().add(sweep).add(last));
    if (next.empty()) {
      break;
    }
    last = next[0].integer(0);
    const auto size = static_cast<std::uint64_t>(item_points);
    const HeldItems pack{sweep, {next[0].number(0) / size, next[0].number(1) / size}, 0, item_points};
    freed += drop_failed(connection, pack, next[0].text(2));
  }
  const Parameters row = Parameters().add(sweep);
  connection.run_all(std::vector<Statement>{
      {"UPDATE sweep_counts SET failed = 0, bytes = bytes - CASE WHEN slot = -1 THEN $2 ELSE 0 END"
       " WHERE sweep = $1",
       Parameters().add(sweep).add(freed)},
      {"UPDATE sweep_left SET crashes = 0 WHERE sweep = $1", row},
      {kAgain, row}});
}

/// Removes items, leases and counts of removed sweeps, so that their bytes do not count for their owners.
/// `gone` has the numbers of the sweeps.
constexpr const char* kEndRemoved =
    ", counts AS (DELETE FROM sweep_counts WHERE sweep IN (SELECT seq FROM gone)),"
    " units AS (DELETE FROM sweep_left WHERE sweep IN (SELECT seq FROM gone)),"
    " leases AS (DELETE FROM sweep_leases WHERE sweep IN (SELECT seq FROM gone))"
    " SELECT count(*) FROM gone";

/// Counts what this program took to compute rows of a sweep. @param now see Clock::at()
void add_usage(Connection& connection, std::int64_t sweep, std::size_t rows, const WorkUsage& usage,
               const std::optional<std::int64_t>& now) {
  static const std::string kLedger =
      "INSERT INTO usage AS sums (owner, hour, label, slot, points, cpu_us, peak_bytes, factorizations)"
      " SELECT owner, coalesce($2, snapthrough_now()) / 3600000000, coalesce(label, ''), pg_backend_pid() % "
      "16,"
      " $6, $3, $4, $5 FROM sweeps WHERE seq = $1 " +
      std::string(kAddUsage);
  static constexpr std::string_view kSweep =
      "INSERT INTO sweep_counts AS counts (sweep, slot, owner, program, cpu_us, peak_bytes, factorizations)"
      " SELECT seq, pg_backend_pid() % 16, owner, $2, $3, $4, $5 FROM sweeps WHERE seq = $1"
      " ON CONFLICT (sweep, slot) DO UPDATE SET program = excluded.program,"
      " cpu_us = coalesce(counts.cpu_us, 0) + excluded.cpu_us,"
      " peak_bytes = greatest(counts.peak_bytes, excluded.peak_bytes),"
      " factorizations = coalesce(counts.factorizations, 0) + excluded.factorizations";
  if (rows == 0) {
    return;
  }
  Parameters ledger = Parameters().add(sweep).add(now).add(usage.cpu_us).add(usage.peak_bytes);
  ledger.add(usage.factorizations).add(static_cast<std::int64_t>(rows));
  Parameters counts = Parameters().add(sweep).add(api::program_text()).add(usage.cpu_us);
  counts.add(usage.peak_bytes).add(usage.factorizations);
  connection.run_all(std::vector<Statement>{{kSweep, counts}, {kLedger, ledger}});
}

/// Largest number of packs (the rows of one lease each) in one read, so that no transaction is open for long.
/// Reading begins with one pack, since a table is sent piece by piece.
constexpr int kReadAtOnce = 16;

/// Calls `use` with the rows of a pack that the query selects; false when `use` returned false.
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
/// Number of keys in the sample that decides whether all keys are looked up.
constexpr std::size_t kSample = 32;

/// Evenly spaced keys, the first and the last among them.
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

/// @brief Places of packs with these keys: sweep and first point. Searches the index once for each key; the
/// planner, which ignores that the arrays are stored apart, would read the whole table.
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
    places.emplace(rows[row].integer(0), rows[row].integer(1));
  }
  return places;
}

class PostgresqlSweepStore final : public SweepStore {
 public:
  PostgresqlSweepStore(Database& database, Clock clock) : database_(database), clock_(clock) {}

  StatusOr<Submitted> submit(const NewSweep& sweep) override {
    return database_.write<Submitted>([&](Connection& connection) -> StatusOr<Submitted> {
      if (sweep.idempotency) {
        connection.run("SELECT pg_advisory_xact_lock(hashtextextended($1 || ' ' || $2, 3))",
                       Parameters().add(sweep.owner).add(sweep.idempotency->key));
        const Rows rows =
            connection.run(kKnownKey, Parameters().add(sweep.owner).add(sweep.idempotency->key));
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

  StatusOr<std::optional<Submitted>> find_key(const IdempotencyKey& key, std::string_view owner) override {
    return database_.read<std::optional<Submitted>>([&](Connection& connection) {
      return known_key(connection.run(kKnownKey, Parameters().add(owner).add(key.key)), key);
    });
  }

  StatusOr<std::vector<UsedKey>> keys(std::string_view id) override {
    return database_.read<std::vector<UsedKey>>([&](Connection& connection) {
      return used_keys(connection.run(
          "SELECT key, fingerprint, sweep_keys.created_us FROM sweep_keys JOIN sweeps ON seq = sweep"
          " WHERE id = $1 AND NOT removed ORDER BY key COLLATE \"C\"",
          Parameters().add(id)));
    });
  }

  Status add_key(std::string_view id, const UsedKey& used) override {
    return database_.write_at_once(
        {{"INSERT INTO sweep_keys (owner, key, fingerprint, sweep, created_us)"
          " SELECT owner, $1, $2, seq, $3 FROM sweeps WHERE id = $4 AND NOT removed ON CONFLICT DO NOTHING",
          key_parameters(id, used)}});
  }

  StatusOr<SweepChange> dismiss(std::string_view id, Time now) override {
    static const std::string kEnd = "UPDATE sweeps SET " + becomes(SweepEvent::dismiss) +
                                    ", finished_us = coalesce($2, snapthrough_now()) WHERE seq = $1";
    return database_.write<SweepChange>([&](Connection& connection) -> StatusOr<SweepChange> {
      const std::optional<StoredSweep> place = lock(connection, id);
      if (!place) {
        return SweepChange{};
      }
      if (!next_state(place->state, SweepEvent::dismiss)) {
        return SweepChange{place->state, false};
      }
      connection.run_all(std::vector<Statement>{
          {kEnd, Parameters().add(place->row).add(clock_.at(now))},
          {"WITH ended AS (DELETE FROM sweep_leases WHERE sweep = $1 RETURNING sweep, first, units, crashes)"
           " INSERT INTO sweep_left (sweep, first, units, crashes) SELECT * FROM ended",
           Parameters().add(place->row)}});
      return SweepChange{place->state, true};
    });
  }

  StatusOr<SweepChange> retry(std::string_view id, const Quotas& quotas, Time now) override {
    return database_.write<SweepChange>([&](Connection& connection) -> StatusOr<SweepChange> {
      const std::optional<StoredSweep> place = lock(connection, id);
      if (!place) {
        return SweepChange{};
      }
      if (!next_state(place->state, SweepEvent::retry)) {
        return SweepChange{place->state, false};
      }
      const Rows sweep = connection.run(
          "SELECT owner, unit_points, points - (SELECT sum(successful) FROM sweep_counts WHERE sweep = "
          "seq)::bigint"
          " FROM sweeps WHERE seq = $1",
          Parameters().add(place->row));
      if (Status status =
              admit(connection, sweep[0].text(0), quotas, {0, sweep[0].integer(2), 0}, clock_.at(now));
          !status.ok()) {
        return status;
      }
      connection.run(
          "INSERT INTO audit (owner, at_us, event, sweep, entry)"
          " SELECT owner, coalesce($2, snapthrough_now()), 'retried', true, id FROM sweeps WHERE seq = $1",
          Parameters().add(place->row).add(clock_.at(now)));
      forget_failures(connection, place->row, sweep[0].integer(1));
      return SweepChange{place->state, true};
    });
  }

  using SweepStore::remove;
  StatusOr<bool> remove(std::string_view id, std::optional<Time> noted) override {
    static const std::string kSql =
        "WITH gone AS (UPDATE sweeps SET removed = true WHERE id = $1 AND NOT removed RETURNING seq, owner, "
        "id), noted AS (INSERT INTO audit (owner, at_us, event, sweep, entry)"
        "  SELECT owner, coalesce($2, snapthrough_now()), 'deleted', true, id FROM gone WHERE $3)" +
        std::string(kEndRemoved);
    return database_.write<bool>([&](Connection& connection) -> StatusOr<bool> {
      lock(connection, id);
      Parameters gone = Parameters().add(id).add(clock_.at(noted.value_or(Time())));
      return connection.run(kSql, gone.add(noted.has_value()))[0].integer(0) > 0;
    });
  }

  StatusOr<int> retire(std::chrono::seconds age, Time now) override {
    static const std::string kSql =
        "WITH old AS (SELECT seq FROM sweeps WHERE finished_us < coalesce($1, snapthrough_now()) - $2"
        "  AND NOT removed FOR UPDATE SKIP LOCKED),"
        " gone AS (UPDATE sweeps SET removed = true WHERE seq IN (SELECT seq FROM old)"
        "  RETURNING seq, owner, id), noted AS (INSERT INTO audit (owner, at_us, event, sweep, entry)"
        "  SELECT owner, coalesce($1, snapthrough_now()), 'retired', true, id FROM gone)" +
        std::string(kEndRemoved);
    return database_.write_at_once<int>({{kSql, Parameters().add(clock_.at(now)).add(microseconds(age))}},
                                        Durability::synced, [](std::span<const Rows> all) -> StatusOr<int> {
                                          return static_cast<int>(all.front()[0].integer(0));
                                        });
  }

  StatusOr<bool> purge(int most) override {
    return database_.write<bool>([&](Connection& connection) -> StatusOr<bool> {
      const Rows removed =
          connection.run("SELECT seq FROM sweeps WHERE removed ORDER BY seq LIMIT 1 FOR UPDATE SKIP LOCKED");
      if (removed.empty()) {
        return false;
      }
      const std::int64_t sweep = removed[0].integer(0);
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

  Status forget_keys(std::chrono::seconds age, Time now) override {
    return database_.write_at_once(
        {{"DELETE FROM sweep_keys WHERE created_us < coalesce($1, snapthrough_now()) - $2",
          Parameters().add(clock_.at(now)).add(microseconds(age))}});
  }

  StatusOr<std::optional<ItemClaim>> claim(std::string_view id, std::uint64_t most, const Lease& lease,
                                           Time now) override {
    Parameters wanted;
    wanted.add(id)
        .add(static_cast<std::int64_t>(most))
        .add(lease.worker)
        .add(microseconds(lease.until - now));
    wanted.add(clock_.at(now));
    const auto use = [&](std::span<const Rows> all) -> StatusOr<std::optional<ItemClaim>> {
      const Rows& rows = all.front();
      if (rows.empty()) {
        return std::optional<ItemClaim>();
      }
      const ItemRun items{rows[0].number(1), rows[0].number(2)};
      return std::optional(ItemClaim{rows[0].integer(0), std::string(id), items});
    };
    return database_.write_at_once<std::optional<ItemClaim>>(
        {{"SELECT * FROM claim_units($1, $2, $3, $4, coalesce($5, snapthrough_now()))", wanted}},
        Durability::unsynced, use);
  }

  StatusOr<std::vector<std::int64_t>> renew(const std::vector<ItemClaim>& claims, Time until,
                                            Time now) override {
    std::vector<std::int64_t> numbers;
    numbers.reserve(claims.size());
    for (const ItemClaim& claim : claims) {
      numbers.push_back(claim.number);
    }
    static constexpr std::string_view kSql =
        "WITH clock AS (SELECT coalesce($2, snapthrough_now()) AS moment),"
        " held AS (SELECT number FROM sweep_leases WHERE number = ANY ($1)"
        "  AND until_us >= (SELECT moment FROM clock) ORDER BY number FOR UPDATE),"
        " renewed AS (UPDATE sweep_leases SET until_us = (SELECT moment FROM clock) + $3"
        "  WHERE number IN (SELECT number FROM held))"
        " SELECT claimed FROM unnest($1) AS claimed WHERE claimed NOT IN (SELECT number FROM held)";
    const auto use = [](std::span<const Rows> all) -> StatusOr<std::vector<std::int64_t>> {
      std::vector<std::int64_t> lost;
      lost.reserve(static_cast<std::size_t>(all.front().count()));
      for (int row = 0; row < all.front().count(); ++row) {
        lost.push_back(all.front()[row].integer(0));
      }
      return lost;
    };
    return database_.write_at_once<std::vector<std::int64_t>>(
        {{kSql, Parameters().add(numbers).add(clock_.at(now)).add(microseconds(until - now))}},
        Durability::unsynced, use);
  }

  using SweepStore::put;
  StatusOr<SweepRecord> put(const ItemClaim& claim, const std::vector<PointRow>& rows, const WorkUsage& usage,
                            Time now) override {
    static constexpr std::string_view kEnd =
        "DELETE FROM sweep_leases USING sweeps WHERE seq = sweep AND number = $1 AND NOT removed"
        " AND id = $3 AND first = $4 AND units = $5 AND until_us >= coalesce($2, snapthrough_now())"
        " RETURNING sweep, first, units, crashes, unit_points";
    static const std::string kRecord = "SELECT " + columns() + " FROM sweeps WHERE seq = $1";
    // The items are compared too: after a crash of the database's machine the number may belong to another
    // claim.
    Parameters held;
    held.add(claim.number).add(clock_.at(now)).add(claim.sweep);
    held.add(static_cast<std::int64_t>(claim.items.first)).add(static_cast<std::int64_t>(claim.items.count));
    const std::vector<Statement> end{
        {"SELECT hold_claims(seq) FROM sweeps WHERE id = $1", Parameters().add(claim.sweep)}, {kEnd, held}};
    const auto work = [&](Connection& connection) -> StatusOr<SweepRecord> {
      const std::vector<Rows> held_and_ended = connection.run_all(end);
      const Rows& ended = held_and_ended.back();
      if (ended.empty()) {
        return Status(StatusCode::conflict, "sweep " + claim.sweep + " does not run any more");
      }
      const HeldItems lease = read_held(ended[0]);
      settle(connection, lease, rows, held_and_ended.front()[0].boolean(0), clock_.at(now));
      add_usage(connection, lease.sweep, rows.size(), usage, clock_.at(now));
      return read_record(connection.run(kRecord, Parameters().add(lease.sweep))[0]);
    };
    return database_.write<SweepRecord>(work, rows.empty() ? Durability::unsynced : Durability::synced);
  }

  StatusOr<std::int64_t> recover(int /*max_crashes*/, Time /*now*/) override {
    return std::int64_t{0};  // a process that is gone is seen by its leases
  }

  StatusOr<std::int64_t> rescue(std::string_view worker, int max_crashes, Time now) override {
    static constexpr std::string_view kLate =
        "SELECT number, sweep FROM sweep_leases WHERE until_us < coalesce($1, snapthrough_now()) ORDER BY "
        "sweep, number";
    static constexpr std::string_view
        kEnd =  // nothing when the lease was renewed, or another process ended it
        "DELETE FROM sweep_leases USING sweeps WHERE seq = sweep AND number = $1"
        " AND until_us < coalesce($2, snapthrough_now())"
        " RETURNING sweep, first, units, crashes, unit_points, worker";
    return database_.write<std::int64_t>([&](Connection& connection) -> StatusOr<std::int64_t> {
      const Rows late = connection.run(kLate, Parameters().add(clock_.at(now)));
      std::int64_t again = 0;
      bool alone = false;
      for (int row = 0; row < late.count(); ++row) {
        if (row == 0 || late[row].integer(1) != late[row - 1].integer(1)) {
          alone =
              connection.run("SELECT hold_claims($1)", Parameters().add(late[row].integer(1)))[0].boolean(0);
        }
        const Rows ended = connection.run(kEnd, Parameters().add(late[row].integer(0)).add(clock_.at(now)));
        if (ended.empty()) {
          continue;
        }
        HeldItems lease = read_held(ended[0]);
        const bool given_up = lost_items(ended[0].text(5), worker, max_crashes, lease).given_up;
        settle(connection, lease, given_up ? crashed_rows(lease) : std::vector<PointRow>(), alone,
               clock_.at(now));
        again += given_up ? 0 : static_cast<std::int64_t>(lease.items.count);
      }
      return again;
    });
  }

  StatusOr<std::int64_t> unfinished() override {
    return database_.read<std::int64_t>([](Connection& connection) {
      return connection
          .run("SELECT count(*) FROM sweeps WHERE " + may(SweepEvent::dismiss) + " AND NOT removed")[0]
          .integer(0);
    });
  }

  StatusOr<std::vector<std::string>> with_items() override {
    return database_.read<std::vector<std::string>>([](Connection& connection) {
      return connection
          .run("SELECT id FROM sweeps WHERE " + may(SweepEvent::dismiss) +
               " AND NOT removed AND EXISTS (SELECT FROM sweep_left WHERE sweep = seq)"
               " ORDER BY row_number() OVER (PARTITION BY owner ORDER BY seq), seq")
          .texts(0);
    });
  }

  StatusOr<std::optional<OpenSweep>> open(std::string_view id) override {
    return database_.read<std::optional<OpenSweep>>([&](Connection& connection) -> std::optional<OpenSweep> {
      const Rows rows = connection.run(
          "SELECT document, owner, reuse FROM sweeps JOIN sweep_documents ON sweep = seq"
          " WHERE id = $1 AND NOT removed AND " +
              may(SweepEvent::dismiss),
          Parameters().add(id));
      return rows.empty() ? std::nullopt
                          : std::optional(OpenSweep{rows[0].text(0), rows[0].text(1), rows[0].boolean(2)});
    });
  }

  StatusOr<std::optional<SweepRecord>> get(std::string_view id) override {
    static const std::string kSql = "SELECT " + columns() + " FROM sweeps WHERE id = $1 AND NOT removed";
    return database_.read<std::optional<SweepRecord>>(
        [&](Connection& connection) -> std::optional<SweepRecord> {
          const Rows rows = connection.run(kSql, Parameters().add(id));
          return rows.empty() ? std::nullopt : std::optional(read_record(rows[0]));
        });
  }

  StatusOr<SweepPage> list(const ListQuery& query) override {
    return database_.read<SweepPage>([&](Connection& connection) {
      static const ListedTable kSweeps{"sweeps", columns().c_str(), kColumnCount, " AND NOT removed"};
      auto [sweeps, next] = read_page<SweepRecord>(connection, kSweeps, query, read_record);
      return SweepPage{std::move(sweeps), next};
    });
  }

  StatusOr<std::optional<std::string>> document(std::string_view id) override {
    return database_.read<std::optional<std::string>>(
        [&](Connection& connection) -> std::optional<std::string> {
          const Rows rows = connection.run(
              "SELECT document FROM sweep_documents JOIN sweeps ON seq = sweep WHERE id = $1 AND NOT removed",
              Parameters().add(id));
          return rows.empty() ? std::nullopt : std::optional(rows[0].text(0));
        });
  }

  Status each_row(std::string_view id, const PointQuery& query,
                  const std::function<bool(std::uint64_t, const api::PointOutcome&)>& use) override {
    static constexpr std::string_view kSql =
        "SELECT first, rows FROM sweep_rows WHERE sweep = (SELECT seq FROM sweeps WHERE id = $1 AND NOT "
        "removed)"
        " AND first >= coalesce((SELECT first FROM sweep_rows WHERE first <= $2"
        "   AND sweep = (SELECT seq FROM sweeps WHERE id = $1) ORDER BY first DESC LIMIT 1), 0)"
        " AND first + points > $2"
        " AND first > $3 AND first < $4 AND (failed > 0 OR NOT $5) ORDER BY first LIMIT $6";
    const auto [first, end] = points_of(query);
    std::int64_t last = -1;
    for (int most = 1;; most = std::min(2 * most, kReadAtOnce)) {
      Parameters page;
      page.add(id).add(first).add(last).add(end);
      page.add(query.failed.value_or(false)).add(most);
      const StatusOr<std::vector<std::string>> read =
          database_.read<std::vector<std::string>>([&](Connection& connection) {
            const Rows rows = connection.run(kSql, page);
            std::vector<std::string> packs;
            for (int row = 0; row < rows.count(); ++row) {
              last = rows[row].integer(0);
              packs.push_back(rows[row].text(1));
            }
            return packs;
          });
      if (!read.ok()) {
        return read.status();
      }
      for (const std::string& pack : *read) {
        const StatusOr<bool> more = use_rows(pack, query, use);
        if (!more.ok() || !*more) {
          return more.status();
        }
      }
      if (read->size() < static_cast<std::size_t>(most)) {
        return {};
      }
    }
  }

  StatusOr<std::vector<std::optional<std::string>>> find_outputs(
      const std::vector<std::string>& keys) override {
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
        return found;  // without a known key in the sample, all points are computed
      }
      for (const auto& [sweep, first] : places_of(connection, some)) {
        const Rows rows = connection.run("SELECT rows FROM sweep_rows WHERE sweep = $1 AND first = $2",
                                         Parameters().add(sweep).add(first));
        for (const PointRow& point : rows.empty() ? std::vector<PointRow>() : unpack_rows(rows[0].text(0))) {
          const auto [begin, end] = wanted.equal_range(point.key);
          for (auto place = begin; place != end && !point.outcome.failed(); ++place) {
            found[place->second] = point.outcome.outputs;
          }
        }
      }
      return found;
    });
  }

 private:
  Database& database_;
  const Clock clock_;
};

}  // namespace

std::unique_ptr<SweepStore> sweeps_in(Database& database, Clock clock) {
  return std::make_unique<PostgresqlSweepStore>(database, clock);
}

}  // namespace snapthrough::server::postgresql
