#pragma once
/// @file
/// Messages between processes that share a store.

#include <chrono>
#include <cstdint>
#include <stop_token>
#include <string>
#include <vector>

#include "server/status.h"
#include "solver/hooks.h"

namespace snapthrough::server {

/// Progress of an analysis in some process.
struct ToldProgress {
  std::string id;            ///< id of the job
  int attempt = 0;           ///< attempt of the claim
  std::uint64_t number = 0;  ///< number of news in this attempt
  Progress progress;
};

/// Work that no worker has.
struct WaitingWork {
  std::int64_t jobs = 0;  ///< accepted jobs
  bool items = false;     ///< whether a sweep has items that nobody has
};

/// @brief Messages between processes that share a store. Thread-safe. A lost message makes things slower, not
/// wrong.
class NeighbourStore {
 public:
  NeighbourStore() = default;
  NeighbourStore(const NeighbourStore&) = delete;
  NeighbourStore& operator=(const NeighbourStore&) = delete;
  NeighbourStore(NeighbourStore&&) = delete;
  NeighbourStore& operator=(NeighbourStore&&) = delete;
  virtual ~NeighbourStore() = default;

  /// Work that waits; jobs are counted up to `most`.
  virtual StatusOr<WaitingWork> work(std::int64_t most) = 0;
  /// The ids of jobs and sweeps that have ended or are not in the store.
  virtual StatusOr<std::vector<std::string>> ended(const std::vector<std::string>& ids) = 0;
  /// Stores the progress of analyses of this process. Lost when the database crashes.
  virtual Status tell(const std::vector<ToldProgress>& progress) = 0;
  /// The stored progress of those jobs that run.
  virtual StatusOr<std::vector<ToldProgress>> told(const std::vector<std::string>& ids) = 0;
  /// Wakes wait() in other processes. A ring may be lost.
  virtual Status ring() = 0;
  /// Returns when another process rang (true), after `longest`, or on a stop.
  virtual bool wait(std::chrono::milliseconds longest, const std::stop_token& stop) = 0;
};

}  // namespace snapthrough::server
