#pragma once
/// @file
/// Rows of the PostgreSQL schema to and from the service's types.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "server/jobs/job.h"
#include "server/jobs/sweep.h"
#include "server/store/postgresql/connection.h"

namespace snapthrough::server::postgresql {

/// @brief What time it is for a store: the database's own, so that the clocks of hosts do not matter, or, for
/// tests that decide the time, the caller's.
class Clock {
 public:
  explicit Clock(bool of_caller) : of_caller_(of_caller) {}
  /// A parameter for `coalesce($n, snapthrough_now())`.
  [[nodiscard]] std::optional<std::int64_t> at(Time now) const;

 private:
  bool of_caller_;
};

/// The literal of a state in SQL.
[[nodiscard]] std::string literal(JobState state);
/// Microseconds of a duration.
[[nodiscard]] std::int64_t microseconds(std::chrono::microseconds duration);

// A column of a row.
[[nodiscard]] Time time_in(const Rows& rows, int row, int column);
[[nodiscard]] std::optional<Time> optional_time_in(const Rows& rows, int row, int column);
[[nodiscard]] JobState state_in(const Rows& rows, int row, int column);

/// What an idempotency key that is known amounts to; empty when it is new.
/// @param rows of a statement that selects the key's fingerprint and the id of what was made with it
[[nodiscard]] std::optional<Submitted> known_key(const Rows& rows, const IdempotencyKey& key);

/// The columns that read_job() reads, for SELECT; needs the table `jobs`.
extern const char* const kJobColumns;
inline constexpr int kJobColumnCount = 16;
[[nodiscard]] Job read_job(const Rows& rows, int row);

/// The columns that read_sweep() reads, for SELECT; needs the table `sweeps`.
extern const char* const kSweepColumns;
inline constexpr int kSweepColumnCount = 13;
[[nodiscard]] SweepRecord read_sweep(const Rows& rows, int row);

/// Adds statements that insert branches with their series, and critical points, of the job with that id.
void add_path(std::vector<Statement>& statements, std::string_view job, const std::vector<Branch>& branches,
              const std::vector<CriticalPoint>& critical_points);
[[nodiscard]] StoredPath read_path(Connection& connection, std::string_view job);

/// Bytes of a piece of a result document, before it is packed.
inline constexpr std::size_t kPiece = std::size_t{1} << 20;
/// Adds statements that insert the result document of the job with that id.
void add_document(std::vector<Statement>& statements, std::string_view job, const JobResult& result);
/// @throws Error with "XX001" when the bytes are no frame of zstd
[[nodiscard]] std::string unpacked(std::string_view frame);
[[nodiscard]] std::string packed(std::string_view bytes);

}  // namespace snapthrough::server::postgresql
