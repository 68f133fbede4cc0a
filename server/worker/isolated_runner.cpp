#include "server/worker/isolated_runner.h"

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <exception>
#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <stop_token>
#include <utility>

#include "server/priority.h"
#include "server/worker/frame.h"
#include "server/worker/record.h"
#include "server/worker/runner_process.h"
#include "server/worker/solve_job.h"

namespace snapthrough::server {
namespace {

using Clock = std::chrono::steady_clock;

/// Interval at which ItemTask::enough is asked.
constexpr std::chrono::milliseconds kLook{20};
/// Bytes of a frame in addition to the memory limit of an analysis.
constexpr std::uint64_t kMostBeside = 1 << 20;
/// Largest size in bytes of one news frame of a running analysis.
constexpr std::size_t kMostNews = 4 << 20;
/// Longest time for which a process may leave sent bytes unread; a process without task reads at once.
constexpr timeval kLongestSend{5, 0};
/// Pause before another attempt to start a process.
constexpr std::chrono::milliseconds kStartPause{200};
/// Number of sweeps that a process knows before it must forget all of them.
constexpr std::size_t kMostSweeps = 16;

}  // namespace

/// Calls the hooks for a news frame of a running analysis. @throws std::runtime_error for a frame that is too
/// large or malformed
void IsolatedRunner::pass_on(const Frame& news, const Hooks& hooks) {
  if (news.body.size() > kMostNews) {
    throw std::runtime_error("news of more bytes than there can be");
  }
  RecordReader reader(news.body);
  const auto progress = reader.get<std::optional<Progress>>();
  for (const CriticalPoint& point : reader.get<std::vector<CriticalPoint>>()) {
    if (hooks.on_critical) hooks.on_critical(point);
  }
  for (const TracedPoint& point : reader.get<std::vector<TracedPoint>>()) {
    if (hooks.on_point) hooks.on_point(point);
  }
  if (progress && hooks.on_progress) hooks.on_progress(*progress);
}

/// Callbacks for a task that the process works on.
struct IsolatedRunner::Watch {
  std::stop_token stop;
  std::function<bool(Frame&)> take;        ///< handles a frame. @return whether it was the last one
  std::function<bool()> enough = nullptr;  ///< see ItemTask::enough; null for jobs
};

std::string own_executable() {
  const std::string link = "/proc/self/exe";
  std::error_code unknown;
  const std::string target = std::filesystem::read_symlink(link, unknown).filename().string();
  return target.rfind("ld-", 0) == 0 ? program_invocation_name : link;
}

IsolatedRunner::IsolatedRunner(IsolatedRunnerOptions options, RunnerCounters& counters)
    : options_(std::move(options)), counters_(counters) {
  start();
}

IsolatedRunner::~IsolatedRunner() {
  if (process_ != 0) {
    ::kill(process_, SIGKILL);
    ::waitpid(process_, nullptr, 0);
    close_ends();
  }
}

void IsolatedRunner::close_ends() const {
  ::close(socket_);
  ::close(control_);
}

void IsolatedRunner::start() {
  std::array<int, 2> completions{};
  std::array<int, 2> controls{};
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, completions.data()) != 0) {
    ended_by_ = std::string("it could not be started: ") + std::strerror(errno);
    return;  // has_process() tries again
  }
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, controls.data()) != 0) {
    ended_by_ = std::string("it could not be started: ") + std::strerror(errno);
    ::close(completions[0]);
    ::close(completions[1]);
    return;
  }
  posix_spawn_file_actions_t actions{};
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, completions[1], kTaskSocket);
  posix_spawn_file_actions_adddup2(&actions, controls[1], kControlPipe);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_addclosefrom_np(&actions, kControlPipe + 1);
  posix_spawnattr_t attributes{};
  posix_spawnattr_init(&attributes);
  sigset_t none{};
  sigset_t all{};
  sigemptyset(&none);
  sigfillset(&all);
  posix_spawnattr_setsigmask(&attributes, &none);
  posix_spawnattr_setsigdefault(&attributes, &all);
  // signals of the terminal are for the service, which stops the analysis itself
  posix_spawnattr_setpgroup(&attributes, 0);
  posix_spawnattr_setflags(&attributes,
                           POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETPGROUP);
  std::string name = "snapthrough";
  std::string command = kRunnerCommand;
  std::string parent = std::to_string(::getpid());
  std::array<char*, 4> arguments{name.data(), command.data(), parent.data(), nullptr};
  std::array<char*, 1> environment{nullptr};
  pid_t process = 0;
  const int failed = ::posix_spawn(&process, options_.executable.c_str(), &actions, &attributes,
                                   arguments.data(), environment.data());
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&actions);
  ::close(completions[1]);
  ::close(controls[1]);
  socket_ = completions[0];
  control_ = controls[0];
  for (const int end : {socket_, control_}) {
    ::setsockopt(end, SOL_SOCKET, SO_SNDTIMEO, &kLongestSend, sizeof kLongestSend);
  }
  if (failed != 0) {
    ended_by_ = std::string("it could not be started: ") + std::strerror(failed);
    close_ends();
    return;
  }
  ++counters_.started;
  process_ = process;
  task_ = 0;
  if (gives_way_) {
    lower_priority();
  }
}

