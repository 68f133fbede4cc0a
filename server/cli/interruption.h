#pragma once
/// @file
/// Handles SIGINT and SIGTERM during a computation.

#include <atomic>
#include <csignal>
#include <stop_token>
#include <thread>

#include "server/bell.h"

namespace snapthrough::server::cli {

/// @brief During its lifetime, the first SIGINT or SIGTERM requests a stop, and the second one ends the
/// process at once. A signal that the process ignores stays ignored.
///
/// REQUIRES: threads of the computation start during its lifetime. At most one object exists at a time.
class Interruption {
 public:
  Interruption();
  ~Interruption();
  Interruption(const Interruption&) = delete;
  Interruption& operator=(const Interruption&) = delete;
  Interruption(Interruption&&) = delete;
  Interruption& operator=(Interruption&&) = delete;

  /// Returns the token on which the first signal requests a stop.
  [[nodiscard]] std::stop_token token() const { return stop_.get_token(); }
  /// Returns the received signal; 0 before the first one.
  [[nodiscard]] int signal() const { return signal_; }
  /// Returns the exit status of a command ended by the signal: 128 + signal. @pre signal() != 0
  [[nodiscard]] int exit_status() const { return 128 + signal_; }

 private:
  void watch();

  sigset_t signals_{};
  sigset_t before_{};
  Descriptor incoming_;
  PollBell finished_;
  std::atomic<int> signal_ = 0;
  std::stop_source stop_;
  std::thread watcher_;
};

}  // namespace snapthrough::server::cli
