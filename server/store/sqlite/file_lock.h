#pragma once
/// @file
/// Exclusive ownership of a file for one process.

#include <optional>
#include <string>

#include "server/status.h"

namespace snapthrough::server::sqlite {

/// @brief An advisory lock on a file, whatever name it was opened by, held until destruction; the kernel
/// releases it when the process dies. Movable, not copyable.
///
/// SQLite's own locks (of another kind) end when their process closes any descriptor of the file: this one
/// must outlive every connection.
class FileLock {
 public:
  /// Creates the file if need be. `unavailable` when another holder has it.
  [[nodiscard]] static StatusOr<FileLock> acquire(const std::string& path);

  FileLock(FileLock&& other) noexcept;
  FileLock& operator=(FileLock&& other) noexcept;
  FileLock(const FileLock&) = delete;
  FileLock& operator=(const FileLock&) = delete;
  ~FileLock();

 private:
  explicit FileLock(int descriptor) : descriptor_(descriptor) {}
  int descriptor_ = -1;
};

/// Makes a finished file durable and gives it its final name, in the place of an older one if need be.
Status publish_file(const std::string& unfinished, const std::string& name);

}  // namespace snapthrough::server::sqlite
