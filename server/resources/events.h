#pragma once
/// @file
/// Server-sent events about a job or a sweep.

#include <atomic>
#include <cstdint>
#include <memory>
#include <string>

#include "server/queue/job_service.h"
#include "server/resources/message.h"

namespace snapthrough::server::http {

/// Ids of the last event, `end`, of a job and of a sweep. A client that received it need not reconnect.
inline constexpr std::uint64_t kEndOfJob = 2'000'000'000'000'000'000;
inline constexpr std::uint64_t kEndOfSweep = 1'000'000'000'000;

/// @brief Streams the events of a job. `status` comes at once. While the analysis runs: `progress` and
/// `points` of the path (at most 20 a second each, older points as far as kept), and `critical_point` for
/// each one found, earlier ones included. At the end: `critical_point` events as in the result (`final`:
/// true), then `end`, the last event.
///
/// Event ids increase; events up to `last_id` (from Last-Event-ID) are not repeated.
[[nodiscard]] std::shared_ptr<StreamSource> follow_job(JobService& jobs, const std::string& id,
                                                       std::uint64_t last_id, Stream::Push push);

/// @brief Streams the events of a sweep: `status` at once, `progress` (counts) during computation, `end`.
[[nodiscard]] std::shared_ptr<StreamSource> follow_sweep(JobService& jobs, const std::string& id,
                                                         std::uint64_t last_id, Stream::Push push);

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