void IsolatedRunner::give_way() {
  gives_way_ = true;
  if (process_ != 0) {
    lower_priority();
  }
}

/// Gives the process a lower priority, which it keeps; returns whether the system did it.
bool IsolatedRunner::lower_priority() const {
  return ::setpriority(PRIO_PROCESS, static_cast<id_t>(process_), kGivesWay) == 0;
}

/// Waits until the system starts a process, which is not the fault of a task; false when `stop` is requested
/// first.
bool IsolatedRunner::has_process(const std::stop_token& stop) {
  if (process_ != 0) {
    return true;
  }
  ++counters_.without_process;
  while (process_ == 0 && !stop.stop_requested()) {
    replace();
    if (process_ == 0) {
      pause(stop, kStartPause);
    }
  }
  --counters_.without_process;
  return process_ != 0;
}

/// Starts a successor of a process that has ended or shall end. The successor knows no sweeps.
void IsolatedRunner::replace() {
  if (process_ != 0) {
    close_ends();
    process_ = 0;
  }
  sweeps_.clear();
  received_ = {};
  start();
}

/// Replaces a process whose priority was lowered: only a privileged user could raise it again.
void IsolatedRunner::retire() {
  ::kill(process_, SIGKILL);
  ::waitpid(process_, nullptr, 0);
  replace();
}

IsolatedRunner::End IsolatedRunner::end_of_process(bool killed) {
  int status = 0;
  ::waitpid(process_, &status, 0);
  const bool no_memory = WIFEXITED(status) && WEXITSTATUS(status) == kOutOfMemoryStatus;
  const End end = killed ? End::killed : no_memory ? End::out_of_memory : End::crashed;
  if (end == End::crashed) {
    ended_by_ = WIFSIGNALED(status) ? "signal " + std::to_string(WTERMSIG(status))
                                    : "status " + std::to_string(WEXITSTATUS(status));
  }
  ++(end == End::killed ? counters_.killed : no_memory ? counters_.out_of_memory : counters_.crashed);
  replace();
  return end;
}

/// Sends a frame; kills a process that does not read it. @return whether the process can still answer
bool IsolatedRunner::send(FrameType type, std::string_view body) const {
  if (write_frame(socket_, type, body)) {
    return true;
  }
  ::kill(process_, SIGKILL);
  return false;
}

bool IsolatedRunner::control(FrameType type) const {
  std::string body;
  RecordWriter(body).put(task_);
  return write_frame(control_, type, body);
}

IsolatedRunner::End IsolatedRunner::run_task(FrameType type, std::string_view body, Watch& watch) {
  ++task_;
  return send(type, body) ? attend(watch) : end_of_process(false);
}

