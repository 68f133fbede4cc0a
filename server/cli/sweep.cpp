#include "api/sweep.h"

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <map>
#include <mutex>
#include <nlohmann/json.hpp>
#include <ostream>
#include <stop_token>
#include <thread>
#include <utility>

#include "api/json_text.h"
#include "api/point_outcome.h"
#include "api/provenance.h"
#include "api/sweep_table.h"
#include "server/cli/commands.h"
#include "server/cli/input.h"
#include "server/cli/interruption.h"
#include "server/cli/part_file.h"
#include "server/cli/progress_bar.h"
#include "server/cli/shown.h"
#include "server/worker/sweep_item.h"
#include "solver/solve.h"

namespace snapthrough::server::cli {
namespace {

using Clock = std::chrono::steady_clock;

/// Largest number of points by which a worker may be ahead of the last written row. Rows wait in memory until
/// those before them are written; the limit bounds that memory.
constexpr std::uint64_t kLongestLead = 4096;
constexpr std::chrono::milliseconds kBetweenBars{100};

/// What was written.
struct Written {
  std::uint64_t outcomes = 0;
  api::RowCounts counts;
};

/// Destination of rows in the order of points: a table or a part file.
class RowSink {
 public:
  RowSink() = default;
  RowSink(const RowSink&) = delete;
  RowSink& operator=(const RowSink&) = delete;
  RowSink(RowSink&&) = delete;
  RowSink& operator=(RowSink&&) = delete;
  virtual ~RowSink() = default;

  virtual void append_row(std::uint64_t point, const api::PointOutcome& outcome, std::string& text) = 0;
  virtual void write(const std::string& text) = 0;
  /// Ends the output. @pre no row follows
  virtual void end() = 0;
};

class TableSink final : public RowSink {
 public:
  TableSink(const api::Sweep& sweep, const nlohmann::json& document, api::TableForm form, std::ostream& out)
      : out_(out), writer_(sweep, form, std::nullopt, api::provenance_members("table", document)) {
    out_ << writer_.head();
  }

  void append_row(std::uint64_t point, const api::PointOutcome& outcome, std::string& text) override {
    writer_.append_row(point, outcome, text);
  }
  void write(const std::string& text) override { out_ << text; }
  void end() override {
    std::string tail;
    writer_.append_tail(tail);
    out_ << tail << std::flush;
  }

 private:
  std::ostream& out_;
  api::TableWriter writer_;
};

class PartSink final : public RowSink {
 public:
  explicit PartSink(PartWriter& file) : file_(file) {}

  void append_row(std::uint64_t point, const api::PointOutcome& outcome, std::string& text) override {
    PartWriter::append_row(point, outcome, text);
  }
  void write(const std::string& text) override { file_.write(text); }
  void end() override {}

 private:
  PartWriter& file_;
};

/// @brief Hands out items and writes the rows of their points in design order. Thread-safe.
class RowQueue {
 public:
  /// @param items items to compute
  /// @param bar stream of the progress bar; null: no bar
  /// @param stop after a requested stop, next() returns nullopt
  RowQueue(const api::Sweep& sweep, ItemRange items, RowSink& sink, std::ostream* bar, std::stop_token stop)
      : sweep_(sweep),
        items_(items),
        stop_(std::move(stop)),
        sink_(sink),
        bar_(bar),
        given_(items.first),
        next_row_(items.first * sweep.item_size()) {}

  /// Returns the next item to compute; nullopt when there is none left.
  std::optional<std::uint64_t> next() {
    std::unique_lock lock(mutex_);
    if (given_ == items_.end || failure_ || stop_.stop_requested()) {
      return std::nullopt;
    }
    const std::uint64_t item = given_++;
    const std::uint64_t size = sweep_.item_size();
    const bool has_room = room_.wait(
        lock, stop_, [&] { return failure_ || item * size < next_row_ + std::max(kLongestLead, 4 * size); });
    return has_room && !failure_ ? std::optional(item) : std::nullopt;
  }

  /// Takes the outcome of a point. A cancelled point gets no row, so that no later row is written either.
  void put(std::uint64_t point, api::PointOutcome outcome) {
    if (stop_.stop_requested() && outcome.code == kCancelled) {
      return;
    }
    const std::lock_guard guard(mutex_);
    ++done_;
    waiting_.emplace(point, std::move(outcome));
    try {
      write_whole_rows();
    } catch (...) {
      failure_ = std::current_exception();  // finish() rethrows it
      room_.notify_all();
    }
    show_bar(false);
  }

  /// Ends the output. Call it after the last put(). @throws the exception of the sink
  Written finish() {
    const std::lock_guard guard(mutex_);
    if (failure_) {
      std::rethrow_exception(failure_);
    }
    sink_.end();
    show_bar(true);
    return {next_row_ - items_.first * sweep_.item_size(), counts_};
  }

 private:
  void write_whole_rows() {
    std::string text;
    for (auto first = waiting_.begin(); first != waiting_.end() && first->first == next_row_;
         first = waiting_.erase(first)) {
      const api::RowCounts counts = sweep_.row_counts(next_row_, first->second);
      counts_.rows += counts.rows;
      counts_.failed += counts.failed;
      sink_.append_row(next_row_++, first->second, text);
    }
    if (!text.empty()) {
      sink_.write(text);
      room_.notify_all();
    }
  }

  void show_bar(bool last) {
    const Clock::time_point now = Clock::now();
    if (bar_ == nullptr || (!last && now < next_bar_)) {
      return;
    }
    next_bar_ = now + kBetweenBars;
    const std::chrono::duration<double> elapsed = now - start_;
    const std::uint64_t all = (items_.end - items_.first) * sweep_.item_size();
    *bar_ << line_start << progress_line(done_, counts_.failed, all, elapsed.count()) << line_end
          << (last ? "\n" : "") << std::flush;
  }

