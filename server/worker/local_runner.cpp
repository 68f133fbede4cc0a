#include "server/worker/local_runner.h"

#include <utility>

#include "server/worker/unit.h"

namespace snapthrough::server {

JobRun LocalRunner::run_job(std::string_view request, const Hooks& hooks) {
  return solve_job(request, solve_, hooks);
}

void LocalRunner::run_units(const UnitTask& task) { compute_units(task, solve_); }

RunnerFactory local_runners(SolveFunction solve) {
  return [solve = std::move(solve)] { return std::make_unique<LocalRunner>(solve); };
}

}  // namespace snapthrough::server
