#pragma once
/// @file
/// Stores by their location: the one place that knows every driver.

#include <memory>
#include <string>

#include "server/environment.h"
#include "server/status.h"
#include "server/store/store.h"

namespace snapthrough::server {

/// Whether several processes may use a store at that location at the same time: postgresql://...; else it is
/// a file of SQLite, which one process owns.
[[nodiscard]] bool is_shared_location(const std::string& location);
/// The location as it may be shown: without a password.
[[nodiscard]] std::string shown_location(const std::string& location);

/// @brief Opens a store, creates it if need be, and brings its schema up to date.
/// @param connections to a database that is not a file, at most
/// @param time_of_caller whatever the driver, it goes by the `now` of verbs: for a copy, which keeps times
/// @return `unsupported` when a newer version wrote it, `unavailable` when it can't be had at the moment
[[nodiscard]] StatusOr<std::unique_ptr<Store>> open_store(const std::string& location, int connections,
                                                          Time now, bool time_of_caller = false);

}  // namespace snapthrough::server
