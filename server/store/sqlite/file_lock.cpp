#include "server/store/sqlite/file_lock.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <system_error>

namespace snapthrough::server::sqlite {

namespace {

bool sync_path(const std::string& path, int flags) {
  const Descriptor file(::open(path.c_str(), flags | O_CLOEXEC));
  return file.get() >= 0 && ::fsync(file.get()) == 0;
}

}  // namespace

StatusOr<Descriptor> lock_file(const std::string& path) {
  Descriptor file(::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644));
  if (file.get() < 0) {
    return Status(StatusCode::io_error, path + ": " + std::generic_category().message(errno));
  }
  if (::flock(file.get(), LOCK_EX | LOCK_NB) != 0) {
    return Status(StatusCode::unavailable, path + ": the store is in use by another process");
  }
  return file;
}

Status publish_file(const std::string& unfinished, const std::string& name) {
  const std::size_t slash = name.rfind('/');
  const std::string folder = slash == std::string::npos ? "." : name.substr(0, slash + 1);
  if (!sync_path(unfinished, O_RDWR) || ::rename(unfinished.c_str(), name.c_str()) != 0 ||
      !sync_path(folder, O_RDONLY | O_DIRECTORY)) {
    return {StatusCode::io_error, name + ": " + std::generic_category().message(errno)};
  }
  return {};
}

}  // namespace snapthrough::server::sqlite
