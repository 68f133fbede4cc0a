#pragma once
/// @file
/// Store on SQLite: one file, with its -wal and -shm beside it.

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "server/environment.h"
#include "server/store/driver.h"
#include "server/store/store.h"

namespace snapthrough::server::sqlite {

/// The steps that this program knows, in order. CMake generates the definition
/// (store/embed_migrations.cmake).
[[nodiscard]] const std::vector<Migration>& embedded_migrations();

/// @brief Opens or creates the store, locks it for this process, and brings its schema up to date.
///
/// One connection writes on a thread of its own, with many callers to a commit. Each concurrent read has a
/// read-only connection, so reads do not wait for writes.
/// @return `unavailable` when another process has the store, `unsupported` for a newer or foreign schema.
[[nodiscard]] StatusOr<std::unique_ptr<Store>> open_store(
    const std::string& path, Time now, std::span<const Migration> migrations = embedded_migrations());

/// @brief Copies a store, which may be in use, to a new file, checks the copy, and gives it its name only
/// then. The copy is one state of the store and can be opened as a store.
[[nodiscard]] Status back_up(const std::string& path, const std::string& target);

}  // namespace snapthrough::server::sqlite
