#pragma once
/// @file
/// Threads that send callbacks at the end of jobs and sweeps.

#include <atomic>
#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "server/environment.h"
#include "server/log/log.h"
#include "server/store/store.h"
#include "server/webhooks/post.h"

namespace snapthrough::server {

/// Time limits and repetition of callbacks.
struct WebhookTimes {
  std::chrono::milliseconds attempt{10'000};  ///< limit from connecting to the response's status
  std::chrono::milliseconds poll{500};        ///< pause between queries for due deliveries
  /// Pauses after failed attempts; a delivery ends with the attempt after the last one.
  std::vector<std::chrono::milliseconds> pauses{std::chrono::seconds(5), std::chrono::seconds(30),
                                                std::chrono::minutes(2), std::chrono::minutes(10),
                                                std::chrono::hours(1),   std::chrono::hours(6)};
};

/// Counts of deliveries. Thread-safe.
struct WebhookCounters {
  std::atomic<std::int64_t> delivered = 0;
  std::atomic<std::int64_t> failed = 0;    ///< failed attempts
  std::atomic<std::int64_t> given_up = 0;  ///< abandoned deliveries
};

/// Objects that deliveries use.
struct WebhookSurroundings {
  Store& store;
  const Environment& environment;
  Log& log;
  const WebhookTimes& times;
  WebhookCounters& counters;
};

/// @brief Sends deliveries during its lifetime, those of each origin on threads of its own. A slow origin
/// delays neither other origins nor the destructor.
///
/// Deliveries of one owner have half of an origin's threads at most. A thread that an owner's receiver has
/// kept for a second or more takes a delivery of another owner next, if one is due.
class Webhooks {
 public:
  /// @param key key that signs callbacks
  Webhooks(const WebhookSurroundings& surroundings, const std::vector<std::string>& origins, std::string key);
  /// Aborts deliveries under way; they are due again at the next start.
  ~Webhooks();
  Webhooks(const Webhooks&) = delete;
  Webhooks& operator=(const Webhooks&) = delete;
  Webhooks(Webhooks&&) = delete;
  Webhooks& operator=(Webhooks&&) = delete;

 private:
  struct Host;
  struct Sender;
  void send_due(Sender& sender, const std::stop_token& stop);
  std::optional<Delivery> take(Sender& sender, const std::stop_token& stop);
  StatusOr<std::optional<Delivery>> next(Sender& sender);
  bool deliver(Sender& sender, const Delivery& delivery, const std::stop_token& stop);
  bool settle(const Delivery& delivery, const PostOutcome& outcome);
  void note(const Delivery& delivery, LogLevel level, std::string_view outcome, const PostOutcome& post);

  const WebhookSurroundings world_;
  const std::string key_;
  std::vector<std::unique_ptr<Host>> hosts_;
  std::vector<std::unique_ptr<Sender>> senders_;
  std::jthread watch_;  ///< thread that aborts late POST requests
};

}  // namespace snapthrough::server
