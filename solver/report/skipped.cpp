#include "solver/report/skipped.h"

#include "solver/support/law.h"

namespace snapthrough {
namespace {

/// Notes that bilateral supports need no contact search.
template <class Support>
void add_bilateral(const char* kind, const std::vector<Support>& supports, std::vector<std::string>& out) {
  for (const Support& support : supports)
    if (support.reaction == Reaction::bilateral && initial_stiffness(support) > 0.0)
      out.push_back(std::string(kind) + " " + support.id + ": contact search, bilateral");
}

}  // namespace

bool points_are_not_polished(const Analysis& analysis) {
  const OutputOptions& output = analysis.output;
  return !analysis.discretization.fixed_mesh && output.states == StateOutput::none && !output.path_points &&
         !output.extremes;
}

std::vector<std::string> skipped_work(const ResolvedModel& model, const Analysis& analysis) {
  std::vector<std::string> out;
  add_bilateral("foundation", model.foundations, out);
  add_bilateral("spring", model.springs, out);
  const AnalysisTraits kind = analysis.traits();
  if (kind.linearised && analysis.output.extremes)
    out.emplace_back("extremes: linearised buckling reaches no states");
  if (!kind.reports_path && analysis.output.path_points)
    out.emplace_back("path_points: only the branches of a path have points");
  if (!kind.follows_path && !analysis.sensitivities.empty())
    out.emplace_back("sensitivities: only critical points on a path have them");
  if (!kind.follows_path && analysis.koiter)
    out.emplace_back("koiter: only bifurcations of a path have Koiter's coefficients");
  if (!kind.follows_path) return out;
  if (kind.ends_at_loss())
    out.emplace_back("path: points and contact changes, only the critical load was asked for");
  if (analysis.output.states == StateOutput::none) out.emplace_back("states: none were asked for");
  if (points_are_not_polished(analysis))
    out.emplace_back("path points: correction to rounding, their states were not asked for");
  return out;
}

}  // namespace snapthrough
