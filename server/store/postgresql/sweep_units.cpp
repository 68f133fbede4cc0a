/// Units of sweeps: who has them, and what came of them.

#include <algorithm>
#include <utility>

#include "server/store/crashes.h"
#include "server/store/postgresql/row_pack.h"
#include "server/store/postgresql/sweeps.h"
#include "server/store/unit_runs.h"

namespace snapthrough::server::postgresql {
namespace {

/// A lease that was ended.
struct EndedLease {
  std::int64_t sweep = 0;
  UnitRun units;
  std::int64_t crashes = 0;
  std::int64_t unit_points = 1;

  [[nodiscard]] std::int64_t first_point() const {
    return static_cast<std::int64_t>(units.first) * unit_points;
  }
  [[nodiscard]] std::int64_t points() const { return static_cast<std::int64_t>(units.count) * unit_points; }
};

EndedLease read_lease(const Rows& rows, int row) {
  const auto number = [&](int column) { return static_cast<std::uint64_t>(rows.integer(row, column)); };
  return {rows.integer(row, 0), {number(1), number(2)}, rows.integer(row, 3), rows.integer(row, 4)};
}

struct Counts {
  std::int64_t successful = 0;
  std::int64_t failed = 0;
  std::int64_t reused = 0;
  std::int64_t bytes = 0;
};

Counts count(const std::vector<PointRow>& rows) {
  Counts counts;
  for (const PointRow& row : rows) {
    (row.outcome.failed() ? counts.failed : counts.successful) += 1;
    counts.reused += row.reused ? 1 : 0;
    counts.bytes += static_cast<std::int64_t>(row.outcome.outputs.size() + row.outcome.code.size() +
                                              row.outcome.detail.size());
  }
  return counts;
}

Statement add_counts(std::int64_t sweep, const Counts& counts) {
  Parameters row;
  row.add(sweep).add(counts.successful).add(counts.failed).add(counts.reused).add(counts.bytes);
  return {
      "INSERT INTO sweep_counts AS sums (sweep, slot, owner, successful, failed, reused, bytes)"
      " SELECT seq, pg_backend_pid() % 16, owner, $2, $3, $4, $5 FROM sweeps WHERE seq = $1"
      " ON CONFLICT (sweep, slot) DO UPDATE SET successful = sums.successful + excluded.successful,"
      " failed = sums.failed + excluded.failed, reused = sums.reused + excluded.reused,"
      " bytes = sums.bytes + excluded.bytes",
      std::move(row)};
}

Statement insert_left(const EndedLease& lease, const UnitRun& run) {
  Parameters row;
  row.add(lease.sweep).add(static_cast<std::int64_t>(run.first)).add(static_cast<std::int64_t>(run.count));
  row.add(lease.crashes);
  return {"INSERT INTO sweep_left (sweep, first, units, crashes) VALUES ($1, $2, $3, $4)", std::move(row)};
}

/// What an earlier lease of the same units came to, if there was one; locked. Rows of a sweep do not overlap,
/// so it is the nearest before or none.
Rows rows_there(Connection& connection, const EndedLease& lease) {
  return connection.run(
      "SELECT first, rows FROM sweep_rows WHERE sweep = $1 AND first + points > $2"
      " AND first = (SELECT max(first) FROM sweep_rows WHERE sweep = $1 AND first <= $2) FOR UPDATE",
      Parameters().add(lease.sweep).add(lease.first_point()));
}

/// Adds rows to those there are, which win; leaves those in `rows` that were added.
Statement merge_rows(const Rows& there, const EndedLease& lease, std::vector<PointRow>& rows) {
  std::vector<PointRow> all = unpack_rows(there.text(0, 1));
  const auto order = [](const PointRow& a, const PointRow& b) { return a.point < b.point; };
  std::erase_if(rows,
                [&](const PointRow& row) { return std::binary_search(all.begin(), all.end(), row, order); });
  const auto middle = static_cast<std::ptrdiff_t>(all.size());
  all.insert(all.end(), rows.begin(), rows.end());
  std::inplace_merge(all.begin(), all.begin() + middle, all.end(), order);
  const std::vector<std::int64_t> keys = short_keys(rows);
  Parameters row;
  row.add(lease.sweep).add(there.integer(0, 0)).add_bytes(pack_rows(all)).add(count(all).failed);
  if (keys.empty()) {  // all keys would go into the index again
    return {"UPDATE sweep_rows SET rows = $3, failed = $4 WHERE sweep = $1 AND first = $2", std::move(row)};
  }
  row.add(keys);
  return {"UPDATE sweep_rows SET rows = $3, failed = $4, keys = keys || $5 WHERE sweep = $1 AND first = $2",
          std::move(row)};
}

Statement insert_rows(const EndedLease& lease, const std::vector<PointRow>& rows) {
  const std::vector<std::int64_t> keys = short_keys(rows);
  return {"INSERT INTO sweep_rows (sweep, first, points, failed, keys, rows) VALUES ($1, $2, $3, $4, $5, $6)",
          Parameters()
              .add(lease.sweep)
              .add(lease.first_point())
              .add(lease.points())
              .add(count(rows).failed)
              .add(keys)
              .add_bytes(pack_rows(rows))};
}

/// Ends the sweep when all points have a row.
Statement end_if_done(std::int64_t sweep, const std::optional<std::int64_t>& now) {
  return {
      "UPDATE sweeps SET finished_us = coalesce($2, snapthrough_now()),"
      " status = CASE WHEN failed > 0 THEN 'failed' ELSE 'successful' END"
      " FROM (SELECT sum(successful) AS good, sum(failed) AS failed FROM sweep_counts WHERE sweep = $1) AS "
      "sums"
      " WHERE seq = $1 AND status = 'running' AND good + failed = points"
      " AND NOT EXISTS (SELECT FROM sweep_leases WHERE sweep = $1)",
      Parameters().add(sweep).add(now)};
}

/// Stores rows of a lease that was ended, and gives its other units out again.
/// @param alone what hold_claims() of the schema gave
void settle(Connection& connection, const EndedLease& lease, std::vector<PointRow> rows, bool alone,
            const std::optional<std::int64_t>& now) {
  std::sort(rows.begin(), rows.end(), [](const PointRow& a, const PointRow& b) { return a.point < b.point; });
  std::vector<Statement> statements;
  for (const UnitRun& run : units_without_rows(lease.units, rows, lease.unit_points)) {
    statements.push_back(insert_left(lease, run));
  }
  if (!rows.empty()) {
    const Rows there = rows_there(connection, lease);
    statements.push_back(there.empty() ? insert_rows(lease, rows) : merge_rows(there, lease, rows));
    statements.push_back(add_counts(lease.sweep, count(rows)));
  }
  if (alone) {
    statements.push_back(end_if_done(lease.sweep, now));
  }
  connection.run_all(statements);
}

}  // namespace

StatusOr<std::optional<UnitClaim>> PostgresqlSweepStore::claim(std::string_view id, std::uint64_t most,
                                                               const Lease& lease, Time now) {
  Parameters wanted;
  wanted.add(id).add(static_cast<std::int64_t>(most)).add(lease.worker).add(microseconds(lease.until - now));
  wanted.add(clock_.at(now));
  const auto use = [&](std::span<const Rows> all) -> StatusOr<std::optional<UnitClaim>> {
    const Rows& rows = all.front();
    if (rows.empty()) {
      return std::optional<UnitClaim>();
    }
    const UnitRun units{static_cast<std::uint64_t>(rows.integer(0, 1)),
                        static_cast<std::uint64_t>(rows.integer(0, 2))};
    return std::optional(UnitClaim{rows.integer(0, 0), std::string(id), units});
  };
  return database_.write_at_once<std::optional<UnitClaim>>(
      {{"SELECT * FROM claim_units($1, $2, $3, $4, coalesce($5, snapthrough_now()))", wanted}},
      Durability::unsynced, use);
}

StatusOr<std::vector<std::int64_t>> PostgresqlSweepStore::renew(const std::vector<UnitClaim>& claims,
                                                                Time until, Time now) {
  std::vector<std::int64_t> numbers;
  numbers.reserve(claims.size());
  for (const UnitClaim& claim : claims) {
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
      lost.push_back(all.front().integer(row, 0));
    }
    return lost;
  };
  return database_.write_at_once<std::vector<std::int64_t>>(
      {{kSql, Parameters().add(numbers).add(clock_.at(now)).add(microseconds(until - now))}},
      Durability::unsynced, use);
}

