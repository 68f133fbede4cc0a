#pragma once
/// @file
/// Monitors the disk of the store and keeps a reserve on it.

#include <cstdint>
#include <string>

namespace snapthrough::server {

/// @brief A ballast file beside the store. Not thread-safe.
///
/// On a full disk a database cannot even delete rows. The ballast file is deleted when a write fails; until
/// there is room for it again, no new jobs are accepted, so that the space serves results, deletions and
/// checkpoints.
class DiskGuard {
 public:
  /// @param ballast_bytes size of the ballast file; 0: none
  /// @param least_free free bytes required for new jobs
  DiskGuard(std::string store_path, std::uint64_t ballast_bytes, std::uint64_t least_free);

  /// Deletes or restores the ballast file as needed. @param writable whether the latest write succeeded
  /// @param reusable unused bytes inside the store's file
  /// @return whether there is room for new jobs
  bool check(bool writable, std::uint64_t reusable);

  /// Returns the bytes that new documents may take. @param reusable as for check()
  [[nodiscard]] std::uint64_t room(std::uint64_t reusable) const;
  /// Returns the number of bytes that the service can use.
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
