#include "server/front/client.h"

#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <new>
#include <utility>

namespace snapthrough::server::http {
namespace {

bool would_block() { return errno == EAGAIN || errno == EWOULDBLOCK; }

/// Largest number of waiting bytes; a client that reads more slowly is disconnected.
constexpr std::size_t kMostWaiting = 256 * 1024;

}  // namespace

bool Outbox::put(const std::string& piece, bool last) {
  const std::lock_guard guard(mutex_);
  if (closed_ || waiting_.size() + piece.size() > kMostWaiting) {
    closed_ = true;
    return false;
  }
  try {
    waiting_ += piece;
  } catch (const std::bad_alloc&) {
    closed_ = true;
    return false;
  }
  last_ = last;
  return true;
}

std::string Outbox::take(bool& last) {
  const std::lock_guard guard(mutex_);
  last = last_;
  return std::exchange(waiting_, {});
}

void Outbox::close() {
  const std::lock_guard guard(mutex_);
  closed_ = true;
}

bool Outbox::closed() {
  const std::lock_guard guard(mutex_);
  return closed_;
}

Client::~Client() { close(); }

std::size_t Client::held_bytes() const {
  return reader.held() + work_bytes + output.size() + (rest ? rest->held_bytes() : 0);
}

bool Client::is_gone() {
  pollfd state{socket, POLLRDHUP, 0};
  if (::poll(&state, 1, 0) <= 0) {
    return false;
  }
  if ((state.revents & (POLLHUP | POLLERR)) == 0) {
    ask_whether_it_waits();
    return false;
  }
  return true;
}

void Client::ask_whether_it_waits() {
  if (!asked && chunked && output.empty()) {
    asked = true;
    const ssize_t sent = ::send(socket, kContinue.data(), kContinue.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
    if (sent > 0 && sent < static_cast<ssize_t>(kContinue.size())) {
      ::shutdown(socket, SHUT_RDWR);  // the response would follow half a line
    }
  }
}

bool Client::has_arrived() const {
  pollfd state{socket, POLLIN, 0};
  return ::poll(&state, 1, 0) > 0;
}

Client::Read Client::receive() {
  std::array<char, 16 * 1024> chunk;  // uninitialised: clearing costs as much as the rest
  ssize_t count = 0;
  do {
    count = ::recv(socket, chunk.data(), chunk.size(), MSG_DONTWAIT);
  } while (count < 0 && errno == EINTR);
  if (count <= 0) {
    return count < 0 && would_block() ? Read::nothing_now : Read::ended;
  }
  reader.append(std::string_view(chunk.data(), static_cast<std::size_t>(count)));
  return static_cast<std::size_t>(count) < chunk.size() ? Read::drained : Read::more;
}

Client::Sent Client::flush() {
  while (output_sent < output.size()) {
    const ssize_t count =
        ::send(socket, output.data() + output_sent, output.size() - output_sent, MSG_NOSIGNAL | MSG_DONTWAIT);
    if (count > 0) {
      output_sent += static_cast<std::size_t>(count);
    } else if (count < 0 && errno == EINTR) {
      continue;
    } else {
      return count < 0 && would_block() ? Sent::some : Sent::failed;
    }
  }
  output_sent = 0;
  output.clear();
  if (output.capacity() > 64 * 1024) {
    std::string().swap(output);
  }
  return Sent::all;
}

void Client::end_output() const { ::shutdown(socket, SHUT_WR); }

Client::Read Client::discard() const {
  std::array<char, 16 * 1024> chunk;
  const ssize_t count = ::recv(socket, chunk.data(), chunk.size(), MSG_DONTWAIT);
  if (count > 0) {
    return Read::more;
  }
  return count < 0 && (would_block() || errno == EINTR) ? Read::nothing_now : Read::ended;
}

void Client::close() {
  if (socket >= 0) {
    ::close(std::exchange(socket, -1));
  }
  phase = Phase::closed;
}

}  // namespace snapthrough::server::http
