#pragma once
/// @file
/// Limits how many clients are worked on at a time; others wait in the order of arrival.

#include <cstdint>
#include <deque>
#include <mutex>
#include <optional>

namespace snapthrough::server::http {

/// A fixed number of turns. Thread-safe; no function blocks.
class Turns {
 public:
  explicit Turns(int count) : free_(count) {}

  /// Returns whether `who` gets a turn at once; else `who` joins the end of the queue for pass().
  bool take(std::uint64_t who) {
    const std::lock_guard guard(mutex_);
    if (free_ == 0) {
      row_.push_back(who);
      return false;
    }
    --free_;
    return true;
  }

  /// Passes a turn to the first in the queue and returns it; nullopt when the queue is empty.
  std::optional<std::uint64_t> pass() {
    const std::lock_guard guard(mutex_);
    if (row_.empty()) {
      ++free_;
      return std::nullopt;
    }
    const std::uint64_t next = row_.front();
    row_.pop_front();
    return next;
  }

 private:
  std::mutex mutex_;
  int free_;
  std::deque<std::uint64_t> row_;
};

}  // namespace snapthrough::server::http
