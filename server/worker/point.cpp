#include "server/worker/point.h"

#include <chrono>
#include <exception>
#include <new>
#include <nlohmann/json.hpp>

namespace snapthrough::server {
namespace {

/// All that is wrong with a request in one text.
std::string sentence_of(const std::vector<Finding>& findings) {
  std::string detail;
  for (const Finding& finding : findings) {
    detail += (detail.empty() ? "" : "; ") + finding.pointer + ": " + finding.detail;
  }
  return detail;
}

api::PointOutcome solved(const api::Sweep& sweep, const std::shared_ptr<const nlohmann::json>& document,
                         const SolveFunction& solve, const Hooks& hooks) {
  const api::ReadOutcome read = api::read_request_document(document);
  if (!read.request) {
    return {"", "wrong_request", sentence_of(read.findings)};
  }
  const auto start = std::chrono::steady_clock::now();
  Result result = solve(read.request->model, read.request->analysis, hooks);
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
  if (result.failure) {
    return {"", result.failure->code, result.failure->detail};
  }
  sweep.drop_unused(result);
  return sweep.outcome(api::write_result(*read.request, result, elapsed.count()));
}

}  // namespace

api::PointOutcome solve_point(const api::Sweep& sweep, const std::shared_ptr<const nlohmann::json>& document,
                              const SolveFunction& solve, const Hooks& hooks) {
  try {
    return solved(sweep, document, solve, hooks);
  } catch (const std::bad_alloc&) {
    return {"", "out_of_memory", "the analysis needs more memory than there is"};
  } catch (const std::exception& error) {
    return {"", "internal_error", error.what()};
  } catch (...) {
    return {"", "internal_error", "unknown exception"};
  }
}

}  // namespace snapthrough::server
