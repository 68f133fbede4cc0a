#include "server/worker/frame.h"

#include <sys/socket.h>
#include <sys/uio.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <utility>

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

bool read_frame(int fd, Frame& frame) {
  std::array<char, sizeof(Head)> bytes{};
  if (!read_all(fd, bytes.data(), bytes.size())) {
    return false;
  }
  Head head;
  std::memcpy(&head, bytes.data(), sizeof head);
  frame.type = head.type;
  frame.body.resize(head.size);
  return read_all(fd, frame.body.data(), frame.body.size());
}

FrameReceiver::State FrameReceiver::receive(int fd, std::uint64_t most) {
  std::array<char, 1 << 16> block;
  for (;;) {
    const bool in_head = head_.size() < sizeof(Head);
    std::string& part = in_head ? head_ : frame_.body;
    const std::uint64_t missing = (in_head ? sizeof(Head) : size_) - part.size();
    if (missing == 0) {
      return State::complete;
    }
    const ssize_t got =
        ::recv(fd, block.data(), std::min<std::uint64_t>(missing, block.size()), MSG_DONTWAIT);
    if (got < 0 && errno == EINTR) {
      continue;
    }
    if (got < 0 && errno == EAGAIN) {
      return State::incomplete;
    }
    if (got <= 0) {
      return State::gone;
    }
    part.append(block.data(), static_cast<std::size_t>(got));
    if (in_head && head_.size() == sizeof(Head)) {
      Head head;
      std::memcpy(&head, head_.data(), sizeof head);
      if (head.size > most) {
        return State::gone;
      }
      size_ = head.size;
      frame_.type = head.type;
      frame_.body.reserve(size_);  // reserves address space; unsent bytes use no memory
    }
  }
}

Frame FrameReceiver::take() {
  head_.clear();
  return std::exchange(frame_, {});
}

}  // namespace snapthrough::server
