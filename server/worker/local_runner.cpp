#include "server/worker/local_runner.h"

#include <chrono>
#include <nlohmann/json.hpp>
#include <utility>

#include "api/api.h"

namespace snapthrough::server {
namespace {

JobRun outcome_of(const api::Request& request, Result result, double seconds) {
  std::string document = api::write_result(request, result, seconds).dump();
  JobRun run;
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

JobRun solve_job(std::string_view text, const SolveFunction& solve, const Hooks& hooks) {
  try {
    const api::ReadOutcome read = api::read_request(text);
    if (!read.request) {
      return {std::nullopt,
              JobFailure{"invalid_request",
                         "this version of the service does not accept the stored request any more", ""}};
    }
    const api::Request& request = *read.request;
    const auto start = std::chrono::steady_clock::now();
    Result result = solve(request.model, request.analysis, hooks);
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
    return outcome_of(request, std::move(result), elapsed.count());
  } catch (...) {
    return {std::nullopt, mishap_now()};
  }
}

JobRun LocalRunner::run_job(std::string_view request, const Hooks& hooks) {
  return solve_job(request, solve_, hooks);
}

void LocalRunner::run_points(const PointTask& task) {
  for (std::size_t i = 0; i < task.points.size(); ++i) {
    if (task.stop.stop_requested() || (i > 0 && task.enough && task.enough())) {
      return;
    }
    api::PointOutcome outcome =
        solve_point(task.sweep, task.sweep.document_at(task.points[i]), solve_, {task.stop});
    const bool cancelled = outcome.code == "cancelled";
    task.tell(std::move(outcome));
    if (cancelled) {
      return;
    }
  }
}

std::vector<api::PointOutcome> LocalRunner::run_curve(const PointTask& task) {
  return solve_curve(task.sweep, task.points.front(), task.stop);
}

RunnerFactory local_runners(SolveFunction solve) {
  return [solve = std::move(solve)] { return std::make_unique<LocalRunner>(solve); };
}

}  // namespace snapthrough::server
