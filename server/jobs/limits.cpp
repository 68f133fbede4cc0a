#include "server/jobs/limits.h"

namespace snapthrough::server {

Status StoreHealth::take_room(std::size_t document) {
  // the write-ahead log has it before the file has it, and a result comes, too
  const std::int64_t bytes = 3 * static_cast<std::int64_t>(document);
  if (room.fetch_sub(bytes) >= bytes) {
    return {};
  }
  room += bytes;
  return {StatusCode::unavailable, "the disk has no room for this document at the moment"};
}

Status StoreHealth::takes_work() const {
  if (draining) {
    return {StatusCode::stopping, "The service is stopping."};
  }
  if (!has_space) {
    return {StatusCode::unavailable, "the disk is full"};
  }
  return writable ? Status() : Status(StatusCode::unavailable, "the store cannot be written");
}

}  // namespace snapthrough::server
