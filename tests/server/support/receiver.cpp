#include "tests/server/support/receiver.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <sstream>
#include <utility>

#include "tests/server/support/eventually.h"

namespace snapthrough::server::test {
namespace {

/// Reads a whole request; empty target when the connection ends first.
Told read_request(int socket) {
  std::string text;
  std::size_t head = std::string::npos;
  std::size_t body = 0;
  std::array<char, 4096> buffer{};
  Told told;
  while (head == std::string::npos || text.size() < head + 4 + body) {
    const ssize_t size = ::recv(socket, buffer.data(), buffer.size(), 0);
    if (size <= 0) {
      return {};
    }
    text.append(buffer.data(), static_cast<std::size_t>(size));
    head = text.find("\r\n\r\n");
    const std::size_t length = text.find("Content-Length: ");
    body = length < head ? std::stoul(text.substr(length + 16)) : 0;
  }
  std::istringstream lines(text.substr(0, head));
  std::string line;
  std::getline(lines, line);
  told.target = line.substr(0, line.rfind(' '));
  while (std::getline(lines, line)) {
    const std::size_t colon = line.find(": ");
    std::string name = line.substr(0, colon);
    std::transform(name.begin(), name.end(), name.begin(),
                   [](char c) { return static_cast<char>(c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c); });
    std::string value = line.substr(colon + 2);
    value.erase(value.find_last_not_of('\r') + 1);
    told.headers[name] = value;
  }
  told.body = text.substr(head + 4);
  return told;
}

bool send_all(int socket, const std::string& bytes) {
  return ::send(socket, bytes.data(), bytes.size(), MSG_NOSIGNAL) == static_cast<ssize_t>(bytes.size());
}

bool readable(int socket, int milliseconds) {
  pollfd poll{socket, POLLIN, 0};
  return ::poll(&poll, 1, milliseconds) > 0;
}

}  // namespace

Receiver::Receiver(Answer answer)
    : answer_(std::move(answer)), listener_(std::move(http::listen_on("127.0.0.1", 0)).value()) {
  thread_ = std::jthread([this](const std::stop_token& stop) {
    while (!stop.stop_requested()) {
      std::string remote;
      if (!readable(listener_.get(), 10)) {
        continue;
      }
      if (const int socket = http::accept_from(listener_.get(), remote); socket >= 0) {
        connections_.emplace_back([this, socket](const std::stop_token& end) { serve(socket, end); });
      }
    }
  });
}

Receiver::Receiver() : Receiver([](int) { return response(204); }) {}

Receiver::~Receiver() {
  thread_.request_stop();
  thread_.join();
  for (std::jthread& connection : connections_) {
    connection.request_stop();
  }
}

/// Ends when the other side does, or the receiver while it holds a connection.
void Receiver::serve(int accepted, const std::stop_token& end) {
  const Descriptor socket(accepted);
  ::fcntl(accepted, F_SETFL, 0);  // it may wait
  const Told told = read_request(accepted);
  if (told.target.empty()) {
    return;
  }
  int number = 0;
  {
    const std::lock_guard guard(mutex_);
    number = static_cast<int>(told_.size());
    told_.push_back(told);
  }
  changed_.notify_all();
  std::string answer = answer_(number);
  const bool hold = answer.empty();
  const bool drip = !hold && answer.back() == kDrip;
  if (drip) {
    answer.pop_back();
  }
  send_all(accepted, answer);
  while (hold && !end.stop_requested() && !readable(accepted, 10)) {
  }
  while (drip && !end.stop_requested() && !readable(accepted, 10) && send_all(accepted, "x")) {
  }
}

std::vector<Told> Receiver::wait_for(std::size_t count) {
  std::unique_lock lock(mutex_);
  changed_.wait_for(lock, kPatience, [&] { return told_.size() >= count; });
  return told_;
}

std::vector<Told> Receiver::told() {
  const std::lock_guard guard(mutex_);
  return told_;
}

std::string Receiver::host() const { return "127.0.0.1:" + std::to_string(http::port_of(listener_.get())); }

std::string response(int status, const std::string& headers) {
  return "HTTP/1.1 " + std::to_string(status) + " x\r\nContent-Length: 0\r\n" + headers + "\r\n";
}

}  // namespace snapthrough::server::test
