#pragma once
/// @file
/// Watches the disk of the store and keeps a reserve on it.

#include <cstdint>
#include <string>

namespace snapthrough::server {

/// @brief A ballast file beside the store. Not thread-safe.
///
/// A full disk leaves a database without room even to delete. So a file of some size is kept and given up
/// when a write fails for want of space; until there is room for it again, no new jobs are taken, so that
/// the space serves results, removals and checkpoints.
class DiskGuard {
 public:
  /// @param ballast_bytes size of the reserve; 0: none
  /// @param least_free bytes that must be free for new jobs
  DiskGuard(std::string store_path, std::uint64_t ballast_bytes, std::uint64_t least_free);

  /// Looks at the disk. @param writable whether the latest write went well
  /// @return whether there is room for new jobs
  bool check(bool writable);

  /// Bytes that are free for the service.
  [[nodiscard]] std::uint64_t free_bytes() const;

 private:
  bool take_ballast();
  void give_up_ballast();

  std::string folder_;
  std::string ballast_;
  std::uint64_t ballast_bytes_;
  std::uint64_t least_free_;
  bool has_ballast_ = false;
};

}  // namespace snapthrough::server
