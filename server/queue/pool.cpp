#include "server/queue/pool.h"

#include <algorithm>
#include <chrono>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>
#include <utility>

#include "server/bell.h"
#include "server/jobs/path_batch.h"
#include "server/priority.h"
#include "server/worker/solve_job.h"

namespace snapthrough::server {
namespace {

using std::chrono::duration;

/// Longest time for which an idle worker waits before it queries the store again without notice. For a shared
/// store it is longer, because Neighbours polls for all workers of the process.
constexpr duration<double> kLongestNap{1.0};
constexpr duration<double> kLongestSharedNap{10.0};
/// Value of WorkerPool::busy_since_ and spare_began_ for a worker that waits for work.
constexpr double kWaits = std::numeric_limits<double>::infinity();
/// Pause before another attempt to store an outcome.
constexpr std::chrono::milliseconds kRetryPause{200};

/// Adds points of the path, and removes the oldest beyond kTracedBytes.
void note_traced(JobNews& news, std::string document) {
  news.traced.push_back({news.number, std::move(document)});
  std::size_t bytes = 0;
  for (const TracedPoints& points : news.traced) {
    bytes += points.document.size();
  }
  for (; bytes > kTracedBytes && news.traced.size() > 1; news.traced.pop_front()) {
    bytes -= news.traced.front().document.size();
  }
}

/// Returns hooks that publish news of an analysis to the followers of its job.
Hooks told_hooks(const Claim& claim, JobProgress& topic, const std::stop_token& stop) {
  const auto tell = [&claim, &topic](auto change) {
    topic.update(claim.id, [&](JobNews& news) {
      news.attempt = claim.attempt;
      ++news.number;
      change(news);
    });
  };
  const auto batch = std::make_shared<PathBatch>();
  return {stop,
          [tell, batch](const Progress& progress) {
            if (!batch->empty()) {
              tell([&](JobNews& news) { note_traced(news, path_points_document(batch->points())); });
              batch->clear();
            }
            tell([&](JobNews& news) { news.progress = progress; });
          },
          [tell](const CriticalPoint& point) {
            tell([&](JobNews& news) { news.found.push_back({news.number, point}); });
          },
          [batch](const TracedPoint& point) { batch->add(point); }};
}

/// Logs that a job begins or is requeued.
void log_job(Log& log, const Claim& claim, JobState state) {
  log.write(LogLevel::info, "job",
            {{"job", std::string_view(claim.id)},
             {"status", to_string(state)},
             {"attempt", static_cast<std::int64_t>(claim.attempt)}});
}

/// Logs the end of a job with its termination or failure code and message.
void log_job_end(Log& log, const Claim& claim, const JobRun& outcome) {
  const bool failed = outcome.failure.has_value();
  log.write(
      failed ? LogLevel::warning : LogLevel::info, "job",
      {{"job", std::string_view(claim.id)},
       {"status", to_string(failed ? JobState::failed : JobState::successful)},
       {"attempt", static_cast<std::int64_t>(claim.attempt)},
       {"peak_bytes", outcome.usage.peak_bytes},
       {"cpu_seconds", static_cast<double>(outcome.usage.cpu_us) * 1e-6},
       {"code", std::string_view(failed ? outcome.failure->code : outcome.result->summary.termination)},
       {"detail", std::string_view(failed ? outcome.failure->detail : outcome.result->summary.message)}});
}

void log_trouble(Log& log, const Claim& claim, const Status& status) {
  log.write(LogLevel::error, "store",
            {{"job", std::string_view(claim.id)},
             {"attempt", static_cast<std::int64_t>(claim.attempt)},
             {"detail", std::string_view(status.message())}});
}

Status store_once(const Claim& claim, JobRun& outcome, const WorkerContext& context) {
  const Time now = context.environment.now();
  if (!outcome.result) {
    return context.store.fail(claim, *outcome.failure, outcome.reached, outcome.usage, now);
  }
  Status status = context.store.finish(claim, *outcome.result, outcome.usage, now);
  if (status.code() != StatusCode::io_error) {
    return status;
  }
  // A result with a number that is not finite cannot be stored; the job then fails instead of staying open.
  outcome.result.reset();
  outcome.failure = JobFailure{"not_stored", "the result could not be stored: " + status.message(), ""};
  return context.store.fail(claim, *outcome.failure, {}, outcome.usage, now);
}

/// Stores the outcome. Repeats while the store is not writable, until the claim is lost or the service stops;
/// the next start then finds the job running.
Status store_outcome(const Claim& claim, JobRun& outcome, const WorkerContext& context,
                     const std::stop_token& stop) {
  Status status = store_once(claim, outcome, context);
  if (status.code() == StatusCode::unavailable) {
    log_trouble(context.log, claim, status);
  }
  while (status.code() == StatusCode::unavailable && !stop.stop_requested()) {
    context.health.writable = false;
    pause(stop, kRetryPause);
    status = store_once(claim, outcome, context);
  }
  return status;
}

void give_back(const Claim& claim, const WorkerContext& context) {
  WaitingCount::Change change(context.waiting);
  if (const Status status = context.store.requeue(claim); !status.ok()) {
    return log_trouble(context.log, claim, status);
  }
  change.add(1);
  log_job(context.log, claim, JobState::accepted);
}

/// Handles the outcome of a stopped analysis; returns whether the outcome must be stored.
bool settle_stop(const Claim& claim, StopReason reason, JobRun& outcome, const WorkerContext& context) {
  const bool cancelled = outcome.failure && outcome.failure->code == kCancelled;
  if (!cancelled) {
    return true;  // the analysis ended before it noticed the stop request
  }
  switch (reason) {
    case StopReason::shutdown:
      give_back(claim, context);
      return false;
    case StopReason::dismissed:
    case StopReason::lease_lost:
      return false;
    case StopReason::time_limit:
      outcome.failure->code = "time_limit";
      outcome.failure->detail =
          "the analysis took longer than " + std::to_string(context.limits.longest_run.count()) + " s";
      return true;
    case StopReason::none:
      return true;
  }
  return true;
}

/// @param stored becomes ready when the store contains the job; null: the store contains the job
void run_job(const Claim& claim, const std::shared_future<bool>* stored, const WorkerContext& context,
             Runners& runners, const std::stop_token& stop) {
  log_job(context.log, claim, JobState::running);
  if (claim.attempt == 1) {
    // the wall clock may have been set back since
    const duration<double> waited = context.environment.now() - claim.created;
    context.metrics.waiting.observe(std::max(0.0, waited.count()));
  }
  const double begun = context.environment.monotonic_seconds();
  ActiveJobs::Entry entry(context.active, claim, steady_time(context.environment), stored);
  const std::stop_callback on_shutdown(stop, [&] { entry.stop(StopReason::shutdown); });
  JobRun outcome =
      runners.of(claim.owner).run_job(claim.document, told_hooks(claim, context.progress, entry.token()));
  runners.note(claim.owner, outcome.usage, context.environment.monotonic_seconds() - begun);
  context.progress.erase(claim.id);
  if (stored != nullptr && !stored->get()) {
    return;
  }
  if (!settle_stop(claim, entry.reason(), outcome, context)) {
    return;
  }
  if (const Status status = store_outcome(claim, outcome, context, stop); !status.ok()) {
    if (status.code() != StatusCode::conflict) {  // a conflict: dismissed or deleted meanwhile
      log_trouble(context.log, claim, status);
    }
    return;
  }
  context.metrics.running.observe(context.environment.monotonic_seconds() - begun);
  context.metrics.job_ended(outcome.failure ? std::string_view(outcome.failure->code)
                                            : to_string(JobState::successful));
  context.completions.announce(claim.id);
  log_job_end(context.log, claim, outcome);
}

/// Claims the next accepted job; nothing when there is none or the store fails.
std::optional<Claim> claim_one(const WorkerContext& context, const OwnersInTurn& owners) {
  WaitingCount::Change change(context.waiting);
  StatusOr<std::optional<Claim>> claim =
      context.store.claim(context.new_lease(), context.environment.now(), owners);
  if (!claim.ok()) {
    log_store_trouble(context.log, claim.status());
    return std::nullopt;
  }
  if (claim->has_value()) {
    change.add(-1);
  }
  return *std::move(claim);
}

}  // namespace

void work_on(const Claim& claim, const WorkerContext& context, Runners& runners,
             const std::stop_token& stop) {
  run_job(claim, nullptr, context, runners, stop);
}

void work_on(const Handoff& handoff, const WorkerContext& context, Runners& runners,
             const std::stop_token& stop) {
  run_job(handoff.claim, &handoff.stored, context, runners, stop);
}

WorkerPool::WorkerPool(int threads, const WorkerContext& context, RunnerFactory make)
    : context_(context),
      make_(std::move(make)),
      busy_since_(static_cast<std::size_t>(threads)),
      spare_began_(static_cast<std::size_t>(threads > 0 ? context.limits.spare_workers : 0)) {
  std::fill(busy_since_.begin(), busy_since_.end(), kWaits);
  std::fill(spare_began_.begin(), spare_began_.end(), kWaits);
  threads_.reserve(busy_since_.size() + spare_began_.size());
  try {
    for (std::size_t i = 0; i < busy_since_.size(); ++i) {
      threads_.emplace_back([this, i] { run(i, stop_.get_token()); });
    }
    for (std::size_t i = 0; i < spare_began_.size(); ++i) {
      threads_.emplace_back([this, i] { run_spare(i, stop_.get_token()); });
    }
  } catch (...) {
    stop();  // the system has no thread left
    throw;
  }
}

WorkerPool::~WorkerPool() { stop(); }

void WorkerPool::stop() {
  stopping_ = true;
  {
    const std::unique_lock claims(claims_);
    stop_.request_stop();
  }
  for (std::jthread& thread : threads_) {
    if (thread.joinable()) {
      thread.join();
    }
  }
}

bool WorkerPool::claim_and_work(Runners& runners, const std::stop_token& stop, const OwnersInTurn& owners) {
  std::optional<Claim> claim;
  {
    const std::shared_lock claims(claims_);
    if (!stopping_) {
      claim = claim_one(context_, owners);
    }
  }
  if (claim) {
    work_on(*claim, context_, runners, stop);
  }
  return claim.has_value();
}

/// Whether all workers have been busy for JobLimits::spare_after.
bool WorkerPool::are_busy() const {
  const double before = now() - duration<double>(context_.limits.spare_after).count();
  return std::all_of(busy_since_.begin(), busy_since_.end(),
                     [&](const auto& since) { return since < before; });
}

bool WorkerPool::is_left() const { return context_.waiting.value() > 0 || context_.sweeps.is_left(); }

/// Waits until there is work, and until workers have had the time that short work takes.
void WorkerPool::wait_as_spare(std::uint64_t& seen, const std::stop_token& stop) {
  const std::lock_guard duty(on_duty_);
  if (!is_left()) {
    context_.handoffs.wait_as_spare(seen, stop, kLongestNap);
  }
  pause(stop, context_.limits.spare_after);
}

/// Whether fewer than half of the spare workers are at work that has taken longer than kShort. Otherwise no
/// spare worker begins the work of an owner who uses much processor time.
bool WorkerPool::are_few_spares_at_long_work() const {
  const double before = now() - duration<double>(kShort).count();
  const auto at_long_work = std::count_if(spare_began_.begin(), spare_began_.end(),
                                          [&](const auto& began) { return began < before; });
  return 2 * at_long_work < std::ssize(spare_began_);
}

void WorkerPool::run_spare(std::size_t number, const std::stop_token& stop) {
  std::atomic<double>& began = spare_began_[number];
  Runners runners(make_, use_);
  std::uint64_t seen = 0;
  while (!stop.stop_requested()) {
    wait_as_spare(seen, stop);
    bool worked = true;
    while (worked && are_busy() && !stop.stop_requested()) {
      const OwnersInTurn owners{1,
                                are_few_spares_at_long_work() ? std::vector<std::string>() : use_.of_much()};
      began = now();
      worked = context_.waiting.value() > 0 && claim_and_work(runners, stop, owners);
      worked = context_.sweeps.do_next(runners, stop, owners) || worked;
    }
    began = kWaits;
  }
}

void WorkerPool::run(std::size_t number, const std::stop_token& stop) {
  std::atomic<double>& busy_since = busy_since_[number];
  Runners runners(make_, use_);
  runners.prepare();
  std::uint64_t seen = 0;
  const auto nap = context_.store.neighbours() == nullptr ? kLongestNap : kLongestSharedNap;
  while (!stop.stop_requested()) {
    // Jobs and sweeps alternate, so that neither waits for the end of the other. While sweeps run, the store
    // is not queried for jobs unless some are known to wait.
    if (busy_since == kWaits) {
      busy_since = now();
    }
    const bool waited = context_.waiting.value() > 0;
    const bool worked = waited && claim_and_work(runners, stop);
    if ((!stop.stop_requested() && context_.sweeps.do_next(runners, stop)) || worked ||
        (!waited && claim_and_work(runners, stop))) {
      continue;
    }
    // Jobs handed over directly have priority over stored ones, so that no worker idles while jobs wait.
    busy_since = kWaits;
    std::optional<Handoff> handoff;
    while ((handoff = context_.handoffs.wait(seen, stop, nap))) {
      busy_since = now();
      work_on(*handoff, context_, runners, stop);
      busy_since = kWaits;
      if (context_.waiting.value() > 0 || context_.sweeps.is_left() || stop.stop_requested()) {
        break;
      }
    }
  }
}

}  // namespace snapthrough::server
