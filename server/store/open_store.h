#pragma once
/// @file
/// Stores by their location: the only file that knows every driver.

#include <memory>
#include <string>

#include "server/environment.h"
#include "server/status.h"
#include "server/store/store.h"

namespace snapthrough::server {

/// Whether several processes may use the store at the same time: a location postgresql://...; any other
/// location is a file of SQLite, which one process owns.
[[nodiscard]] bool is_shared_location(const std::string& location);
/// The location without its password, for logs.
[[nodiscard]] std::string shown_location(const std::string& location);

/// @brief Opens a store, creates it if it is new, and brings its schema up to date.
/// @param connections most connections to a database that is not a file
/// @param time_of_caller the store takes the `now` of verbs as the time: for a copy, which keeps times
/// @return `unsupported` when a newer version wrote the store, `unavailable` when it can't be opened at the
/// moment
[[nodiscard]] StatusOr<std::unique_ptr<Store>> open_store(const std::string& location, int connections,
                                                          Time now, bool time_of_caller = false);

}  // namespace snapthrough::server
