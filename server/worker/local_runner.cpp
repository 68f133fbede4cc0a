#include "server/worker/local_runner.h"

#include <nlohmann/json.hpp>
#include <utility>

#include "server/sweeps/point.h"

namespace snapthrough::server {

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
