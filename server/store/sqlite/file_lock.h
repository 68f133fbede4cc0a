#pragma once
/// @file
/// Files of one process: locked, and published when they are whole.

#include <string>

#include "server/descriptor.h"
#include "server/status.h"

namespace snapthrough::server::sqlite {

/// @brief Takes an advisory lock on a file, which holds for every name of the file until the descriptor is
/// closed or the process dies; creates the file if need be. `unavailable` when another process holds the
/// lock.
///
/// SQLite's own locks (of another kind) end when their process closes any descriptor of the file: the result
/// must outlive every connection.
[[nodiscard]] StatusOr<Descriptor> lock_file(const std::string& path);

/// Writes a finished file to the disk and gives it its final name; an older file of that name goes.
Status publish_file(const std::string& unfinished, const std::string& name);

}  // namespace snapthrough::server::sqlite
