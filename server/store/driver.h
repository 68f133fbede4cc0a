#pragma once
/// @file
/// What drivers of stores share beside SQL: rows as types of the service, conditions on states, schema steps.

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "api/names.h"
#include "api/stored_fields.h"
#include "server/jobs/job.h"
#include "server/jobs/sweep.h"
#include "server/status.h"
#include "server/store/list_query.h"

namespace snapthrough::server {

/// Whether a write has to survive the death of the database's machine before its caller goes on. A write that
/// need not survives the death of the process all the same.
enum class Durability { synced, unsynced };

// Conditions on states, made of the tables in server/jobs/state.h and sweep_state.h.

/// @brief The state as a literal of SQL. Not a parameter: partial indexes hold the rows of some states, and
/// SQLite compiles a statement again for each value of a parameter that such an index depends on.
[[nodiscard]] std::string literal(JobState state);
/// "status = '...'", or "status IN (...)" in the order of the states. @pre not empty
[[nodiscard]] std::string status_in(std::span<const JobState> states);
/// The condition that an event is legal, e.g. "status = 'accepted'".
template <class Event>
[[nodiscard]] std::string may(Event event) {
  std::vector<JobState> states;
  for (const Transition<Event>& row : transitions_of(event)) {
    if (row.event == event) {
      states.push_back(row.from);
    }
  }
  return status_in(states);
}
/// The assignment that an event makes, e.g. "status = 'running'".
template <class Event>
[[nodiscard]] std::string becomes(Event event) {
  return "status = " + literal(state_after(event));
}

/// @brief Row of a result. Columns count from 0. A value that the schema does not allow throws the error of
/// the driver.
class Row {
 public:
  Row() = default;
  Row(const Row&) = default;
  Row& operator=(const Row&) = default;
  Row(Row&&) = default;
  Row& operator=(Row&&) = default;
  virtual ~Row() = default;

  [[nodiscard]] virtual bool is_null(int column) const = 0;
  [[nodiscard]] virtual std::int64_t integer(int column) const = 0;
  [[nodiscard]] virtual double real(int column) const = 0;
  /// Empty for NULL.
  [[nodiscard]] virtual std::string text(int column) const = 0;
  /// Numbers that were stored as little-endian float64; empty for NULL.
  [[nodiscard]] virtual std::vector<double> series(int column) const = 0;
  /// Throws the error of the driver.
  [[noreturn]] virtual void refuse(const std::string& why) const = 0;

