#include "solver/analysis/held_loads.h"

#include <algorithm>
#include <cstddef>

#include "solver/analysis/capacity_rule.h"
#include "solver/numeric/number_text.h"
#include "solver/report/capacity.h"
#include "solver/report/escape_text.h"
#include "solver/report/result_parts.h"

namespace snapthrough {
namespace {

std::string sentence(const std::string& loads, const ResolvedModel& model, const UnilateralBalance& balance,
                     const Escape& escape) {
  return "one-sided supports can't hold " + loads + ": " + escape_text(model, balance.motions(), escape);
}

/// Description of the loads at the start of a path.
std::string first_loads(const Escape& escape) {
  return escape.actions.constant != 0.0
             ? "the constant actions and a little of the proportional ones, with which the path begins"
             : "these loads";
}

HeldLoads held_factors(const ResolvedModel& model, const Analysis& analysis,
                       const UnilateralBalance& balance) {
  HeldLoads out;
  out.any = false;
  std::size_t refused = 0;
  const bool path = analysis.geometry == Geometry::nonlinear;
  for (const double factor : analysis.load_factors) {
    std::optional<Escape> escape = balance.escape(factor);
    std::string loads = "the loads at load factor " + number(factor);
    if (!escape && path) {
      escape = balance.escape_at_start(factor < 0.0 ? -1.0 : 1.0);
      if (escape) loads = first_loads(*escape) + " (to load factor " + number(factor) + ")";
    }
    out.factors.push_back(escape ? 0 : 1);
    out.any = out.any || !escape;
    if (escape && refused++ == 0) out.refusal = sentence(loads, model, balance, *escape);
  }
  if (refused > 1) *out.refusal += " (" + std::to_string(refused) + " load factors are not held)";
  return out;
}

}  // namespace

HeldLoads held_loads(const ResolvedModel& model, const Analysis& analysis, const UnilateralBalance& balance) {
  HeldLoads out;
  if (balance.motions().empty() || analysis.start) {
    out.factors.assign(analysis.load_factors.size(), 1);
    return out;
  }
  if (analysis.traits().has_rows) return held_factors(model, analysis, balance);
  const bool buckling = analysis.traits().linearised;
  std::optional<Escape> escape = balance.escape_at_start(buckling ? 1.0 : analysis.step.direction);
  std::string loads = escape ? first_loads(*escape) : "";
  if (!escape && buckling && !balance.is_proportional()) {
    escape = balance.escape(1.0);
    loads = "the reference load (load factor 1), with whose contact buckling is linearised";
  }
  if (!escape) return out;
  return {sentence(loads, model, balance, *escape), false, {}};
}

namespace {

/// Refuses asked load factors beyond the limit load of supports with a capacity, if displacements are small;
/// if they are large, the path ends at the limit load. That is below the load at which one-sided supports
/// lose their hold, so it alone is reported.
void refuse_rows_beyond_capacity(const ResolvedModel& model, const Analysis& analysis,
                                 const CapacityEnds& ends, HeldLoads& held, Result& result) {
  const bool is_linear = analysis.geometry == Geometry::linear;
  std::vector<double> exceeding;
  bool others_refused = false;
  for (std::size_t i = 0; i < analysis.load_factors.size(); ++i) {
    const double factor = analysis.load_factors[i];
    const bool is_beyond =
        ends.is_beyond(factor) && (held.factors[i] != 0 || !ends.of(factor)->supports.empty());
    others_refused = others_refused || (held.factors[i] == 0 && !is_beyond);
    if (!is_beyond) continue;
    held.factors[i] = is_linear ? 0 : 1;
    exceeding.push_back(factor);
  }
  if (exceeding.empty()) return;
  if (!others_refused) held.refusal.reset();
  if (is_linear) {
    const std::string text = report_exceeded(model, ends, exceeding, result);
    if (!held.refusal) held.code = "capacity";
    held.refusal = held.refusal ? *held.refusal + "; " + text : text;
  }
  held.any = std::ranges::any_of(held.factors, [](char one) { return one != 0; });
}

}  // namespace

void refuse_beyond_capacity(const ResolvedModel& model, const Analysis& analysis, const CapacityEnds& ends,
                            HeldLoads& held, Result& result) {
  if (analysis.start || (!held.any && ends.constant)) return;
  if (ends.constant) {
    result.capacity.push_back(capacity_limit(model, ends, *ends.constant, 0.0));
    held.refusal = "supports carry no more than " + rounded(ends.constant->factor) +
                   " of the constant actions: " + capacity_text(model, ends, *ends.constant);
    held.code = "capacity";
    held.any = false;
    return;
  }
  if (analysis.traits().has_rows) refuse_rows_beyond_capacity(model, analysis, ends, held, result);
}

std::optional<std::string> start_refusal(const ResolvedModel& model, const UnilateralBalance& balance) {
  Analysis path;
  path.type = AnalysisType::path;
  return held_loads(model, path, balance).refusal;
}

void withdraw_load_not_held(const ResolvedModel& model, const UnilateralBalance& balance, Result& result) {
  const std::optional<double> load = result.summary.critical_load_factor;
  if (!load || balance.is_proportional()) return;
  const std::optional<Escape> escape = balance.escape(*load);
  if (!escape) return;
  // exact to 1e-11, so that nine digits may be reported
  const double most = balance.largest_held(std::min(1.0, *load), *load);
  withdraw_critical_load(result);
  std::erase_if(result.warnings, [](const Warning& warning) { return warning.code == "contact_changes"; });
  fail(result, "not_held",
       sentence("loads beyond load factor " + rounded(most, 9), model, balance, *escape) +
           "; the linearised load factor " + number(*load) + " is beyond it");
}

}  // namespace snapthrough
