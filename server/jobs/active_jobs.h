#pragma once
/// @file
/// The jobs that this process works on, and how they are asked to stop.

#include <cstddef>
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
  [[nodiscard]] bool has(const std::string& id) const;

 private:
  static void stop_entry(Entry& entry, StopReason reason);
  mutable std::mutex mutex_;
  std::unordered_multimap<std::string, Entry*> entries_;
};

}  // namespace snapthrough::server
