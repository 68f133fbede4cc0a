#pragma once
/// @file
/// A receiver of callbacks on a free port of 127.0.0.1.

#include <condition_variable>
#include <functional>
#include <map>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "server/front/sockets.h"

namespace snapthrough::server::test {

/// What came in one request. Names of headers are in lower case.
struct Told {
  std::string target;
  std::map<std::string, std::string> headers;
  std::string body;
};

/// @brief Reads requests, each on a connection of its own, and answers as it is told to.
class Receiver {
 public:
  /// The bytes to answer the request of that number (from 0) with. What ends in kDrip is followed by a byte
  /// every 10 ms; nothing: the connection is held open without an answer.
  using Answer = std::function<std::string(int)>;
  static constexpr char kDrip = '\x01';

  explicit Receiver(Answer answer);
  Receiver();  ///< takes everything
  ~Receiver();
  Receiver(const Receiver&) = delete;
  Receiver& operator=(const Receiver&) = delete;
  Receiver(Receiver&&) = delete;
  Receiver& operator=(Receiver&&) = delete;

  /// What came, once it is so many; less after kPatience.
  std::vector<Told> wait_for(std::size_t count);
  [[nodiscard]] std::vector<Told> told();
  /// "127.0.0.1:port"
  [[nodiscard]] std::string host() const;
  /// An address of it.
  [[nodiscard]] std::string address() const { return "http://" + host() + "/ended?x=1"; }

 private:
  void serve(int socket, const std::stop_token& end);

  Answer answer_;
  Descriptor listener_;
  std::mutex mutex_;
  std::condition_variable_any changed_;
  std::vector<Told> told_;
  std::vector<std::jthread> connections_;
  std::jthread thread_;
};

/// A whole response without a body.
std::string response(int status, const std::string& headers = "");

}  // namespace snapthrough::server::test
