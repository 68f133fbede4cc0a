#include "solver/check/check.h"

#include "solver/check/check_parts.h"
#include "solver/discrete/mechanism.h"
#include "solver/resolve/resolved_model.h"

namespace snapthrough {

std::vector<Finding> check(const Model& model, const Analysis& analysis) {
  std::vector<Finding> findings;
  const checks::Place root(PointerPath(), findings);
  const checks::Place place = root / "model";
  checks::Names names;
  checks::check_texts(place, model);
  checks::check_nodes(place, model, names);
  checks::check_sections(place, model, names);
  checks::check_members(place, model, names);
  checks::check_supports(place, model, names);
  checks::check_springs(place, model, names);
  checks::check_foundations(place, model, names);
  checks::check_loads(place, model, names);
  checks::check_something_proportional(place, model, analysis);
  checks::check_imperfections(place, model, names);
  checks::check_worst_imperfection(root, model, analysis);
  checks::check_masses(place, model, names);
  checks::check_monitors(place, model, names);
  checks::check_analysis(root, model, analysis, names);
  checks::check_cables(root, model, analysis, names);
  checks::check_supported(root, model, analysis);
  if (findings.empty()) checks::check_obstacles(root, model, analysis);
  if (!findings.empty()) return findings;
  const ResolvedModel resolved = resolve(model);
  findings = find_mechanism(resolved);
  // with large displacements, members that pull may hold what moves at first
  const bool may_tighten = analysis.geometry == Geometry::nonlinear && !analysis.traits().linearised;
  if (!findings.empty() && may_tighten && is_loose(resolved)) findings.clear();
  return findings;
}

}  // namespace snapthrough
