/// Sweeps in SQLite.

#include <algorithm>
#include <string>
#include <utility>

#include "api/provenance.h"
#include "server/store/crashes.h"
#include "server/store/sqlite/list.h"
#include "server/store/sqlite/parts.h"

namespace snapthrough::server::sqlite {
namespace {

/// Columns of read_record().
const std::string& columns() {
  static const std::string kColumns = std::string(kSweepColumns) +
                                      ", sweeps.successful, sweeps.failed, sweeps.reused, sweeps.program,"
                                      " sweeps.cpu_us, sweeps.peak_bytes, sweeps.factorizations";
  return kColumns;
}
constexpr int kColumnCount = kSweepColumnCount + 7;

SweepRecord read_record(const Row& row) {
  SweepRecord sweep = read_sweep(row);
  sweep.successful = row.integer(kSweepColumnCount);
  sweep.failed = row.integer(kSweepColumnCount + 1);
  sweep.reused = row.integer(kSweepColumnCount + 2);
  sweep.program = row.text(kSweepColumnCount + 3);
  sweep.usage = read_work_usage(row, kSweepColumnCount + 4);
  return sweep;
}

std::optional<StoredSweep> find(const Connection& connection, std::string_view id) {
  Statement row = connection.query("SELECT seq, status FROM sweeps WHERE id = ? AND removed = 0", id);
  return row.step() ? std::optional(StoredSweep{row.integer(0), row.state(1)}) : std::nullopt;
}

std::optional<Submitted> find_key_in(const Connection& connection, const IdempotencyKey& key,
                                     std::string_view owner) {
  Statement row = connection.query(
      "SELECT sweep_keys.fingerprint, sweeps.id FROM sweep_keys JOIN sweeps ON sweeps.seq = sweep"
      " WHERE sweep_keys.owner = ? AND sweep_keys.key = ? AND removed = 0",
      owner, key.key);
  return row.step() ? std::optional(known_key(row, key)) : std::nullopt;
}

/// Inserts free items of a sweep.
void insert_left(Connection& connection, std::int64_t sweep, const ItemRun& items, std::int64_t crashes) {
  connection.run("INSERT INTO sweep_left (sweep, first, units, crashes) VALUES (?, ?, ?, ?)", sweep,
                 static_cast<std::int64_t>(items.first), static_cast<std::int64_t>(items.count), crashes);
}

void insert_sweep(Connection& connection, const NewSweep& sweep) {
  connection.run(
      "INSERT INTO sweeps (id, owner, title, reuse, points, created_us, analysis_type, label, metadata,"
      " callback, unit_points, request_sha256) VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)",
      sweep.id, sweep.owner, sweep.title, sweep.reuse ? 1 : 0, sweep.points, to_row(sweep.created),
      sweep.analysis_type, text_or_null(sweep.annotations.label), text_or_null(sweep.annotations.metadata),
      text_or_null(sweep.annotations.callback), sweep.item_points, text_or_null(sweep.request_sha256));
  const std::int64_t row = connection.last_row();
  insert_left(connection, row, {0, static_cast<std::uint64_t>(sweep.points / sweep.item_points)}, 0);
  connection.run("INSERT INTO sweep_documents (sweep, document) VALUES (?, ?)", row, sweep.document);
  if (sweep.idempotency) {
    connection.run(
        "INSERT OR REPLACE INTO sweep_keys (owner, key, fingerprint, sweep, created_us)"
        " VALUES (?, ?, ?, ?, ?)",
        sweep.owner, sweep.idempotency->key, sweep.idempotency->fingerprint, row, to_row(sweep.created));
  }
}

/// Inserts the row of a point unless the point has one; returns whether it did.
bool insert_point(Connection& connection, std::int64_t sweep, const PointRow& row) {
  const bool failed = row.outcome.failed();
  const auto text = [](bool there, const std::string& value) {
    return there ? std::optional<std::string_view>(value) : std::nullopt;
  };
  connection.run(
      "INSERT INTO sweep_points (sweep, point, outputs, code, detail, content_key)"
      " VALUES (?, ?, ?, ?, ?, ?) ON CONFLICT DO NOTHING",
      sweep, static_cast<std::int64_t>(row.point), text(!failed, row.outcome.outputs),
      text(failed, row.outcome.code), text(failed, row.outcome.detail),
      text(!failed && !row.key.empty(), row.key));
  return connection.changes() > 0;
}

/// Inserts rows and counts them; ends the sweep when all points have a row.
void insert_points(Connection& connection, std::int64_t sweep, const std::vector<PointRow>& rows, Time now) {
  static const std::string kEnd = "UPDATE sweeps SET status = iif(failed > 0, " +
                                  literal(state_after(SweepEvent::fail)) + ", " +
                                  literal(state_after(SweepEvent::finish)) +
                                  "), finished_us = ? WHERE seq = ? AND successful + failed = points";
  RowCounts counts;
  for (const PointRow& row : rows) {
    if (insert_point(connection, sweep, row)) {
      counts.add(row);
    }
  }
  connection.run(
      "UPDATE sweeps SET successful = successful + ?, failed = failed + ?, reused = reused + ?,"
      " bytes = bytes + ? WHERE seq = ?",
      counts.successful, counts.failed, counts.reused, counts.bytes, sweep);
  connection.run(kEnd, to_row(now), sweep);
}

/// Counts what this program took to compute rows of a sweep.
void add_usage(Connection& connection, std::int64_t sweep, std::size_t rows, const WorkUsage& usage,
               Time now) {
  if (rows == 0) {
    return;
  }
  connection.run(
      "UPDATE sweeps SET program = ?, cpu_us = ifnull(cpu_us, 0) + ?,"
      " peak_bytes = max(ifnull(peak_bytes, 0), ?), factorizations = ifnull(factorizations, 0) + ?"
      " WHERE seq = ?",
      api::program_text(), usage.cpu_us, usage.peak_bytes, usage.factorizations, sweep);
  static const std::string kAdd =
      "INSERT INTO usage (owner, hour, label, points, cpu_us, peak_bytes, factorizations)"
      " SELECT owner, ?, ifnull(label, ''), ?, ?, ?, ? FROM sweeps WHERE seq = ? " +
      std::string(kAddUsage);
  connection.run(kAdd, hour_of(now), static_cast<std::int64_t>(rows), usage.cpu_us, usage.peak_bytes,
                 usage.factorizations, sweep);
}

/// Notes an event of a sweep for its owner.
void note_event(Connection& connection, std::string_view event, std::int64_t sweep, Time now) {
  connection.run(
      "INSERT INTO audit (owner, at_us, event, sweep, entry) SELECT owner, ?, ?, 1, id FROM sweeps"
      " WHERE seq = ?",
      to_row(now), event, sweep);
}

/// Removes at most `most` free items of a sweep from `sweep_left` and returns them.
std::optional<HeldItems> take_left(Connection& connection, std::int64_t sweep, std::uint64_t most) {
  Statement row = connection.query(
      "SELECT first, units, crashes FROM sweep_left WHERE sweep = ? ORDER BY crashes, first LIMIT 1", sweep);
  if (!row.step()) {
    return std::nullopt;
  }
  const ItemRun run{row.number(0), row.number(1)};
  const std::int64_t crashes = row.integer(2);
  const std::uint64_t taken = std::min(most_after_crashes(most, crashes), run.count);
  connection.run("DELETE FROM sweep_left WHERE sweep = ? AND first = ?", sweep, row.integer(0));
  if (taken < run.count) {
    insert_left(connection, sweep, {run.first + taken, run.count - taken}, crashes);
  }
  return HeldItems{sweep, {run.first, taken}, crashes};
}

/// Columns of read_held(), from sweep_claims JOIN sweeps.
constexpr const char* kHeldColumns = "sweep, first, units, crashes, unit_points";
HeldItems read_held(const Row& row) {
  return {row.integer(0), {row.number(1), row.number(2)}, row.integer(3), row.integer(4)};
}

/// Ends a claim and returns its items; empty when the claim has ended or its lease has run out.
std::optional<HeldItems> end_claim(Connection& connection, const ItemClaim& claim, Time now) {
  static const std::string kSql = "SELECT " + std::string(kHeldColumns) +
                                  " FROM sweep_claims JOIN sweeps ON seq = sweep"
                                  " WHERE number = ? AND lease_until_us >= ?";
  Statement row = connection.query(kSql, claim.number, to_row(now));
  if (!row.step()) {
    return std::nullopt;
  }
  const HeldItems held = read_held(row);
  connection.run("DELETE FROM sweep_claims WHERE number = ?", claim.number);
  return held;
}

/// A claim whose lease has run out.
struct LateClaim {
  std::int64_t number = 0;
  HeldItems held;
  LostLease lost;
};

/// Ends claims whose lease ends before `ended_before`, by the decisions of lost_items(). Returns how many
/// items are given out again.
std::int64_t take_claims_back(Connection& connection, Time ended_before, std::string_view rescuer,
                              int max_crashes, Time now) {
  static const std::string kSql = "SELECT " + std::string(kHeldColumns) +
                                  ", number, worker FROM sweep_claims JOIN sweeps ON seq = sweep"
                                  " WHERE lease_until_us < ? ORDER BY number";
  std::vector<LateClaim> claims;
  Statement row = connection.query(kSql, to_row(ended_before));
  while (row.step()) {
    LateClaim& late = claims.emplace_back(LateClaim{row.integer(5), read_held(row), {}});
    late.lost = lost_items(row.text(6), rescuer, max_crashes, late.held);
  }
  std::int64_t again = 0;
  for (const auto& [number, held, lost] : claims) {
    connection.run("DELETE FROM sweep_claims WHERE number = ?", number);
    if (lost.given_up) {
      insert_points(connection, held.sweep, crashed_rows(held), now);
      continue;
    }
    insert_left(connection, held.sweep, held.items, held.crashes);
    again += static_cast<std::int64_t>(held.items.count);
  }
  return again;
}

/// Items of a sweep with the points that have a row.
ItemRows stored_rows(const Connection& connection, std::int64_t sweep, const ItemRun& items,
                     std::int64_t item_points) {
  ItemRows stored(items, item_points);
  Statement row =
      connection.query("SELECT point FROM sweep_points WHERE sweep = ? AND point >= ? AND point < ?", sweep,
                       static_cast<std::int64_t>(items.first) * item_points,
                       static_cast<std::int64_t>(items.first + items.count) * item_points);
  while (row.step()) {
    stored.add(row.number(0));
  }
  return stored;
}

/// Removes the failed rows of a sweep that has ended, and gives out all items that lack a row.
void forget_failures(Connection& connection, std::int64_t sweep) {
  connection.run("DELETE FROM sweep_points WHERE sweep = ? AND code IS NOT NULL", sweep);
  connection.run("DELETE FROM sweep_left WHERE sweep = ?", sweep);
  Statement row =
      connection.query("SELECT points / unit_points, unit_points FROM sweeps WHERE seq = ?", sweep);
  row.step();
  const ItemRows stored = stored_rows(connection, sweep, {0, row.number(0)}, row.integer(1));
  for (const ItemRun& run : joined(stored.left())) {
    insert_left(connection, sweep, run, 0);
  }
}

class SqliteSweepStore final : public SweepStore {
 public:
  explicit SqliteSweepStore(Database& database) : database_(database) {}

