#include "server/sweeps/point.h"

#include <chrono>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <utility>

#include "solver/sweep/critical_curve.h"

namespace snapthrough::server {
namespace {

api::PointOutcome failed(const JobFailure& failure) { return {"", failure.code, failure.detail}; }

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
  api::ReadOutcome read = api::read_request_document(document);
  if (!read.request) {
    return {"", "wrong_request", sentence_of(read.findings)};
  }
  sweep.spare_unused(read.request->analysis);
  const auto start = std::chrono::steady_clock::now();
  Result result = solve(read.request->model, read.request->analysis, hooks);
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
  if (result.failure) {
    return {"", result.failure->code, result.failure->detail};
  }
  sweep.drop_unused(result);
  return sweep.outcome(api::write_result(*read.request, result, elapsed.count(), sweep.parts()));
}

/// A model of the curve, which need not be a point's.
Model model_between(const api::Sweep& sweep, std::uint64_t first, double value) {
  api::ReadOutcome read = api::read_request_document(sweep.document_between(first, value));
  if (!read.request) {
    throw std::runtime_error("between two points: " + sentence_of(read.findings));
  }
  return std::move(read.request->model);
}

/// The result document as far as a curve has it.
nlohmann::json curve_document(const CriticalCurvePoint& point) {
  nlohmann::json summary{{"critical_load_factor", nullptr}, {"critical_type", nullptr}};
  if (point.load_factor) {
    summary = {{"critical_load_factor", *point.load_factor},
               {"critical_type", api::critical_type_name(point.type)}};
  }
  return {{"summary", std::move(summary)}};
}

std::vector<api::PointOutcome> followed(const api::Sweep& sweep, std::uint64_t first,
                                        const std::stop_token& stop) {
  std::vector<api::PointOutcome> outcomes(sweep.block());
  CriticalCurveRequest request;
  std::vector<std::size_t> rows;  // of the curve's values
  for (std::size_t i = 0; i < outcomes.size(); ++i) {
    const api::ReadOutcome read = api::read_request_document(sweep.document_at(first + i));
    if (!read.request) {
      outcomes[i] = {"", "wrong_request", sentence_of(read.findings)};
      continue;
    }
    request.analysis = read.request->analysis;
    request.values.push_back(sweep.values(first + i).back().get<double>());
    rows.push_back(i);
  }
  if (rows.empty()) {
    return outcomes;
  }
  request.logarithmic = sweep.follows_logarithm();
  request.stop = stop;
  request.model = [&](double value) { return model_between(sweep, first, value); };
  const CriticalCurve curve = follow_critical_point(request);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const CriticalCurvePoint& point = curve.points[i];
    outcomes[rows[i]] = point.failure.empty()
                            ? sweep.outcome(curve_document(point))
                            : api::PointOutcome{"", point.failure, "the path could not be traced"};
  }
  return outcomes;
}

}  // namespace

std::vector<api::PointOutcome> solve_curve(const api::Sweep& sweep, std::uint64_t first,
                                           const std::stop_token& stop) {
  try {
    return followed(sweep, first, stop);
  } catch (...) {
    return std::vector<api::PointOutcome>(sweep.block(), failed(mishap_now()));
  }
}

api::PointOutcome solve_point(const api::Sweep& sweep, const std::shared_ptr<const nlohmann::json>& document,
                              const SolveFunction& solve, const Hooks& hooks) {
  try {
    return solved(sweep, document, solve, hooks);
  } catch (...) {
    return failed(mishap_now());
  }
}

}  // namespace snapthrough::server
