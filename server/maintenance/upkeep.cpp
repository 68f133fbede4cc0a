#include "server/maintenance/upkeep.h"

#include <algorithm>
#include <chrono>
#include <cstdint>

#include "server/bell.h"

namespace snapthrough::server {
namespace {

constexpr std::chrono::seconds kPause{1};
constexpr std::chrono::seconds kBetweenRetirements{10};
/// Jobs deleted in one transaction, which must be short; and transactions in a row, limited so that leases
/// are renewed in time.
constexpr int kRetiredAtOnce = 200;
constexpr int kRetirementsAtOnce = 100;
/// Rows of deleted sweeps that are purged in one transaction, and consecutive transactions.
constexpr int kPurgedRows = 2000;
constexpr int kPurgesAtOnce = 100;

}  // namespace

void log_recovery(Log& log, const Recovery& recovery, std::string_view why) {
  for (const std::string& id : recovery.requeued) {
    log.write(LogLevel::warning, "job",
              {{"job", std::string_view(id)}, {"status", to_string(JobState::accepted)}, {"detail", why}});
  }
  for (const std::string& id : recovery.failed) {
    log.write(LogLevel::error, "job",
              {{"job", std::string_view(id)},
               {"status", to_string(JobState::failed)},
               {"code", std::string_view("crashed")}});
  }
}

void Upkeep::run_once() {
  const Time now = context_.environment.now();
  const Time steady = steady_time(context_.environment);
  look_at_clocks(now, steady);
  look_at_disk(now);
  context_.active.stop_older(steady - context_.limits.longest_run, StopReason::time_limit);
  context_.sweeps.stop_older(steady - context_.limits.longest_run);
  keep_leases(now, steady);
  if (steady >= next_retirement_) {
    next_retirement_ = steady + kBetweenRetirements;
    // The earlier of two clocks decides: neither a clock that was set forward nor one that was set back after
    // it was ahead makes ended work older than it is.
    const Time kept = std::min(now, started_ + (steady - started_steady_));
    retire(kept);
    retire_sweeps(kept);
    count_waiting();
  }
}

/// Notes by how much the wall clock was set since the last look.
void Upkeep::look_at_clocks(Time now, Time steady) {
  const auto moved = (now - now_) - (steady - steady_);
  now_ = now;
  steady_ = steady;
  if (std::chrono::abs(moved) > std::chrono::milliseconds(context_.limits.lease) / 4) {
    moved_ += moved;
    context_.log.write(LogLevel::warning, "clock",
                       {{"seconds", std::chrono::duration<double>(moved).count()},
                        {"detail", std::string_view("the clock of the system was set by so much")}});
  }
}

/// Renews leases, and takes back work whose leases have run out. After the clock was set, all leases are
/// renewed first, as of the clock before, by which they hold.
void Upkeep::keep_leases(Time now, Time steady) {
  const bool shared = context_.store.neighbours() != nullptr;
  const auto quarter = std::chrono::milliseconds(context_.limits.lease) / 4;
  if (moved_ != moved_.zero()) {
    if (!renew_leases(Time::max(), now + context_.limits.lease, now - moved_)) {
      return;
    }
    moved_ = moved_.zero();
    next_renewal_ = steady + quarter;
  } else if (shared || steady >= next_renewal_) {
    // A shared store is asked each time, which shows claims dismissed by other processes.
    next_renewal_ = steady + quarter;
    renew_leases(shared ? steady : steady - quarter / 2, now + context_.limits.lease, now);
  }
  if (steady >= next_rescue_) {
    next_rescue_ = steady + quarter;
    rescue(now);
    context_.sweeps.rescue(now);
  }
}

/// Renews the leases of jobs and items held since before `since` (steady_time()) that have not run out at
/// `now`. Returns whether the store did it.
bool Upkeep::renew_leases(Time since, Time until, Time now) {
  const bool items = context_.sweeps.renew_leases(since, until, now);
  const std::vector<Claim> held = context_.active.stored_before(since);
  if (held.empty()) {
    return items;
  }
  const StatusOr<std::vector<std::string>> lost = context_.store.renew(held, until, now);
  if (!lost.ok()) {
    log_store_trouble(context_.log, lost.status());
    return false;
  }
  for (const std::string& id : *lost) {
    context_.active.stop(id, StopReason::lease_lost);
  }
  return items;
}

void Upkeep::rescue(Time now) {
  WaitingCount::Change change(context_.waiting);
  const StatusOr<Recovery> recovery =
      context_.store.rescue(context_.new_lease().worker, context_.limits.max_crashes, now);
  if (!recovery.ok()) {
    return;  // the next run repeats it; look_at_disk() reports failures
  }
  log_recovery(context_.log, *recovery, "the lease of the worker ran out");
  for (const std::string& id : recovery->failed) {
    context_.completions.announce(id);
    context_.metrics.job_ended("crashed");
  }
  for (std::size_t i = 0; i < recovery->requeued.size(); ++i) {
    change.add(1);
    context_.handoffs.ring();
  }
}

void Upkeep::look_at_disk(Time now) {
  StoreHealth& health = context_.health;
  const bool before = health.writable && health.has_space;
  const Status probe = context_.store.probe(now);
  health.writable = probe.ok();
  if (probe.ok()) {
    context_.log.is_back("store");
  }
  if (!guard_) {  // a store that is no file: its disk is not ours
    if (!probe.ok()) {
      log_store_trouble(context_.log, probe);
    }
    return;
  }
  const StatusOr<std::uint64_t> reusable = context_.store.give_back_space();
  const std::uint64_t unused = reusable.ok() ? *reusable : 0;
  health.has_space = guard_->check(probe.ok(), unused);
  health.room = static_cast<std::int64_t>(guard_->room(unused));
  if (const bool after = health.writable && health.has_space; after != before) {
    context_.log.write(after ? LogLevel::info : LogLevel::error, "disk",
                       {{"writable", health.writable.load()},
                        {"has_space", health.has_space.load()},
                        {"free_bytes", static_cast<std::int64_t>(guard_->free_bytes())},
                        {"detail", std::string_view(probe.message())}});
  }
}

void Upkeep::retire(Time now) {
  const JobLimits& limits = context_.limits;
  if (limits.keep_jobs.count() > 0) {
    StatusOr<int> retired = kRetiredAtOnce;
    int total = 0;
    for (int i = 0; i < kRetirementsAtOnce && retired.ok() && *retired == kRetiredAtOnce; ++i) {
      retired = context_.store.retire(limits.keep_jobs, kRetiredAtOnce, now);
      total += retired.ok() ? *retired : 0;
    }
    if (total > 0) {
      context_.log.write(LogLevel::info, "retired", {{"jobs", static_cast<std::int64_t>(total)}});
    }
  }
  StatusOr<bool> more = limits.keep_records.count() > 0;
  for (int i = 0; i < kRetirementsAtOnce && more.ok() && *more; ++i) {
    more = context_.store.ledger().forget(limits.keep_records, kRetiredAtOnce, now);
  }
  if (const Status status = context_.store.forget_keys(limits.keep_keys, now); !status.ok()) {
    log_store_trouble(context_.log, status);
  }
}

/// Deletes sweeps past their retention time, and purges the rows of deleted ones.
void Upkeep::retire_sweeps(Time now) {
  SweepStore& store = context_.store.sweeps();
  const JobLimits& limits = context_.limits;
  if (limits.keep_jobs.count() > 0) {
    const StatusOr<int> retired = store.retire(limits.keep_jobs, now);
    if (retired.ok() && *retired > 0) {
      context_.log.write(LogLevel::info, "retired", {{"sweeps", static_cast<std::int64_t>(*retired)}});
    }
  }
  StatusOr<bool> more = true;
  for (int i = 0; i < kPurgesAtOnce && more.ok() && *more; ++i) {
    more = store.purge(kPurgedRows);
  }
  if (const Status status = store.forget_keys(limits.keep_keys, now); !status.ok()) {
    log_store_trouble(context_.log, status);
  }
}

void Upkeep::count_waiting() {
  context_.waiting.recount([this] { return context_.store.waiting(); });
}

UpkeepThread::UpkeepThread(Upkeep& upkeep)
    : thread_([&upkeep](const std::stop_token& stop) {
        while (!stop.stop_requested()) {
          upkeep.run_once();
          pause(stop, kPause);
        }
      }) {}

}  // namespace snapthrough::server
