#include <string>

#include "server/store/postgresql/parts.h"

namespace snapthrough::server::postgresql {
namespace {

/// Key of the lock that keeps two programs from applying steps at the same time.
constexpr std::int64_t kLock = 0x736e617074687275;

/// Number of steps that the database has, or why it cannot be used.
StatusOr<std::size_t> applied_steps(Connection& connection, std::span<const Migration> migrations) {
  const Rows rows = connection.run("SELECT version, name, checksum FROM schema_migrations ORDER BY version");
  for (int row = 0; row < rows.count(); ++row) {
    if (Status status = check_applied(rows[row], static_cast<std::size_t>(row), migrations); !status.ok()) {
      return status;
    }
  }
  return static_cast<std::size_t>(rows.count());
}

}  // namespace

Status migrate(Connection& connection, std::span<const Migration> migrations) {
  Transaction transaction(connection, true);
  connection.execute("SET LOCAL lock_timeout = '5min'");  // another program may be applying steps
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
