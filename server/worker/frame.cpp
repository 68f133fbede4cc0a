#include "server/worker/frame.h"

#include <sys/socket.h>
#include <sys/uio.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>

namespace snapthrough::server {
namespace {

struct Head {
  std::uint64_t size = 0;
  FrameType type = FrameType::done;
};

bool read_all(int fd, char* out, std::size_t size) {
  while (size > 0) {
    const ssize_t got = ::read(fd, out, size);
    if (got < 0 && errno == EINTR) {
      continue;
    }
    if (got <= 0) {
      return false;
    }
    out += got;
    size -= static_cast<std::size_t>(got);
  }
  return true;
}

}  // namespace

bool write_frame(int fd, FrameType type, std::string_view body) {
  Head head{body.size(), type};
  std::array<iovec, 2> parts{iovec{&head, sizeof head}, iovec{const_cast<char*>(body.data()), body.size()}};
  std::size_t first = 0;
  while (first < parts.size()) {
    msghdr message{};
    message.msg_iov = &parts.at(first);
    message.msg_iovlen = parts.size() - first;
    ssize_t sent = ::sendmsg(fd, &message, MSG_NOSIGNAL);
    if (sent < 0 && errno == EINTR) {
      continue;
    }
    if (sent < 0) {
      return false;
    }
    while (first < parts.size() && static_cast<std::size_t>(sent) >= parts.at(first).iov_len) {
      sent -= static_cast<ssize_t>(parts.at(first).iov_len);
      ++first;
    }
    if (first < parts.size()) {
      iovec& part = parts.at(first);
      part.iov_base = static_cast<char*>(part.iov_base) + sent;
      part.iov_len -= static_cast<std::size_t>(sent);
    }
  }
  return true;
}

bool read_frame(int fd, Frame& frame, std::uint64_t most) {
  std::array<char, sizeof(Head)> bytes{};
  if (!read_all(fd, bytes.data(), bytes.size())) {
    return false;
  }
  Head head;
  std::memcpy(&head, bytes.data(), sizeof head);
  if (head.size > most) {
    return false;
  }
  frame.type = head.type;
  frame.body.resize(head.size);
  return read_all(fd, frame.body.data(), frame.body.size());
}

}  // namespace snapthrough::server
