#include "server/worker/pool.h"

#include <chrono>
#include <exception>
#include <nlohmann/json.hpp>
#include <utility>

#include "api/api.h"

namespace snapthrough::server {
namespace {

using std::chrono::duration;

/// How long a worker without work waits at most before it looks at the queue again.
constexpr duration<double> kLongestNap{5.0};

/// What an attempt came to: exactly one of the two is set unless it was interrupted.
struct Outcome {
  std::optional<JobResult> result;
  std::optional<JobFailure> failure;
  StoredPath reached;  ///< with a failure
};

Outcome failed(std::string code, std::string detail) {
  return {std::nullopt, JobFailure{std::move(code), std::move(detail), ""}, {}};
}

Outcome to_outcome(const api::Request& request, Result result, double seconds) {
  std::string document = api::write_result(request, result, seconds).dump();
  if (result.failure) {
    return {
        std::nullopt,
        JobFailure{std::move(result.failure->code), std::move(result.failure->detail), std::move(document)},
        {std::move(result.branches), std::move(result.critical_points)}};
  }
  return {JobResult{std::move(document), seconds, std::move(result.summary), std::move(result.branches),
                    std::move(result.critical_points)},
          std::nullopt,
          {}};
}

Outcome attempt(const Claim& claim, JobDesk& desk, const SolveFunction& solve, const std::stop_token& stop) {
  const api::ReadOutcome read = api::read_request(claim.document);
  if (!read.request) {
    return failed("invalid_request",
                  "this version of the service does not accept the stored request any more");
  }
  const Hooks hooks{stop, [&](const Progress& progress) { desk.progress_board().set(claim.id, progress); }};
  const double start = desk.environment().monotonic_seconds();
  Result result = solve(read.request->model, read.request->analysis, hooks);
  return to_outcome(*read.request, std::move(result), desk.environment().monotonic_seconds() - start);
}

Outcome guarded_attempt(const Claim& claim, JobDesk& desk, const SolveFunction& solve,
                        const std::stop_token& stop) {
  try {
    return attempt(claim, desk, solve, stop);
  } catch (const std::bad_alloc&) {
    return failed("out_of_memory", "the analysis needs more memory than the service has");
  } catch (const std::exception& error) {
    return failed("internal_error", error.what());
  } catch (...) {
    return failed("internal_error", "unknown exception");
  }
}

/// A job begins or goes back to the queue.
void log_job(Log& log, const Claim& claim, JobState state) {
  log.write(LogLevel::info, "job",
            {{"job", std::string_view(claim.id)},
             {"status", to_string(state)},
             {"attempt", static_cast<std::int64_t>(claim.attempt)}});
}

/// A job ended: with a termination or failure code, and a sentence.
void log_job_end(Log& log, const Claim& claim, JobState state, std::string_view code,
                 std::string_view detail) {
  log.write(state == JobState::failed ? LogLevel::warning : LogLevel::info, "job",
            {{"job", std::string_view(claim.id)},
             {"status", to_string(state)},
             {"attempt", static_cast<std::int64_t>(claim.attempt)},
             {"code", code},
             {"detail", detail}});
}

void log_trouble(Log& log, const Claim& claim, const Status& status) {
  log.write(LogLevel::error, "store",
            {{"job", std::string_view(claim.id)},
             {"attempt", static_cast<std::int64_t>(claim.attempt)},
             {"detail", std::string_view(status.message())}});
}

Status store_outcome(const Claim& claim, Outcome& outcome, Store& store, Time now) {
  if (!outcome.result) {
    return store.fail(claim, *outcome.failure, outcome.reached, now);
  }
  Status status = store.finish(claim, *outcome.result, now);
  if (status.ok() || status.code() == StatusCode::conflict) {
    return status;
  }
  // The result can't be stored (a number that is none, a full disk): say so rather than leave the job
  // running.
  outcome.result.reset();
  outcome.failure = JobFailure{"not_stored", "the result could not be stored: " + status.message(), ""};
  return store.fail(claim, *outcome.failure, {}, now);
}

}  // namespace

void work_on(const Claim& claim, JobDesk& desk, const SolveFunction& solve, Log& log,
             const std::stop_token& stop) {
  log_job(log, claim, JobState::running);
  Outcome outcome = guarded_attempt(claim, desk, solve, stop);
  desk.progress_board().erase(claim.id);
  if (stop.stop_requested() && outcome.failure && outcome.failure->code == "cancelled") {
    if (const Status status = desk.store().requeue(claim); !status.ok()) {
      return log_trouble(log, claim, status);
    }
    return log_job(log, claim, JobState::accepted);
  }
  if (const Status status = store_outcome(claim, outcome, desk.store(), desk.environment().now());
      !status.ok()) {
    return log_trouble(log, claim, status);
  }
  desk.ends().announce(claim.id);
  if (outcome.failure) {
    return log_job_end(log, claim, JobState::failed, outcome.failure->code, outcome.failure->detail);
  }
  log_job_end(log, claim, JobState::successful, outcome.result->summary.termination,
              outcome.result->summary.message);
}

WorkerPool::WorkerPool(int threads, JobDesk& desk, SolveFunction solve, Log& log)
    : desk_(desk), solve_(std::move(solve)), log_(log) {
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

void WorkerPool::run(const std::stop_token& stop) {
  std::uint64_t seen = 0;
  while (!stop.stop_requested()) {
    const StatusOr<std::optional<Claim>> claim = desk_.store().claim(desk_.environment().now());
    if (!claim.ok()) {
      log_.write(LogLevel::error, "store", {{"detail", std::string_view(claim.status().message())}});
    }
    if (claim.ok() && claim->has_value()) {
      work_on(**claim, desk_, solve_, log_, stop);
    } else {
      desk_.bell().wait(seen, stop, kLongestNap);
    }
  }
}

}  // namespace snapthrough::server
