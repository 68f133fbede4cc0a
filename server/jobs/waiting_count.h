#pragma once
/// @file
/// Number of accepted jobs, held in memory so that a submission need not ask the store for it.

#include <atomic>
#include <cstdint>
#include <mutex>

namespace snapthrough::server {

/// @brief Number of accepted jobs in the store. Thread-safe.
///
/// Whoever submits, claims or dismisses a job changes first the store and then this count. Between the two
/// the store's own number differs from the count, and recount() therefore waits for a later call.
class WaitingCount {
 public:
  /// A change of the store and of the count. @pre made before the store is changed
  class Change {
   public:
    explicit Change(WaitingCount& count) : count_(count) {
      const std::lock_guard lock(count_.mutex_);
      ++count_.begun_;
      ++count_.open_;
    }
    ~Change() {
      const std::lock_guard lock(count_.mutex_);
      --count_.open_;
    }
    Change(const Change&) = delete;
    Change& operator=(const Change&) = delete;
    Change(Change&&) = delete;
    Change& operator=(Change&&) = delete;

    void add(std::int64_t jobs) { count_.value_ += jobs; }

   private:
    WaitingCount& count_;
  };

  [[nodiscard]] std::int64_t value() const { return value_; }

  /// @brief Sets the count to what `query` returns, unless a change is open or was made during the query.
  /// @param query returns a StatusOr<std::int64_t>; the count stays when that is an error
  template <class Query>
  void recount(Query query) {
    std::unique_lock lock(mutex_);
    const std::uint64_t begun = begun_;
    if (open_ > 0) {
      return;
    }
    lock.unlock();
    const auto counted = query();
    lock.lock();
    if (counted.ok() && begun == begun_) {
      value_ = *counted;
    }
  }

  /// Replaces the count if it is still `before`. For a store that other processes change at any time, where
  /// the count is right to the number of changes that are open.
  void replace(std::int64_t before, std::int64_t now) { value_.compare_exchange_strong(before, now); }

 private:
  std::mutex mutex_;
  std::atomic<std::int64_t> value_ = 0;
  std::uint64_t begun_ = 0;  ///< changes made so far
  int open_ = 0;             ///< changes that are not destroyed yet
};

}  // namespace snapthrough::server
