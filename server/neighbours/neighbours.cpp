#include "server/neighbours/neighbours.h"

#include <algorithm>

#include "server/bell.h"

namespace snapthrough::server {
namespace {

using std::chrono::milliseconds;

constexpr milliseconds kShortest{50};
constexpr milliseconds kLongest{1000};
/// Longest pause while a thread here waits for the end of a job, which is seen even without a ring.
constexpr milliseconds kLongestWhileWaiting{250};
/// Shortest time between two rings of a process, so that many ends give one ring.
constexpr milliseconds kBetweenRings{20};
/// Waiting jobs are counted up to this number.
constexpr std::int64_t kMany = 1000;

/// Returns the pause with a random change of up to a quarter, so that processes do not poll in step.
milliseconds with_jitter(milliseconds pause, const Environment& environment) {
  const auto quarter = static_cast<std::uint64_t>(pause.count() / 4 + 1);
  return pause - milliseconds(quarter) + milliseconds(environment.random_bits() % (2 * quarter));
}

}  // namespace

Neighbours::Neighbours(NeighbourStore& store, const WorkerContext& context)
    : store_(store),
      context_(context),
      watching_([this](const std::stop_token& stop) { watch(stop); }),
      telling_([this](const std::stop_token& stop) { tell_others(stop); }) {}

void Neighbours::watch(const std::stop_token& stop) {
  milliseconds longest = kShortest;
  while (!stop.stop_requested()) {
    const bool rung = store_.wait(with_jitter(longest, context_.environment), stop);
    const bool found = look();
    longest = rung || found ? kShortest : std::min(2 * longest, kLongest);
    if (!context_.completions.waited().empty()) {
      longest = std::min(longest, kLongestWhileWaiting);
    }
    if (rung) {
      pause(stop, kBetweenRings);
    }
  }
}

void Neighbours::tell_others(const std::stop_token& stop) {
  std::uint64_t seen = 0;
  while (!stop.stop_requested()) {
    if (context_.bell.wait(seen, stop, kLongest)) {
      (void)store_.ring().ok();  // a failed ring() only delays the others
      pause(stop, kBetweenRings);
    }
  }
}

/// Looks once for ends and work, and each second for progress. Returns whether it found ends or work.
bool Neighbours::look() {
  const double now = context_.environment.monotonic_seconds();
  const bool second = now >= next_second_;
  const bool ends = look_for_ends();
  const bool work = (second || context_.handoffs.idle() > 0) && look_for_work();
  if (second) {
    next_second_ = now + 1.0;
    pass_on_progress();
    tell_progress();
  }
  return ends || work;
}

bool Neighbours::look_for_ends() {
  const std::vector<std::string> waited = context_.completions.waited();
  if (waited.empty()) {
    return false;
  }
  const StatusOr<std::vector<std::string>> ended = store_.ended(waited);
  for (const std::string& id : ended.ok() ? *ended : std::vector<std::string>()) {
    context_.completions.end(id);
  }
  return ended.ok() && !ended->empty();
}

bool Neighbours::look_for_work() {
  const std::int64_t before = context_.waiting.value();
  const StatusOr<WaitingWork> work = store_.work(kMany);
  if (!work.ok()) {
    return false;
  }
  // fails if jobs were added or claimed in the meantime; the next look then decides
  context_.waiting.replace(before, work->jobs < kMany ? work->jobs : std::max(before, kMany));
  const std::size_t idle = context_.handoffs.idle();
  for (std::size_t i = 0; i < std::min(idle, static_cast<std::size_t>(work->jobs)); ++i) {
    context_.handoffs.ring();
  }
  if (work->items) {
    context_.sweeps.look_again();
  }
  return idle > 0 && (work->jobs > 0 || work->items);
}

/// Publishes the progress of other processes to the followers in this process.
void Neighbours::pass_on_progress() {
  const std::vector<std::string> jobs = context_.progress.followed();
  const StatusOr<std::vector<ToldProgress>> told =
      jobs.empty() ? std::vector<ToldProgress>() : store_.told(jobs);
  for (const ToldProgress& one : told.ok() ? *told : std::vector<ToldProgress>()) {
    if (!context_.active.has(one.id)) {
      context_.progress.pass_on(one.id, JobNews{one.attempt, one.number, one.progress, {}, {}});
    }
  }
  for (const std::string& id : context_.sweeps.news().followed()) {
    const StatusOr<std::optional<SweepRecord>> sweep = context_.store.sweeps().get(id);
    if (sweep.ok() && *sweep && !is_final((*sweep)->state)) {
      context_.sweeps.news().pass_on(id, **sweep);
    }
  }
}

/// Stores the progress of this process' analyses for other processes.
void Neighbours::tell_progress() {
  std::vector<ToldProgress> all;
  for (const Claim& claim : context_.active.stored_before(Time::max())) {
    const auto number = context_.progress.get(claim.id, &JobNews::number);
    const auto progress = context_.progress.get(claim.id, &JobNews::progress).value_or(std::nullopt);
    if (number && progress) {
      all.push_back({claim.id, claim.attempt, *number, *progress});
    }
  }
  if (!all.empty()) {
    (void)store_.tell(all).ok();  // a failed tell() is repeated in a second
  }
}

}  // namespace snapthrough::server
