#pragma once
/// @file
/// Rows of the SQLite schema to and from the service's types. Everything here throws Error.

#include <optional>
#include <string>
#include <string_view>

#include "server/jobs/job.h"
#include "server/store/sqlite/connection.h"

namespace snapthrough::server::sqlite {

/// Microseconds since 1970, as times are stored.
[[nodiscard]] std::int64_t to_row(Time time);
// A column of the current row.
[[nodiscard]] Time time_in(const Statement& row, int column);
[[nodiscard]] std::optional<Time> optional_time_in(const Statement& row, int column);
[[nodiscard]] JobState state_in(const Statement& row, int column);

/// @brief A state as a literal, for conditions: indexes have the rows of some states only, and with a state
/// that is bound SQLite would compile the statement again each time to see whether they may be used.
[[nodiscard]] std::string literal(JobState state);
/// The condition that something is to be done: "status IN (...)".
[[nodiscard]] const std::string& unfinished_condition();

/// The annotations in three columns: label, metadata, callback.
[[nodiscard]] Annotations annotations_in(const Statement& row, int column);
/// NULL for an empty text.
[[nodiscard]] std::optional<std::string_view> text_or_null(std::string_view text);

/// @brief What an idempotency key that is known amounts to; empty when it is new.
/// @param row a bound statement that selects the key's fingerprint and the id of what was made with it
[[nodiscard]] std::optional<Submitted> known_key(Statement& row, const IdempotencyKey& key);

/// The columns that read_job() reads, for SELECT; needs the table `jobs`.
extern const char* const kJobColumns;
/// The job in the current row of a statement that selects kJobColumns first, and the column after the last.
[[nodiscard]] Job read_job(const Statement& row);
inline constexpr int kJobColumnCount = 16;

/// Inserts branches with their series, and critical points.
void insert_path(Connection& connection, std::int64_t job, const std::vector<Branch>& branches,
                 const std::vector<CriticalPoint>& critical_points);
[[nodiscard]] std::vector<Branch> read_branches(const Connection& connection, std::int64_t job);
[[nodiscard]] std::vector<CriticalPoint> read_critical_points(const Connection& connection, std::int64_t job);

}  // namespace snapthrough::server::sqlite
