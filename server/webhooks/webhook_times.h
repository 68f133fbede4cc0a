#pragma once
/// @file
/// How long a receiver of callbacks may take, and when it is tried again.

#include <chrono>
#include <vector>

namespace snapthrough::server {

struct WebhookTimes {
  std::chrono::milliseconds attempt{10'000};  ///< from connecting to the status of the response
  std::chrono::milliseconds poll{500};        ///< between looks for what is due
  /// After each attempt that failed; after one more the delivery is given up.
  std::vector<std::chrono::milliseconds> pauses{std::chrono::seconds(5), std::chrono::seconds(30),
                                                std::chrono::minutes(2), std::chrono::minutes(10),
                                                std::chrono::hours(1),   std::chrono::hours(6)};
};

}  // namespace snapthrough::server
