#include "server/sweeps/chunk.h"

#include <algorithm>
#include <chrono>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <utility>

#include "server/pause.h"
#include "server/sweeps/unit.h"

namespace snapthrough::server {
namespace {

/// A chunk that takes longer ends after the unit it is at; when jobs wait, sooner.
constexpr double kLongest = 0.25;
constexpr double kLongestWhileJobsWait = 0.02;
constexpr std::chrono::milliseconds kRetryPause{200};

/// A unit that is still to be computed.
struct Pending {
  std::uint64_t number = 0;
  std::unique_ptr<SweepUnit> unit;
  std::vector<std::string> keys;  ///< of its points
};

struct Work {
  std::vector<PointRow> rows;
  std::vector<Pending> pending;
  std::vector<std::uint64_t> rest;  ///< units that were not computed
};

std::vector<Pending> pending_units(const Chunk& chunk) {
  const ActiveSweep& sweep = *chunk.sweep;
  std::shared_ptr<nlohmann::json> document;
  std::vector<Pending> all;
  for (const std::uint64_t number : chunk.units) {
    std::unique_ptr<SweepUnit> unit = make_unit(sweep.sweep, number);
    std::vector<std::string> keys = unit->keys(sweep.outputs, sweep.owner, document);
    all.push_back({number, std::move(unit), std::move(keys)});
  }
  return all;
}

/// Takes what is known already: units, of which every point is.
void look_up(const Chunk& chunk, const WorkerContext& context, Work& work) {
  if (!chunk.sweep->reuse) {
    return;
  }
  std::vector<std::string> keys;
  for (const Pending& pending : work.pending) {
    keys.insert(keys.end(), pending.keys.begin(), pending.keys.end());
  }
  auto found = context.sweeps.store().find_outputs(keys);
  if (!found.ok()) {
    return;  // they are computed then
  }
  std::vector<Pending> unknown;
  auto outputs = found->begin();  // of the unit's first point
  for (Pending& pending : work.pending) {
    const auto end = outputs + static_cast<std::ptrdiff_t>(pending.keys.size());
    if (std::find(outputs, end, std::nullopt) != end) {
      unknown.push_back(std::move(pending));
      outputs = end;
      continue;
    }
    for (std::size_t i = 0; i < pending.keys.size(); ++i, ++outputs) {
      work.rows.push_back(
          {pending.unit->first() + i, {*std::move(*outputs), "", ""}, std::move(pending.keys[i]), true});
    }
  }
  work.pending = std::move(unknown);
}

bool is_late(double seconds, const WorkerContext& context) {
  return seconds > kLongest || (seconds > kLongestWhileJobsWait && context.waiting > 0);
}

/// The rows of a unit that was computed, or stopped for its time.
void add_rows(Pending& pending, std::vector<api::PointOutcome> outcomes, const WorkerContext& context,
              std::vector<PointRow>& rows) {
  for (std::size_t i = 0; i < outcomes.size(); ++i) {
    if (outcomes[i].code == kCancelled) {
      outcomes[i] = {"", "time_limit", pending.unit->too_long(context.limits.longest_run)};
    }
    rows.push_back({pending.unit->first() + i, std::move(outcomes[i]), std::move(pending.keys[i])});
  }
}

/// Computes what is pending; what it does not come to is left as the rest.
void compute(const Chunk& chunk, const WorkerContext& context, Runner& runner, SweepScheduler::Watch& watch,
             Work& work) {
  const double start = context.environment.monotonic_seconds();
  std::vector<std::uint64_t> units;
  for (const Pending& pending : work.pending) {
    units.push_back(pending.number);
  }
  std::size_t next = 0;
  const auto late = [&] { return is_late(context.environment.monotonic_seconds() - start, context); };
  const auto take = [&](std::vector<api::PointOutcome> outcomes) {
    if (is_cut_short(outcomes) && watch.reason() != StopReason::time_limit) {
      return;
    }
    add_rows(work.pending[next], std::move(outcomes), context, work.rows);
    ++next;
    watch.begin(context.environment.now());
  };
  watch.begin(context.environment.now());
  runner.run_units(
      {chunk.sweep->id, chunk.sweep->document, chunk.sweep->sweep, units, watch.token(), late, take});
  work.rest.assign(units.begin() + static_cast<std::ptrdiff_t>(next), units.end());
}

}  // namespace

void work_on(const Chunk& chunk, const WorkerContext& context, Runner& runner, const std::stop_token& stop) {
  SweepScheduler::Watch watch(context.sweeps.scheduler(), context.environment.now());
  const std::stop_callback on_shutdown(stop, [&] { watch.stop(StopReason::shutdown); });
  const std::stop_callback on_dismissal(chunk.sweep->stopped(), [&] { watch.stop(StopReason::dismissed); });
  const double start = context.environment.monotonic_seconds();
  Work work;
  work.pending = pending_units(chunk);
  look_up(chunk, context, work);
  compute(chunk, context, runner, watch, work);
  const double seconds = context.environment.monotonic_seconds() - start;
  Status status = context.sweeps.settle(chunk, work.rows, work.rest, seconds);
  while (status.code() == StatusCode::unavailable && !stop.stop_requested()) {
    pause(stop, kRetryPause);
    status = context.sweeps.settle(chunk, work.rows, work.rest, seconds);
  }
  if (!status.ok() && status.code() != StatusCode::conflict) {
    context.log.write(
        LogLevel::error, "store",
        {{"sweep", std::string_view(chunk.sweep->id)}, {"detail", std::string_view(status.message())}});
  }
}

}  // namespace snapthrough::server
