#include "server/store/postgresql/sweep_rows.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "server/store/postgresql/parts.h"

namespace snapthrough::server::postgresql {
namespace {

RowCounts count(const std::vector<PointRow>& rows) {
  RowCounts counts;
  for (const PointRow& row : rows) {
    counts.add(row);
  }
  return counts;
}

/// Keys of rows that other sweeps may reuse. A reused row is found in the sweep that computed it.
std::vector<std::int64_t> short_keys(const std::vector<PointRow>& rows) {
  std::vector<std::int64_t> keys;
  for (const PointRow& row : rows) {
    if (!row.outcome.failed() && !row.key.empty() && !row.reused) {
      keys.push_back(short_key(row.key));
    }
  }
  return keys;
}

Statement add_counts(std::int64_t sweep, const RowCounts& counts) {
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

/// The rows of an earlier lease of the same items, locked, if there was one. Stored runs of a sweep do not
/// overlap, so only the nearest run before can have the items.
Rows rows_there(Connection& connection, const HeldItems& lease) {
  return connection.run(
      "SELECT first, rows FROM sweep_rows WHERE sweep = $1 AND first + points > $2"
      " AND first = (SELECT max(first) FROM sweep_rows WHERE sweep = $1 AND first <= $2) FOR UPDATE",
      Parameters().add(lease.sweep).add(lease.first_point()));
}

/// Adds rows of points without a row to the stored rows; the others are removed from `rows`.
/// @param all the stored rows @param first their first point
Statement merge_rows(std::vector<PointRow> all, std::int64_t first, const HeldItems& lease,
                     std::vector<PointRow>& rows) {
  const auto order = [](const PointRow& a, const PointRow& b) { return a.point < b.point; };
  std::erase_if(rows,
                [&](const PointRow& row) { return std::binary_search(all.begin(), all.end(), row, order); });
  const auto middle = static_cast<std::ptrdiff_t>(all.size());
  all.insert(all.end(), rows.begin(), rows.end());
  std::inplace_merge(all.begin(), all.begin() + middle, all.end(), order);
  const std::vector<std::int64_t> keys = short_keys(rows);
  Parameters row;
  row.add(lease.sweep).add(first).add_bytes(pack_rows(all)).add(count(all).failed);
  if (keys.empty()) {  // without a new key the index of keys is not rewritten
    return {"UPDATE sweep_rows SET rows = $3, failed = $4 WHERE sweep = $1 AND first = $2", std::move(row)};
  }
  row.add(keys);
  return {"UPDATE sweep_rows SET rows = $3, failed = $4, keys = keys || $5 WHERE sweep = $1 AND first = $2",
          std::move(row)};
}

Statement insert_rows(const HeldItems& lease, const std::vector<PointRow>& rows) {
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
  static const std::string kSql =
      "UPDATE sweeps SET finished_us = coalesce($2, snapthrough_now()), status = CASE WHEN failed > 0 THEN " +
      literal(state_after(SweepEvent::fail)) + " ELSE " + literal(state_after(SweepEvent::finish)) +
      " END FROM (SELECT sum(successful) AS good, sum(failed) AS failed FROM sweep_counts WHERE sweep = $1)"
      " AS sums WHERE seq = $1 AND " +
      may(SweepEvent::finish) +
      " AND good + failed = points AND NOT EXISTS (SELECT FROM sweep_leases WHERE sweep = $1)";
  return {kSql, Parameters().add(sweep).add(now)};
}

}  // namespace

std::string pack_rows(const std::vector<PointRow>& rows) {
  // Columns pack better than rows. An empty text stands for nothing.
  nlohmann::json columns{{"point", nlohmann::json::array()},
                         {"outputs", nlohmann::json::array()},
                         {"code", nlohmann::json::array()},
                         {"detail", nlohmann::json::array()},
                         {"key", nlohmann::json::array()}};
  std::uint64_t last = 0;
  for (const PointRow& row : rows) {
    columns["point"].push_back(
        static_cast<std::int64_t>(row.point - last));  // the difference is mostly 1, which packs well
    last = row.point;
    // bytes, since a detail need not be UTF-8
    const auto bytes = [](const std::string& text) {
      return nlohmann::json::binary({text.begin(), text.end()});
    };
    columns["outputs"].push_back(bytes(row.outcome.outputs));
    columns["code"].push_back(bytes(row.outcome.code));
    columns["detail"].push_back(bytes(row.outcome.detail));
    columns["key"].push_back(bytes(row.key));
  }
  std::string cbor;
  nlohmann::json::to_cbor(columns, cbor);
  return packed(cbor);
}

std::vector<PointRow> unpack_rows(std::string_view bytes) try {
  const nlohmann::json columns = nlohmann::json::from_cbor(unpacked(bytes));
  std::vector<PointRow> rows(columns.at("point").size());
  std::uint64_t last = 0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const auto text = [&](const char* column) {
      const auto& binary = columns.at(column).at(i).get_binary();
      return std::string(binary.begin(), binary.end());
    };
    last += static_cast<std::uint64_t>(columns.at("point").at(i).get<std::int64_t>());
    rows[i] = {last, {text("outputs"), text("code"), text("detail")}, text("key")};
  }
  return rows;
} catch (const nlohmann::json::exception& error) {
  throw Error("XX001", std::string("rows of a sweep in the store are damaged: ") + error.what());
}

std::int64_t short_key(std::string_view key) {
  std::uint64_t hash = 0xcbf29ce484222325;  // FNV-1a: the same value on every host
  for (const char c : key) {
    hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3;
  }
  return static_cast<std::int64_t>(hash);
}

Statement insert_left(std::int64_t sweep, const ItemRun& run, std::int64_t crashes) {
  Parameters row;
  row.add(sweep)
      .add(static_cast<std::int64_t>(run.first))
      .add(static_cast<std::int64_t>(run.count))
      .add(crashes);
  return {"INSERT INTO sweep_left (sweep, first, units, crashes) VALUES ($1, $2, $3, $4)", std::move(row)};
}

void settle(Connection& connection, const HeldItems& lease, std::vector<PointRow> rows, bool alone,
            const std::optional<std::int64_t>& now) {
  std::sort(rows.begin(), rows.end(), [](const PointRow& a, const PointRow& b) { return a.point < b.point; });
  const Rows there = rows_there(connection, lease);
  std::vector<PointRow> stored = there.empty() ? std::vector<PointRow>() : unpack_rows(there[0].text(1));
  ItemRows items(lease.items, lease.item_points);
  for (const std::vector<PointRow>* const some : {&stored, &rows}) {
    for (const PointRow& row : *some) {
      items.add(row.point);
    }
  }
  std::vector<Statement> statements;
  for (const ItemRun& run : items.left()) {
    statements.push_back(insert_left(lease.sweep, run, lease.crashes));
  }
  if (!rows.empty()) {
    statements.push_back(there.empty() ? insert_rows(lease, rows)
                                       : merge_rows(std::move(stored), there[0].integer(0), lease, rows));
    statements.push_back(add_counts(lease.sweep, count(rows)));
  }
  if (alone) {
    statements.push_back(end_if_done(lease.sweep, now));
  }
  connection.run_all(statements);
}

}  // namespace snapthrough::server::postgresql
