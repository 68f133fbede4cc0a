#include "server/worker/solve_job.h"

#include <algorithm>
#include <chrono>
#include <nlohmann/json.hpp>
#include <utility>

#include "api/api.h"
#include "api/point_outcome.h"
#include "api/sweep_item.h"
#include "server/worker/thread_time.h"

namespace snapthrough::server {
namespace {

JobRun outcome_of(const api::Request& request, Result result, double seconds) {
  std::string document = api::write_result(request, result, seconds).dump();
  JobRun run;
  run.usage.factorizations = std::max(0, result.diagnostics.factorizations);
  if (result.failure) {
    run.failure =
        JobFailure{std::move(result.failure->code), std::move(result.failure->detail), std::move(document)};
    run.reached = {std::move(result.branches), std::move(result.critical_points)};
  } else {
    run.result = JobResult{std::move(document), seconds, std::move(result.summary),
                           std::move(result.branches), std::move(result.critical_points)};
  }
  return run;
}

}  // namespace

JobFailure mishap_now() {
  api::PointOutcome mishap = api::mishap_now();
  return {std::move(mishap.code), std::move(mishap.detail), ""};
}

JobRun solve_job(std::string_view request, const SolveFunction& solve, const Hooks& hooks) {
  const ThreadTime time;
  try {
    const api::ReadOutcome read = api::read_request(request);
    if (!read.request) {
      return {std::nullopt,
              JobFailure{"invalid_request",
                         "this version of the service does not accept the stored request any more", ""}};
    }
    const auto start = std::chrono::steady_clock::now();
    Result result = solve(read.request->model, read.request->analysis, hooks);
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
    JobRun run = outcome_of(*read.request, std::move(result), elapsed.count());
    run.usage.cpu_us = time.microseconds();
    return run;
  } catch (...) {
    return {std::nullopt, mishap_now()};
  }
}

}  // namespace snapthrough::server
