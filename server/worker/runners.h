#pragma once
/// @file
/// What computes for one worker, by the owner of the work.

#include <memory>
#include <string>

#include "server/jobs/recent_use.h"
#include "server/worker/runner.h"

namespace snapthrough::server {

/// @brief The runners of one worker: one of normal priority, and one that gives way to others, for owners who
/// use much processor time. Each is made for its first task. Used on the worker's thread.
class Runners {
 public:
  /// @param make called on the worker's thread. @param use what owners have used, shared by all workers
  Runners(const RunnerFactory& make, RecentUse& use) : make_(make), use_(use) {}

  /// Makes the runner of normal priority before its first task.
  void prepare() {
    if (!normal_) {
      normal_ = make_();
    }
  }
  /// Returns the runner for the next task of an owner: the one that gives way if the owner uses much.
  [[nodiscard]] Runner& of(const std::string& owner) {
    if (use_.is_much(owner)) {
      if (!low_) {
        low_ = make_();
        low_->give_way();
      }
      return *low_;
    }
    prepare();
    return *normal_;
  }
  /// Counts what computing for an owner took. @param seconds duration, for a process that could not tell
  void note(const std::string& owner, const WorkUsage& usage, double seconds) {
    const double used = usage.cpu_us > 0 ? static_cast<double>(usage.cpu_us) * 1e-6 : seconds;
    use_.add(owner, RecentUse::Seconds(used));
  }

 private:
  const RunnerFactory& make_;
  RecentUse& use_;
  std::unique_ptr<Runner> normal_;
  std::unique_ptr<Runner> low_;
};

}  // namespace snapthrough::server
