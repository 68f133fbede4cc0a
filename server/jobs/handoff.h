#pragma once
/// @file
/// Jobs that go to a worker of the same process directly, not by the store.

#include <chrono>
#include <cstdint>
#include <deque>
#include <future>
#include <optional>
#include <stop_token>
#include <string>
#include <utility>

#include "server/bell.h"
#include "server/jobs/job.h"

namespace snapthrough::server {

/// A job that a worker gets before it is stored, so that solving and storing overlap.
struct Handoff {
  Claim claim;
  std::shared_future<bool>
      stored;  ///< set when the store has queued the write (true) or refused the job (false)
};

/// @brief Queue in which workers of this process wait for jobs. Thread-safe.
class HandoffQueue {
 public:
  /// Announces one more job or item in the store; wakes one worker and one spare worker.
  void ring() {
    bell_.ring();
    for_spares_.ring();
  }
  /// Gives the job to an idle worker; returns false and leaves the job alone when no worker is idle.
  bool offer(Handoff& handoff);
  /// Number of workers in wait().
  [[nodiscard]] std::size_t idle() {
    return bell_.locked([&] { return idle_; });
  }
  /// Waits for a job from offer(), a ring after ring number `seen` (see Bell), a stop, or the end of the
  /// time.
  std::optional<Handoff> wait(std::uint64_t& seen, std::stop_token stop, std::chrono::duration<double> time);
  /// Has a spare worker wait for a ring after ring number `seen`, a stop, or the end of the time.
  void wait_as_spare(std::uint64_t& seen, std::stop_token stop, std::chrono::duration<double> time) {
    for_spares_.wait(seen, std::move(stop), time);
  }

 private:
  Bell bell_;  ///< its lock guards the members below
  std::size_t idle_ = 0;
  std::deque<Handoff> given_;
  Bell for_spares_;
};

}  // namespace snapthrough::server
