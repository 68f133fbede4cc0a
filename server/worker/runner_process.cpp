#include "server/worker/runner_process.h"

#include <malloc.h>
#include <pthread.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <cstdlib>
#include <exception>
#include <mutex>
#include <new>
#include <nlohmann/json.hpp>
#include <optional>
#include <unordered_map>
#include <utility>

#include "server/jobs/path_batch.h"
#include "server/worker/confinement.h"
#include "server/worker/frame.h"
#include "server/worker/record.h"
#include "server/worker/sweep_item.h"

namespace snapthrough::server {
namespace {

/// Unsent outcomes, serialised so that they can be sent when no memory is left.
class OutcomeBuffer {
 public:
  void add(const api::PointOutcome& outcome) { RecordWriter(bytes_).put(outcome); }
  /// @brief Sends the outcomes to the service and clears the buffer.
  /// @return whether the service is still connected
  bool tell() {
    if (bytes_.empty()) {
      return true;
    }
    const bool told = write_frame(kTaskSocket, FrameType::outcomes, bytes_);
    bytes_.clear();
    return told;
  }

 private:
  std::string bytes_;
};

OutcomeBuffer& untold() {
  static OutcomeBuffer buffer;
  return buffer;
}

/// Ends without unwinding: destructors may need memory, and there is none.
[[noreturn]] void end_without_memory() {
  untold().tell();
  ::_exit(kOutOfMemoryStatus);
}

/// Handles an uncaught exception: of an allocation, or by an error of this program.
[[noreturn]] void on_terminate() {
  try {
    if (std::current_exception()) {
      throw;
    }
  } catch (const std::bad_alloc&) {
    end_without_memory();
  } catch (...) {
  }
  std::abort();
}

/// Receives requests of the service about the current task on a separate thread, so that they take effect at
/// once and tasks stay on one thread.
class Control {
 public:
  Control() {
    constexpr std::size_t kStack = 256 << 10;
    pthread_attr_t attributes;
    pthread_attr_init(&attributes);
    pthread_attr_setstacksize(&attributes, kStack);
    pthread_t thread{};
    if (pthread_create(&thread, &attributes, &Control::read, this) != 0) {
      std::abort();
    }
    pthread_detach(thread);
    pthread_attr_destroy(&attributes);
  }

  /// Begins the next task; a stop request for it may have arrived before.
  [[nodiscard]] std::stop_token begin() {
    const std::lock_guard guard(mutex_);
    ++task_;
    stop_ = {};
    heed();
    return stop_.get_token();
  }
  /// Returns whether the current task must begin no further item.
  [[nodiscard]] bool enough() const { return enough_ == task_; }

 private:
  static void* read(void* control) {
    static_cast<Control*>(control)->read_all();
    return nullptr;
  }

  void read_all() {
    Frame frame;
    while (read_frame(kControlPipe, frame)) {
      const auto task = RecordReader(frame.body).get<std::uint64_t>();
      if (frame.type == FrameType::enough) {
        enough_ = task;
        continue;
      }
      const std::lock_guard guard(mutex_);
      stopped_ = task;
      heed();
    }
    ::_exit(EXIT_SUCCESS);  // the service has ended, so the runner ends
  }

  void heed() {
    if (stopped_ == task_) {
      stop_.request_stop();
    }
  }

  std::mutex mutex_;
  std::stop_source stop_;
  std::uint64_t stopped_ = 0;
  std::atomic<std::uint64_t> task_ = 0;  ///< number of the current task, from 1
  std::atomic<std::uint64_t> enough_ = 0;
};

/// Sends news of a running analysis, at most twenty times a second.
class News {
 public:
  [[nodiscard]] Hooks hooks(std::stop_token stop) {
    return {std::move(stop),
            [this](const Progress& progress) {
              progress_ = progress;
              tell_if_due();
            },
            [this](const CriticalPoint& point) {
              found_.push_back(point);
              tell_if_due();
            },
            [this](const TracedPoint& point) { traced_.add(point); }};
  }
  /// Sends the pending news.
  void tell() {
    if (!progress_ && found_.empty()) {
      return;
    }
    std::string body;
    RecordWriter writer(body);
    writer.put(progress_);
    writer.put(found_);
    writer.put(traced_.points());
    if (!write_frame(kTaskSocket, FrameType::news, body)) {
      ::_exit(EXIT_SUCCESS);
    }
    progress_.reset();
    found_.clear();
    traced_.clear();
    told_ = std::chrono::steady_clock::now();
  }

