#pragma once
/// @file
/// What streams of server-sent events have in common, whatever they follow.

#include <atomic>
#include <cstdint>
#include <memory>
#include <string>

#include "server/queue/job_service.h"
#include "server/resources/message.h"

namespace snapthrough::server::http {

/// One server-sent event; its data is one line.
[[nodiscard]] std::string event_text(std::uint64_t id, const char* kind, const std::string& data);

/// @brief One client that follows one thing with an id until it ends. News come from the threads of those who
/// work on it, one at a time; the rest is called by the listener.
class Following : public StreamSource {
 public:
  /// @param last_id of the last event that the client has seen; 0: none
  Following(JobService& jobs, std::string id, std::uint64_t last_id, Stream::Push push);

  /// Sends the last events once the end was announced.
  void poll() override;

 protected:
  /// The events of the end, as the store has it; empty when it has not ended (the service stops).
  [[nodiscard]] virtual std::string ending() = 0;

  /// It has ended already, or is not there: poll() does the rest.
  void end_at_once() { *ended_ = true; }
  /// Sends the status it has now, which tells all up to that number.
  void send_status(std::uint64_t number, const std::string& document);
  /// From now on the announced end is seen.
  void listen_for_end();
  /// Whether the client lacks this event.
  [[nodiscard]] bool lacks(std::uint64_t number) const { return number > last_; }
  /// Sends an event that the client lacks. Only for callbacks that come one at a time.
  void send(std::uint64_t number, const char* kind, const std::string& data);
  /// Sends progress, unless some was sent a moment ago.
  void send_progress(std::uint64_t number, const std::string& data);

  JobService& jobs_;
  const std::string id_;

 private:
  std::atomic<std::uint64_t> last_;
  std::shared_ptr<std::atomic<bool>> ended_ = std::make_shared<std::atomic<bool>>(false);
  bool finished_ = false;
  double next_progress_ = 0.0;
  Stream::Push push_;
  JobCompletions::Ticket ticket_;
};

}  // namespace snapthrough::server::http
