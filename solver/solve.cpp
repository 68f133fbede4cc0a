#include "solver/solve.h"

#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "solver/analysis/analyses.h"
#include "solver/analysis/capacity_rule.h"
#include "solver/analysis/held_loads.h"
#include "solver/analysis/worst_offset.h"
#include "solver/discrete/build_structure.h"
#include "solver/discrete/free_motions.h"
#include "solver/discrete/mechanism.h"
#include "solver/numeric/cancelled.h"
#include "solver/numeric/number_text.h"
#include "solver/report/apparent_joints.h"
#include "solver/report/result_parts.h"
#include "solver/report/skipped.h"
#include "solver/resolve/resolved_model.h"
#include "solver/support/law.h"

namespace snapthrough {
namespace {

/// Reports the mesh if the analysis has not done so.
void report_unchecked_mesh(const Analysis& analysis, const Structure& structure, Result& result) {
  const bool chosen = !analysis.discretization.fixed_mesh;
  if (chosen) result.discretization.requested_accuracy = analysis.discretization.accuracy;
  if (result.discretization.refinements >= 0) return;
  report_mesh(structure, 0, result);
  if (chosen) result.summary.message += "; the mesh was chosen by rule, its error was not estimated";
}

/// Reports a stop request that interrupted the check of loads on finer meshes.
void report_stop(const Hooks& hooks, Result& result) {
  const bool unchecked = !result.failure || result.failure->code == "not_confirmed";
  if (hooks.stop.stop_requested() && unchecked)
    result.failure = Failure{"cancelled", "cancelled before the critical loads were checked on finer meshes"};
}

/// Load factors with requested states or rows.
std::vector<double> asked_load_factors(const Analysis& analysis) {
  if (analysis.traits().has_rows) return analysis.load_factors;
  if (analysis.traits().linearised) return {};
  return analysis.output.at_load_factors;
}

/// Reports static load factors that the supports do not hold, in addition to computed ones.
void report_refused(const HeldLoads& held, Result& result) {
  if (!held.refusal) return;
  if (!result.failure) return fail(result, held.code, *held.refusal);
  result.failure->detail += "; " + *held.refusal;
  result.summary.message += "; " + *held.refusal;
}

/// Sets the failure of an analysis that computes nothing.
void give_up(const Analysis& analysis, const char* code, const std::string& detail, Result& result) {
  fail(result, code, detail);
  result.not_reached = asked_load_factors(analysis);
}

/// @throws Cancelled when no result was reached
void analyse(const ResolvedModel& model, const Analysis& analysis, const Hooks& hooks,
             const CriticalVisitor& visit, Result& result) {
  // only one-sided supports need the equilibrium test of their loads
  std::optional<FreeMotions> motions;
  std::optional<UnilateralBalance> balance;
  HeldLoads held{{}, true, std::vector<char>(analysis.load_factors.size(), 1)};
  // what holds a loose structure when it is tight is not known in advance
  const bool loose = analysis.geometry == Geometry::nonlinear && is_loose(model);
  if (has_one_sided_supports(model) && !loose) {
    balance.emplace(motions.emplace(model));
    held = held_loads(model, analysis, *balance);
  }
  // linearised buckling takes the tangent of its reference load, which it finds itself
  const auto capacity = analysis.traits().linearised ? nullptr : capacity_ends(model);
  if (capacity) refuse_beyond_capacity(model, analysis, *capacity, held, result);
  if (!held.any) return give_up(analysis, held.code, *held.refusal, result);
  ModeOffsets modes;
  try {
    modes = mode_offsets(model, analysis, hooks.stop);
  } catch (const std::runtime_error& error) {
    return give_up(analysis, "no_buckling_mode", error.what(), result);
  }
  if (analysis.traits().linearised && run_exact_column(model, analysis, hooks, result)) {
    const std::vector<std::string> absent = without_stiffness(model);
    result.diagnostics.skipped.insert(result.diagnostics.skipped.begin(), absent.begin(), absent.end());
    return;
  }
  // derivatives with respect to a stiffness need the stiffness as given
  const Discretization& asked = analysis.discretization;
  Structure structure =
      make_structure(model, analysis.sensitivities.empty() ? asked : as_stiff_as_given(asked),
                     analysis.geometry, modes, mesh_use(analysis));
  if (!loose) structure.free_motions = motions ? motions->of_nodes() : free_motions(model);
  structure.stop = hooks.stop;
  result.diagnostics.skipped = structure.skipped;
  switch (analysis.type) {
    case AnalysisType::critical:
    case AnalysisType::path:
      run_path(analysis, structure, capacity.get(), hooks, result, visit);
      report_stop(hooks, result);
      break;
    case AnalysisType::static_:
      run_static(analysis, structure, {held.factors, capacity.get()}, hooks, result);
      report_refused(held, result);
      break;
    case AnalysisType::vibration:
      run_vibration(analysis, structure, {held.factors, capacity.get()}, hooks, result);
      report_refused(held, result);
      break;
    case AnalysisType::buckling:
      run_buckling(analysis, structure, result);
      if (balance) withdraw_load_not_held(model, *balance, result);
      break;
  }
  for (std::string& what : skipped_work(model, analysis))
    result.diagnostics.skipped.push_back(std::move(what));
  report_unchecked_mesh(analysis, structure, result);
}

/// @param visit may be empty
Result run(const ResolvedModel& model, const Analysis& analysis, const Hooks& hooks,
           const CriticalVisitor& visit) {
  Result result;
  result.diagnostics = {0, 0, 0, 0, 0.0, {}, {}};
  if (!unless_cancelled([&] { analyse(model, analysis, hooks, visit, result); })) {
    fail(result, "cancelled",
         result.branches.empty() ? "cancelled before anything was found"
                                 : "cancelled before the critical loads were checked on finer meshes");
    result.not_reached = asked_load_factors(analysis);
  }
  for (Warning& warning : apparent_joints(model)) result.warnings.push_back(std::move(warning));
  return result;
}

/// Sensitivities of the structure with the offsets that were found. Their shape is held, and their size
/// follows the amplitude of the worst imperfection.
std::vector<Variation> with_shape_held(std::vector<Variation> variations, const WorstOffset& found,
                                       double amplitude) {
  for (Variation& variation : variations) {
    variation.model_at = [inner = std::move(variation.model_at), offsets = found.imperfections,
                          amplitude](double value) -> std::optional<Model> {
      const std::optional<Model> changed = inner(value);
      if (!changed) return std::nullopt;
      return with_offsets(*changed, offsets, worst_imperfection(*changed)->amplitude / amplitude);
    };
  }
  return variations;
}

/// Warns of a worst imperfection that does not lower the critical load.
void warn_of_no_fall(const WorstOffset& found, Result& result) {
  if (found.load_factor && *found.load_factor < found.perfect_load_factor) return;
  result.warnings.push_back(
      {"worst_imperfection",
       "no offset that was tried lowers the critical load factor " + number(found.perfect_load_factor) +
           ": states beyond it are stable, as those of a column after Euler's load, and the imperfect path " +
           (found.load_factor ? "loses stability at load factor " + number(*found.load_factor)
                              : std::string("loses no stability"))});
}

/// Warns of paths of the search that failed.
void warn_of_failed_paths(const WorstSearch& search, Result& result) {
  if (search.failed_paths == 0) return;
  result.warnings.push_back(
      {"worst_imperfection", std::to_string(search.failed_paths) + " of " +
                                 std::to_string(search.found->paths) +
                                 " paths of the search failed; their offsets were passed over, and one of "
                                 "them may lower the load more"});
}

/// Finds the worst imperfection and runs the analysis on the structure with it.
Result run_with_worst(const Model& model, const WorstImperfection& worst, const Analysis& analysis,
                      const Hooks& hooks) {
  const Hooks quiet{hooks.stop};
  const auto run_critical = [&](const ResolvedModel& with, const CriticalVisitor& visit) {
    return run(with, search_analysis(analysis), quiet, visit);
  };
  WorstSearch search = find_worst_offset(model, analysis, run_critical, hooks.stop);
  if (!search.found) {
    search.failed.not_reached = asked_load_factors(analysis);
    return std::move(search.failed);
  }
  Analysis final = analysis;
  final.sensitivities = with_shape_held(analysis.sensitivities, *search.found, worst.amplitude);
  Result result = run(resolve(with_offsets(model, search.found->imperfections)), final, hooks, {});
  warn_of_no_fall(*search.found, result);
  warn_of_failed_paths(search, result);
  result.worst_imperfection = std::move(search.found);
  return result;
}

}  // namespace

Result solve(const Model& model, const Analysis& analysis, const Hooks& hooks) {
  if (const auto findings = check(model, analysis); !findings.empty())
    throw std::invalid_argument(findings.front().pointer + ": " + findings.front().detail);
  return solve_checked(model, analysis, hooks);
}

Result solve_checked(const Model& model, const Analysis& analysis, const Hooks& hooks) {
  const WorstImperfection* worst = worst_imperfection(model);
  return worst != nullptr ? run_with_worst(model, *worst, analysis, hooks)
                          : run(resolve(model), analysis, hooks, {});
}

}  // namespace snapthrough
