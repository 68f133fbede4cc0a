#include "server/store/sqlite/parts.h"

namespace snapthrough::server::sqlite {
namespace {

constexpr const char* kHistoryTable =
    "CREATE TABLE IF NOT EXISTS schema_migrations ("
    " version INTEGER PRIMARY KEY,"
    " name TEXT NOT NULL,"
    " checksum TEXT NOT NULL,"
    " applied_us INTEGER NOT NULL"
    ") STRICT";

/// Number of steps that the database has, or why it cannot be used.
StatusOr<std::size_t> applied_steps(Connection& connection, std::span<const Migration> migrations) {
  Statement rows =
      connection.prepare("SELECT version, name, checksum FROM schema_migrations ORDER BY version");
  std::size_t applied = 0;
  while (rows.step()) {
    if (Status status = check_applied(rows, applied, migrations); !status.ok()) {
      return status;
    }
    ++applied;
  }
  return applied;
}

void apply(Connection& connection, const Migration& migration, Time now) {
  connection.execute(std::string(migration.sql));
  connection.run("INSERT INTO schema_migrations (version, name, checksum, applied_us) VALUES (?, ?, ?, ?)",
                 migration.version, migration.name, migration.checksum, to_row(now));
}

}  // namespace

Status migrate(Connection& connection, std::span<const Migration> migrations, Time now) {
  connection.execute(kHistoryTable);
  const StatusOr<std::size_t> applied = applied_steps(connection, migrations);
  if (!applied.ok()) {
    return applied.status();
  }
  if (*applied == migrations.size()) {
    return {};
  }
  Transaction transaction(connection);
  for (const Migration& migration : migrations.subspan(*applied)) {
    apply(connection, migration, now);
  }
  transaction.commit();
  return {};
}

}  // namespace snapthrough::server::sqlite
