#pragma once
/// @file
/// Common base of server-sent event streams.

#include <atomic>
#include <cstdint>
#include <memory>
#include <string>

#include "server/queue/job_service.h"
#include "server/resources/message.h"

namespace snapthrough::server::http {

/// Returns a server-sent event; its data is one line.
[[nodiscard]] std::string event_text(std::uint64_t id, const char* kind, const std::string& data);

/// @brief A client that follows a job or sweep until its end. Threads that work on it deliver news, one at a
/// time; the listener calls the other functions.
class Following : public StreamSource {
 public:
  /// @param last_id id of the last event that the client received; 0: none
  Following(JobService& jobs, std::string id, std::uint64_t last_id, Stream::Push push);

  /// Sends the last events after the end was announced.
  void poll() override;

 protected:
  /// Returns the events of the end from the store; "" when it has not ended (the service stops).
  [[nodiscard]] virtual std::string ending() = 0;

  /// Makes poll() send the end, for a job or sweep that has ended or does not exist.
  void end_at_once() { *ended_ = true; }
  /// Sends the current status, which includes all events up to `number`.
  void send_status(std::uint64_t number, const std::string& document);
  /// Starts to receive the announcement of the end.
  void listen_for_end();
  /// Returns whether the client has not received an event.
  [[nodiscard]] bool lacks(std::uint64_t number) const { return number > last_; }
  /// Sends an event that the client lacks. Only for callbacks that come one at a time.
  void send(std::uint64_t number, const char* kind, const std::string& data);
  /// Sends progress, unless the last one was sent less than 50 ms ago.
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
