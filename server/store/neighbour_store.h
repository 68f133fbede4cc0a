#pragma once
/// @file
/// What processes that share a store tell each other through it.

#include <chrono>
#include <cstdint>
#include <stop_token>
#include <string>
#include <vector>

#include "server/status.h"
#include "solver/hooks.h"

namespace snapthrough::server {

/// Where an analysis stands that runs in some process.
struct ToldProgress {
  std::string id;            ///< of the job
  int attempt = 0;           ///< of the claim
  std::uint64_t number = 0;  ///< how often it told something in this attempt
  Progress progress;
};

/// What there is for workers without one.
struct WaitingWork {
  std::int64_t jobs = 0;  ///< accepted jobs
  bool units = false;     ///< of sweeps
};

/// @brief What processes that share a store tell each other. Thread-safe. Nothing here is needed for anything
/// to be right: it is what makes it quick.
class NeighbourStore {
 public:
  NeighbourStore() = default;
  NeighbourStore(const NeighbourStore&) = delete;
  NeighbourStore& operator=(const NeighbourStore&) = delete;
  NeighbourStore(NeighbourStore&&) = delete;
  NeighbourStore& operator=(NeighbourStore&&) = delete;
  virtual ~NeighbourStore() = default;

  /// What waits. Jobs are counted up to `most`.
  virtual StatusOr<WaitingWork> work(std::int64_t most) = 0;
  /// Those of these jobs and sweeps that have ended, or are there no more.
  virtual StatusOr<std::vector<std::string>> ended(const std::vector<std::string>& ids) = 0;
  /// Tells where analyses of this process stand. Lost when the database crashes.
  virtual Status tell(const std::vector<ToldProgress>& progress) = 0;
  /// What was told of those of these jobs that run.
  virtual StatusOr<std::vector<ToldProgress>> told(const std::vector<std::string>& ids) = 0;
  /// Wakes those who wait() in other processes. It may be lost.
  virtual Status ring() = 0;
  /// Returns when another process rang, or after that time, or on stop; whether somebody rang.
  virtual bool wait(std::chrono::milliseconds longest, const std::stop_token& stop) = 0;
};

}  // namespace snapthrough::server