  StatusOr<Submitted> submit(const NewSweep& sweep) override {
    return database_.write<Submitted>([&](Connection& connection) -> StatusOr<Submitted> {
      if (sweep.idempotency) {
        if (const std::optional<Submitted> known = find_key_in(connection, *sweep.idempotency, sweep.owner)) {
          return *known;
        }
      }
      const Usage addition{0, sweep.points, static_cast<std::int64_t>(sweep.document.size())};
      if (Status status = admit(connection, sweep.owner, sweep.quotas, addition, sweep.created);
          !status.ok()) {
        return status;
      }
      insert_sweep(connection, sweep);
      return Submitted{Submitted::Kind::created, sweep.id};
    });
  }

  StatusOr<std::optional<Submitted>> find_key(const IdempotencyKey& key, std::string_view owner) override {
    return database_.read<std::optional<Submitted>>(
        [&](const Connection& connection) { return find_key_in(connection, key, owner); });
  }

  StatusOr<std::vector<UsedKey>> keys(std::string_view id) override {
    return database_.read<std::vector<UsedKey>>([&](const Connection& connection) {
      return used_keys(connection.query(
          "SELECT key, fingerprint, sweep_keys.created_us FROM sweep_keys"
          " JOIN sweeps ON sweeps.seq = sweep WHERE sweeps.id = ? AND NOT removed ORDER BY key",
          id));
    });
  }

