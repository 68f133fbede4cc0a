#pragma once
/// @file
/// Ctrl-C while something is computed.

#include <atomic>
#include <csignal>
#include <stop_token>
#include <thread>

#include "server/bell.h"

namespace snapthrough::server::cli {

/// @brief While this exists, the first SIGINT or SIGTERM asks the work to stop, and a second one ends the
/// process at once. A signal that the process ignores stays ignored.
///
/// REQUIRES: threads that share the work are started while this exists. One at a time.
class Interruption {
 public:
  Interruption();
  ~Interruption();
  Interruption(const Interruption&) = delete;
  Interruption& operator=(const Interruption&) = delete;
  Interruption(Interruption&&) = delete;
  Interruption& operator=(Interruption&&) = delete;

  /// Asked to stop by the first signal.
  [[nodiscard]] std::stop_token token() const { return stop_.get_token(); }
  /// The signal that came; 0: none yet.
  [[nodiscard]] int signal() const { return signal_; }
  /// What a shell gives a command that the signal ended: 128 + signal. @pre signal() != 0
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
