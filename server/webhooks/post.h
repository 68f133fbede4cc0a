#pragma once
/// @file
/// HTTP client for callbacks.

#include <chrono>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "server/descriptor.h"

namespace snapthrough::server {

/// Outcome of a POST.
struct PostOutcome {
  int status = 0;       ///< HTTP status; 0: no response
  std::string trouble;  ///< why there is no response
  [[nodiscard]] bool delivered() const { return status >= 200 && status < 300; }
};

/// @brief Sends POST requests to one origin, one at a time, each on its own connection without a proxy. The
/// system must trust the certificate of an https origin for its host. Redirects are not followed; response
/// bodies are discarded. Only cut_late() may be called from other threads.
class Poster {
 public:
  /// @param origin "https://host:port" or "http://host:port"
  /// @param longest time limit from connecting to the response's status
  Poster(std::string origin, std::chrono::milliseconds longest)
      : origin_(std::move(origin)), longest_(longest) {}

  /// Sends JSON. @param target path and query of the address
  [[nodiscard]] PostOutcome post(const std::string& target, const std::string& body,
                                 const std::vector<std::pair<std::string, std::string>>& headers);
  /// Aborts a POST that exceeds its time limit, or any POST if `now`. Call it repeatedly: a client that
  /// connects may try another address.
  void cut_late(bool now);

 private:
  using Clock = std::chrono::steady_clock;
  void watch(int socket);

  const std::string origin_;
  const std::chrono::milliseconds longest_;
  std::mutex mutex_;
  Clock::time_point deadline_;
  Descriptor socket_;  ///< a duplicate, because the library may close its own at any time
};

}  // namespace snapthrough::server
