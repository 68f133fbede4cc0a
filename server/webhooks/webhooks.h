#pragma once
/// @file
/// The threads that tell callbacks of the ends of jobs and sweeps.

#include <atomic>
#include <cstdint>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "server/environment.h"
#include "server/log/log.h"
#include "server/store/store.h"
#include "server/webhooks/post.h"
#include "server/webhooks/webhook_times.h"

namespace snapthrough::server {

/// How deliveries went. Thread-safe.
struct WebhookCounters {
  std::atomic<std::int64_t> delivered = 0;
  std::atomic<std::int64_t> failed = 0;    ///< attempts
  std::atomic<std::int64_t> given_up = 0;  ///< deliveries
};

/// What deliveries are made with.
struct WebhookSurroundings {
  Store& store;
  const Environment& environment;
  Log& log;
  const WebhookTimes& times;
  WebhookCounters& counters;
};

/// @brief Makes the deliveries of each origin on a thread of its own, one after the other, for as long as it
/// exists. An origin that is slow or down delays no other, nor the end of this.
class Webhooks {
 public:
  /// @param key what is signed with
  Webhooks(const WebhookSurroundings& surroundings, const std::vector<std::string>& origins, std::string key);
  /// Cuts what is being sent: it is due again at the next start.
  ~Webhooks();
  Webhooks(const Webhooks&) = delete;
  Webhooks& operator=(const Webhooks&) = delete;
  Webhooks(Webhooks&&) = delete;
  Webhooks& operator=(Webhooks&&) = delete;

 private:
  struct Sender;
  void send_due(Sender& sender, const std::stop_token& stop);
  bool deliver(Sender& sender, const Delivery& delivery, const std::stop_token& stop);
  bool settle(const Delivery& delivery, const PostOutcome& outcome);
  void note(const Delivery& delivery, LogLevel level, std::string_view outcome, const PostOutcome& post);

  const WebhookSurroundings world_;
  const std::string key_;
  std::vector<std::unique_ptr<Sender>> senders_;
  std::jthread watch_;  ///< cuts what takes too long
};

}  // namespace snapthrough::server
