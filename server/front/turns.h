#pragma once
/// @file
/// Who may work: so many at a time, the others in the order they came.

#include <cstdint>
#include <deque>
#include <mutex>
#include <optional>

namespace snapthrough::server::http {

/// A number of turns. Thread-safe; nobody waits in here.
class Turns {
 public:
  explicit Turns(int count) : free_(count) {}

  /// Whether this one has a turn now; else it is the last in the row, and pass() will name it.
  bool take(std::uint64_t who) {
    const std::lock_guard guard(mutex_);
    if (free_ == 0) {
      row_.push_back(who);
      return false;
    }
    --free_;
    return true;
  }

  /// Passes a turn on: who has it now, or nobody.
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
