#pragma once
/// @file
/// How one thread wakes another: Bell for a thread that sleeps, PollBell for one that waits in poll() or
/// epoll_wait().

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <stop_token>
#include <utility>

#include "server/descriptor.h"

namespace snapthrough::server {

/// @brief Wakes threads that sleep until there is something to do. Thread-safe.
///
/// Rings are counted and each sleeper keeps the count that it has seen: a ring before wait() is not missed,
/// and several rings wake a thread once.
class Bell {
 public:
  /// Counts a ring and wakes one sleeper.
  void ring() {
    wake_if([&] { return ++rings_ > 0; });
  }
  /// Runs `use()` under the lock of the bell; returns its result.
  template <class Use>
  auto locked(const Use& use) {
    const std::lock_guard guard(mutex_);
    return use();
  }
  /// Runs `change()` under the lock of the bell; wakes one sleeper, without a ring, when it returns true.
  template <class Change>
  bool wake_if(const Change& change) {
    const std::lock_guard guard(mutex_);
    const bool wake = change();
    if (wake) {
      changed_.notify_one();
    }
    return wake;
  }
  /// @brief Sleeps until a ring after ring number `seen`, until `ready()`, a stop, or the end of the time.
  /// @param[in,out] seen set to the number of the latest ring unless `ready()`
  /// @param ready called under the lock of the bell; wake_if() changes what it depends on
  /// @return whether the bell was rung after ring number `seen`
  template <class Ready>
  bool wait(std::uint64_t& seen, std::stop_token stop, std::chrono::duration<double> longest,
            const Ready& ready) {
    std::unique_lock lock(mutex_);
    changed_.wait_for(lock, std::move(stop), longest, [&] { return rings_ != seen || ready(); });
    const bool rung = rings_ != seen;
    if (!ready()) {
      seen = rings_;
    }
    return rung;
  }
  bool wait(std::uint64_t& seen, std::stop_token stop, std::chrono::duration<double> longest) {
    return wait(seen, std::move(stop), longest, [] { return false; });
  }

 private:
  std::mutex mutex_;
  std::condition_variable_any changed_;
  std::uint64_t rings_ = 0;
};

/// Sleeps for that time, or until a stop is requested.
inline void pause(const std::stop_token& stop, std::chrono::milliseconds time) {
  std::uint64_t seen = 0;
  Bell().wait(seen, stop, time);
}

/// A bell that poll() hears: its descriptor (eventfd) is readable after ring(). Thread-safe.
class PollBell {
 public:
  /// @param one_by_one each silence() takes back one ring; otherwise all
  /// @throws std::system_error without a free descriptor
  explicit PollBell(bool one_by_one = false);
  [[nodiscard]] int descriptor() const { return descriptor_.get(); }
  void ring() const;
  void silence() const;

 private:
  Descriptor descriptor_;
};

}  // namespace snapthrough::server
