#pragma once
/// @file
/// How threads of one process learn that something happened to a job, without asking the store again and
/// again.

#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <unordered_map>

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

/// @brief Latest progress of the jobs that run in this process, and who follows it. Thread-safe.
class ProgressBoard {
 public:
  /// Follows one job for as long as it exists.
  class Follower {
   public:
    /// The callback must be quick, must not throw, and must not use the board.
    Follower(ProgressBoard& board, std::string id, std::function<void(const Progress&)> callback);
    ~Follower();
    Follower(const Follower&) = delete;
    Follower& operator=(const Follower&) = delete;
    Follower(Follower&&) = delete;
    Follower& operator=(Follower&&) = delete;

   private:
    friend class ProgressBoard;
    ProgressBoard& board_;
    std::string id_;
    std::function<void(const Progress&)> callback_;
  };

  void set(const std::string& id, const Progress& progress);
  void erase(const std::string& id);
  [[nodiscard]] std::optional<Progress> get(const std::string& id) const;

 private:
  mutable std::mutex mutex_;
  std::unordered_map<std::string, Progress> latest_;
  std::unordered_multimap<std::string, Follower*> followers_;
};

}  // namespace snapthrough::server
