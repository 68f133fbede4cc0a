#pragma once
/// @file
/// How threads of one process learn that something happened to a job, without asking the store again and
/// again.

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <stop_token>
#include <string>
#include <unordered_map>

namespace snapthrough::server {

/// @brief Wakes those who wait for the end of a job. Thread-safe.
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

    /// Waits until the job has ended, the time is over, or the service closes. True: the job has ended.
    bool wait_for(std::chrono::duration<double> time);

   private:
    friend class JobEnds;
    JobEnds& ends_;
    std::string id_;
    bool ended_ = false;
    std::condition_variable changed_;
  };

  /// The job is in a final state, and the store says so.
  void announce(const std::string& id);
  /// Nobody shall wait any longer, now or later.
  void close();

 private:
  std::mutex mutex_;
  bool closed_ = false;
  std::unordered_multimap<std::string, Ticket*> tickets_;
};

/// @brief Tells workers that a job was accepted. Thread-safe.
class WorkBell {
 public:
  /// One more job waits.
  void ring();
  /// Waits for a ring since `seen`, which it updates, a stop, or the end of the time.
  void wait(std::uint64_t& seen, std::stop_token stop, std::chrono::duration<double> time);

 private:
  std::mutex mutex_;
  std::condition_variable_any rung_;
  std::uint64_t count_ = 0;
};

}  // namespace snapthrough::server
