#include "api/sweep.h"

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <map>
#include <mutex>
#include <nlohmann/json.hpp>
#include <ostream>
#include <stop_token>
#include <thread>
#include <utility>

#include "api/sweep_table.h"
#include "server/cli/commands.h"
#include "server/cli/input.h"
#include "server/cli/interruption.h"
#include "server/cli/progress_bar.h"
#include "server/sweeps/unit.h"
#include "solver/solve.h"

namespace snapthrough::server::cli {
namespace {

using Clock = std::chrono::steady_clock;

/// Rows wait here until those before them are written; workers further ahead than this wait, so that memory
/// does not grow with the sweep.
constexpr std::uint64_t kLongestLead = 4096;
constexpr std::chrono::milliseconds kBetweenBars{100};

/// Of the rows that were written.
struct RowCounts {
  std::uint64_t written = 0;
  std::uint64_t failed = 0;
};

/// @brief Gives units out and puts the rows of their points in design order. Thread-safe.
class RowQueue {
 public:
  /// @param stop no more units are given out then
  RowQueue(const api::Sweep& sweep, const Streams& streams, const SweepOptions& options, std::stop_token stop)
      : sweep_(sweep),
        streams_(streams),
        stop_(std::move(stop)),
        show_progress_(options.show_progress),
        writer_(sweep, options.form) {
    streams_.out << writer_.head();
  }

  /// The number of a unit to compute; nothing when there are no more.
  std::optional<std::uint64_t> next() {
    std::unique_lock lock(mutex_);
    if (given_ == sweep_.units() || stop_.stop_requested()) {
      return std::nullopt;
    }
    const std::uint64_t unit = given_++;
    const std::uint64_t size = sweep_.unit_size();
    const bool has_room =
        room_.wait(lock, stop_, [&] { return unit * size < written_ + std::max(kLongestLead, 4 * size); });
    return has_room ? std::optional(unit) : std::nullopt;
  }

  /// A point that was stopped leaves no row, and none is written after it.
  void put(std::uint64_t point, api::PointOutcome outcome) {
    if (stop_.stop_requested() && outcome.code == kCancelled) {
      return;
    }
    const std::lock_guard guard(mutex_);
    ++done_;
    waiting_.emplace(point, std::move(outcome));
    std::string text;
    for (auto first = waiting_.begin(); first != waiting_.end() && first->first == written_;
         first = waiting_.erase(first)) {
      failed_ += first->second.failed() ? 1 : 0;
      writer_.append_row(written_++, first->second, text);
    }
    if (!text.empty()) {
      streams_.out << text;
      room_.notify_all();
    }
    show_bar(false);
  }

  /// To be called when all points were put that ever will be.
  RowCounts finish() {
    const std::lock_guard guard(mutex_);
    std::string tail;
    writer_.append_tail(tail);
    streams_.out << tail << std::flush;
    show_bar(true);
    return {written_, failed_};
  }

 private:
  void show_bar(bool last) {
    const Clock::time_point now = Clock::now();
    if (!show_progress_ || (!last && now < next_bar_)) {
      return;
    }
    next_bar_ = now + kBetweenBars;
    const std::chrono::duration<double> elapsed = now - start_;
    streams_.err << '\r' << progress_line(done_, failed_, sweep_.size(), elapsed.count()) << "\x1b[K"
                 << (last ? "\n" : "") << std::flush;
  }

  const api::Sweep& sweep_;
  const Streams& streams_;
  const std::stop_token stop_;
  const bool show_progress_;
  std::mutex mutex_;
  std::condition_variable_any room_;
  api::TableWriter writer_;
  std::map<std::uint64_t, api::PointOutcome> waiting_;
  std::uint64_t given_ = 0;  ///< units
  std::uint64_t written_ = 0;
  std::uint64_t done_ = 0;
  std::uint64_t failed_ = 0;
  const Clock::time_point start_ = Clock::now();
  Clock::time_point next_bar_ = start_;
};

/// Each unit is computed alone, so that rows do not depend on how many threads share them.
RowCounts compute_rows(const api::Sweep& sweep, const Streams& streams, const SweepOptions& options,
                       const std::stop_token& stop) {
  RowQueue queue(sweep, streams, options, stop);
  const SolveFunction solver = [](const Model& model, const Analysis& analysis, const Hooks& hooks) {
    return solve_checked(model, analysis, hooks);
  };
  const auto work = [&] {
    std::shared_ptr<nlohmann::json> document;
    while (const std::optional<std::uint64_t> number = queue.next()) {
      const std::unique_ptr<SweepUnit> unit = make_unit(sweep, *number);
      std::vector<api::PointOutcome> outcomes = unit->compute(solver, {.stop = stop}, document);
      for (std::size_t i = 0; i < outcomes.size(); ++i) {
        queue.put(unit->first() + i, std::move(outcomes[i]));
      }
    }
  };
  {
    std::vector<std::jthread> others;
    for (int i = 1; i < options.threads && static_cast<std::uint64_t>(i) < sweep.size(); ++i) {
      others.emplace_back(work);
    }
    work();
  }
  return queue.finish();
}

/// The request document of a point, to be solved alone.
int write_point(const api::Sweep& sweep, std::uint64_t point, const Streams& streams) {
  if (point >= sweep.size()) {
    streams.err << "snapthrough: the points of this sweep are 0 to " << sweep.size() - 1 << ", not " << point
                << '\n';
    return kOther;
  }
  streams.out << sweep.document_at(point)->dump(2) << '\n' << std::flush;
  return kDone;
}

}  // namespace

int sweep_command(const std::string& path, const Streams& streams, const SweepOptions& options) {
  const std::optional<std::string> text = read_all(path, streams);
  if (!text) {
    return kOther;
  }
  const api::SweepOutcome outcome = api::read_sweep(*text);
  if (!outcome.sweep) {
    print_findings(outcome.findings, streams);
    return kWrongRequest;
  }
  const std::uint64_t points = outcome.sweep->size();
  if (options.point) {
    return write_point(*outcome.sweep, *options.point, streams);
  }
  const Interruption interruption;
  const RowCounts rows = compute_rows(*outcome.sweep, streams, options, interruption.token());
  if (!streams.out) {
    streams.err << "snapthrough: cannot write the rows\n";
    return kOther;
  }
  if (rows.written < points) {
    streams.err << "interrupted: " << rows.written << " of " << points << " rows were written\n";
    return interruption.exit_status();
  }
  if (rows.failed > 0) {
    streams.err << rows.failed << " of " << points
                << " points could not be completed; the column error says why\n";
    return kNotCompleted;
  }
  return kDone;
}

}  // namespace snapthrough::server::cli