  [[nodiscard]] int whole(int column) const { return static_cast<int>(integer(column)); }
  [[nodiscard]] std::uint64_t number(int column) const { return static_cast<std::uint64_t>(integer(column)); }
  [[nodiscard]] std::optional<std::int64_t> optional_integer(int column) const;
  [[nodiscard]] std::optional<double> optional_real(int column) const;
  /// A time that is stored as microseconds since 1970.
  [[nodiscard]] Time time(int column) const;
  [[nodiscard]] std::optional<Time> optional_time(int column) const;
  [[nodiscard]] JobState state(int column) const;
  /// Label, metadata and callback in three columns.
  [[nodiscard]] Annotations annotations(int column) const;
};

/// Microseconds since 1970: the stored form of a time.
[[nodiscard]] inline std::int64_t to_row(Time time) { return time.time_since_epoch().count(); }
/// The text; nothing (NULL) for an empty text.
[[nodiscard]] inline std::optional<std::string_view> text_or_null(std::string_view text) {
  return text.empty() ? std::nullopt : std::optional(text);
}

/// Numbered parameters of a statement, e.g. "$2, $3". @param mark '?' (SQLite) or '$' (PostgreSQL)
[[nodiscard]] std::string numbered(char mark, int first, int count);

/// Columns of read_job() for SELECT from `jobs`, and their number.
extern const char* const kJobColumns;
inline constexpr int kJobColumnCount = 21;
[[nodiscard]] Job read_job(const Row& row);

/// Usage in three columns from `column` on; empty when nothing was computed.
[[nodiscard]] std::optional<WorkUsage> read_work_usage(const Row& row, int column);

/// Columns of read_sweep() for SELECT from `sweeps`, and their number. The counts of points, the
/// program and the usage are the driver's.
extern const char* const kSweepColumns;
inline constexpr int kSweepColumnCount = 13;
[[nodiscard]] SweepRecord read_sweep(const Row& row);

/// @brief Outcome of a submission with a known idempotency key.
/// @param row fingerprint of the document that came with the key; id of the job or sweep that was made of it
[[nodiscard]] Submitted known_key(const Row& row, const IdempotencyKey& key);

/// @param row key, fingerprint, time of the first use
[[nodiscard]] UsedKey read_used_key(const Row& row);

/// Columns of read_branch() and add_branch(), and their number.
extern const char* const kBranchColumns;
inline constexpr int kBranchColumnCount = 7;
[[nodiscard]] Branch read_branch(const Row& row);
/// Columns of read_critical_point() and add_critical_point(), and their number.
extern const char* const kCriticalPointColumns;
inline constexpr int kCriticalPointColumnCount = 10;
[[nodiscard]] CriticalPoint read_critical_point(const Row& row);

/// The values, NaN for those that are not known.
[[nodiscard]] std::vector<double> with_nan(std::span<const std::optional<double>> values);

/// Adds the values of kBranchColumns. @tparam Values parameters of a statement of the driver
template <class Values>
void add_branch(Values& values, const Branch& branch) {
  const std::vector<double> negative(branch.negative_eigenvalues.begin(), branch.negative_eigenvalues.end());
  values.add(branch.id).add(branch.parent).add_series(branch.load_factor).add_series(branch.arc_length);
  values.add_series(negative).add_series(with_nan(branch.stiffness_ratio));
  values.add(api::stored_fields(branch));
}

/// Adds the values of kCriticalPointColumns.
template <class Values>
void add_critical_point(Values& values, const CriticalPoint& point) {
  values.add(point.branch).add(api::name_of(api::kCriticalTypes, point.type)).add(point.load_factor);
  values.add(point.error_estimate).add(point.arc_length).add(point.negative_before).add(point.negative_after);
  values.add(point.multiplicity).add(point.imperfection).add(api::stored_fields(point));
}

/// A table whose rows are listed: it has the columns seq, owner, status, label, analysis_type, created_us.
struct ListedTable {
  const char* name;
  const char* columns;    ///< columns for SELECT
  int count;              ///< number of columns
  const char* condition;  ///< condition on every listed row: " AND ...", or ""
};

/// @brief Bounds of a page: rows created after `after`, and whose (created, number) is less than `end`.
/// Microseconds since 1970, number of the row.
struct ListBounds {
  std::int64_t after = 0;
  std::pair<std::int64_t, std::int64_t> end;
};
[[nodiscard]] ListBounds bounds_of(const ListQuery& query);
/// Joins the statements `run(state)` of the states that the query asks for by UNION ALL.
template <class Run>
std::string union_of_states(const ListQuery& query, const Run& run) {
  std::string sql;
  for (const JobState state : kJobStates) {
    if (!query.state || *query.state == state) {
      sql += (sql.empty() ? "" : " UNION ALL ") + run(state);
    }
  }
  return sql;
}

/// One step of the history of a schema, from the file migrations/<driver>/<name>.sql.
struct Migration {
  int version = 0;            ///< 1, 2, ... without gaps
  std::string_view name;      ///< file name without ending, e.g. "0001_jobs"
  std::string_view checksum;  ///< SHA-256 of the file, to notice that an applied step was edited later
  std::string_view sql;
};
/// @brief Compares an applied step with the steps that this program knows.
/// @param row version, name and checksum of an applied step
/// @param applied number of steps before it
/// @return `unsupported` for a step of a newer version, or one that differs
[[nodiscard]] Status check_applied(const Row& row, std::size_t applied, std::span<const Migration> known);

}  // namespace snapthrough::server