 private:
  void tell_if_due() {
    constexpr std::chrono::milliseconds kPause{50};
    if (std::chrono::steady_clock::now() - told_ >= kPause) {
      tell();
    }
  }

  std::optional<Progress> progress_;
  std::vector<CriticalPoint> found_;
  PathBatch traced_;  ///< points since the last news; progress follows each
  std::chrono::steady_clock::time_point told_ = std::chrono::steady_clock::now();
};

class RunnerProcess {
 public:
  RunnerProcess(MemoryBound& memory, const SolveFunction& solve) : memory_(memory), solve_(solve) {}

  /// Works until the service disconnects.
  void work() {
    Frame frame;
    while (read_frame(kTaskSocket, frame)) {
      RecordReader reader(frame.body);
      switch (frame.type) {
        case FrameType::job:
          run_job(reader);
          break;
        case FrameType::sweep:
          keep_sweep(reader);
          break;
        case FrameType::items:
          run_items(reader);
          break;
        default:
          std::abort();
      }
      memory_.lift();
    }
  }

 private:
  void answer(FrameType type, std::string_view body) {
    if (!write_frame(kTaskSocket, type, body)) {
      ::_exit(EXIT_SUCCESS);
    }
  }

  void run_job(RecordReader& reader) {
    const std::stop_token stop = control_.begin();
    memory_.set(reader.get<std::int64_t>());
    News news;
    std::string body;
    {
      JobRun run = solve_job(reader.get<std::string>(), solve_, news.hooks(stop));
      if (run.failure && run.failure->code == kOutOfMemory) {
        end_without_memory();
      }
      run.usage.peak_bytes = memory_.peak();
      RecordWriter(body).put(run);
    }
    news.tell();
    answer(FrameType::job_run, body);
  }

  void keep_sweep(RecordReader& reader) {
    if (reader.get<bool>()) {
      sweeps_.clear();
    }
    const auto number = reader.get<std::uint64_t>();
    api::SweepOutcome read = api::read_sweep(reader.get<std::string>());
    if (read.sweep) {
      sweeps_.emplace(number, *std::move(read.sweep));
    }
  }

  /// Computes items. Outcomes wait up to 10 ms, unless `at_once`, and longer only while an item runs.
  void run_items(RecordReader& reader) {
    constexpr std::chrono::milliseconds kUntold{10};
    const std::stop_token stop = control_.begin();
    memory_.set(reader.get<std::int64_t>());
    const api::Sweep& sweep = sweeps_.at(reader.get<std::uint64_t>());
    const bool at_once = reader.get<bool>();
    const auto items = reader.get<std::vector<std::uint64_t>>();
    static const std::string kNotNeeded;
    auto told = std::chrono::steady_clock::now();
    const auto tell = [&](const std::vector<api::PointOutcome>& outcomes) {
      for (const api::PointOutcome& outcome : outcomes) {
        if (outcome.code == kOutOfMemory) {
          end_without_memory();
        }
        untold().add(outcome);
      }
      const auto now = std::chrono::steady_clock::now();
      if (at_once || now - told >= kUntold) {
        told = now;
        if (!untold().tell()) {
          ::_exit(EXIT_SUCCESS);
        }
      }
    };
    WorkUsage usage = compute_items(
        {kNotNeeded, kNotNeeded, sweep, items, stop, [this] { return control_.enough(); }, tell}, solve_);
    untold().tell();
    usage.peak_bytes = memory_.peak();
    std::string body;
    RecordWriter(body).put(usage);
    answer(FrameType::done, body);
  }

  MemoryBound& memory_;
  const SolveFunction& solve_;
  Control control_;
  std::unordered_map<std::uint64_t, api::Sweep> sweeps_;
};

/// Makes malloc return freed memory to the system, because the limit of an analysis applies to the process.
void keep_heap_small() {
  constexpr int kLarge = 1 << 20;
  ::mallopt(M_MMAP_THRESHOLD, kLarge);
  ::mallopt(M_TRIM_THRESHOLD, 2 * kLarge);
  ::mallopt(M_ARENA_MAX, 1);
}

}  // namespace

int run_runner(int parent, const SolveFunction& solve) {
  if (!confine_process(parent)) {
    return EXIT_FAILURE;
  }
  keep_heap_small();
  std::set_new_handler(end_without_memory);
  std::set_terminate(on_terminate);
  MemoryBound memory;
  RunnerProcess process(memory, solve);
  confine_calls();
  process.work();
  return EXIT_SUCCESS;
}

}  // namespace snapthrough::server
