#include "server/worker/sweep_item.h"

#include <algorithm>
#include <chrono>
#include <nlohmann/json.hpp>
#include <utility>

#include "api/solved_point.h"
#include "api/sweep_item.h"
#include "server/jobs/content_key.h"
#include "server/worker/thread_time.h"

namespace snapthrough::server {

std::vector<std::string> SweepItem::keys(const std::string& outputs, std::string_view owner,
                                         std::shared_ptr<nlohmann::json>& document) const {
  const std::string beside = sweep_.follows()   ? outputs + sweep_.curve_text(first())
                             : sweep_.refines() ? outputs + sweep_.refinement_text()
                                                : outputs;
  std::vector<std::string> all;
  for (std::uint64_t i = 0; i < count(); ++i) {
    sweep_.write_document(sweep_.first_place(first() + i), document);
    all.push_back(point_key(*document, beside, owner));
  }
  return all;
}

std::vector<api::PointOutcome> SweepItem::compute(const SolveFunction& solve, const Hooks& hooks,
                                                  std::shared_ptr<nlohmann::json>& document) const {
  const api::SolvePoint timed = [&solve](const Model& model, const Analysis& analysis, const Hooks& watched) {
    const auto start = std::chrono::steady_clock::now();
    Result result = solve(model, analysis, watched);
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
    return api::TimedResult{std::move(result), elapsed.count()};
  };
  return api::item_outcomes(sweep_, number_, timed, hooks, document);
}

std::string SweepItem::too_long(std::chrono::seconds longest) const {
  return sweep_.follows() || sweep_.refines()
             ? "the curve or surface took longer than one analysis may take"
             : "the analysis took longer than " + std::to_string(longest.count()) + " s";
}

WorkUsage compute_items(const ItemTask& task, const SolveFunction& solve) {
  const ThreadTime time;
  WorkUsage usage;
  const SolveFunction counted = [&](const Model& model, const Analysis& analysis, const Hooks& hooks) {
    Result result = solve(model, analysis, hooks);
    usage.factorizations += std::max(0, result.diagnostics.factorizations);
    return result;
  };
  std::shared_ptr<nlohmann::json> document;
  for (std::size_t i = 0; i < task.items.size(); ++i) {
    if (task.stop.stop_requested() || (i > 0 && task.enough && task.enough())) {
      break;
    }
    std::vector<api::PointOutcome> outcomes =
        SweepItem(task.sweep, task.items[i]).compute(counted, {task.stop}, document);
    const bool stopped = api::is_cut_short(outcomes);
    task.tell(std::move(outcomes));
    if (stopped) {
      break;
    }
  }
  usage.cpu_us = time.microseconds();
  return usage;
}

}  // namespace snapthrough::server