StatusOr<SweepRecord> PostgresqlSweepStore::put(const UnitClaim& claim, const std::vector<PointRow>& rows,
                                                Time now) {
  static constexpr std::string_view kEnd =
      "DELETE FROM sweep_leases USING sweeps WHERE seq = sweep AND number = $1 AND NOT removed"
      " AND id = $3 AND first = $4 AND units = $5 AND until_us >= coalesce($2, snapthrough_now())"
      " RETURNING sweep, first, units, crashes, unit_points";
  static const std::string kRecord = "SELECT " + std::string(kSweepColumns) + " FROM sweeps WHERE seq = $1";
  // The units, too: a number whose claim was lost with the database's machine may be another's now.
  Parameters held;
  held.add(claim.number).add(clock_.at(now)).add(claim.sweep);
  held.add(static_cast<std::int64_t>(claim.units.first)).add(static_cast<std::int64_t>(claim.units.count));
  const std::vector<Statement> end{
      {"SELECT hold_claims(seq) FROM sweeps WHERE id = $1", Parameters().add(claim.sweep)}, {kEnd, held}};
  const auto work = [&](Connection& connection) -> StatusOr<SweepRecord> {
    const std::vector<Rows> held_and_ended = connection.run_all(end);
    const Rows& ended = held_and_ended.back();
    if (ended.empty()) {
      return Status(StatusCode::conflict, "sweep " + claim.sweep + " does not run any more");
    }
    const EndedLease lease = read_lease(ended, 0);
    settle(connection, lease, rows, held_and_ended.front().boolean(0, 0), clock_.at(now));
    return read_sweep(connection.run(kRecord, Parameters().add(lease.sweep)), 0);
  };
  return database_.write<SweepRecord>(work, rows.empty() ? Durability::unsynced : Durability::synced);
}