  Status add_key(std::string_view id, const UsedKey& used) override {
    return database_.write_only([&](Connection& connection) {
      connection.run(
          "INSERT OR IGNORE INTO sweep_keys (owner, key, fingerprint, sweep, created_us)"
          " SELECT owner, ?, ?, seq, ? FROM sweeps WHERE id = ? AND NOT removed",
          used.key.key, used.key.fingerprint, to_row(used.first_used), id);
      return Status();
    });
  }

  StatusOr<std::optional<ItemClaim>> claim(std::string_view id, std::uint64_t most, const Lease& lease,
                                           Time now) override {
    using Outcome = StatusOr<std::optional<ItemClaim>>;
    static const std::string kBegin = "UPDATE sweeps SET " + becomes(SweepEvent::claim) +
                                      ", started_us = ifnull(started_us, ?) WHERE seq = ?";
    return database_.write<std::optional<ItemClaim>>(
        [&](Connection& connection) -> Outcome {
          const std::optional<StoredSweep> place = find(connection, id);
          if (!place || !next_state(place->state, SweepEvent::claim)) {
            return Status(StatusCode::conflict, "sweep " + std::string(id) + " is over");
          }
          const std::optional<HeldItems> taken = take_left(connection, place->row, most);
          if (!taken) {
            return std::optional<ItemClaim>();
          }
          if (place->state != state_after(SweepEvent::claim)) {
            connection.run(kBegin, to_row(now), place->row);
          }
          connection.run(
              "INSERT INTO sweep_claims (sweep, first, units, crashes, worker, lease_until_us)"
              " VALUES (?, ?, ?, ?, ?, ?)",
              place->row, static_cast<std::int64_t>(taken->items.first),
              static_cast<std::int64_t>(taken->items.count), taken->crashes, lease.worker,
              to_row(lease.until));
          return std::optional(ItemClaim{connection.last_row(), std::string(id), taken->items});
        },
        Durability::unsynced);
  }

