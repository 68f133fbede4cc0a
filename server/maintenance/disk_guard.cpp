#include "server/maintenance/disk_guard.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <sys/statvfs.h>
#include <unistd.h>

#include <algorithm>
#include <utility>

namespace snapthrough::server {

DiskGuard::DiskGuard(std::string store_path, std::uint64_t ballast_bytes, std::uint64_t least_free)
    : ballast_(std::move(store_path) + ".ballast"), ballast_bytes_(ballast_bytes), least_free_(least_free) {
  const std::size_t slash = ballast_.rfind('/');
  folder_ = slash == std::string::npos ? "." : ballast_.substr(0, slash + 1);
  struct stat info {};
  has_ballast_ =
      ::stat(ballast_.c_str(), &info) == 0 && static_cast<std::uint64_t>(info.st_size) >= ballast_bytes_;
}

std::uint64_t DiskGuard::free_bytes() const {
  struct statvfs info {};
  if (::statvfs(folder_.c_str(), &info) != 0) {
    return 0;
  }
  return static_cast<std::uint64_t>(info.f_bavail) * info.f_frsize;
}

std::uint64_t DiskGuard::room(std::uint64_t reusable) const {
  const std::uint64_t free = free_bytes();
  return free + reusable < least_free_ ? 0 : std::min(free, free + reusable - least_free_);
}

bool DiskGuard::check(bool writable, std::uint64_t reusable) {
  const std::uint64_t free = free_bytes();
  if (!writable || free + reusable < least_free_) {
    if (!writable) {
      give_up_ballast();
    }
    return false;
  }
  if (has_ballast_ || ballast_bytes_ == 0) {
    return true;
  }
  return free >= 2 * ballast_bytes_ && free + reusable >= 2 * ballast_bytes_ + least_free_ && take_ballast();
}

bool DiskGuard::take_ballast() {
  const int file = ::open(ballast_.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0600);
  if (file < 0) {
    return false;
  }
  has_ballast_ = ::posix_fallocate(file, 0, static_cast<off_t>(ballast_bytes_)) == 0;
  ::close(file);
  if (!has_ballast_) {
    give_up_ballast();
  }
  return has_ballast_;
}

void DiskGuard::give_up_ballast() {
  ::unlink(ballast_.c_str());
  has_ballast_ = false;
}

}  // namespace snapthrough::server
