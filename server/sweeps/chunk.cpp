#include "server/sweeps/chunk.h"

#include <chrono>
#include <nlohmann/json.hpp>
#include <utility>

#include "server/jobs/content_key.h"
#include "server/pause.h"

namespace snapthrough::server {
namespace {

/// A chunk that takes longer ends after the point it is at; when jobs wait, sooner.
constexpr double kLongest = 0.25;
constexpr double kLongestWhileJobsWait = 0.02;
constexpr std::chrono::milliseconds kRetryPause{200};

/// A point that is still to be computed.
struct Pending {
  std::uint64_t point = 0;
  std::string key;
};

struct Work {
  std::vector<PointRow> rows;
  std::vector<Pending> pending;
  std::vector<std::uint64_t> rest;
};

/// Points of a curve are the same only on the same curve: following gives other last digits than tracing.
/// @param curve Sweep::curve_text() of the chunk
std::string key_of(const Chunk& chunk, const std::string& curve, const nlohmann::json& document) {
  return point_key(document, chunk.sweep->outputs + curve, chunk.sweep->owner);
}

std::vector<Pending> pending_points(const Chunk& chunk) {
  const std::string curve = chunk.sweep->sweep.curve_text(chunk.points.front());
  std::vector<Pending> all;
  for (const std::uint64_t point : chunk.points) {
    all.push_back({point, key_of(chunk, curve, *chunk.sweep->sweep.document_at(point))});
  }
  return all;
}

/// Takes what is known already.
void look_up(const Chunk& chunk, const WorkerContext& context, Work& work) {
  if (!chunk.sweep->reuse) {
    return;
  }
  std::vector<std::string> keys;
  for (const Pending& pending : work.pending) {
    keys.push_back(pending.key);
  }
  const auto found = context.sweeps.find_outputs(keys);
  if (!found.ok()) {
    return;  // they are computed then
  }
  std::vector<Pending> unknown;
  for (std::size_t i = 0; i < work.pending.size(); ++i) {
    Pending& pending = work.pending[i];
    if ((*found)[i]) {
      work.rows.push_back({pending.point, {*(*found)[i], "", ""}, std::move(pending.key), true});
    } else {
      unknown.push_back(std::move(pending));
    }
  }
  work.pending = std::move(unknown);
}

bool is_late(double seconds, const WorkerContext& context) {
  return seconds > kLongest || (seconds > kLongestWhileJobsWait && context.waiting > 0);
}

/// Computes what is pending; what it does not come to is left as the rest.
void compute(const Chunk& chunk, const WorkerContext& context, Runner& runner, SweepScheduler::Watch& watch,
             Work& work) {
  const double start = context.environment.monotonic_seconds();
  std::vector<std::uint64_t> points;
  for (const Pending& pending : work.pending) {
    points.push_back(pending.point);
  }
  std::size_t next = 0;
  const auto late = [&] { return is_late(context.environment.monotonic_seconds() - start, context); };
  const auto take = [&](api::PointOutcome outcome) {
    if (outcome.code == "cancelled" && watch.reason() == StopReason::time_limit) {
      outcome = {
          "", "time_limit",
          "the analysis took longer than " + std::to_string(context.limits.longest_run.count()) + " s"};
    } else if (outcome.code == "cancelled") {
      return;
    }
    work.rows.push_back({points[next], std::move(outcome), std::move(work.pending[next].key)});
    ++next;
    watch.begin(context.environment.now());
  };
  watch.begin(context.environment.now());
  runner.run_points(
      {chunk.sweep->id, chunk.sweep->document, chunk.sweep->sweep, points, watch.token(), late, take});
  work.rest.assign(points.begin() + static_cast<std::ptrdiff_t>(next), points.end());
}

/// Computes a curve, wholly or not at all.
void compute_curve(const Chunk& chunk, const WorkerContext& context, Runner& runner,
                   SweepScheduler::Watch& watch, Work& work) {
  if (work.pending.empty()) {
    return;
  }
  work.rows.clear();  // what was found of a curve is not enough
  watch.begin(context.environment.now());
  std::vector<api::PointOutcome> outcomes = runner.run_curve(
      {chunk.sweep->id, chunk.sweep->document, chunk.sweep->sweep, chunk.points, watch.token()});
  const std::string curve = chunk.sweep->sweep.curve_text(chunk.points.front());
  const bool late = watch.reason() == StopReason::time_limit;
  if (watch.token().stop_requested() && !late) {
    work.rest = chunk.points;
    return;
  }
  for (std::size_t i = 0; i < outcomes.size(); ++i) {
    if (late && outcomes[i].code == "cancelled") {
      outcomes[i] = {"", "time_limit", "the curve took longer than one analysis may take"};
    }
    const auto document = chunk.sweep->sweep.document_at(chunk.points[i]);
    work.rows.push_back({chunk.points[i], std::move(outcomes[i]), key_of(chunk, curve, *document)});
  }
}

}  // namespace

void work_on(const Chunk& chunk, const WorkerContext& context, Runner& runner, const std::stop_token& stop) {
  SweepScheduler::Watch watch(context.sweeps.scheduler(), context.environment.now());
  const std::stop_callback on_shutdown(stop, [&] { watch.stop(StopReason::shutdown); });
  const std::stop_callback on_dismissal(chunk.sweep->stopped(), [&] { watch.stop(StopReason::dismissed); });
  const double start = context.environment.monotonic_seconds();
  Work work;
  work.pending = pending_points(chunk);
  look_up(chunk, context, work);
  if (chunk.sweep->sweep.follows()) {
    compute_curve(chunk, context, runner, watch, work);
  } else {
    compute(chunk, context, runner, watch, work);
  }
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
