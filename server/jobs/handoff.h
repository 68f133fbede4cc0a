#pragma once
/// @file
/// Jobs that are given to a worker of the same process directly, beside the store.

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <future>
#include <mutex>
#include <optional>
#include <stop_token>
#include <string>

#include "server/environment.h"
#include "server/jobs/job.h"

namespace snapthrough::server {

/// A job that goes to an idle worker while it is still being stored: solving and storing overlap.
struct Handoff {
  Claim claim;
  std::shared_future<bool> stored;  ///< true: what the store is asked from then on comes after the job
};

/// @brief Where workers wait for jobs. Thread-safe.
class HandoffQueue {
 public:
  /// One more job waits in the store.
  void ring();
  /// Gives the job to an idle worker; false (and the job is left alone) when none is idle.
  bool offer(Handoff& handoff);
  /// Workers that wait.
  [[nodiscard]] std::size_t idle();
  /// Waits for a job that is given, a ring since `seen` (which it updates), a stop, or the end of the time.
  std::optional<Handoff> wait(std::uint64_t& seen, std::stop_token stop, std::chrono::duration<double> time);

 private:
  std::mutex mutex_;
  std::condition_variable_any changed_;
  std::uint64_t rings_ = 0;
  std::size_t idle_ = 0;
  std::deque<Handoff> given_;
};

}  // namespace snapthrough::server
