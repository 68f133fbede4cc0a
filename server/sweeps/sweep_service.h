#pragma once
/// @file
/// What a caller can do with sweeps, whatever the protocol.

#include <optional>
#include <string>
#include <string_view>

#include "server/jobs/submission.h"
#include "server/sweeps/sweep_work.h"

namespace snapthrough::server {

/// @brief Where sweeps are handed in and asked for. Thread-safe.
class SweepService {
 public:
  explicit SweepService(const SweepSurroundings& surroundings) : world_(surroundings), work_(surroundings) {}

  /// @brief Reads and checks a sweep document and, when nothing is wrong, stores it.
  /// The sweep is durable when this returns an id. `unavailable` when nothing can be stored at the moment.
  StatusOr<Submission> submit(const Order& order);
  /// The sweep, if there is one and it is the owner's.
  StatusOr<std::optional<SweepRecord>> get(const std::string& id, std::string_view owner);
  /// Dismisses a sweep and stops work on it; its rows stay. @pre get() found it
  StatusOr<SweepChange> dismiss(const std::string& id) { return work_.dismiss(id); }
  /// Computes failed and missing points of a sweep that has ended again. `unavailable` or `stopping` when no
  /// work is taken at the moment. @pre get() found it
  StatusOr<SweepChange> retry(const std::string& id);
  /// Removes a sweep and its rows, after stopping work on it. @pre get() found it
  Status remove(const std::string& id);

  [[nodiscard]] SweepStore& store() { return world_.store; }
  /// For the workers, and for whoever follows what they do.
  [[nodiscard]] SweepWork& work() { return work_; }

 private:
  const SweepSurroundings world_;
  SweepWork work_;
};

}  // namespace snapthrough::server
