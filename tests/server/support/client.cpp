#include "tests/server/support/client.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <strings.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <sstream>
#include <system_error>
#include <thread>

#include "tests/server/support/eventually.h"

namespace snapthrough::server::test {

std::string Reply::header(const std::string& name) const {
  for (const auto& [candidate, value] : headers) {
    if (::strcasecmp(candidate.c_str(), name.c_str()) == 0) {
      return value;
    }
  }
  return "";
}

Socket::Socket(int port) : descriptor_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
  const timeval timeout{kPatience.count(), 0};  // a test that hangs shall fail instead
  ::setsockopt(descriptor_, SOL_SOCKET, SO_RCVTIMEO, &timeout, sizeof timeout);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(static_cast<std::uint16_t>(port));
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  if (::connect(descriptor_, reinterpret_cast<sockaddr*>(&address), sizeof address) != 0) {
    const int cause = errno;
    ::close(descriptor_);
    throw std::system_error(cause, std::generic_category(), "connect");
  }
}

Socket::~Socket() { ::close(descriptor_); }

void Socket::send(const std::string& bytes) const {
  std::size_t sent = 0;
  while (sent < bytes.size()) {
    const ssize_t count = ::send(descriptor_, bytes.data() + sent, bytes.size() - sent, MSG_NOSIGNAL);
    if (count < 0) {
      return;  // refused while it was still sending: the response says why
    }
    sent += static_cast<std::size_t>(count);
  }
}

void Socket::end_sending() const { ::shutdown(descriptor_, SHUT_WR); }

bool Socket::readable() const {
  pollfd state{descriptor_, POLLIN, 0};
  return !buffer_.empty() || ::poll(&state, 1, 0) > 0;
}

bool Socket::fill() {
  std::array<char, 65536> chunk{};
  const ssize_t count = ::recv(descriptor_, chunk.data(), chunk.size(), 0);
  if (count <= 0) {
    error_ = count < 0 ? errno : 0;
    return false;
  }
  buffer_.append(chunk.data(), static_cast<std::size_t>(count));
  return true;
}

Reply Socket::receive(bool without_body) {
  std::size_t head_end = 0;
  while ((head_end = buffer_.find("\r\n\r\n")) == std::string::npos) {
    if (!fill()) {
      return {};
    }
  }
  Reply reply;
  std::istringstream head(buffer_.substr(0, head_end));
  buffer_.erase(0, head_end + 4);
  std::string line;
  std::getline(head, line);
  reply.status = std::stoi(line.substr(line.find(' ') + 1));
  while (std::getline(head, line)) {
    line.erase(line.find_last_not_of("\r") + 1);
    const std::size_t colon = line.find(':');
    reply.headers.emplace_back(line.substr(0, colon), line.substr(line.find_first_not_of(' ', colon + 1)));
  }
  if (reply.header("Transfer-Encoding") == "chunked" && !without_body) {
    receive_chunks(reply);
    return reply;
  }
  const std::string length = reply.header("Content-Length");
  const std::size_t size = length.empty() || without_body ? 0 : std::stoul(length);
  while (buffer_.size() < size && fill()) {
  }
  reply.body = buffer_.substr(0, size);
  buffer_.erase(0, size);
  return reply;
}

void Socket::receive_chunks(Reply& reply) {
  reply.whole = false;
  std::string line;
  while (!(line = read_until("\r\n")).empty()) {
    const std::size_t size = std::stoul(line, nullptr, 16);
    while (buffer_.size() < size + 2 && fill()) {
    }
    if (buffer_.size() < size + 2) {
      return;
    }
    reply.body.append(buffer_, 0, size);
    buffer_.erase(0, size + 2);
    if (size == 0) {
      reply.whole = true;
      return;
    }
  }
}

std::string Socket::read_until(const std::string& mark) {
  std::size_t found = 0;
  while ((found = buffer_.find(mark)) == std::string::npos) {
    if (!fill()) {
      return std::move(buffer_);
    }
  }
  std::string text = buffer_.substr(0, found + mark.size());
  buffer_.erase(0, text.size());
  return text;
}

std::string Socket::rest() {
  while (fill()) {
  }
  return std::move(buffer_);
}

std::string Socket::read_slowly(std::size_t piece, std::chrono::milliseconds pause,
                                std::chrono::milliseconds& longest) {
  const int room = static_cast<int>(piece);
  ::setsockopt(descriptor_, SOL_SOCKET, SO_RCVBUF, &room, sizeof room);
  std::string text = std::move(buffer_);
  std::string chunk(piece, '\0');
  ssize_t count = 0;
  longest = std::chrono::milliseconds(0);
  while ((count = ::recv(descriptor_, chunk.data(), chunk.size(), 0)) > 0) {
    const auto begin = std::chrono::steady_clock::now();
    text.append(chunk, 0, static_cast<std::size_t>(count));
    std::this_thread::sleep_for(pause);
    const auto time = std::chrono::steady_clock::now() - begin;
    longest = std::max(longest, std::chrono::duration_cast<std::chrono::milliseconds>(time));
  }
  return text;
}

bool Socket::at_end() { return buffer_.empty() && !fill(); }

bool Socket::was_reset() {
  while (fill()) {
  }
  return error_ == ECONNRESET;
}

Reply call(int port, const std::string& method, const std::string& target, const std::string& body,
           const Headers& headers) {
  std::string bytes = method + " " + target + " HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n";
  for (const std::string& header : headers) {
    bytes += header + "\r\n";
  }
  if (!body.empty() || method == "POST") {
    bytes += "Content-Length: " + std::to_string(body.size()) + "\r\n";
  }
  Socket socket(port);
  socket.send(bytes + "\r\n" + body);
  return socket.receive(method == "HEAD");
}

Reply get(int port, const std::string& target, const Headers& headers) {
  return call(port, "GET", target, "", headers);
}

Reply post(int port, const std::string& target, const std::string& body, const Headers& headers) {
  return call(port, "POST", target, body, headers);
}

}  // namespace snapthrough::server::test