  StatusOr<std::vector<std::int64_t>> renew(const std::vector<ItemClaim>& claims, Time until,
                                            Time now) override {
    return database_.write<std::vector<std::int64_t>>(
        [&](Connection& connection) -> StatusOr<std::vector<std::int64_t>> {
          std::vector<std::int64_t> lost;
          for (const ItemClaim& claim : claims) {
            connection.run(
                "UPDATE sweep_claims SET lease_until_us = ? WHERE number = ? AND lease_until_us >= ?",
                to_row(until), claim.number, to_row(now));
            if (connection.changes() == 0) {
              lost.push_back(claim.number);
            }
          }
          return lost;
        },
        Durability::unsynced);
  }

  using SweepStore::put;
  StatusOr<SweepRecord> put(const ItemClaim& claim, const std::vector<PointRow>& rows, const WorkUsage& usage,
                            Time now) override {
    return database_.write<SweepRecord>(
        [&](Connection& connection) -> StatusOr<SweepRecord> {
          const std::optional<StoredSweep> place = find(connection, claim.sweep);
          const std::optional<HeldItems> held = end_claim(connection, claim, now);
          if (!place || !next_state(place->state, SweepEvent::finish) || !held) {
            return Status(StatusCode::conflict, "sweep " + claim.sweep + " does not run any more");
          }
          insert_points(connection, place->row, rows, now);
          add_usage(connection, place->row, rows.size(), usage, now);
          for (const ItemRun& run :
               stored_rows(connection, held->sweep, held->items, held->item_points).left()) {
            insert_left(connection, held->sweep, run, held->crashes);
          }
          Statement row = connection.query("SELECT " + columns() + " FROM sweeps WHERE seq = ?", place->row);
          row.step();
          return read_record(row);
        },
        rows.empty() ? Durability::unsynced : Durability::synced);
  }

  StatusOr<std::int64_t> recover(int max_crashes, Time now) override {
    return database_.write<std::int64_t>([&](Connection& connection) -> StatusOr<std::int64_t> {
      return take_claims_back(connection, Time::max(), "", max_crashes, now);
    });
  }

  StatusOr<std::int64_t> rescue(std::string_view worker, int max_crashes, Time now) override {
    return database_.write<std::int64_t>([&](Connection& connection) -> StatusOr<std::int64_t> {
      return take_claims_back(connection, now, worker, max_crashes, now);
    });
  }

