/// What happens to sweeps: verbs that write.

#include "server/store/sqlite/sweeps.h"

#include <utility>

#include "server/store/sqlite/quotas.h"
#include "server/store/sqlite/rows.h"

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

void insert_sweep(Connection& connection, const NewSweep& sweep) {
  connection
      .prepare(
          "INSERT INTO sweeps (id, owner, title, reuse, points, created_us, analysis_type, label, metadata,"
          " callback) VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?)")
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
      .run();
  const std::int64_t row = connection.last_row();
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

/// A point that was being computed when the process died.
struct Suspect {
  std::int64_t sweep = 0;
  std::uint64_t point = 0;
};

std::vector<Suspect> suspects(const Connection& connection) {
  std::vector<Suspect> all;
  Statement claims = connection.prepare("SELECT sweep, points FROM sweep_claims ORDER BY number");
  while (claims.step()) {
    const std::int64_t sweep = claims.integer(0);
    for (const double point : claims.series(1)) {
      Statement there = connection.prepare("SELECT 1 FROM sweep_points WHERE sweep = ? AND point = ?");
      there.bind(sweep).bind(static_cast<std::int64_t>(point));
      if (!there.step()) {
        all.push_back({sweep, static_cast<std::uint64_t>(point)});
      }
    }
  }
  return all;
}

/// Counts the crash; whether the point is given up.
bool blame(Connection& connection, const Suspect& suspect, int max_crashes) {
  connection
      .prepare(
          "INSERT INTO sweep_crashes (sweep, point, crashes) VALUES (?, ?, 1)"
          " ON CONFLICT DO UPDATE SET crashes = crashes + 1")
      .bind(suspect.sweep)
      .bind(static_cast<std::int64_t>(suspect.point))
      .run();
  Statement row = connection.prepare("SELECT crashes FROM sweep_crashes WHERE sweep = ? AND point = ?");
  row.bind(suspect.sweep).bind(static_cast<std::int64_t>(suspect.point));
  return row.step() && row.integer(0) >= max_crashes;
}

}  // namespace

StatusOr<Submitted> SqliteSweepStore::submit(const NewSweep& sweep) {
  return database_.write<Submitted>([&](Connection& connection) -> StatusOr<Submitted> {
    if (sweep.idempotency) {
      if (const std::optional<Submitted> known = known_key(connection, *sweep.idempotency, sweep.owner)) {
        return *known;
      }
    }
    const Addition addition{0, sweep.points, static_cast<std::int64_t>(sweep.document.size())};
    if (Status status = check_quotas(connection, sweep.owner, sweep.quotas, addition); !status.ok()) {
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

StatusOr<PointClaim> SqliteSweepStore::claim(std::string_view id, const std::vector<std::uint64_t>& points,
                                             Time now) {
  const std::vector<double> numbers(points.begin(), points.end());
  return database_.write<PointClaim>(
      [&](Connection& connection) -> StatusOr<PointClaim> {
        const std::optional<Place> place = find(connection, id);
        if (!place || is_final(place->state)) {
          return Status(StatusCode::conflict, "sweep " + std::string(id) + " is over");
        }
        if (place->state == JobState::accepted) {
          connection.prepare("UPDATE sweeps SET status = ?, started_us = ifnull(started_us, ?) WHERE seq = ?")
              .bind(to_string(JobState::running))
              .bind(to_row(now))
              .bind(place->row)
              .run();
        }
        connection.prepare("INSERT INTO sweep_claims (sweep, points) VALUES (?, ?)")
            .bind(place->row)
            .bind_series(numbers)
            .run();
        return PointClaim{connection.last_row(), std::string(id)};
      },
      Durability::unsynced);
}

StatusOr<SweepRecord> SqliteSweepStore::put(const PointClaim& claim, const std::vector<PointRow>& rows,
                                            Time now) {
  return database_.write<SweepRecord>(
      [&](Connection& connection) -> StatusOr<SweepRecord> {
        const std::optional<Place> place = find(connection, claim.sweep);
        connection.prepare("DELETE FROM sweep_claims WHERE number = ?").bind(claim.number).run();
        if (!place || place->state != JobState::running || connection.changes() == 0) {
          return Status(StatusCode::conflict, "sweep " + claim.sweep + " does not run any more");
        }
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
    std::int64_t again = 0;
    for (const Suspect& suspect : suspects(connection)) {
      if (!blame(connection, suspect, max_crashes)) {
        ++again;
        continue;
      }
      const std::string detail = "the service died " + std::to_string(max_crashes) +
                                 " times while it worked on this point; it is not tried again";
      insert_points(connection, suspect.sweep, {{suspect.point, {"", "crashed", detail}}}, now);
    }
    connection.execute("DELETE FROM sweep_claims");
    return again;
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
    connection.prepare("DELETE FROM sweep_claims WHERE sweep = ?").bind(place->row).run();
    return SweepChange{place->state, true};
  });
}

StatusOr<SweepChange> SqliteSweepStore::retry(std::string_view id, const Quotas& quotas) {
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
    if (Status status = check_quotas(connection, sweep.text(0), quotas, {0, sweep.integer(1), 0});
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
    connection.prepare("DELETE FROM sweep_points WHERE sweep = ? AND code IS NOT NULL")
        .bind(place->row)
        .run();
    connection.prepare("DELETE FROM sweep_crashes WHERE sweep = ?").bind(place->row).run();
    return SweepChange{place->state, true};
  });
}

StatusOr<bool> SqliteSweepStore::remove(std::string_view id) {
  return database_.write<bool>([&](Connection& connection) -> StatusOr<bool> {
    connection.prepare("UPDATE sweeps SET removed = 1 WHERE id = ? AND removed = 0").bind(id).run();
    return connection.changes() > 0;
  });
}

StatusOr<int> SqliteSweepStore::retire(Time ended_before) {
  return database_.write<int>([&](Connection& connection) -> StatusOr<int> {
    connection.prepare("UPDATE sweeps SET removed = 1 WHERE finished_us < ? AND removed = 0")
        .bind(to_row(ended_before))
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

Status SqliteSweepStore::forget_keys(Time used_before) {
  return database_.write_only([&](Connection& connection) {
    connection.prepare("DELETE FROM sweep_keys WHERE created_us < ?").bind(to_row(used_before)).run();
    return Status();
  });
}

}  // namespace snapthrough::server::sqlite
