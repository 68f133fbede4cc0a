#pragma once
/// @file
/// Jobs that run in this process, and requests to stop them.

#include <cstddef>
#include <future>
#include <mutex>
#include <stop_token>
#include <string>
#include <unordered_map>
#include <vector>

#include "server/environment.h"
#include "server/jobs/job.h"

namespace snapthrough::server {

/// Why an analysis is asked to stop.
enum class StopReason { none, shutdown, dismissed, lease_lost, time_limit };

/// Register of the jobs that run in this process. Thread-safe.
class ActiveJobs {
 public:
  /// Registers a job for as long as the entry exists.
  class Entry {
   public:
    /// @param stored as Handoff::stored; null: the store has the job
    Entry(ActiveJobs& active, const Claim& claim, Time since, const std::shared_future<bool>* stored);
    ~Entry();
    Entry(const Entry&) = delete;
    Entry& operator=(const Entry&) = delete;
    Entry(Entry&&) = delete;
    Entry& operator=(Entry&&) = delete;

    [[nodiscard]] std::stop_token token() const { return stop_.get_token(); }
    /// Asks the analysis to stop. The first reason is kept.
    void stop(StopReason reason);
    [[nodiscard]] StopReason reason() const;

   private:
    friend class ActiveJobs;
    ActiveJobs& active_;
    Claim claim_;
    Time since_;
    std::shared_future<bool> stored_;  ///< without state: the store has the job
    StopReason reason_ = StopReason::none;
    std::stop_source stop_;
  };

  /// Asks the analysis of a job to stop if it runs in this process.
  void stop(const std::string& id, StopReason reason);
  /// Asks every analysis to stop that began before `since`.
  void stop_older(Time since, StopReason reason);
  /// Claims, without documents, of the jobs that began before `since` and that the store has: one that it is
  /// still to take has no lease there that could be renewed or lost.
  [[nodiscard]] std::vector<Claim> stored_before(Time since) const;
  [[nodiscard]] std::size_t count() const;
  [[nodiscard]] bool has(const std::string& id) const;

 private:
  static void stop_entry(Entry& entry, StopReason reason);
  mutable std::mutex mutex_;
  std::unordered_multimap<std::string, Entry*> entries_;
};

}  // namespace snapthrough::server
