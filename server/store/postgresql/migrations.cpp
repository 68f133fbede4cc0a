#include "server/store/postgresql/migrations.h"

#include <string>

namespace snapthrough::server::postgresql {
namespace {

/// Of the lock that keeps two programs from bringing one database up to date at the same time.
constexpr std::int64_t kLock = 0x736e617074687275;

/// How many steps the database has, or why it cannot be used.
StatusOr<std::size_t> applied_steps(Connection& connection, std::span<const Migration> migrations) {
  const Rows rows = connection.run("SELECT version, name, checksum FROM schema_migrations ORDER BY version");
  for (int row = 0; row < rows.count(); ++row) {
    const std::string name = rows.text(row, 1);
    const auto step = static_cast<std::size_t>(row);
    if (step >= migrations.size()) {
      return Status(StatusCode::unsupported,
                    "the store was written by a newer version of the program: it has schema step " + name +
                        ", this program knows " + std::to_string(migrations.size()) + " steps");
    }
    if (rows.integer(row, 0) != migrations[step].version || rows.text(row, 2) != migrations[step].checksum) {
      return Status(StatusCode::unsupported, "the store's schema step " + name +
                                                 " differs from this program's step " +
                                                 std::string(migrations[step].name));
    }
  }
  return static_cast<std::size_t>(rows.count());
}

}  // namespace

Status migrate(Connection& connection, std::span<const Migration> migrations) {
  Transaction transaction(connection, true);
  connection.execute("SET LOCAL lock_timeout = '5min'");  // for who is at it
  connection.run("SELECT pg_advisory_xact_lock($1)", Parameters().add(kLock));
  connection.execute(
      "SET LOCAL client_min_messages = warning; CREATE TABLE IF NOT EXISTS schema_migrations ("
      " version bigint PRIMARY KEY, name text NOT NULL, checksum text NOT NULL,"
      " applied_at timestamptz NOT NULL DEFAULT now())");
  const StatusOr<std::size_t> applied = applied_steps(connection, migrations);
  if (!applied.ok()) {
    return applied.status();
  }
  for (const Migration& step : migrations.subspan(*applied)) {
    connection.execute(std::string(step.sql));
    connection.run("INSERT INTO schema_migrations (version, name, checksum) VALUES ($1, $2, $3)",
                   Parameters().add(step.version).add(step.name).add(step.checksum));
  }
  transaction.commit();
  return {};
}

}  // namespace snapthrough::server::postgresql
