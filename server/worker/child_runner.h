#pragma once
/// @file
/// A runner in a process of its own: what happens to it is one failed analysis, never the service's end.

#include <sys/types.h>

#include <atomic>
#include <chrono>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "server/bell.h"
#include "server/worker/frame.h"
#include "server/worker/runner.h"

namespace snapthrough::server {

/// What the runners of a service did. Thread-safe.
struct RunnerCounters {
  std::atomic<std::int64_t> started = 0;
  std::atomic<std::int64_t> out_of_memory = 0;
  std::atomic<std::int64_t> killed = 0;   ///< they did not stop when they were asked to
  std::atomic<std::int64_t> crashed = 0;  ///< they ended otherwise
};

struct ChildRunnerOptions {
  std::string executable;   ///< snapthrough itself
  std::int64_t memory = 0;  ///< bytes of one analysis
  int max_crashes = 1;      ///< an analysis during which runners died so often is given up, >= 1
  std::chrono::milliseconds grace{2000};  ///< from the request to stop to the kill
};

/// @brief Asks a child process, which is replaced as soon as it ends. The process ends with the thread that
/// makes the runner.
class ChildRunner final : public Runner {
 public:
  /// @param counters outlive it
  ChildRunner(ChildRunnerOptions options, RunnerCounters& counters);
  ~ChildRunner() override;

  [[nodiscard]] JobRun run_job(std::string_view request, const Hooks& hooks) override;
  void run_units(const UnitTask& task) override;

  /// The process, for tests that harm it; 0: there is none.
  [[nodiscard]] pid_t process() const { return process_; }

 private:
  /// How a task came to its end.
  enum class End { answered, out_of_memory, killed, crashed };
  struct Watch;

  void start();
  void replace();
  void close_ends();
  /// Sends the task and attends to it.
  [[nodiscard]] End run_task(FrameType type, std::string_view body, Watch& watch);
  [[nodiscard]] bool send(FrameType type, std::string_view body);
  [[nodiscard]] bool control(FrameType type);
  [[nodiscard]] std::uint64_t send_sweep(const UnitTask& task);
  [[nodiscard]] End attend(Watch& watch);
  [[nodiscard]] std::optional<bool> take_frame(Watch& watch);
  static void pass_on(const Frame& news, const Hooks& hooks);
  [[nodiscard]] End end_of_process(bool killed);
  /// What is left of a list of units, until the process has answered or ended.
  [[nodiscard]] End attempt_units(const UnitTask& task, std::size_t& told, bool at_once);
  [[nodiscard]] JobFailure failure_of(End end, int crashes) const;

  const ChildRunnerOptions options_;
  RunnerCounters& counters_;
  pid_t process_ = 0;
  int socket_ = -1;
  int control_ = -1;
  FrameReceiver received_;                       ///< of this process
  std::uint64_t task_ = 0;                       ///< of this process, counted from 1
  PollBell alarm_;                               ///< rung when a stop is requested
  std::string ended_by_;                         ///< how the last process that crashed ended
  std::map<std::string, std::uint64_t> sweeps_;  ///< that the process knows, by id
  std::uint64_t next_sweep_ = 0;
};

/// @brief The factory for a service. @param executable empty: this program
[[nodiscard]] RunnerFactory child_runners(ChildRunnerOptions options, RunnerCounters& counters);

}  // namespace snapthrough::server
