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

#include "server/store/admission.h"
#include "server/store/postgresql/database.h"
#include "server/store/store.h"

namespace snapthrough::server::postgresql {

/// @brief The clock of a store: that of the database, so that the clocks of hosts do not matter, or that of
/// the caller, for tests that decide the time.
class Clock {
 public:
  explicit Clock(bool of_caller) : of_caller_(of_caller) {}
  /// A parameter for `coalesce($n, snapthrough_now())`.
  [[nodiscard]] std::optional<std::int64_t> at(Time now) const {
    return of_caller_ ? std::optional(to_row(now)) : std::nullopt;
  }

 private:
  bool of_caller_;
};

/// Microseconds of a duration.
[[nodiscard]] inline std::int64_t microseconds(std::chrono::microseconds duration) {
  return duration.count();
}

/// Outcome of a submission with an idempotency key; empty for a new key. @param rows none or one row for
/// server::known_key()
[[nodiscard]] inline std::optional<Submitted> known_key(const Rows& rows, const IdempotencyKey& key) {
  return rows.empty() ? std::nullopt : std::optional(server::known_key(rows[0], key));
}

/// Rows as keys, see read_used_key().
[[nodiscard]] inline std::vector<UsedKey> used_keys(const Rows& rows) {
  std::vector<UsedKey> keys;
  keys.reserve(static_cast<std::size_t>(rows.count()));
  for (int row = 0; row < rows.count(); ++row) {
    keys.push_back(read_used_key(rows[row]));
  }
  return keys;
}
/// Key, fingerprint, time of the first use and the id of the job or sweep, for a statement that inserts them.
[[nodiscard]] inline Parameters key_parameters(std::string_view id, const UsedKey& used) {
  return Parameters().add(used.key.key).add(used.key.fingerprint).add(to_row(used.first_used)).add(id);
}

// Parts of the store. REQUIRES: the database outlives them.
[[nodiscard]] std::unique_ptr<Store> jobs_in(const std::string& location, int connections, Clock clock);
[[nodiscard]] std::unique_ptr<SweepStore> sweeps_in(Database& database, Clock clock);
[[nodiscard]] std::unique_ptr<DeliveryStore> deliveries_in(Database& database, Clock clock);
[[nodiscard]] std::unique_ptr<LedgerStore> ledger_in(Database& database, Clock clock);
[[nodiscard]] std::unique_ptr<NeighbourStore> neighbours_in(Database& database);

/// End of an INSERT into `usage AS sums`: adds to the row of the hour and slot, if there is one.
inline constexpr std::string_view kAddUsage =
    "ON CONFLICT (owner, hour, label, slot) DO UPDATE SET jobs = sums.jobs + excluded.jobs,"
    " points = sums.points + excluded.points, cpu_us = sums.cpu_us + excluded.cpu_us,"
    " peak_bytes = greatest(sums.peak_bytes, excluded.peak_bytes),"
    " factorizations = sums.factorizations + excluded.factorizations";

/// @brief Applies the steps that the database lacks in one transaction, and records each in
/// schema_migrations. Other programs that do the same wait, and then find it done.
/// @return see check_applied(). When a step fails the database is as before.
Status migrate(Connection& connection, std::span<const Migration> migrations);

/// @brief Counts what an owner hands in, or returns as check_quotas() which quota forbids it. Other
/// transactions that add to what the owner has wait until this one ends.
/// @param now microseconds; empty: the time of the database
[[nodiscard]] Status admit(Connection& connection, std::string_view owner, const Quotas& quotas,
                           const Usage& addition, const std::optional<std::int64_t>& now);

/// What an owner has of what quotas bound. @param most_jobs jobs are counted up to this number @param now as
/// for admit()
[[nodiscard]] Balance balance_of(Connection& connection, std::string_view owner, std::int64_t most_jobs,
                                 const std::optional<std::int64_t>& now);

/// Adds statements that insert branches with their series, and critical points. @param job its id
void add_path(std::vector<Statement>& statements, std::string_view job, const std::vector<Branch>& branches,
              const std::vector<CriticalPoint>& critical_points);
[[nodiscard]] StoredPath read_path(Connection& connection, std::string_view job);

/// Bytes of a piece of a result document, before it is packed.
inline constexpr std::size_t kPiece = std::size_t{1} << 20;
/// Adds statements that insert the result document. @param job its id
void add_document(std::vector<Statement>& statements, std::string_view job, const JobResult& result);

/// Frame of zstd with the bytes.
[[nodiscard]] std::string packed(std::string_view bytes);
/// Bytes of a frame of zstd. @throws Error with "XX001" for anything else
[[nodiscard]] std::string unpacked(std::string_view frame);

}  // namespace snapthrough::server::postgresql
