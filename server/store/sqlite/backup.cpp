#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <system_error>

#include "server/descriptor.h"
#include "server/store/sqlite/parts.h"
#include "server/store/sqlite/sqlite_store.h"

namespace snapthrough::server::sqlite {
namespace {

bool sync_path(const std::string& path, int flags) {
  const Descriptor file(::open(path.c_str(), flags | O_CLOEXEC));
  return file.get() >= 0 && ::fsync(file.get()) == 0;
}

/// Files that SQLite keeps beside a database and reads with it.
constexpr std::array<const char*, 3> kBesideIt{"-journal", "-wal", "-shm"};

/// Files of a store: the database, what SQLite and the service keep beside it.
constexpr std::array<const char*, 5> kFilesOfAStore{"", "-journal", "-wal", "-shm", ".ballast"};

bool exists(const std::string& path) {
  struct stat info {};
  return ::lstat(path.c_str(), &info) == 0;
}

/// Whether two names lead to one file.
bool are_one_file(const std::string& a, const std::string& b) {
  struct stat first {
  }, second{};
  return ::stat(a.c_str(), &first) == 0 && ::stat(b.c_str(), &second) == 0 && first.st_dev == second.st_dev &&
         first.st_ino == second.st_ino;
}

/// Whether a copy named `name` would write to, or remove, a file of the store.
bool touches_store(const std::string& path, const std::string& name) {
  for (const char* own : kFilesOfAStore) {
    const auto is_own = [&](const char* ending) { return are_one_file(path + own, name + ending); };
    if (is_own("") || std::ranges::any_of(kBesideIt, is_own)) {
      return true;
    }
  }
  return false;
}

bool remove_beside(const std::string& path) {
  return std::ranges::all_of(kBesideIt, [&path](const char* ending) {
    return ::unlink((path + ending).c_str()) == 0 || errno == ENOENT;
  });
}

/// Removes an unfinished copy with the files that SQLite keeps beside it.
void remove_unfinished(const std::string& path) {
  ::unlink(path.c_str());
  remove_beside(path);
}

/// Removes an older file with what SQLite keeps beside it, if there is any of the latter: a file alone is
/// replaced at once by rename().
bool remove_with_leftovers(const std::string& name, const std::string& folder) {
  if (std::ranges::none_of(kBesideIt, [&name](const char* ending) { return exists(name + ending); })) {
    return true;
  }
  const bool removed = ::unlink(name.c_str()) == 0 || errno == ENOENT;
  return removed && remove_beside(name) && sync_path(folder, O_RDONLY | O_DIRECTORY);
}

/// @brief Writes a finished file to the disk and gives it its final name; an older file of that name goes.
///
/// SQLite would read an older file's -wal or -journal as the new one's. They are removed after the older
/// file, which is damaged without them, and before the new one has the name.
Status publish_file(const std::string& unfinished, const std::string& name) {
  const std::size_t slash = name.rfind('/');
  const std::string folder = slash == std::string::npos ? "." : name.substr(0, slash + 1);
  const bool published = sync_path(unfinished, O_RDWR) && remove_with_leftovers(name, folder) &&
                         ::rename(unfinished.c_str(), name.c_str()) == 0 &&
                         sync_path(folder, O_RDONLY | O_DIRECTORY);
  return published ? Status()
                   : Status(StatusCode::io_error, name + ": " + std::generic_category().message(errno));
}

/// Copies a store into an empty file and checks the copy. Leaves no other file beside it.
Status copy_and_check(const std::string& path, const std::string& copy_path, const std::string& target) {
  try {
    Connection(path, Access::read_only).copy_to(copy_path);
    // A connection that may write removes -wal and -shm when it is closed.
    const Connection copy(copy_path, Access::read_write);
    Statement check = copy.prepare("PRAGMA integrity_check");
    if (!check.step() || check.text(0) != "ok") {
      return {StatusCode::io_error, target + ": the copy is damaged"};
    }
  } catch (const Error& error) {
    const Status status = to_status(error);
    return {status.code(), path + ": " + status.message()};
  }
  for (const char* ending : kBesideIt) {
    if (exists(copy_path + ending)) {
      return {StatusCode::io_error, copy_path + ending + ": another process uses the unfinished copy"};
    }
  }
  return {};
}

/// Takes the lock of a file that a backup may replace; no lock when there is no such file.
StatusOr<Descriptor> lock_if_there(const std::string& path) {
  return exists(path) ? lock_file(path) : StatusOr<Descriptor>(Descriptor());
}

}  // namespace

Status back_up(const std::string& path, const std::string& target) {
  const std::string unfinished = target + ".part";
  if (touches_store(path, target) || touches_store(path, unfinished)) {
    return {StatusCode::unsupported, target + ": is, or is beside, a file of the store " + path +
                                         "; a backup needs a name of its own"};
  }
  const StatusOr<Descriptor> replaced = lock_if_there(target);
  if (!replaced.ok()) {
    return replaced.status();
  }
  const StatusOr<Descriptor> written = lock_file(unfinished);
  if (!written.ok()) {
    return written.status();
  }
  if (::fchmod(written->get(), 0600) != 0 || ::ftruncate(written->get(), 0) != 0 ||
      !remove_beside(unfinished)) {
    return {StatusCode::io_error, unfinished + ": " + std::generic_category().message(errno)};
  }
  Status status = copy_and_check(path, unfinished, target);
  if (status.ok()) {
    status = publish_file(unfinished, target);
  }
  if (!status.ok()) {
    remove_unfinished(unfinished);
  }
  return status;
}

}  // namespace snapthrough::server::sqlite
