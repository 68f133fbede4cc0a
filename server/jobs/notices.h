#pragma once
/// @file
/// How threads of one process learn that something happened to a job, without asking the store again and
/// again.

#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "solver/solve.h"

namespace snapthrough::server {

/// @brief Tells those who wait that a job has ended. Thread-safe.
///
/// A waiter makes its Ticket before it looks at the store, so that an end in between is not missed.
class JobEnds {
 public:
  class Ticket {
   public:
    Ticket(JobEnds& ends, std::string id);
    ~Ticket();
    Ticket(const Ticket&) = delete;
    Ticket& operator=(const Ticket&) = delete;
    Ticket(Ticket&&) = delete;
    Ticket& operator=(Ticket&&) = delete;

    /// @brief Calls it once when the job has ended or the service closes, on whatever thread; at once when
    /// that is so already. It must be quick, must not throw, and must not use JobEnds.
    void on_end(std::function<void()> callback);

   private:
    friend class JobEnds;
    JobEnds& ends_;
    std::string id_;
    bool ended_ = false;
    std::function<void()> callback_;
  };

  /// The job is in a final state, or gone, and the store says so.
  void announce(const std::string& id);
  /// Nobody shall wait any longer, now or later.
  void close();

 private:
  static void call(Ticket& ticket);
  std::mutex mutex_;
  bool closed_ = false;
  std::unordered_multimap<std::string, Ticket*> tickets_;
};

/// @brief The latest news of what this process works on, by id, and who follows it. Thread-safe.
template <class News>
class NewsBoard {
 public:
  /// Follows one id for as long as it exists.
  class Follower {
   public:
    /// Tells the latest news at once if there are any. The callback is called by one thread at a time; it
    /// must be quick, must not throw, and must not use the board.
    Follower(NewsBoard& board, std::string id, std::function<void(const News&)> callback)
        : board_(board), id_(std::move(id)), callback_(std::move(callback)) {
      const std::lock_guard guard(board_.mutex_);
      board_.followers_.emplace(id_, this);
      if (const auto latest = board_.latest_.find(id_); latest != board_.latest_.end()) {
        callback_(latest->second);
      }
    }
    ~Follower() {
      const std::lock_guard guard(board_.mutex_);
      const auto [first, last] = board_.followers_.equal_range(id_);
      for (auto it = first; it != last; ++it) {
        if (it->second == this) {
          board_.followers_.erase(it);
          return;
        }
      }
    }
    Follower(const Follower&) = delete;
    Follower& operator=(const Follower&) = delete;
    Follower(Follower&&) = delete;
    Follower& operator=(Follower&&) = delete;

   private:
    friend class NewsBoard;
    NewsBoard& board_;
    std::string id_;
    std::function<void(const News&)> callback_;
  };

  /// Changes what is remembered (which begins empty) and tells the followers.
  /// @param change called with News&
  template <class Change>
  void update(const std::string& id, Change change) {
    const std::lock_guard guard(mutex_);
    News& news = latest_[id];
    change(news);
    tell(id, news);
  }
  /// Only tells the followers.
  void pass_on(const std::string& id, const News& news) const {
    const std::lock_guard guard(mutex_);
    tell(id, news);
  }
  void erase(const std::string& id) {
    const std::lock_guard guard(mutex_);
    latest_.erase(id);
  }
  /// One field of what is remembered.
  template <class Field>
  [[nodiscard]] std::optional<Field> get(const std::string& id, Field News::*field) const {
    const std::lock_guard guard(mutex_);
    const auto found = latest_.find(id);
    return found == latest_.end() ? std::nullopt : std::optional<Field>(found->second.*field);
  }

 private:
  void tell(const std::string& id, const News& news) const {
    const auto [first, last] = followers_.equal_range(id);
    for (auto it = first; it != last; ++it) {
      it->second->callback_(news);
    }
  }
  mutable std::mutex mutex_;
  std::unordered_map<std::string, News> latest_;
  std::unordered_multimap<std::string, Follower*> followers_;
};

/// A critical point that a running analysis has found.
struct FoundPoint {
  std::uint64_t number = 0;  ///< JobNews::number of the news that brought it
  CriticalPoint point;
};

/// What a running analysis has told so far.
struct JobNews {
  int attempt = 0;
  std::uint64_t number = 0;          ///< how often it told something in this attempt
  std::optional<Progress> progress;  ///< the latest
  std::vector<FoundPoint> found;     ///< all, in the order they were found
};

/// Where the jobs are that run in this process.
using ProgressBoard = NewsBoard<JobNews>;

}  // namespace snapthrough::server
