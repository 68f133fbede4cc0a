#pragma once
/// @file
/// How threads of one process learn that a job has ended, without asking the store again and again.

#include <functional>
#include <mutex>
#include <string>
#include <unordered_map>
#include <vector>

#include "server/bell.h"

namespace snapthrough::server {

/// @brief Tells those who wait that a job has ended. Thread-safe.
///
/// A waiter makes its Ticket before it looks at the store, so that an end in between is not missed.
class JobCompletions {
 public:
  /// @param bell rung with each announcement
  explicit JobCompletions(Bell& bell) : bell_(bell) {}

  class Ticket {
   public:
    Ticket(JobCompletions& completions, std::string id);
    ~Ticket();
    Ticket(const Ticket&) = delete;
    Ticket& operator=(const Ticket&) = delete;
    Ticket(Ticket&&) = delete;
    Ticket& operator=(Ticket&&) = delete;

    /// @brief Calls it once when the job has ended or the service closes, on whatever thread; at once when
    /// that is so already. It must be quick, must not throw, and must not use JobCompletions.
    void on_end(std::function<void()> callback);

   private:
    friend class JobCompletions;
    JobCompletions& completions_;
    std::string id_;
    bool ended_ = false;
    std::function<void()> callback_;
  };

  /// The job is in a final state, or gone, and the store says so: for those who wait here and elsewhere.
  void announce(const std::string& id);
  /// The same, as others know already.
  void end(const std::string& id);
  /// What is waited for.
  [[nodiscard]] std::vector<std::string> waited();
  /// Nobody shall wait any longer, now or later.
  void close();

 private:
  static void call(Ticket& ticket);
  Bell& bell_;
  std::mutex mutex_;
  bool closed_ = false;
  std::unordered_multimap<std::string, Ticket*> tickets_;
};

}  // namespace snapthrough::server