StatusOr<std::int64_t> PostgresqlSweepStore::recover(int /*max_crashes*/, Time /*now*/) {
  return std::int64_t{0};  // who is gone is seen by leases
}

StatusOr<std::int64_t> PostgresqlSweepStore::rescue(std::string_view worker, int max_crashes, Time now) {
  static constexpr std::string_view kLate =
      "SELECT number, sweep FROM sweep_leases WHERE until_us < coalesce($1, snapthrough_now()) ORDER BY "
      "sweep, number";
  static constexpr std::string_view kEnd =  // unless it was renewed, or somebody else was faster
      "DELETE FROM sweep_leases USING sweeps WHERE seq = sweep AND number = $1"
      " AND until_us < coalesce($2, snapthrough_now())"
      " RETURNING sweep, first, units, crashes, unit_points, worker";
  return database_.write<std::int64_t>([&](Connection& connection) -> StatusOr<std::int64_t> {
    const Rows late = connection.run(kLate, Parameters().add(clock_.at(now)));
    std::int64_t again = 0;
    bool alone = false;
    for (int row = 0; row < late.count(); ++row) {
      if (row == 0 || late.integer(row, 1) != late.integer(row - 1, 1)) {
        alone =
            connection.run("SELECT hold_claims($1)", Parameters().add(late.integer(row, 1))).boolean(0, 0);
      }
      const Rows ended = connection.run(kEnd, Parameters().add(late.integer(row, 0)).add(clock_.at(now)));
      if (ended.empty()) {
        continue;
      }
      EndedLease lease = read_lease(ended, 0);
      const bool crashed = ended.text(0, 5) != worker;
      lease.crashes += crashed ? 1 : 0;
      const bool give_up = crashed && is_given_up(lease.units, lease.crashes, max_crashes);
      settle(connection, lease,
             give_up ? crashed_rows(lease.units, lease.unit_points, lease.crashes) : std::vector<PointRow>(),
             alone, clock_.at(now));
      again += give_up ? 0 : static_cast<std::int64_t>(lease.units.count);
    }
    return again;
  });
}

}  // namespace snapthrough::server::postgresql
