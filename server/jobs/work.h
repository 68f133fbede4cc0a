#pragma once
/// @file
/// Between those who hand jobs in and the workers of the same process: jobs that are given directly, jobs
/// that are being worked on.

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <future>
#include <mutex>
#include <optional>
#include <stop_token>
#include <string>
#include <unordered_map>
#include <vector>

#include "server/environment.h"
#include "server/jobs/job.h"

namespace snapthrough::server {

/// A job that goes to an idle worker while it is still being stored: solving and storing overlap.
struct Handoff {
  Claim claim;
  std::shared_future<bool> stored;  ///< true: what the store is asked from then on comes after the job
};

/// @brief Where workers wait for jobs. Thread-safe.
class WorkExchange {
 public:
  /// One more job waits in the store.
  void ring();
  /// Gives the job to an idle worker; false (and the job is left alone) when none is idle.
  bool offer(Handoff& handoff);
  /// Waits for a job that is given, a ring since `seen` (which it updates), a stop, or the end of the time.
  std::optional<Handoff> wait(std::uint64_t& seen, std::stop_token stop, std::chrono::duration<double> time);

 private:
  std::mutex mutex_;
  std::condition_variable_any changed_;
  std::uint64_t rings_ = 0;
  std::size_t idle_ = 0;
  std::deque<Handoff> given_;
};

/// Why an analysis is asked to stop.
enum class StopReason { none, shutdown, dismissed, lease_lost, time_limit };

/// @brief The jobs that this process works on. Thread-safe.
class ActiveJobs {
 public:
  /// A job is worked on for as long as this exists.
  class Entry {
   public:
    Entry(ActiveJobs& active, const Claim& claim, Time since);
    ~Entry();
    Entry(const Entry&) = delete;
    Entry& operator=(const Entry&) = delete;
    Entry(Entry&&) = delete;
    Entry& operator=(Entry&&) = delete;

    [[nodiscard]] std::stop_token token() const { return stop_.get_token(); }
    /// Asks the analysis to stop; the first reason counts.
    void stop(StopReason reason);
    [[nodiscard]] StopReason reason() const;

   private:
    friend class ActiveJobs;
    ActiveJobs& active_;
    Claim claim_;
    Time since_;
    StopReason reason_ = StopReason::none;
    std::stop_source stop_;
  };

  /// Asks the analysis of that job to stop, if it runs here.
  void stop(const std::string& id, StopReason reason);
  /// Asks those to stop that run since before that time.
  void stop_older(Time since, StopReason reason);
  /// The claims that are held since before that time.
  [[nodiscard]] std::vector<Claim> older(Time since) const;
  [[nodiscard]] std::size_t count() const;

 private:
  static void stop_entry(Entry& entry, StopReason reason);
  mutable std::mutex mutex_;
  std::unordered_multimap<std::string, Entry*> entries_;
};

}  // namespace snapthrough::server
