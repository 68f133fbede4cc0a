#pragma once
/// @file
/// Whole requests from a socket, whole responses to it, within time limits.

#include <atomic>
#include <chrono>
#include <string>
#include <string_view>

#include "server/http/wire.h"

namespace snapthrough::server::http {

/// How long a client may take.
struct WireTimes {
  std::chrono::milliseconds idle{10'000};  ///< until the first byte of a request
  std::chrono::milliseconds head{10'000};  ///< from the first byte to the end of the head
  std::chrono::milliseconds body{60'000};  ///< for the body
  std::chrono::milliseconds send{30'000};  ///< to take a response
};

/// Wakes every connection that waits in receive(), once and for ever.
class StopSignal {
 public:
  StopSignal();
  ~StopSignal();
  StopSignal(const StopSignal&) = delete;
  StopSignal& operator=(const StopSignal&) = delete;
  StopSignal(StopSignal&&) = delete;
  StopSignal& operator=(StopSignal&&) = delete;

  void raise();
  [[nodiscard]] bool raised() const { return raised_; }
  [[nodiscard]] int descriptor() const { return descriptor_; }

 private:
  int descriptor_ = -1;
  std::atomic<bool> raised_ = false;
};

/// A complete request, or why there is none.
struct Received {
  enum class Kind { request, refused, closed } kind = Kind::closed;
  Head head;              ///< of a request or a refused one
  std::string head_text;  ///< cleaned, up to and including the empty line
  std::string body;
};

/// @brief One client's connection; owns nothing of the socket but the bytes read ahead. Not thread-safe.
class Connection {
 public:
  Connection(int socket, const WireLimits& limits, const WireTimes& times, const StopSignal& stop)
      : socket_(socket), limits_(limits), times_(times), stop_(stop) {}

  /// Waits for the next request. `closed` when the client went away, was too slow, or the service stops.
  Received receive();
  /// False when the client does not take it in time.
  bool send(std::string_view bytes) const;
  /// Ends the sending side and discards what still comes for a moment, so that a client which is still
  /// sending reads the response instead of an aborted connection.
  void linger() const;

 private:
  using Clock = std::chrono::steady_clock;
  bool fill(std::size_t wanted, Clock::time_point deadline);
  bool wait_readable(Clock::time_point deadline) const;
  bool read_some();

  int socket_;
  const WireLimits& limits_;
  const WireTimes& times_;
  const StopSignal& stop_;
  std::string buffer_;
};

}  // namespace snapthrough::server::http
