#pragma once
/// @file
/// How a process says that other processes should look at the store.

#include <condition_variable>
#include <mutex>
#include <stop_token>
#include <utility>

namespace snapthrough::server {

/// @brief Rung where there is new work, or where something has ended. Whoever tells the others waits for it;
/// where there are no others, nobody does. Thread-safe.
class Bell {
 public:
  void ring() {
    const std::lock_guard guard(mutex_);
    rung_ = true;
    changed_.notify_one();
  }
  /// Returns when it was rung since the last time, or on stop; whether it was rung.
  bool wait(std::stop_token stop) {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, std::move(stop), [&] { return rung_; });
    return std::exchange(rung_, false);
  }

 private:
  std::mutex mutex_;
  std::condition_variable_any changed_;
  bool rung_ = false;
};

}  // namespace snapthrough::server
