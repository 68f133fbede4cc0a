#include "solver/analysis/held_loads.h"

#include <algorithm>
#include <cstddef>

#include "solver/numeric/number_text.h"
#include "solver/report/escape_text.h"
#include "solver/report/result_parts.h"

namespace snapthrough {
namespace {

std::string sentence(const std::string& loads, const Model& model, const UnilateralBalance& balance,
                     const Escape& escape) {
  return "one-sided supports can't hold " + loads + ": " + escape_text(model, balance.motions(), escape);
}

/// Description of the loads at the start of a path.
std::string first_loads(const Escape& escape) {
  return escape.actions.constant != 0.0
             ? "the constant actions and a little of the proportional ones, with which the path begins"
             : "these loads";
}

HeldLoads held_factors(const Model& model, const Analysis& analysis, const UnilateralBalance& balance) {
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

HeldLoads held_loads(const Model& model, const Analysis& analysis, const UnilateralBalance& balance) {
  HeldLoads out;
  if (balance.motions().empty() || analysis.start) {
    out.factors.assign(analysis.load_factors.size(), 1);
    return out;
  }
  if (has_rows(analysis.type)) return held_factors(model, analysis, balance);
  const bool buckling = analysis.type == AnalysisType::buckling;
  std::optional<Escape> escape = balance.escape_at_start(buckling ? 1.0 : analysis.step.direction);
  std::string loads = escape ? first_loads(*escape) : "";
  if (!escape && buckling && !balance.is_proportional()) {
    escape = balance.escape(1.0);
    loads = "the reference load (load factor 1), with whose contact buckling is linearised";
  }
  if (!escape) return out;
  return {sentence(loads, model, balance, *escape), false, {}};
}

std::optional<std::string> start_refusal(const Model& model, const UnilateralBalance& balance) {
  Analysis path;
  path.type = AnalysisType::path;
  return held_loads(model, path, balance).refusal;
}

void withdraw_load_not_held(const Model& model, const UnilateralBalance& balance, Result& result) {
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