/// Receives a frame if it is complete. Its content is not trusted, because the analysis may have corrupted
/// the process.
/// @return whether it was the last one; nullopt when the process is gone, or was killed for invalid content
std::optional<bool> IsolatedRunner::take_frame(Watch& watch) {
  try {
    switch (received_.receive(socket_, static_cast<std::uint64_t>(options_.memory) + kMostBeside)) {
      case FrameReceiver::State::complete: {
        Frame frame = received_.take();
        return watch.take(frame);
      }
      case FrameReceiver::State::incomplete:
        return false;
      case FrameReceiver::State::gone:
        break;
    }
  } catch (const std::exception&) {
    // the record is malformed, or too large for this process
  }
  ::kill(process_, SIGKILL);
  return std::nullopt;
}

/// Receives the frames of a task until the last one, the end of the process, or the end of the grace period
/// after a stop request.
IsolatedRunner::End IsolatedRunner::attend(Watch& watch) {
  alarm_.silence();  // clears a stop request that arrived while a process ended
  const std::stop_callback on_stop(watch.stop, [this] { alarm_.ring(); });
  std::optional<Clock::time_point> deadline;
  bool told_enough = false;
  bool gives_way = gives_way_;
  Clock::time_point begin = Clock::now();
  for (;;) {
    std::array<pollfd, 2> fds{pollfd{socket_, POLLIN, 0}, pollfd{alarm_.descriptor(), POLLIN, 0}};
    std::optional<std::chrono::milliseconds> wait;
    if (deadline) {
      wait = std::max(std::chrono::milliseconds(0),
                      std::chrono::ceil<std::chrono::milliseconds>(*deadline - Clock::now()));
    } else if (watch.enough && !told_enough) {
      wait = kLook;
    } else if (!gives_way) {
      wait = kShort;
    }
    if (!gives_way && Clock::now() >= begin + kShort) {
      gives_way = lower_priority();
      begin = Clock::now();
    }
    const int ready = ::poll(fds.data(), deadline ? 1 : 2, wait ? static_cast<int>(wait->count()) : -1);
    if (ready > 0 && fds[0].revents != 0) {
      const std::optional<bool> last = take_frame(watch);
      if (!last) {
        return end_of_process(false);
      }
      if (*last) {
        if (gives_way && !gives_way_) {
          retire();
        }
        return End::answered;
      }
      if (watch.enough) {
        begin = Clock::now();  // the next item begins
      }
    }
    if (!deadline && watch.stop.stop_requested()) {
      deadline = Clock::now() + options_.grace;
      if (!control(FrameType::stop)) {
        return end_of_process(false);
      }
    }
    if (deadline && Clock::now() >= *deadline) {
      ::kill(process_, SIGKILL);
      return end_of_process(true);
    }
    if (watch.enough && !told_enough && watch.enough()) {
      told_enough = true;
      if (!control(FrameType::enough)) {
        return end_of_process(false);
      }
    }
  }
}

JobFailure IsolatedRunner::failure_of(End end, int crashes) const {
  switch (end) {
    case End::out_of_memory:
      return {"memory_limit",
              "the analysis needs more than " + std::to_string(options_.memory) + " bytes of memory", ""};
    case End::killed:
      return {kCancelled, "the analysis was ended, because it did not stop when it was asked to", ""};
    case End::answered:
    case End::crashed:
      break;
  }
  return {"crashed",
          "the process that computed it died " + std::to_string(crashes) + " times, the last by " + ended_by_,
          ""};
}

JobRun IsolatedRunner::run_job(std::string_view request, const Hooks& hooks) {
  std::string body;
  RecordWriter writer(body);
  writer.put(options_.memory);
  writer.put(request);
  for (int crashes = 0;;) {
    JobRun run;
    Watch watch{hooks.stop, [&](Frame& frame) {
                  RecordReader reader(frame.body);
                  if (frame.type == FrameType::job_run) {
                    reader.get(run);
                    if (run.result.has_value() == run.failure.has_value()) {
                      throw std::runtime_error("a job comes to a result or a failure");
                    }
                    return true;
                  }
                  pass_on(frame, hooks);
                  return false;
                }};
    const End end = has_process(hooks.stop) ? run_task(FrameType::job, body, watch) : End::killed;
    if (end == End::answered) {
      return run;
    }
    crashes += end == End::crashed ? 1 : 0;
    if (end != End::crashed || crashes >= options_.max_crashes || hooks.stop.stop_requested()) {
      run.failure = failure_of(end, crashes);
      return run;
    }
  }
}

