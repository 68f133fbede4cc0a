#pragma once
/// @file
/// The schema's history: numbered steps, each applied once, in order; what is lacking in one transaction.

#include <span>
#include <string>
#include <vector>

#include "server/environment.h"
#include "server/status.h"
#include "server/store/migration.h"
#include "server/store/sqlite/connection.h"

namespace snapthrough::server::sqlite {

/// The steps this program knows, in order. Defined in a source generated at build time.
[[nodiscard]] const std::vector<Migration>& embedded_migrations();

/// @brief Brings a database up to date and records each step in schema_migrations.
/// @return `unsupported` when the database has a step that this program does not know (a newer version wrote
/// it) or an applied step differs from the one known here; nothing When a step fails, the database is as it
/// was before the first. Throws Error when the database can't be read or written.
Status migrate(Connection& connection, std::span<const Migration> migrations, Time now);

}  // namespace snapthrough::server::sqlite
