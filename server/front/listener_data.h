#pragma once
/// @file
/// Options of a listener, and what it tells of its connections.

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <string>

#include "server/front/request_head.h"

namespace snapthrough::server::http {

/// Time limits for clients.
struct ClientTimes {
  std::chrono::milliseconds idle{75'000};     ///< to the first byte of a request
  std::chrono::milliseconds head{10'000};     ///< from the first byte to the end of the head
  std::chrono::milliseconds body{60'000};     ///< to receive the body
  std::chrono::milliseconds send{30'000};     ///< for a client to take some bytes of a response
  std::chrono::milliseconds ping{15'000};     ///< between comments on a stream without events
  std::chrono::milliseconds reading{10'000};  ///< processor time to read and check what was sent
  std::chrono::milliseconds thread{5'000};    ///< for a thread, until the service is not ready
  std::chrono::milliseconds drain{2'000};     ///< for requests and responses under way when the service stops
  std::chrono::milliseconds settle{500};      ///< to a request when the service stops, from the last response
};

/// Options of a listener.
struct ListenerOptions {
  std::string host = "127.0.0.1";
  int port = 8080;           ///< port; 0: any free one
  int threads = 32;          ///< requests computed at a time; others wait
  int connections = 10'000;  ///< open connections; further ones are refused with 503
  int streams = 200;         ///< open server-sent event streams; further ones are refused with 503
  HeadLimits limits;
  ClientTimes times;
};

/// Open connections and their memory. Large bodies, which are worked on one at a time, do not count in
/// `longest_wait`.
struct ListenerLoad {
  int connections = 0;
  int streams = 0;
  std::size_t buffered_bytes = 0;  ///< bytes of incomplete requests and of responses that are being sent
  /// Longest time for which complete requests of a party have waited because other parties have all threads.
  std::chrono::steady_clock::duration longest_wait{0};
  std::int64_t without_memory = 0;  ///< connections that ended because there was no memory for them
};

}  // namespace snapthrough::server::http
