#pragma once
/// @file
/// News of ends: threads of one process learn that a job or sweep has ended without asking the store.

#include <functional>
#include <mutex>
#include <string>
#include <unordered_map>
#include <vector>

#include "server/bell.h"

namespace snapthrough::server {

/// @brief Calls back who waits for the end of a job or sweep. Thread-safe.
///
/// REQUIRES: a waiter makes its Ticket before it reads the state from the store, so that no end is missed in
/// between.
class JobCompletions {
 public:
  /// @param bell rung by announce()
  explicit JobCompletions(Bell& bell) : bell_(bell) {}

  class Ticket {
   public:
    Ticket(JobCompletions& completions, std::string id);
    ~Ticket();
    Ticket(const Ticket&) = delete;
    Ticket& operator=(const Ticket&) = delete;
    Ticket(Ticket&&) = delete;
    Ticket& operator=(Ticket&&) = delete;

    /// @brief Calls `callback` once, on any thread, when the job has ended or close() was called; at once
    /// if either has happened before. The callback must be quick, must not throw, and must not use
    /// JobCompletions.
    void on_end(std::function<void()> callback);

   private:
    friend class JobCompletions;
    JobCompletions& completions_;
    std::string id_;
    bool ended_ = false;
    std::function<void()> callback_;
  };

  /// Tells waiters in this process and, by the bell, other processes that the store has the job in a final
  /// state, or has it no more.
  void announce(const std::string& id);
  /// Tells waiters in this process only: another process has announced the end.
  void end(const std::string& id);
  /// Ids of the jobs and sweeps that somebody waits for.
  [[nodiscard]] std::vector<std::string> waited();
  /// Calls the callback of every ticket now, and of every later on_end() at once, ended job or not.
  void close();

 private:
  static void call(Ticket& ticket);
  Bell& bell_;
  std::mutex mutex_;
  bool closed_ = false;
  std::unordered_multimap<std::string, Ticket*> tickets_;
};

}  // namespace snapthrough::server