  const api::Sweep& sweep_;
  const ItemRange items_;
  const std::stop_token stop_;
  RowSink& sink_;
  std::ostream* const bar_;
  std::mutex mutex_;
  std::condition_variable_any room_;
  std::map<std::uint64_t, api::PointOutcome> waiting_;
  std::uint64_t given_;         ///< next item to hand out
  std::uint64_t next_row_;      ///< point of the next row
  std::exception_ptr failure_;  ///< exception of the sink
  std::uint64_t done_ = 0;      ///< number of computed points
  api::RowCounts counts_;       ///< written
  const Clock::time_point start_ = Clock::now();
  Clock::time_point next_bar_ = start_;
};

/// Computes the items of a queue on `threads` threads. Items are independent, so that rows do not depend on
/// the number of threads.
Written compute_rows(const api::Sweep& sweep, RowQueue& queue, int threads, const std::stop_token& stop) {
  const SolveFunction solver = [](const Model& model, const Analysis& analysis, const Hooks& hooks) {
    return solve_checked(model, analysis, hooks);
  };
  const auto work = [&] {
    std::shared_ptr<nlohmann::json> document;
    while (const std::optional<std::uint64_t> number = queue.next()) {
      const SweepItem item(sweep, *number);
      std::vector<api::PointOutcome> outcomes = item.compute(solver, {.stop = stop}, document);
      for (std::size_t i = 0; i < outcomes.size(); ++i) {
        queue.put(item.first() + i, std::move(outcomes[i]));
      }
    }
  };
  {
    std::vector<std::jthread> others;
    for (int i = 1; i < threads && static_cast<std::uint64_t>(i) < sweep.size(); ++i) {
      others.emplace_back(work);
    }
    work();
  }
  return queue.finish();
}

/// Writes the request document of one point.
int write_point(const api::Sweep& sweep, std::uint64_t point, const Streams& streams) {
  if (point >= sweep.places()) {
    streams.err << "snapthrough: the points of this sweep are 0 to " << sweep.places() - 1 << ", not "
                << point << '\n';
    return kOther;
  }
  streams.out << sweep.document_at(point)->dump(2) << '\n' << std::flush;
  return kDone;
}

/// Solves the whole sweep and writes its table to the output.
int write_table(const api::Sweep& sweep, const nlohmann::json& document, const Streams& streams,
                const SweepOptions& options) {
  const Interruption interruption;
  TableSink sink(sweep, document, options.form, streams.out);
  RowQueue queue(sweep, {0, sweep.items()}, sink, options.show_progress ? &streams.err : nullptr,
                 interruption.token());
  const Written rows = compute_rows(sweep, queue, options.threads, interruption.token());
  if (!streams.out) {
    streams.err << "snapthrough: cannot write the rows\n";
    return kOther;
  }
  if (rows.outcomes < sweep.size()) {
    streams.err << "interrupted: " << rows.outcomes << " of " << sweep.size()
                << (sweep.refines() ? " curves or surfaces" : " rows") << " were written\n";
    return interruption.exit_status();
  }
  return told_failed(rows.counts, streams);
}

/// Solves the points of a part that its file lacks, and appends their rows.
int write_part(const api::Sweep& sweep, const nlohmann::json& document, const Streams& streams,
               const SweepOptions& options) {
  const Interruption interruption;
  PartWriter file(options.out, document, sweep, options.part);
  PartSink sink(file);
  ItemRange items = items_of(options.part, sweep);
  const std::uint64_t points = (items.end - items.first) * sweep.item_size();
  if (file.points_before() > points) {
    streams.err << "snapthrough: " << options.out << " has more rows than its part\n";
    return kOther;
  }
  items.first += file.points_before() / sweep.item_size();
  RowQueue queue(sweep, items, sink, options.show_progress ? &streams.err : nullptr, interruption.token());
  const Written rows = compute_rows(sweep, queue, options.threads, interruption.token());
  const std::uint64_t present = file.points_before() + rows.outcomes;
  if (present < points) {
    streams.err << "interrupted: " << options.out << " has " << present << " of " << points
                << (sweep.refines() ? " curves or surfaces" : " rows")
                << "; the same command goes on with it\n";
    return interruption.exit_status();
  }
  const api::RowCounts& before = file.counts_before();
  return told_failed({before.rows + rows.counts.rows, before.failed + rows.counts.failed}, streams);
}

}  // namespace

int told_failed(const api::RowCounts& counts, const Streams& streams) {
  if (counts.failed == 0) {
    return kDone;
  }
  streams.err << counts.failed << " of " << counts.rows
              << " points could not be completed; the column error says why\n";
  return kNotCompleted;
}

int sweep_command(const std::string& path, const Streams& streams, const SweepOptions& options) {
  const std::optional<std::string> text = read_all(path, streams);
  if (!text) {
    return kOther;
  }
  const api::ParsedText parsed = api::parse_json(*text);
  const api::SweepOutcome outcome = parsed.document != nullptr ? api::read_sweep_document(parsed.document)
                                                               : api::SweepOutcome{true, parsed.findings, {}};
  if (!outcome.sweep) {
    print_findings(outcome.findings, streams);
    return kWrongRequest;
  }
  if (options.point) {
    return write_point(*outcome.sweep, *options.point, streams);
  }
  return options.out.empty() ? write_table(*outcome.sweep, *parsed.document, streams, options)
                             : write_part(*outcome.sweep, *parsed.document, streams, options);
}

}  // namespace snapthrough::server::cli
