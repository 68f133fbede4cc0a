#pragma once
/// @file
/// A runner in a process of its own: its crash fails one analysis and does not end the service.

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

/// Counts of events of a service's runners. Thread-safe.
struct RunnerCounters {
  std::atomic<std::int64_t> started = 0;
  std::atomic<std::int64_t> out_of_memory = 0;
  std::atomic<std::int64_t> killed = 0;   ///< processes that ignored a stop request
  std::atomic<std::int64_t> crashed = 0;  ///< processes ended by a signal or an unknown status
  /// Workers that wait because the system starts no process for them now (descriptors, processes, memory).
  std::atomic<std::int64_t> without_process = 0;
};

/// Path of the program that is running: a link of the system, which stays the same program when its file is
/// replaced. Where a loader of Linux was started with the program as its argument, the name that it gave the
/// program: the link is that of the loader then.
[[nodiscard]] std::string own_executable();

struct IsolatedRunnerOptions {
  std::string executable = own_executable();  ///< path of the program snapthrough
  std::int64_t memory = 0;                    ///< limit of one analysis in bytes
  int max_crashes = 1;                        ///< crashes after which an analysis fails, >= 1
  std::chrono::milliseconds grace{2000};      ///< from the stop request to the kill
};

/// @brief Lets a process of its own compute, and replaces it when it ends. The process ends with the thread
/// that created the runner.
class IsolatedRunner final : public Runner {
 public:
  /// @param counters must outlive the runner
  IsolatedRunner(IsolatedRunnerOptions options, RunnerCounters& counters);
  ~IsolatedRunner() override;

  [[nodiscard]] JobRun run_job(std::string_view request, const Hooks& hooks) override;
  WorkUsage run_items(const ItemTask& task) override;
  void give_way() override;

  /// Returns the id of the process, for tests that damage it; 0: there is none.
  [[nodiscard]] pid_t process() const { return process_; }

 private:
  /// How a task ended.
  enum class End { answered, out_of_memory, killed, crashed };
  struct Watch;

  void start();
  bool lower_priority() const;
  void replace();
  [[nodiscard]] bool has_process(const std::stop_token& stop);
  void close_ends() const;
  /// Sends a task and receives its answer.
  [[nodiscard]] End run_task(FrameType type, std::string_view body, Watch& watch);
  [[nodiscard]] bool send(FrameType type, std::string_view body) const;
  [[nodiscard]] bool control(FrameType type) const;
  [[nodiscard]] std::uint64_t send_sweep(const ItemTask& task);
  [[nodiscard]] End attend(Watch& watch);
  [[nodiscard]] std::optional<bool> take_frame(Watch& watch);
  static void pass_on(const Frame& news, const Hooks& hooks);
  void retire();
  [[nodiscard]] End end_of_process(bool killed);
  /// Computes the remaining items of a list, until the process has answered or ended.
  [[nodiscard]] End attempt_items(const ItemTask& task, std::size_t& told, bool at_once, WorkUsage& usage);
  [[nodiscard]] JobFailure failure_of(End end, int crashes) const;

  const IsolatedRunnerOptions options_;
  RunnerCounters& counters_;
  bool gives_way_ = false;  ///< its processes have a low priority from their start
  pid_t process_ = 0;
  int socket_ = -1;
  int control_ = -1;
  FrameReceiver received_;                       ///< bytes received from the current process
  std::uint64_t task_ = 0;                       ///< number of the process' current task, from 1
  PollBell alarm_;                               ///< rung when a stop is requested
  std::string ended_by_;                         ///< how the last crashed process ended
  std::map<std::string, std::uint64_t> sweeps_;  ///< numbers of sweeps known to the process, by id
  std::uint64_t next_sweep_ = 0;
};

/// Returns a factory of runners with processes of their own.
[[nodiscard]] RunnerFactory isolated_runners(IsolatedRunnerOptions options, RunnerCounters& counters);

}  // namespace snapthrough::server
