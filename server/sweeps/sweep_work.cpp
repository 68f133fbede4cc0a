#include "server/sweeps/sweep_work.h"

#include <algorithm>
#include <chrono>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <utility>

#include "api/point_outcome.h"
#include "api/sweep_item.h"
#include "server/bell.h"
#include "server/store/items.h"
#include "server/worker/sweep_item.h"

namespace snapthrough::server {
namespace {

/// A chunk ends after the current item when it has taken this many times the seconds that it should take.
constexpr double kLongest = 2.5;
/// Length of a chunk in seconds while jobs wait.
constexpr double kWhileJobsWait = 0.02;
constexpr std::chrono::milliseconds kRetryPause{200};

/// The rows of the same points with the error that the store refused them.
std::vector<PointRow> not_stored(std::vector<PointRow> rows, const Status& status) {
  for (PointRow& row : rows) {
    row = {row.point, {"", "not_stored", "the row could not be stored: " + status.message()}};
  }
  return rows;
}

/// An item without rows.
struct Pending {
  std::uint64_t number = 0;
  SweepItem item;
  std::vector<std::string> keys;  ///< keys of its points
};

struct Work {
  std::vector<PointRow> rows;    ///< rows of items that are done
  std::vector<Pending> pending;  ///< items that are neither computed nor found in the store
  WorkUsage usage;               ///< what computing rows took
};

/// Items of a chunk that lack a row in the store. When the store can't be read, all items: a point that has a
/// row keeps it.
std::vector<ItemRun> items_left(const Chunk& chunk, SweepStore& store) {
  const ItemRun& items = chunk.claim.items;
  const std::uint64_t size = chunk.sweep->sweep.item_size();
  ItemRows stored(items, static_cast<std::int64_t>(size));
  const Status read = store.each_row(chunk.claim.sweep, {items.first * size, items.count * size, {}},
                                     [&](std::uint64_t point, const api::PointOutcome&) {
                                       stored.add(point);
                                       return true;
                                     });
  return read.ok() ? stored.left() : std::vector<ItemRun>{items};
}

std::vector<Pending> pending_items(const Chunk& chunk, SweepStore& store) {
  const ActiveSweep& sweep = *chunk.sweep;
  std::shared_ptr<nlohmann::json> document;
  std::vector<Pending> all;
  for (const ItemRun& run : items_left(chunk, store)) {
    for (std::uint64_t number = run.first; number < run.first + run.count; ++number) {
      const SweepItem item(sweep.sweep, number);
      std::vector<std::string> keys = item.keys(sweep.outputs, sweep.owner, document);
      all.push_back({number, item, std::move(keys)});
    }
  }
  return all;
}

/// Takes rows of earlier points with the same keys, for items whose points all have one.
void look_up(const Chunk& chunk, const SweepSurroundings& world, Work& work) {
  if (!chunk.sweep->reuse) {
    return;
  }
  std::vector<std::string> keys;
  for (const Pending& pending : work.pending) {
    keys.insert(keys.end(), pending.keys.begin(), pending.keys.end());
  }
  auto found = world.store.find_outputs(keys);
  if (!found.ok()) {
    return;  // the items are computed
  }
  std::vector<Pending> unknown;
  auto outputs = found->begin();  // output of the first point of the item
  for (Pending& pending : work.pending) {
    const auto end = outputs + static_cast<std::ptrdiff_t>(pending.keys.size());
    if (std::find(outputs, end, std::nullopt) != end) {
      unknown.push_back(std::move(pending));
      outputs = end;
      continue;
    }
    for (std::size_t i = 0; i < pending.keys.size(); ++i, ++outputs) {
      work.rows.push_back({pending.item.first() + i, {**outputs, "", ""}, std::move(pending.keys[i]), true});
    }
  }
  work.pending = std::move(unknown);
}

/// Whether a chunk that has run for `seconds` should end. @param chunk seconds that it should take
bool is_late(double seconds, double chunk, const SweepSurroundings& world) {
  return seconds > kLongest * chunk || (seconds > kWhileJobsWait && world.waiting.value() > 0);
}

/// Rows of an item that was computed, or stopped at the time limit.
void add_rows(Pending& pending, std::vector<api::PointOutcome> outcomes, const SweepSurroundings& world,
              std::vector<PointRow>& rows) {
  for (std::size_t i = 0; i < outcomes.size(); ++i) {
    if (outcomes[i].code == kCancelled) {
      outcomes[i] = {"", "time_limit", pending.item.too_long(world.limits.longest_run)};
    }
    rows.push_back({pending.item.first() + i, std::move(outcomes[i]), std::move(pending.keys[i])});
  }
}

/// Computes pending items until about `seconds` have passed, jobs wait, or a stop is requested. Returns how
/// many were computed.
std::size_t compute(const Chunk& chunk, double seconds, const SweepSurroundings& world, Runner& runner,
                    SweepScheduler::Watch& watch, Work& work) {
  const double start = world.environment.monotonic_seconds();
  std::vector<std::uint64_t> items;
  items.reserve(work.pending.size());
  for (const Pending& pending : work.pending) {
    items.push_back(pending.number);
  }
  std::size_t next = 0;
  const auto late = [&] { return is_late(world.environment.monotonic_seconds() - start, seconds, world); };
  const auto take = [&](std::vector<api::PointOutcome> outcomes) {
    if (api::is_cut_short(outcomes) && watch.reason() != StopReason::time_limit) {
      return;
    }
    add_rows(work.pending[next], std::move(outcomes), world, work.rows);
    ++next;
    watch.begin(steady_time(world.environment));
  };
  watch.begin(steady_time(world.environment));
  work.usage = runner.run_items(
      {chunk.sweep->id, chunk.sweep->document, chunk.sweep->sweep, items, watch.token(), late, take});
  return next;
}

}  // namespace

void log_sweep(Log& log, std::string_view id, std::string_view status, std::string_view detail) {
  log.write(LogLevel::info, "sweep", {{"sweep", id}, {"status", status}, {"detail", detail}});
}

StatusOr<SweepChange> SweepWork::dismiss(const std::string& id) {
  StatusOr<SweepChange> change = world_.store.dismiss(id, world_.environment.now());
  if (change.ok() && change->changed) {
    scheduler_.remove(id);
    unloaded_ = true;  // the scheduler has room, and the sweep may have been tried again
    world_.completions.announce(id);
    log_sweep(world_.log, id, to_string(JobState::dismissed));
  }
  return change;
}

bool SweepWork::renew_leases(Time since, Time until, Time now) {
  const std::vector<ItemClaim> held = scheduler_.older(since);
  if (held.empty()) {
    return true;
  }
  const StatusOr<std::vector<std::int64_t>> lost = world_.store.renew(held, until, now);
  for (const std::int64_t number : lost.ok() ? *lost : std::vector<std::int64_t>()) {
    scheduler_.stop_claim(number, StopReason::lease_lost);
  }
  return lost.ok();
}

void SweepWork::rescue(Time now) {
  const StatusOr<std::int64_t> items = world_.store.rescue(world_.instance, world_.limits.max_crashes, now);
  if (items.ok() && *items > 0) {
    world_.log.write(LogLevel::warning, "sweep",
                     {{"units", *items}, {"detail", std::string_view("the lease of the worker ran out")}});
    wake();
  }
}

void SweepWork::wake() {
  look_again();
  world_.bell.ring();
}

void SweepWork::look_again() {
  unloaded_ = true;
  world_.handoffs.ring();
}

/// Adds the oldest sweeps that the scheduler does not have, as many as it has room for.
void SweepWork::load() {
  const std::unique_lock lock(loading_, std::try_to_lock);
  if (!lock.owns_lock() || !unloaded_.exchange(false)) {
    return;  // another thread loads
  }
  scheduler_.refresh();
  const StatusOr<std::vector<std::string>> ids = world_.store.with_items();
  bool all = ids.ok();
  if (ids.ok()) {
    std::erase_if(foreign_, [&](const std::string& id) {
      return std::find(ids->begin(), ids->end(), id) == ids->end();
    });
  }
  // the store gives the first sweep of each owner, then the second ones: a new owner's sweep comes before the
  // second of another, which is put aside
  std::vector<std::string> first;
  for (const std::string& id : ids.ok() ? *ids : std::vector<std::string>()) {
    if (first.size() < SweepScheduler::kMost && !foreign_.contains(id)) {
      first.push_back(id);
    }
  }
  if (ids.ok()) {
    scheduler_.give_turns_to(first);
  }
  for (const std::string& id : first) {
    all = (scheduler_.has(id) || load_one(id)) && !foreign_.contains(id) && all;
  }
  if (!all) {
    unloaded_ = true;  // the store failed, or another one has its place: the next call tries again
  }
}

/// Adds one sweep; returns false when the store failed.
bool SweepWork::load_one(const std::string& id) {
  const StatusOr<std::optional<OpenSweep>> open = world_.store.open(id);
  if (!open.ok() || !open->has_value()) {
    return open.ok();  // an empty answer: the sweep has ended
  }
  OpenSweep found = **open;
  const api::SweepOutcome read = api::read_sweep(found.document);
  if (!read.sweep) {
    leave(id, read.findings.front());
    return true;
  }
  scheduler_.add(std::make_shared<ActiveSweep>(id, *read.sweep, std::move(found)));
  return true;
}

/// Leaves a sweep to workers of other versions.
void SweepWork::leave(const std::string& id, const Finding& finding) {
  foreign_.insert(id);
  const std::string why =
      "a program of another version stored the document, this worker leaves it to others: " +
      finding.pointer + ": " + finding.detail;
  world_.log.write(LogLevel::warning, "sweep",
                   {{"sweep", std::string_view(id)},
                    {"status", std::string_view("not_readable")},
                    {"detail", std::string_view(why)}});
}

std::optional<Chunk> SweepWork::take(const OwnersInTurn& owners) {
  if (unloaded_) {
    load();
  }
  const double seconds = world_.waiting.value() > 0 ? kWhileJobsWait : scheduler_.chunk_seconds();
  while (const std::optional<SweepTurn> turn = scheduler_.next(seconds, owners)) {
    const std::string& id = turn->sweep->id;
    const Time now = world_.environment.now();
    const double start = world_.environment.monotonic_seconds();
    const Lease lease{world_.instance, now + world_.limits.lease};
    StatusOr<std::optional<ItemClaim>> claim = world_.store.claim(id, turn->most, lease, now);
    if (claim.ok() && claim->has_value()) {
      if (scheduler_.has_items()) {
        world_.handoffs.ring();  // wakes the next worker
      }
      return Chunk{turn->sweep, **std::move(claim), world_.environment.monotonic_seconds() - start};
    }
    if (claim.ok()) {
      scheduler_.exhausted(*turn);
    } else if (claim.status().code() == StatusCode::conflict) {
      scheduler_.remove(turn->sweep);
    } else {
      log_store_trouble(world_.log, claim.status());
      return std::nullopt;
    }
  }
  return std::nullopt;
}

bool SweepWork::do_next(Runners& runners, const std::stop_token& stop, const OwnersInTurn& owners) {
  const std::optional<Chunk> chunk = take(owners);
  if (!chunk) {
    return false;
  }
  SweepScheduler::Watch watch(scheduler_, chunk->claim, steady_time(world_.environment));
  const std::stop_callback on_shutdown(stop, [&] { watch.stop(StopReason::shutdown); });
  const std::stop_callback on_dismissal(chunk->sweep->stopped(), [&] { watch.stop(StopReason::dismissed); });
  const double start = world_.environment.monotonic_seconds();
  Work work;
  work.pending = pending_items(*chunk, world_.store);
  look_up(*chunk, world_, work);
  const std::size_t computed =
      compute(*chunk, scheduler_.chunk_seconds(), world_, runners.of(chunk->sweep->owner), watch, work);
  const double seconds = world_.environment.monotonic_seconds() - start;
  runners.note(chunk->sweep->owner, work.usage, seconds);
  const std::uint64_t done = chunk->claim.items.count - (work.pending.size() - computed);
  Status status = settle(*chunk, work.rows, work.usage, done, seconds);
  while (status.code() == StatusCode::unavailable && !stop.stop_requested()) {
    pause(stop, kRetryPause);
    status = settle(*chunk, work.rows, work.usage, done, seconds);
  }
  if (!status.ok() && status.code() != StatusCode::conflict) {
    world_.log.write(
        LogLevel::error, "store",
        {{"sweep", std::string_view(chunk->sweep->id)}, {"detail", std::string_view(status.message())}});
  }
  return true;
}

Status SweepWork::settle(const Chunk& chunk, const std::vector<PointRow>& rows, const WorkUsage& usage,
                         std::uint64_t done, double seconds) {
  const double start = world_.environment.monotonic_seconds();
  StatusOr<SweepRecord> record = world_.store.put(chunk.claim, rows, usage, world_.environment.now());
  if (record.ok()) {
    scheduler_.store_took(chunk.claim_seconds + world_.environment.monotonic_seconds() - start);
  }
  if (!record.ok() && record.status().code() == StatusCode::io_error) {
    record =
        world_.store.put(chunk.claim, not_stored(rows, record.status()), usage, world_.environment.now());
  }
  if (record.ok()) {
    scheduler_.give_back(chunk, done, seconds);
    stored(*record, rows);
    return {};
  }
  if (record.status().code() == StatusCode::unavailable) {
    world_.health.writable = false;
    return record.status();
  }
  // The sweep was dismissed or removed meanwhile, or the store is broken: the next start takes the sweep up
  // again then. A sweep that was tried again since is another object in the scheduler.
  scheduler_.remove(chunk.sweep);
  return record.status();
}

void SweepWork::stored(const SweepRecord& record, const std::vector<PointRow>& rows) {
  for (const PointRow& row : rows) {
    world_.metrics.point_ended(row.reused             ? "reused"
                               : row.outcome.failed() ? std::string_view(row.outcome.code)
                                                      : to_string(JobState::successful));
  }
  if (!is_final(record.state)) {
    news_.pass_on(record.id, record);
    return;
  }
  scheduler_.remove(record.id);
  unloaded_ = true;  // the scheduler has room
  world_.completions.announce(record.id);
  world_.log.write(record.failed > 0 ? LogLevel::warning : LogLevel::info, "sweep",
                   {{"sweep", std::string_view(record.id)},
                    {"status", to_string(record.state)},
                    {to_string(JobState::successful), record.successful},
                    {to_string(JobState::failed), record.failed},
                    {"reused", record.reused}});
}

}  // namespace snapthrough::server
