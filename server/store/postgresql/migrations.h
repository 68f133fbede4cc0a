#pragma once
/// @file
/// The schema's history: numbered steps, each applied once, in order.

#include <span>

#include "server/status.h"
#include "server/store/migration.h"
#include "server/store/postgresql/connection.h"

namespace snapthrough::server::postgresql {

/// @brief Brings a database up to date in one transaction, and records each step in schema_migrations. Others
/// that would do the same wait, and then find it done.
/// @return `unsupported` when the database has a step that this program does not know (a newer version wrote
/// it) or an applied step differs from the one known here. Throws Error when a step fails: the database is as
/// it was.
Status migrate(Connection& connection, std::span<const Migration> migrations);

}  // namespace snapthrough::server::postgresql
