#pragma once
/// @file
/// The history of the schema: numbered steps, each applied once, in order.

#include <span>
#include <string>
#include <vector>

#include "server/environment.h"
#include "server/store/sqlite/connection.h"

namespace snapthrough::server::sqlite {

/// The steps that this program knows, in order. CMake generates the definition
/// (store/embed_migrations.cmake).
[[nodiscard]] const std::vector<Migration>& embedded_migrations();

/// @brief Applies the steps that the database lacks in one transaction, and records each in
/// schema_migrations.
/// @return see check_applied(). Throws Error when a step fails, or the database can't be read or written: it
/// is as before then.
Status migrate(Connection& connection, std::span<const Migration> migrations, Time now);

}  // namespace snapthrough::server::sqlite
