#pragma once
/// @file
/// Time limits and repetition of callbacks.

#include <chrono>
#include <vector>

namespace snapthrough::server {

struct WebhookTimes {
  std::chrono::milliseconds attempt{10'000};  ///< limit from connecting to the response's status
  std::chrono::milliseconds poll{500};        ///< pause between queries for due deliveries
  /// Pauses after failed attempts; a delivery ends with the attempt after the last one.
  std::vector<std::chrono::milliseconds> pauses{std::chrono::seconds(5), std::chrono::seconds(30),
                                                std::chrono::minutes(2), std::chrono::minutes(10),
                                                std::chrono::hours(1),   std::chrono::hours(6)};
};

}  // namespace snapthrough::server
