#pragma once
/// @file
/// What a caller can do with jobs, whatever the protocol: hand one in, wait for it, look at it.

#include <chrono>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "server/environment.h"
#include "server/jobs/notices.h"
#include "server/log/log.h"
#include "server/store/store.h"
#include "solver/model/check.h"
#include "solver/solve.h"

namespace snapthrough::server {

/// What became of a request document that was handed in.
struct Submission {
  bool malformed = false;         ///< not a JSON document
  std::vector<Finding> findings;  ///< what is wrong with it; nothing was stored then
  std::string id;                 ///< of the stored job, when nothing is wrong
};

/// @brief Latest progress of the jobs that run in this process. Thread-safe.
class ProgressBoard {
 public:
  void set(const std::string& id, const Progress& progress);
  void erase(const std::string& id);
  [[nodiscard]] std::optional<Progress> get(const std::string& id) const;

 private:
  mutable std::mutex mutex_;
  std::unordered_map<std::string, Progress> latest_;
};

/// @brief Where jobs are handed in and asked for. Thread-safe; the parts it is given must outlive it.
class JobDesk {
 public:
  JobDesk(Store& store, const Environment& environment, Log& log);

  /// @brief Reads and checks a request document and, when nothing is wrong, stores it as an accepted job.
  /// The job is durable when this returns an id.
  StatusOr<Submission> submit(std::string_view document, std::string_view request_id);

  /// The job, after waiting for its end at most `wait`.
  StatusOr<std::optional<Job>> get(const std::string& id, std::chrono::duration<double> wait);

  [[nodiscard]] std::optional<Progress> progress(const std::string& id) const { return progress_.get(id); }
  [[nodiscard]] Store& store() { return store_; }
  [[nodiscard]] const Environment& environment() const { return environment_; }

  // For the workers.
  [[nodiscard]] JobEnds& ends() { return ends_; }
  [[nodiscard]] WorkBell& bell() { return bell_; }
  [[nodiscard]] ProgressBoard& progress_board() { return progress_; }

 private:
  Store& store_;
  const Environment& environment_;
  Log& log_;
  JobEnds ends_;
  WorkBell bell_;
  ProgressBoard progress_;
};

}  // namespace snapthrough::server