  StatusOr<SweepChange> dismiss(std::string_view id, Time now) override {
    static const std::string kEnd =
        "UPDATE sweeps SET " + becomes(SweepEvent::dismiss) + ", finished_us = ? WHERE seq = ?";
    return database_.write<SweepChange>([&](Connection& connection) -> StatusOr<SweepChange> {
      const std::optional<StoredSweep> place = find(connection, id);
      if (!place) {
        return SweepChange{};
      }
      if (!next_state(place->state, SweepEvent::dismiss)) {
        return SweepChange{place->state, false};
      }
      connection.run(kEnd, to_row(now), place->row);
      connection.run(
          "INSERT INTO sweep_left (sweep, first, units, crashes)"
          " SELECT sweep, first, units, crashes FROM sweep_claims WHERE sweep = ?",
          place->row);
      connection.run("DELETE FROM sweep_claims WHERE sweep = ?", place->row);
      return SweepChange{place->state, true};
    });
  }

  StatusOr<SweepChange> retry(std::string_view id, const Quotas& quotas, Time now) override {
    static const std::string kAgain =
        "UPDATE sweeps SET failed = 0, " + becomes(SweepEvent::retry) +
        ", finished_us = NULL, bytes = max(0, bytes -"
        " (SELECT ifnull(sum(length(CAST(code || detail AS BLOB))), 0) FROM sweep_points"
        " WHERE sweep = seq AND code IS NOT NULL)) WHERE seq = ?";
    return database_.write<SweepChange>([&](Connection& connection) -> StatusOr<SweepChange> {
      const std::optional<StoredSweep> place = find(connection, id);
      if (!place) {
        return SweepChange{};
      }
      if (!next_state(place->state, SweepEvent::retry)) {
        return SweepChange{place->state, false};
      }
      Statement sweep =
          connection.query("SELECT owner, points - successful FROM sweeps WHERE seq = ?", place->row);
      sweep.step();
      if (Status status = admit(connection, sweep.text(0), quotas, {0, sweep.integer(1), 0}, now);
          !status.ok()) {
        return status;
      }
      connection.run(kAgain, place->row);
      note_event(connection, to_string(AuditEvent::retried), place->row, now);
      forget_failures(connection, place->row);
      return SweepChange{place->state, true};
    });
  }

  using SweepStore::remove;
  StatusOr<bool> remove(std::string_view id, std::optional<Time> noted) override {
    return database_.write<bool>([&](Connection& connection) -> StatusOr<bool> {
      if (const std::optional<StoredSweep> place = find(connection, id); place && noted) {
        note_event(connection, to_string(AuditEvent::deleted), place->row, *noted);
      }
      connection.run("UPDATE sweeps SET removed = 1 WHERE id = ? AND removed = 0", id);
      return connection.changes() > 0;
    });
  }

  StatusOr<int> retire(std::chrono::seconds age, Time now) override {
    return database_.write<int>([&](Connection& connection) -> StatusOr<int> {
      connection.run(
          "INSERT INTO audit (owner, at_us, event, sweep, entry) SELECT owner, ?, 'retired', 1, id"
          " FROM sweeps WHERE finished_us < ? AND removed = 0",
          to_row(now), to_row(now - age));
      connection.run("UPDATE sweeps SET removed = 1 WHERE finished_us < ? AND removed = 0",
                     to_row(now - age));
      return static_cast<int>(connection.changes());
    });
  }

  StatusOr<bool> purge(int most) override {
    return database_.write<bool>([&](Connection& connection) -> StatusOr<bool> {
      Statement row = connection.prepare("SELECT seq FROM sweeps WHERE removed = 1 ORDER BY seq LIMIT 1");
      if (!row.step()) {
        return false;
      }
      const std::int64_t sweep = row.integer(0);
      connection.run(
          "DELETE FROM sweep_points WHERE sweep = ? AND point IN"
          " (SELECT point FROM sweep_points WHERE sweep = ? LIMIT ?)",
          sweep, sweep, most);
      if (connection.changes() < most) {
        connection.run("DELETE FROM sweeps WHERE seq = ?", sweep);
      }
      return true;
    });
  }

  Status forget_keys(std::chrono::seconds age, Time now) override {
    return database_.write_only([&](Connection& connection) {
      connection.run("DELETE FROM sweep_keys WHERE created_us < ?", to_row(now - age));
      return Status();
    });
  }

