/// What happens to sweeps: verbs that write.

#include "server/store/sqlite/sweeps.h"

#include <algorithm>
#include <utility>

#include "server/store/crashes.h"
#include "server/store/sqlite/quotas.h"
#include "server/store/sqlite/rows.h"
#include "server/store/unit_runs.h"

namespace snapthrough::server::sqlite {
namespace {

/// A sweep that is there: row number and status.
struct Place {
  std::int64_t row = 0;
  JobState state = JobState::accepted;
};

std::optional<Place> find(const Connection& connection, std::string_view id) {
  Statement row = connection.prepare("SELECT seq, status FROM sweeps WHERE id = ? AND removed = 0");
  row.bind(id);
  return row.step() ? std::optional(Place{row.integer(0), state_in(row, 1)}) : std::nullopt;
}

std::optional<Submitted> known_key(const Connection& connection, const IdempotencyKey& key,
                                   std::string_view owner) {
  Statement row = connection.prepare(
      "SELECT sweep_keys.fingerprint, sweeps.id FROM sweep_keys JOIN sweeps ON sweeps.seq = sweep"
      " WHERE sweep_keys.owner = ? AND sweep_keys.key = ? AND removed = 0");
  row.bind(owner).bind(key.key);
  return known_key(row, key);
}

/// Units that anybody may have.
void insert_left(Connection& connection, std::int64_t sweep, const UnitRun& units, std::int64_t crashes) {
  connection.prepare("INSERT INTO sweep_left (sweep, first, units, crashes) VALUES (?, ?, ?, ?)")
      .bind(sweep)
      .bind(static_cast<std::int64_t>(units.first))
      .bind(static_cast<std::int64_t>(units.count))
      .bind(crashes)
      .run();
}

void insert_sweep(Connection& connection, const NewSweep& sweep) {
  connection
      .prepare(
          "INSERT INTO sweeps (id, owner, title, reuse, points, created_us, analysis_type, label, metadata,"
          " callback, unit_points) VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)")
      .bind(sweep.id)
      .bind(sweep.owner)
      .bind(sweep.title)
      .bind(sweep.reuse ? 1 : 0)
      .bind(sweep.points)
      .bind(to_row(sweep.created))
      .bind(sweep.analysis_type)
      .bind(text_or_null(sweep.annotations.label))
      .bind(text_or_null(sweep.annotations.metadata))
      .bind(text_or_null(sweep.annotations.callback))
      .bind(sweep.unit_points)
      .run();
  const std::int64_t row = connection.last_row();
  insert_left(connection, row, {0, static_cast<std::uint64_t>(sweep.points / sweep.unit_points)}, 0);
  connection.prepare("INSERT INTO sweep_documents (sweep, document) VALUES (?, ?)")
      .bind(row)
      .bind(sweep.document)
      .run();
  if (sweep.idempotency) {
    connection
        .prepare(
            "INSERT OR REPLACE INTO sweep_keys (owner, key, fingerprint, sweep, created_us)"
            " VALUES (?, ?, ?, ?, ?)")
        .bind(sweep.owner)
        .bind(sweep.idempotency->key)
        .bind(sweep.idempotency->fingerprint)
        .bind(row)
        .bind(to_row(sweep.created))
        .run();
  }
}

/// Whether the row is new.
bool insert_point(Connection& connection, std::int64_t sweep, const PointRow& row) {
  const bool failed = row.outcome.failed();
  const auto text = [](bool there, const std::string& value) {
    return there ? std::optional<std::string_view>(value) : std::nullopt;
  };
  connection
      .prepare(
          "INSERT INTO sweep_points (sweep, point, outputs, code, detail, content_key)"
          " VALUES (?, ?, ?, ?, ?, ?) ON CONFLICT DO NOTHING")
      .bind(sweep)
      .bind(static_cast<std::int64_t>(row.point))
      .bind(text(!failed, row.outcome.outputs))
      .bind(text(failed, row.outcome.code))
      .bind(text(failed, row.outcome.detail))
      .bind(text(!failed && !row.key.empty(), row.key))
      .run();
  return connection.changes() > 0;
}

struct Counts {
  std::int64_t successful = 0;
  std::int64_t failed = 0;
  std::int64_t reused = 0;
  std::int64_t bytes = 0;
};

/// Inserts rows and counts them; when all points have one, the sweep ends.
void insert_points(Connection& connection, std::int64_t sweep, const std::vector<PointRow>& rows, Time now) {
  Counts counts;
  for (const PointRow& row : rows) {
    if (insert_point(connection, sweep, row)) {
      (row.outcome.failed() ? counts.failed : counts.successful) += 1;
      counts.reused += row.reused ? 1 : 0;
      counts.bytes += static_cast<std::int64_t>(row.outcome.outputs.size() + row.outcome.code.size() +
                                                row.outcome.detail.size());
    }
  }
  connection
      .prepare(
          "UPDATE sweeps SET successful = successful + ?, failed = failed + ?, reused = reused + ?,"
          " bytes = bytes + ? WHERE seq = ?")
      .bind(counts.successful)
      .bind(counts.failed)
      .bind(counts.reused)
      .bind(counts.bytes)
      .bind(sweep)
      .run();
  connection
      .prepare(
          "UPDATE sweeps SET status = iif(failed > 0, ?, ?), finished_us = ?"
          " WHERE seq = ? AND successful + failed = points")
      .bind(to_string(JobState::failed))
      .bind(to_string(JobState::successful))
      .bind(to_row(now))
      .bind(sweep)
      .run();
}

/// A claim as it is stored.
struct StoredClaim {
  std::int64_t number = 0;
  std::int64_t sweep = 0;
  UnitRun units;
  std::int64_t crashes = 0;
  bool crashed = false;  ///< its process has died
};

/// Units of a sweep that nobody has, at most `most`; taken out of what is left.
std::optional<StoredClaim> take_left(Connection& connection, std::int64_t sweep, std::uint64_t most) {
  Statement row = connection.prepare(
      "SELECT first, units, crashes FROM sweep_left WHERE sweep = ? ORDER BY crashes, first LIMIT 1");
  row.bind(sweep);
  if (!row.step()) {
    return std::nullopt;
  }
  const UnitRun run{static_cast<std::uint64_t>(row.integer(0)), static_cast<std::uint64_t>(row.integer(1))};
  const std::int64_t crashes = row.integer(2);
  const std::uint64_t taken = std::min(most_after_crashes(most, crashes), run.count);
  connection.prepare("DELETE FROM sweep_left WHERE sweep = ? AND first = ?")
      .bind(sweep)
      .bind(static_cast<std::int64_t>(run.first))
      .run();
  if (taken < run.count) {
    insert_left(connection, sweep, {run.first + taken, run.count - taken}, crashes);
  }
  return StoredClaim{0, sweep, {run.first, taken}, crashes};
}

/// Gives the units of a claim out again, but for those that have rows.
void put_rest_back(Connection& connection, const StoredClaim& claim, const std::vector<PointRow>& rows,
                   std::int64_t unit_points) {
  for (const UnitRun& run : units_without_rows(claim.units, rows, unit_points)) {
    insert_left(connection, claim.sweep, run, claim.crashes);
  }
}

/// The claim, taken out of the store; empty when it does not hold any more.
std::optional<StoredClaim> end_claim(Connection& connection, const UnitClaim& claim, Time now) {
  Statement row = connection.prepare(
      "SELECT sweep, first, units, crashes FROM sweep_claims WHERE number = ? AND lease_until_us >= ?");
  row.bind(claim.number).bind(to_row(now));
  if (!row.step()) {
    return std::nullopt;
  }
  const StoredClaim stored{
      claim.number,
      row.integer(0),
      {static_cast<std::uint64_t>(row.integer(1)), static_cast<std::uint64_t>(row.integer(2))},
      row.integer(3)};
  connection.prepare("DELETE FROM sweep_claims WHERE number = ?").bind(claim.number).run();
  return stored;
}

std::int64_t unit_points_of(const Connection& connection, std::int64_t sweep) {
  Statement row = connection.prepare("SELECT unit_points FROM sweeps WHERE seq = ?");
  row.bind(sweep).step();
  return row.integer(0);
}

/// Ends claims whose lease ends before `ended_before`; those of `worker` don't count as crashed.
std::int64_t take_claims_back(Connection& connection, Time ended_before, std::string_view worker,
                              int max_crashes, Time now) {
  std::vector<StoredClaim> claims;
  {
    Statement row = connection.prepare(
        "SELECT number, sweep, first, units, crashes, worker FROM sweep_claims WHERE lease_until_us < ?"
        " ORDER BY number");
    row.bind(to_row(ended_before));
    while (row.step()) {
      claims.push_back(
          {row.integer(0),
           row.integer(1),
           {static_cast<std::uint64_t>(row.integer(2)), static_cast<std::uint64_t>(row.integer(3))},
           row.integer(4),
           worker.empty() || row.text(5) != worker});
    }
  }
  std::int64_t again = 0;
  for (StoredClaim& claim : claims) {
    connection.prepare("DELETE FROM sweep_claims WHERE number = ?").bind(claim.number).run();
    claim.crashes += claim.crashed ? 1 : 0;
    if (claim.crashed && is_given_up(claim.units, claim.crashes, max_crashes)) {
      const std::int64_t unit_points = unit_points_of(connection, claim.sweep);
      insert_points(connection, claim.sweep, crashed_rows(claim.units, unit_points, claim.crashes), now);
      continue;
    }
    insert_left(connection, claim.sweep, claim.units, claim.crashes);
    again += static_cast<std::int64_t>(claim.units.count);
  }
  return again;
}

/// Gives out again what a sweep that is tried again lacks: units with a point that failed.
void failed_units_left(Connection& connection, std::int64_t sweep) {
  std::vector<UnitRun> runs;
  {
    Statement row = connection.prepare(
        "SELECT DISTINCT point / unit_points FROM sweep_points JOIN sweeps ON seq = sweep"
        " WHERE sweep = ? AND code IS NOT NULL ORDER BY 1");
    row.bind(sweep);
    while (row.step()) {
      add_unit(runs, static_cast<std::uint64_t>(row.integer(0)));
    }
  }
  for (const UnitRun& run : runs) {
    insert_left(connection, sweep, run, 0);
  }
}

}  // namespace

StatusOr<Submitted> SqliteSweepStore::submit(const NewSweep& sweep) {
  return database_.write<Submitted>([&](Connection& connection) -> StatusOr<Submitted> {
    if (sweep.idempotency) {
      if (const std::optional<Submitted> known = known_key(connection, *sweep.idempotency, sweep.owner)) {
        return *known;
      }
    }
    const Usage addition{0, sweep.points, static_cast<std::int64_t>(sweep.document.size())};
    if (Status status = admit(connection, sweep.owner, sweep.quotas, addition, sweep.created); !status.ok()) {
      return status;
    }
    insert_sweep(connection, sweep);
    return Submitted{Submitted::Kind::created, sweep.id};
  });
}

StatusOr<std::optional<Submitted>> SqliteSweepStore::find_key(const IdempotencyKey& key,
                                                              std::string_view owner) {
  return database_.read<std::optional<Submitted>>(
      [&](const Connection& connection) { return known_key(connection, key, owner); });
}

StatusOr<std::optional<UnitClaim>> SqliteSweepStore::claim(std::string_view id, std::uint64_t most,
                                                           const Lease& lease, Time now) {
  using Outcome = StatusOr<std::optional<UnitClaim>>;
  return database_.write<std::optional<UnitClaim>>(
      [&](Connection& connection) -> Outcome {
        const std::optional<Place> place = find(connection, id);
        if (!place || is_final(place->state)) {
          return Status(StatusCode::conflict, "sweep " + std::string(id) + " is over");
        }
        const std::optional<StoredClaim> taken = take_left(connection, place->row, most);
        if (!taken) {
          return std::optional<UnitClaim>();
        }
        if (place->state == JobState::accepted) {
          connection.prepare("UPDATE sweeps SET status = ?, started_us = ifnull(started_us, ?) WHERE seq = ?")
              .bind(to_string(JobState::running))
              .bind(to_row(now))
              .bind(place->row)
              .run();
        }
        connection
            .prepare(
                "INSERT INTO sweep_claims (sweep, first, units, crashes, worker, lease_until_us)"
                " VALUES (?, ?, ?, ?, ?, ?)")
            .bind(place->row)
            .bind(static_cast<std::int64_t>(taken->units.first))
            .bind(static_cast<std::int64_t>(taken->units.count))
            .bind(taken->crashes)
            .bind(lease.worker)
            .bind(to_row(lease.until))
            .run();
        return std::optional(UnitClaim{connection.last_row(), std::string(id), taken->units});
      },
      Durability::unsynced);
}

StatusOr<std::vector<std::int64_t>> SqliteSweepStore::renew(const std::vector<UnitClaim>& claims, Time until,
                                                            Time now) {
  return database_.write<std::vector<std::int64_t>>(
      [&](Connection& connection) -> StatusOr<std::vector<std::int64_t>> {
        std::vector<std::int64_t> lost;
        for (const UnitClaim& claim : claims) {
          connection
              .prepare("UPDATE sweep_claims SET lease_until_us = ? WHERE number = ? AND lease_until_us >= ?")
              .bind(to_row(until))
              .bind(claim.number)
              .bind(to_row(now))
              .run();
          if (connection.changes() == 0) {
            lost.push_back(claim.number);
          }
        }
        return lost;
      },
      Durability::unsynced);
}

StatusOr<SweepRecord> SqliteSweepStore::put(const UnitClaim& claim, const std::vector<PointRow>& rows,
                                            Time now) {
  return database_.write<SweepRecord>(
      [&](Connection& connection) -> StatusOr<SweepRecord> {
        const std::optional<Place> place = find(connection, claim.sweep);
        const std::optional<StoredClaim> held = end_claim(connection, claim, now);
        if (!place || place->state != JobState::running || !held) {
          return Status(StatusCode::conflict, "sweep " + claim.sweep + " does not run any more");
        }
        put_rest_back(connection, *held, rows, unit_points_of(connection, place->row));
        insert_points(connection, place->row, rows, now);
        Statement row =
            connection.prepare("SELECT " + std::string(kSweepColumns) + " FROM sweeps WHERE seq = ?");
        row.bind(place->row);
        row.step();
        return read_sweep_record(row);
      },
      rows.empty() ? Durability::unsynced : Durability::synced);
}

StatusOr<std::int64_t> SqliteSweepStore::recover(int max_crashes, Time now) {
  return database_.write<std::int64_t>([&](Connection& connection) -> StatusOr<std::int64_t> {
    return take_claims_back(connection, Time::max(), "", max_crashes, now);
  });
}

StatusOr<std::int64_t> SqliteSweepStore::rescue(std::string_view worker, int max_crashes, Time now) {
  return database_.write<std::int64_t>([&](Connection& connection) -> StatusOr<std::int64_t> {
    return take_claims_back(connection, now, worker, max_crashes, now);
  });
}

StatusOr<SweepChange> SqliteSweepStore::dismiss(std::string_view id, Time now) {
  return database_.write<SweepChange>([&](Connection& connection) -> StatusOr<SweepChange> {
    const std::optional<Place> place = find(connection, id);
    if (!place) {
      return SweepChange{};
    }
    if (is_final(place->state)) {
      return SweepChange{place->state, false};
    }
    connection.prepare("UPDATE sweeps SET status = ?, finished_us = ? WHERE seq = ?")
        .bind(to_string(JobState::dismissed))
        .bind(to_row(now))
        .bind(place->row)
        .run();
    connection
        .prepare(
            "INSERT INTO sweep_left (sweep, first, units, crashes)"
            " SELECT sweep, first, units, crashes FROM sweep_claims WHERE sweep = ?")
        .bind(place->row)
        .run();
    connection.prepare("DELETE FROM sweep_claims WHERE sweep = ?").bind(place->row).run();
    return SweepChange{place->state, true};
  });
}

StatusOr<SweepChange> SqliteSweepStore::retry(std::string_view id, const Quotas& quotas, Time now) {
  return database_.write<SweepChange>([&](Connection& connection) -> StatusOr<SweepChange> {
    const std::optional<Place> place = find(connection, id);
    if (!place) {
      return SweepChange{};
    }
    if (place->state != JobState::failed && place->state != JobState::dismissed) {
      return SweepChange{place->state, false};
    }
    Statement sweep = connection.prepare("SELECT owner, points - successful FROM sweeps WHERE seq = ?");
    sweep.bind(place->row).step();
    if (Status status = admit(connection, sweep.text(0), quotas, {0, sweep.integer(1), 0}, now);
        !status.ok()) {
      return status;
    }
    connection
        .prepare(
            "UPDATE sweeps SET failed = 0, status = ?, finished_us = NULL, bytes = max(0, bytes -"
            " (SELECT ifnull(sum(length(CAST(code || detail AS BLOB))), 0) FROM sweep_points"
            " WHERE sweep = seq AND code IS NOT NULL)) WHERE seq = ?")
        .bind(to_string(JobState::accepted))
        .bind(place->row)
        .run();
    failed_units_left(connection, place->row);
    connection.prepare("DELETE FROM sweep_points WHERE sweep = ? AND code IS NOT NULL")
        .bind(place->row)
        .run();
    connection.prepare("UPDATE sweep_left SET crashes = 0 WHERE sweep = ?").bind(place->row).run();
    return SweepChange{place->state, true};
  });
}

StatusOr<bool> SqliteSweepStore::remove(std::string_view id) {
  return database_.write<bool>([&](Connection& connection) -> StatusOr<bool> {
    connection.prepare("UPDATE sweeps SET removed = 1 WHERE id = ? AND removed = 0").bind(id).run();
    return connection.changes() > 0;
  });
}

StatusOr<int> SqliteSweepStore::retire(std::chrono::seconds age, Time now) {
  return database_.write<int>([&](Connection& connection) -> StatusOr<int> {
    connection.prepare("UPDATE sweeps SET removed = 1 WHERE finished_us < ? AND removed = 0")
        .bind(to_row(now - age))
        .run();
    return static_cast<int>(connection.changes());
  });
}

StatusOr<bool> SqliteSweepStore::purge(int most) {
  return database_.write<bool>([&](Connection& connection) -> StatusOr<bool> {
    Statement row = connection.prepare("SELECT seq FROM sweeps WHERE removed = 1 ORDER BY seq LIMIT 1");
    if (!row.step()) {
      return false;
    }
    const std::int64_t sweep = row.integer(0);
    connection
        .prepare(
            "DELETE FROM sweep_points WHERE sweep = ? AND point IN"
            " (SELECT point FROM sweep_points WHERE sweep = ? LIMIT ?)")
        .bind(sweep)
        .bind(sweep)
        .bind(most)
        .run();
    if (connection.changes() < most) {
      connection.prepare("DELETE FROM sweeps WHERE seq = ?").bind(sweep).run();
    }
    return true;
  });
}

Status SqliteSweepStore::forget_keys(std::chrono::seconds age, Time now) {
  return database_.write_only([&](Connection& connection) {
    connection.prepare("DELETE FROM sweep_keys WHERE created_us < ?").bind(to_row(now - age)).run();
    return Status();
  });
}

}  // namespace snapthrough::server::sqlite
