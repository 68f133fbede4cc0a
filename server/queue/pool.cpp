#include "server/queue/pool.h"

#include <chrono>
#include <memory>
#include <nlohmann/json.hpp>
#include <utility>

#include "server/bell.h"
#include "server/jobs/path_batch.h"
#include "server/worker/solve_job.h"

namespace snapthrough::server {
namespace {

using std::chrono::duration;

/// Longest sleep, in seconds, of a worker without work before it looks at the store though no bell was rung.
/// In front of a shared store Neighbours looks for all workers of the process.
constexpr duration<double> kLongestNap{1.0};
constexpr duration<double> kLongestSharedNap{10.0};
/// Pause between two tries to store an outcome.
constexpr std::chrono::milliseconds kRetryPause{200};

/// Adds points of the path; drops the oldest beyond kTracedBytes.
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

/// Hooks that tell the followers of a job what its analysis does.
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

/// Logs that a job begins or goes back to the queue.
void log_job(Log& log, const Claim& claim, JobState state) {
  log.write(LogLevel::info, "job",
            {{"job", std::string_view(claim.id)},
             {"status", to_string(state)},
             {"attempt", static_cast<std::int64_t>(claim.attempt)}});
}

/// Logs the end of a job, with its termination or failure code and a sentence.
void log_job_end(Log& log, const Claim& claim, const JobRun& outcome) {
  const bool failed = outcome.failure.has_value();
  log.write(
      failed ? LogLevel::warning : LogLevel::info, "job",
      {{"job", std::string_view(claim.id)},
       {"status", to_string(failed ? JobState::failed : JobState::successful)},
       {"attempt", static_cast<std::int64_t>(claim.attempt)},
       {"peak_bytes", outcome.peak_bytes},
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
    return context.store.fail(claim, *outcome.failure, outcome.reached, now);
  }
  Status status = context.store.finish(claim, *outcome.result, now);
  if (status.code() != StatusCode::io_error) {
    return status;
  }
  // The store refuses the result itself (e.g. a number that is NaN): the job fails, so that it does not stay
  // running.
  outcome.result.reset();
  outcome.failure = JobFailure{"not_stored", "the result could not be stored: " + status.message(), ""};
  return context.store.fail(claim, *outcome.failure, {}, now);
}

/// Stores the outcome. While the store can't be written, tries until the claim is lost or the service stops;
/// then the next start finds the job running.
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
  if (const Status status = context.store.requeue(claim); !status.ok()) {
    return log_trouble(context.log, claim, status);
  }
  context.waiting += 1;
  log_job(context.log, claim, JobState::accepted);
}

/// Changes the outcome of an analysis by the reason for which it was stopped; false when nothing is to be
/// stored.
bool settle_stop(const Claim& claim, StopReason reason, JobRun& outcome, const WorkerContext& context) {
  const bool cancelled = outcome.failure && outcome.failure->code == kCancelled;
  if (!cancelled) {
    return true;  // the analysis ended before it saw the request to stop
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

/// @param stored set when the store has queued the job; null: the store has the job
void run_job(const Claim& claim, const std::shared_future<bool>* stored, const WorkerContext& context,
             Runner& runner, const std::stop_token& stop) {
  log_job(context.log, claim, JobState::running);
  if (claim.attempt == 1) {
    context.metrics.waiting.observe(duration<double>(context.environment.now() - claim.created).count());
  }
  const double begun = context.environment.monotonic_seconds();
  ActiveJobs::Entry entry(context.active, claim, context.environment.now());
  const std::stop_callback on_shutdown(stop, [&] { entry.stop(StopReason::shutdown); });
  JobRun outcome = runner.run_job(claim.document, told_hooks(claim, context.progress, entry.token()));
  context.progress.erase(claim.id);
  if (stored != nullptr && !stored->get()) {
    return;
  }
  if (!settle_stop(claim, entry.reason(), outcome, context)) {
    return;
  }
  if (const Status status = store_outcome(claim, outcome, context, stop); !status.ok()) {
    if (status.code() != StatusCode::conflict) {  // a conflict: the job was dismissed or removed meanwhile
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

}  // namespace

void work_on(const Claim& claim, const WorkerContext& context, Runner& runner, const std::stop_token& stop) {
  run_job(claim, nullptr, context, runner, stop);
}

void work_on(const Handoff& handoff, const WorkerContext& context, Runner& runner,
             const std::stop_token& stop) {
  run_job(handoff.claim, &handoff.stored, context, runner, stop);
}

WorkerPool::WorkerPool(int threads, const WorkerContext& context, RunnerFactory make)
    : context_(context), make_(std::move(make)) {
  threads_.reserve(static_cast<std::size_t>(threads));
  for (int i = 0; i < threads; ++i) {
    threads_.emplace_back([this](const std::stop_token& stop) { run(stop); });
  }
}

WorkerPool::~WorkerPool() { stop(); }

void WorkerPool::stop() {
  for (std::jthread& thread : threads_) {
    thread.request_stop();
  }
  for (std::jthread& thread : threads_) {
    if (thread.joinable()) {
      thread.join();
    }
  }
}

bool WorkerPool::claim_and_work(Runner& runner, const std::stop_token& stop) {
  const StatusOr<std::optional<Claim>> claim =
      context_.store.claim(context_.new_lease(), context_.environment.now());
  if (!claim.ok()) {
    context_.log.write(LogLevel::error, "store", {{"detail", std::string_view(claim.status().message())}});
    return false;
  }
  if (!claim->has_value()) {
    return false;
  }
  context_.waiting -= 1;
  work_on(**claim, context_, runner, stop);
  return true;
}

void WorkerPool::run(const std::stop_token& stop) {
  const std::unique_ptr<Runner> own = make_();
  Runner& runner = *own;
  std::uint64_t seen = 0;
  const auto nap = context_.store.neighbours() == nullptr ? kLongestNap : kLongestSharedNap;
  while (!stop.stop_requested()) {
    // Jobs and sweeps in turn, so that neither waits for the end of the other. While sweeps go on, the store
    // is asked for jobs only when some wait.
    const bool waited = context_.waiting > 0;
    const bool worked = waited && claim_and_work(runner, stop);
    if ((!stop.stop_requested() && context_.sweeps.do_next(runner, stop)) || worked ||
        (!waited && claim_and_work(runner, stop))) {
      continue;
    }
    // A job from offer() comes at once: no worker is idle while jobs wait in the store.
    std::optional<Handoff> handoff;
    while ((handoff = context_.handoffs.wait(seen, stop, nap))) {
      work_on(*handoff, context_, runner, stop);
      if (context_.waiting > 0 || context_.sweeps.is_left() || stop.stop_requested()) {
        break;
      }
    }
  }
}

}  // namespace snapthrough::server
