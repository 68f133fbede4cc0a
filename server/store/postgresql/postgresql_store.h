#pragma once
/// @file
/// Store on PostgreSQL, which many processes on many hosts may use at the same time.

#include <memory>
#include <span>
#include <string>

#include "server/status.h"
#include "server/store/driver.h"
#include "server/store/store.h"

namespace snapthrough::server::postgresql {

struct Options {
  int connections = 4;          ///< most connections of this process, beside one that listens
  bool time_of_caller = false;  ///< the store takes the `now` of verbs as the time, for tests and copies
};

/// Whether a location names a database of PostgreSQL: postgresql://... or postgres://...
[[nodiscard]] bool is_location(const std::string& location);
/// The location without its password, for logs.
[[nodiscard]] std::string without_password(const std::string& location);

/// The steps that this program knows, in order. CMake generates the definition
/// (store/embed_migrations.cmake).
[[nodiscard]] const std::vector<Migration>& embedded_migrations();

/// @brief Connects and brings the schema up to date, under a lock: one process at a time.
/// @return `unsupported` when a newer version wrote the database; `unavailable` when it can't be reached
[[nodiscard]] StatusOr<std::unique_ptr<Store>> open_store(
    const std::string& location, const Options& options = {},
    std::span<const Migration> migrations = embedded_migrations());

}  // namespace snapthrough::server::postgresql
