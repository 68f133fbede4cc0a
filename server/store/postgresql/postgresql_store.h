#pragma once
/// @file
/// The store on PostgreSQL, which many processes on many hosts may use at the same time.

#include <memory>
#include <span>
#include <string>

#include "server/status.h"
#include "server/store/driver.h"
#include "server/store/store.h"

namespace snapthrough::server::postgresql {

struct Options {
  int connections = 4;          ///< at most, of this process; beside one that listens
  bool time_of_caller = false;  ///< go by the `now` that verbs are given: for who decides the time
};

/// Whether a store's location names a database of PostgreSQL: postgresql://... or postgres://...
[[nodiscard]] bool is_location(const std::string& location);
/// The location without its password, for logs.
[[nodiscard]] std::string without_password(const std::string& location);

/// The steps this program knows, in order. Defined in a source generated at build time.
[[nodiscard]] const std::vector<Migration>& embedded_migrations();

/// @brief Connects, and brings the schema up to date (under a lock: one process at a time).
/// @return `unsupported` when the database was written by a newer version; `unavailable` when it can't be
/// reached
[[nodiscard]] StatusOr<std::unique_ptr<Store>> open_store(
    const std::string& location, const Options& options = {},
    std::span<const Migration> migrations = embedded_migrations());

}  // namespace snapthrough::server::postgresql
