#include "api/solved_point.h"

#include <nlohmann/json.hpp>

namespace snapthrough::api {

std::string sentence_of(const std::vector<Finding>& findings) {
  std::string detail;
  for (const Finding& finding : findings) {
    detail += (detail.empty() ? "" : "; ") + finding.pointer + ": " + finding.detail;
  }
  return detail;
}

PointOutcome solved_point(const Sweep& sweep, const std::shared_ptr<const nlohmann::json>& document,
                          const SolvePoint& solve, const Hooks& hooks,
                          const std::function<void(const Result&)>& seen) {
  ReadOutcome read = read_request_document(document);
  if (!read.request) {
    return {"", "wrong_request", sentence_of(read.findings)};
  }
  sweep.spare_unused(read.request->analysis);
  auto [result, seconds] = solve(read.request->model, read.request->analysis, hooks);
  if (result.failure) {
    return {"", result.failure->code, result.failure->detail};
  }
  if (seen) {
    seen(result);
  }
  sweep.drop_unused(result);
  return sweep.outcome(write_result(*read.request, result, seconds, sweep.parts()));
}

}  // namespace snapthrough::api
