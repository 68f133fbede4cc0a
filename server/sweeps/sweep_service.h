#pragma once
/// @file
/// Sweeps for any protocol: submit, get, dismiss, retry, remove.

#include <optional>
#include <string>
#include <string_view>

#include "server/jobs/submission.h"
#include "server/sweeps/sweep_work.h"

namespace snapthrough::server {

/// Takes sweeps in and answers questions about them. Thread-safe.
class SweepService {
 public:
  explicit SweepService(const SweepSurroundings& surroundings) : world_(surroundings), work_(surroundings) {}

  /// @brief Checks a sweep document and stores it if it has no findings. The sweep is durable when an id is
  /// returned.
  /// @return `unavailable` or `stopping` while the service takes no work
  StatusOr<Submission> submit(const Order& order);
  /// The sweep of that id and owner, or nothing.
  StatusOr<std::optional<SweepRecord>> get(const std::string& id, std::string_view owner);
  /// Dismisses a sweep and stops its workers; its rows stay. @pre get() found the sweep
  StatusOr<SweepChange> dismiss(const std::string& id) { return work_.dismiss(id); }
  /// Accepts a failed or dismissed sweep again, for its failed and missing points. `unavailable` or
  /// `stopping` while the service takes no work. @pre get() found the sweep
  StatusOr<SweepChange> retry(const std::string& id);
  /// Stops the workers of a sweep and removes it with its rows. @pre get() found the sweep
  Status remove(const std::string& id);

  [[nodiscard]] SweepStore& store() { return world_.store; }
  /// The part that workers and followers use.
  [[nodiscard]] SweepWork& work() { return work_; }

 private:
  const SweepSurroundings world_;
  SweepWork work_;
};

}  // namespace snapthrough::server