/// Returns the number of the sweep in the process; sends the sweep if the process does not know it.
std::uint64_t IsolatedRunner::send_sweep(const ItemTask& task) {
  if (const auto known = sweeps_.find(task.id); known != sweeps_.end()) {
    return known->second;
  }
  const bool forget = sweeps_.size() >= kMostSweeps;
  if (forget) {
    sweeps_.clear();
  }
  const std::uint64_t number = next_sweep_++;
  sweeps_.emplace(task.id, number);
  std::string body;
  RecordWriter writer(body);
  writer.put(forget);
  writer.put(number);
  writer.put(task.document);
  static_cast<void>(send(FrameType::sweep, body));  // a failure shows in the task that follows
  return number;
}

IsolatedRunner::End IsolatedRunner::attempt_items(const ItemTask& task, std::size_t& told, bool at_once,
                                                  WorkUsage& usage) {
  if (!has_process(task.stop)) {
    return End::killed;
  }
  const std::uint64_t number = send_sweep(task);
  const std::size_t before = told;
  const auto rest = task.items.subspan(told);
  std::string body;
  RecordWriter writer(body);
  writer.put(options_.memory);
  writer.put(number);
  writer.put(at_once);
  writer.put(std::vector<std::uint64_t>(rest.begin(), rest.end()));
  std::vector<api::PointOutcome> outcomes;  // outcomes of an incomplete item
  Watch watch{task.stop,
              [&](Frame& frame) {
                const bool done = frame.type == FrameType::done;
                RecordReader reader(frame.body);
                while (!done && !reader.at_end()) {
                  if (told == task.items.size()) {
                    throw std::runtime_error("there are more outcomes than points");
                  }
                  outcomes.push_back(reader.get<api::PointOutcome>());
                  if (outcomes.size() == task.sweep.item_size()) {
                    ++told;
                    task.tell(std::exchange(outcomes, {}));
                  }
                }
                if (done) {
                  usage.add(reader.get<WorkUsage>());
                }
                if (done && (!outcomes.empty() || (told == before && !task.stop.stop_requested()))) {
                  throw std::runtime_error("at least one item is computed, and each wholly");
                }
                return done;
              },
              task.enough};
  return run_task(FrameType::items, body, watch);
}

/// A process without memory first sends all outcomes, so that the next item is the cause. A crashed process
/// may not have sent all; a second attempt sends each at once. A single remaining item is the cause.
WorkUsage IsolatedRunner::run_items(const ItemTask& task) {
  WorkUsage usage;
  int crashes = 0;
  bool at_once = task.items.size() == 1;
  for (std::size_t told = 0; told < task.items.size();) {
    const std::size_t before = told;
    const End end = attempt_items(task, told, at_once, usage);
    if (end == End::answered) {
      return usage;
    }
    crashes = (told == before ? crashes : 0) + (end == End::crashed ? 1 : 0);
    const bool sure = at_once || end != End::crashed;
    at_once = at_once || end == End::crashed;
    if (told < task.items.size() && sure && (end != End::crashed || crashes >= options_.max_crashes)) {
      const JobFailure failure = failure_of(end, crashes);
      ++told;
      task.tell(std::vector<api::PointOutcome>(task.sweep.item_size(), {"", failure.code, failure.detail}));
      crashes = 0;
    }
    if (task.stop.stop_requested()) {
      return usage;
    }
  }
  return usage;
}

RunnerFactory isolated_runners(IsolatedRunnerOptions options, RunnerCounters& counters) {
  return [options = std::move(options), &counters] {
    return std::make_unique<IsolatedRunner>(options, counters);
  };
}

}  // namespace snapthrough::server