  StatusOr<std::int64_t> unfinished() override {
    return database_.read<std::int64_t>([](const Connection& connection) {
      static const std::string kSql =
          "SELECT count(*) FROM sweeps WHERE " + may(SweepEvent::dismiss) + " AND removed = 0";
      Statement row = connection.prepare(kSql);
      row.step();
      return row.integer(0);
    });
  }

  StatusOr<std::vector<std::string>> with_items() override {
    return database_.read<std::vector<std::string>>([](const Connection& connection) {
      static const std::string kSql =
          "SELECT id FROM sweeps WHERE " + may(SweepEvent::dismiss) +
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

  StatusOr<std::optional<OpenSweep>> open(std::string_view id) override {
    return database_.read<std::optional<OpenSweep>>(
        [&](const Connection& connection) -> std::optional<OpenSweep> {
          static const std::string kSql =
              "SELECT document, owner, reuse FROM sweeps JOIN sweep_documents ON sweep = seq"
              " WHERE id = ? AND removed = 0 AND " +
              may(SweepEvent::dismiss);
          Statement row = connection.query(kSql, id);
          return row.step() ? std::optional(OpenSweep{row.text(0), row.text(1), row.integer(2) == 1})
                            : std::nullopt;
        });
  }

  StatusOr<std::optional<SweepRecord>> get(std::string_view id) override {
    return database_.read<std::optional<SweepRecord>>(
        [&](const Connection& connection) -> std::optional<SweepRecord> {
          Statement row =
              connection.query("SELECT " + columns() + " FROM sweeps WHERE id = ? AND removed = 0", id);
          return row.step() ? std::optional(read_record(row)) : std::nullopt;
        });
  }

  StatusOr<SweepPage> list(const ListQuery& query) override {
    return database_.read<SweepPage>([&](const Connection& connection) {
      static const ListedTable kSweeps{"sweeps", columns().c_str(), kColumnCount, " AND removed = 0"};
      auto [sweeps, next] = read_page<SweepRecord>(connection, kSweeps, query, read_record);
      return SweepPage{std::move(sweeps), next};
    });
  }

  StatusOr<std::optional<std::string>> document(std::string_view id) override {
    return database_.read<std::optional<std::string>>(
        [&](const Connection& connection) -> std::optional<std::string> {
          Statement row = connection.query(
              "SELECT document FROM sweep_documents JOIN sweeps ON seq = sweep WHERE id = ? AND removed = 0",
              id);
          return row.step() ? std::optional(row.text(0)) : std::nullopt;
        });
  }

  Status each_row(std::string_view id, const PointQuery& query,
                  const std::function<bool(std::uint64_t, const api::PointOutcome&)>& use) override {
    const auto points = points_of(query);
    const StatusOr<bool> read = database_.read<bool>([&](const Connection& connection) {
      std::string sql =
          "SELECT point, outputs, code, detail FROM sweep_points"
          " WHERE sweep = (SELECT seq FROM sweeps WHERE id = ? AND removed = 0) AND point >= ? AND point < ?";
      if (query.failed) {
        sql += *query.failed ? " AND code IS NOT NULL" : " AND code IS NULL";
      }
      Statement rows = connection.query(sql + " ORDER BY point", id, points.first, points.second);
      while (rows.step() && use(rows.number(0), {rows.text(1), rows.text(2), rows.text(3)})) {
      }
      return true;
    });
    return read.status();
  }

  StatusOr<std::vector<std::optional<std::string>>> find_outputs(
      const std::vector<std::string>& keys) override {
    using Found = std::vector<std::optional<std::string>>;
    return database_.read<Found>([&](const Connection& connection) {
      Found found;
      for (const std::string& key : keys) {
        Statement row = connection.query(
            "SELECT outputs FROM sweep_points WHERE content_key = ? AND outputs IS NOT NULL LIMIT 1", key);
        found.push_back(row.step() ? std::optional(row.text(0)) : std::nullopt);
      }
      return found;
    });
  }

 private:
  Database& database_;
};

}  // namespace

std::unique_ptr<SweepStore> sweeps_in(Database& database) {
  return std::make_unique<SqliteSweepStore>(database);
}

}  // namespace snapthrough::server::sqlite
