#pragma once
/// @file
/// The store on SQLite: one file (with its -wal, -shm and .lock beside it).

#include <memory>
#include <span>
#include <string>

#include "server/environment.h"
#include "server/store/sqlite/migrations.h"
#include "server/store/store.h"

namespace snapthrough::server::sqlite {

/// @brief Opens or creates the store, takes it for this process, and brings its schema up to date.
///
/// One connection writes, guarded by a mutex; readers are read-only connections, one for each thread that
/// reads at the same time, so reading never waits for writing.
/// @return `unavailable` when another process has the store, `unsupported` for a newer or foreign schema.
[[nodiscard]] StatusOr<std::unique_ptr<Store>> open_store(
    const std::string& path, Time now, std::span<const Migration> migrations = embedded_migrations());

}  // namespace snapthrough::server::sqlite
