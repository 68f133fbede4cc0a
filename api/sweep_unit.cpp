#include "api/sweep_unit.h"

#include <algorithm>
#include <exception>
#include <new>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <utility>

#include "api/names.h"
#include "solver/sweep/critical_curve.h"

namespace snapthrough::api {
namespace {

/// Returns all findings in one text.
std::string sentence_of(const std::vector<Finding>& findings) {
  std::string detail;
  for (const Finding& finding : findings) {
    detail += (detail.empty() ? "" : "; ") + finding.pointer + ": " + finding.detail;
  }
  return detail;
}

PointOutcome solved(const Sweep& sweep, const std::shared_ptr<const nlohmann::json>& document,
                    const SolvePoint& solve, const Hooks& hooks) {
  ReadOutcome read = read_request_document(document);
  if (!read.request) {
    return {"", "wrong_request", sentence_of(read.findings)};
  }
  sweep.spare_unused(read.request->analysis);
  auto [result, seconds] = solve(read.request->model, read.request->analysis, hooks);
  if (result.failure) {
    return {"", result.failure->code, result.failure->detail};
  }
  sweep.drop_unused(result);
  return sweep.outcome(write_result(*read.request, result, seconds, sweep.parts()));
}

/// Returns a model between points of a curve. @throws std::runtime_error when the request is invalid there
Model model_between(const Sweep& sweep, std::uint64_t first, double value) {
  ReadOutcome read = read_request_document(sweep.document_between(first, value));
  if (!read.request) {
    throw std::runtime_error("between two points: " + sentence_of(read.findings));
  }
  return std::move(read.request->model);
}

/// Returns the part of a result document that a curve gives.
nlohmann::json curve_document(const CriticalCurvePoint& point) {
  nlohmann::json summary{{"critical_load_factor", nullptr}, {"critical_type", nullptr}};
  if (point.load_factor) {
    summary = {{"critical_load_factor", *point.load_factor},
               {"critical_type", name_of(kCriticalTypes, point.type)}};
  }
  return {{"summary", std::move(summary)}};
}

std::vector<PointOutcome> followed(const Sweep& sweep, std::uint64_t first, const std::stop_token& stop) {
  std::vector<PointOutcome> outcomes(sweep.unit_size());
  CriticalCurveRequest request;
  std::vector<std::size_t> rows;  // index of each value in `outcomes`
  for (std::size_t i = 0; i < outcomes.size(); ++i) {
    const ReadOutcome read = read_request_document(sweep.document_at(first + i));
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
                            : PointOutcome{"", point.failure, "the path could not be traced"};
  }
  return outcomes;
}

/// Computes unit_outcomes(), but lets exceptions pass.
std::vector<PointOutcome> outcomes_of(const Sweep& sweep, std::uint64_t unit, const SolvePoint& solve,
                                      const Hooks& hooks, std::shared_ptr<nlohmann::json>& document) {
  const std::uint64_t first = unit * sweep.unit_size();
  if (sweep.follows()) {
    return followed(sweep, first, hooks.stop);
  }
  sweep.write_document(first, document);
  std::vector<PointOutcome> alone;
  alone.push_back(solved(sweep, document, solve, hooks));
  return alone;
}

}  // namespace

std::vector<PointOutcome> unit_outcomes(const Sweep& sweep, std::uint64_t unit, const SolvePoint& solve,
                                        const Hooks& hooks, std::shared_ptr<nlohmann::json>& document) {
  try {
    return outcomes_of(sweep, unit, solve, hooks, document);
  } catch (...) {
    return std::vector<PointOutcome>(sweep.unit_size(), mishap_now());
  }
}

bool is_cut_short(const std::vector<PointOutcome>& outcomes) {
  return std::any_of(outcomes.begin(), outcomes.end(),
                     [](const PointOutcome& outcome) { return outcome.code == "cancelled"; });
}

PointOutcome mishap_now() {
  try {
    throw;
  } catch (const std::bad_alloc&) {
    return {"", "out_of_memory", "the analysis needs more memory than there is"};
  } catch (const std::exception& error) {
    return {"", "internal_error", error.what()};
  } catch (...) {
    return {"", "internal_error", "unknown exception"};
  }
}

}  // namespace snapthrough::api
