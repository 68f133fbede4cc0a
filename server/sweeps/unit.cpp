#include "server/sweeps/unit.h"

#include <algorithm>
#include <chrono>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <utility>

#include "api/api.h"
#include "api/names.h"
#include "server/jobs/content_key.h"
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
               {"critical_type", api::name_of(api::kCriticalTypes, point.type)}};
  }
  return {{"summary", std::move(summary)}};
}

std::vector<api::PointOutcome> followed(const api::Sweep& sweep, std::uint64_t first,
                                        const std::stop_token& stop) {
  std::vector<api::PointOutcome> outcomes(sweep.unit_size());
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

/// A point that is computed alone.
class PointUnit final : public SweepUnit {
 public:
  PointUnit(const api::Sweep& sweep, std::uint64_t number) : SweepUnit(sweep, number) {}

  [[nodiscard]] std::string too_long(std::chrono::seconds longest) const override {
    return "the analysis took longer than " + std::to_string(longest.count()) + " s";
  }

 private:
  [[nodiscard]] std::vector<api::PointOutcome> outcomes(
      const SolveFunction& solve, const Hooks& hooks,
      std::shared_ptr<nlohmann::json>& document) const override {
    sweep().write_document(first(), document);
    std::vector<api::PointOutcome> all;
    all.push_back(solved(sweep(), document, solve, hooks));
    return all;
  }
  [[nodiscard]] std::string surroundings() const override { return ""; }
};

/// The points along which a critical point is followed (solver/sweep/critical_curve.h).
class CurveUnit final : public SweepUnit {
 public:
  CurveUnit(const api::Sweep& sweep, std::uint64_t number) : SweepUnit(sweep, number) {}

  [[nodiscard]] std::string too_long(std::chrono::seconds /*longest*/) const override {
    return "the curve took longer than one analysis may take";
  }

 private:
  [[nodiscard]] std::vector<api::PointOutcome> outcomes(
      const SolveFunction& /*solve*/, const Hooks& hooks,
      std::shared_ptr<nlohmann::json>& /*document*/) const override {
    return followed(sweep(), first(), hooks.stop);
  }
  [[nodiscard]] std::string surroundings() const override { return sweep().curve_text(first()); }
};

}  // namespace

std::unique_ptr<SweepUnit> make_unit(const api::Sweep& sweep, std::uint64_t number) {
  if (sweep.follows()) {
    return std::make_unique<CurveUnit>(sweep, number);
  }
  return std::make_unique<PointUnit>(sweep, number);
}

std::vector<std::string> SweepUnit::keys(const std::string& outputs, std::string_view owner,
                                         std::shared_ptr<nlohmann::json>& document) const {
  const std::string beside = outputs + surroundings();
  std::vector<std::string> all;
  for (std::uint64_t i = 0; i < count(); ++i) {
    sweep_.write_document(first_ + i, document);
    all.push_back(point_key(*document, beside, owner));
  }
  return all;
}

std::vector<api::PointOutcome> SweepUnit::compute(const SolveFunction& solve, const Hooks& hooks,
                                                  std::shared_ptr<nlohmann::json>& document) const {
  try {
    return outcomes(solve, hooks, document);
  } catch (...) {
    return std::vector<api::PointOutcome>(count(), failed(mishap_now()));
  }
}

bool is_cut_short(const std::vector<api::PointOutcome>& outcomes) {
  return std::any_of(outcomes.begin(), outcomes.end(),
                     [](const api::PointOutcome& outcome) { return outcome.code == kCancelled; });
}

void compute_units(const UnitTask& task, const SolveFunction& solve) {
  std::shared_ptr<nlohmann::json> document;
  for (std::size_t i = 0; i < task.units.size(); ++i) {
    if (task.stop.stop_requested() || (i > 0 && task.enough && task.enough())) {
      return;
    }
    std::vector<api::PointOutcome> outcomes =
        make_unit(task.sweep, task.units[i])->compute(solve, {task.stop}, document);
    const bool stopped = is_cut_short(outcomes);
    task.tell(std::move(outcomes));
    if (stopped) {
      return;
    }
  }
}

}  // namespace snapthrough::server
