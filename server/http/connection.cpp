#include "server/http/connection.h"

#include <poll.h>
#include <sys/eventfd.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <system_error>
#include <utility>

namespace snapthrough::server::http {
namespace {

constexpr std::string_view kHeadEnd = "\r\n\r\n";
/// What a client that is sending may still take once the service stops.
constexpr std::chrono::milliseconds kStopGrace{2'000};
constexpr std::chrono::milliseconds kLinger{500};

int milliseconds_until(std::chrono::steady_clock::time_point deadline) {
  const auto left =
      std::chrono::ceil<std::chrono::milliseconds>(deadline - std::chrono::steady_clock::now()).count();
  return static_cast<int>(std::max<std::int64_t>(left, 0));
}

Received refused(Head head) {
  Received received;
  received.kind = Received::Kind::refused;
  received.head = std::move(head);
  return received;
}

}  // namespace

StopSignal::StopSignal() : descriptor_(::eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)) {
  if (descriptor_ < 0) {
    throw std::system_error(errno, std::generic_category(), "eventfd");
  }
}

StopSignal::~StopSignal() { ::close(descriptor_); }

void StopSignal::raise() {
  raised_ = true;
  const std::uint64_t one = 1;
  // It stays readable for ever: nobody reads it. A full counter would be readable too.
  [[maybe_unused]] const ssize_t written = ::write(descriptor_, &one, sizeof one);
}

bool Connection::wait_readable(Clock::time_point deadline) const {
  std::array<pollfd, 2> watched{{{socket_, POLLIN, 0}, {stop_.descriptor(), POLLIN, 0}}};
  if (stop_.raised()) {
    if (buffer_.empty()) {
      return false;
    }
    watched[1].fd = -1;
    deadline = std::min(deadline, Clock::now() + kStopGrace);
  }
  int ready = 0;
  do {
    ready = ::poll(watched.data(), watched.size(), milliseconds_until(deadline));
  } while (ready < 0 && errno == EINTR);
  if (ready > 0 && watched[0].revents == 0) {
    return wait_readable(deadline);  // the stop signal: once more, now with the grace time
  }
  return ready > 0;
}

bool Connection::read_some() {
  std::array<char, 16 * 1024> chunk{};
  ssize_t count = 0;
  do {
    count = ::recv(socket_, chunk.data(), chunk.size(), 0);
  } while (count < 0 && errno == EINTR);
  if (count <= 0) {
    return false;
  }
  buffer_.append(chunk.data(), static_cast<std::size_t>(count));
  return true;
}

bool Connection::fill(std::size_t wanted, Clock::time_point deadline) {
  while (buffer_.size() < wanted) {
    if (!wait_readable(deadline) || !read_some()) {
      return false;
    }
  }
  return true;
}

Received Connection::receive() {
  if (!fill(1, Clock::now() + times_.idle)) {
    return {};
  }
  const Clock::time_point head_deadline = Clock::now() + times_.head;
  std::size_t head_end = 0;
  while ((head_end = buffer_.find(kHeadEnd)) == std::string::npos && buffer_.size() <= limits_.head_bytes) {
    if (!fill(buffer_.size() + 1, head_deadline)) {
      return {};
    }
  }
  if (head_end == std::string::npos || head_end + kHeadEnd.size() > limits_.head_bytes) {
    Head head;
    head.refusal = Refusal{431, "The headers may have " + std::to_string(limits_.head_bytes) + " bytes."};
    return refused(std::move(head));
  }
  const std::size_t head_size = head_end + kHeadEnd.size();
  Received received;
  received.head = read_head(std::string_view(buffer_).substr(0, head_size), limits_);
  if (received.head.refusal) {
    return refused(std::move(received.head));
  }
  received.head_text = cleaned_head(std::string_view(buffer_).substr(0, head_size));
  const std::size_t total = head_size + received.head.body_bytes;
  if (received.head.expects_continue && buffer_.size() < total && !send("HTTP/1.1 100 Continue\r\n\r\n")) {
    return {};
  }
  if (!fill(total, Clock::now() + times_.body)) {
    return {};
  }
  received.kind = Received::Kind::request;
  received.body = buffer_.substr(head_size, received.head.body_bytes);
  buffer_.erase(0, total);
  return received;
}

bool Connection::send(std::string_view bytes) const {
  const Clock::time_point deadline = Clock::now() + times_.send;
  while (!bytes.empty()) {
    const ssize_t count = ::send(socket_, bytes.data(), bytes.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
    if (count > 0) {
      bytes.remove_prefix(static_cast<std::size_t>(count));
      continue;
    }
    pollfd writable{socket_, POLLOUT, 0};
    const bool again = count < 0 && (errno == EAGAIN || errno == EWOULDBLOCK || errno == EINTR);
    if (!again || ::poll(&writable, 1, milliseconds_until(deadline)) == 0) {
      return false;
    }
  }
  return true;
}

void Connection::linger() const {
  ::shutdown(socket_, SHUT_WR);
  const Clock::time_point deadline = Clock::now() + kLinger;
  std::array<char, 16 * 1024> discarded{};
  pollfd readable{socket_, POLLIN, 0};
  while (Clock::now() < deadline && ::poll(&readable, 1, milliseconds_until(deadline)) > 0) {
    if (::recv(socket_, discarded.data(), discarded.size(), MSG_DONTWAIT) <= 0) {
      return;
    }
  }
}

}  // namespace snapthrough::server::http
