#pragma once
/// @file
/// One POST to a callback.

#include <chrono>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "server/descriptor.h"

namespace snapthrough::server {

/// What became of a POST.
struct PostOutcome {
  int status = 0;       ///< of the response; 0: there was none
  std::string trouble;  ///< why there was none
  [[nodiscard]] bool delivered() const { return status >= 200 && status < 300; }
};

/// @brief Sends POST requests to one origin, one at a time, each on a connection of its own, by no proxy. The
/// certificate of an https origin has to be one that the system trusts for its host. A redirect is not
/// followed, a body of a response is not kept. Only cut_late() may be called from other threads.
class Poster {
 public:
  /// @param origin "https://host:port" or "http://host:port"
  /// @param longest from connecting to the status of the response
  Poster(std::string origin, std::chrono::milliseconds longest)
      : origin_(std::move(origin)), longest_(longest) {}

  /// Sends JSON. @param target what follows the origin in the address
  [[nodiscard]] PostOutcome post(const std::string& target, const std::string& body,
                                 const std::vector<std::pair<std::string, std::string>>& headers);
  /// Ends a POST that has taken longer than it may, or any if `now`. To be called again and again: what is
  /// being connected may have another address to try.
  void cut_late(bool now);

 private:
  using Clock = std::chrono::steady_clock;
  void watch(int socket);

  const std::string origin_;
  const std::chrono::milliseconds longest_;
  std::mutex mutex_;
  Clock::time_point deadline_;
  Descriptor socket_;  ///< a duplicate: the library may close its own at any moment
};

}  // namespace snapthrough::server
