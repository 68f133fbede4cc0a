#pragma once
/// @file
/// What the files of the driver give one another. Everything that takes a Connection throws Error.

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "server/descriptor.h"
#include "server/status.h"
#include "server/store/admission.h"
#include "server/store/sqlite/database.h"
#include "server/store/store.h"

namespace snapthrough::server::sqlite {

/// @brief Takes an advisory lock on a file, which holds for every name of the file until the descriptor is
/// closed or the process dies; creates the file if need be. `unavailable` when another process holds the
/// lock.
///
/// SQLite's own locks (of another kind) end when their process closes any descriptor of the file: the result
/// must outlive every connection.
[[nodiscard]] StatusOr<Descriptor> lock_file(const std::string& path);

/// The sweeps of a database. REQUIRES: the database outlives them.
[[nodiscard]] std::unique_ptr<SweepStore> sweeps_in(Database& database);
/// The deliveries of a database; triggers (migrations/sqlite/0007_deliveries.sql) fill their table. REQUIRES:
/// the database outlives them.
[[nodiscard]] std::unique_ptr<DeliveryStore> deliveries_in(Database& database);

/// What owners used and did. REQUIRES: the database outlives it.
[[nodiscard]] std::unique_ptr<LedgerStore> ledger_in(Database& database);

/// Hours since 1970, the key of rows of usage.
[[nodiscard]] inline std::int64_t hour_of(Time time) {
  return std::chrono::floor<std::chrono::hours>(time.time_since_epoch()).count();
}
/// End of an INSERT into `usage`: adds to the row of the hour, if there is one.
inline constexpr std::string_view kAddUsage =
    "ON CONFLICT (owner, hour, label) DO UPDATE SET jobs = jobs + excluded.jobs,"
    " points = points + excluded.points, cpu_us = cpu_us + excluded.cpu_us,"
    " peak_bytes = max(peak_bytes, excluded.peak_bytes),"
    " factorizations = factorizations + excluded.factorizations";

/// @brief Applies the steps that the database lacks in one transaction, and records each in
/// schema_migrations.
/// @return see check_applied(). Throws Error when a step fails, or the database can't be read or written: it
/// is as before then.
Status migrate(Connection& connection, std::span<const Migration> migrations, Time now);

/// Counts what an owner hands in, or returns as check_quotas() which quota forbids it.
[[nodiscard]] Status admit(Connection& connection, std::string_view owner, const Quotas& quotas,
                           const Usage& addition, Time now);

/// What an owner has waiting and keeps, without points of an hour.
[[nodiscard]] Usage usage_of(const Connection& connection, std::string_view owner);
/// Points that an owner handed in or tried again during the last sixty minutes, and the first of these
/// minutes (since 1970) that has any. Points are counted only while their quota is set.
struct HourOfPoints {
  std::int64_t points = 0;
  std::optional<std::int64_t> oldest;
};
[[nodiscard]] HourOfPoints points_of_hour(const Connection& connection, std::string_view owner, Time now);

/// The rows of a statement as keys, see read_used_key().
[[nodiscard]] inline std::vector<UsedKey> used_keys(Statement rows) {
  std::vector<UsedKey> keys;
  while (rows.step()) {
    keys.push_back(read_used_key(rows));
  }
  return keys;
}

/// Inserts branches with their series, and critical points. @param job number of its row
void insert_path(Connection& connection, std::int64_t job, const std::vector<Branch>& branches,
                 const std::vector<CriticalPoint>& critical_points);
[[nodiscard]] StoredPath read_path(const Connection& connection, std::int64_t job);

// A result document of any length: its first megabyte lies in its row of `results`, the rest in rows of
// `result_pieces`.

/// The part of a document that its row of `results` holds.
[[nodiscard]] std::string_view first_piece(std::string_view document);
/// Inserts the rest. @param job number of its row
void insert_document_rest(Connection& connection, std::int64_t job, std::string_view document);
/// At most `most` bytes of the document from `offset` on. @pre the job has a result
[[nodiscard]] DocumentPiece read_document_piece(const Connection& connection, std::int64_t job,
                                                std::size_t offset, std::size_t most);

}  // namespace snapthrough::server::sqlite
