#include "solver/report/result_parts.h"

#include <algorithm>
#include <cstddef>

#include "solver/events/critical_mode.h"
#include "solver/report/mode.h"

namespace snapthrough {

std::vector<NamedValue> monitor_values(const Structure& structure, const Eigen::VectorXd& y) {
  std::vector<NamedValue> out;
  out.reserve(structure.monitors.size());
  for (const MonitorRow& monitor : structure.monitors) out.push_back({monitor.id, monitor.row.dot(y)});
  return out;
}

void add_statistics(const PathStatistics& statistics, Result& result) {
  Diagnostics& d = result.diagnostics;
  d.steps += statistics.steps;
  d.rejected_steps += statistics.rejected_steps;
  d.iterations += statistics.iterations;
  d.factorizations += statistics.factorizations;
  for (std::size_t i = 0; i < d.corrections.size(); ++i) d.corrections[i] += statistics.corrections[i];
  d.max_relative_residual = std::max(d.max_relative_residual, statistics.max_relative_residual);
}

void report_mesh(const Structure& structure, int refinements, Result& result) {
  MeshReport& report = result.discretization;
  report.elements = static_cast<int>(structure.mesh.elements.size());
  report.order = structure.mesh.order;
  report.unknowns = structure.free_displacements;
  report.refinements = refinements;
}

void report_path_mesh(const Structure& structure, int paths, Result& result) {
  const Mesh& mesh = structure.mesh;
  result.discretization.paths = paths;
  result.discretization.ends.assign(mesh.first.size() - 1, {0.0});
  for (const MeshElement& e : mesh.elements) result.discretization.ends[e.member].push_back(e.to);
}

void withdraw_critical_load(Result& result) {
  result.summary.critical_load_factor.reset();
  result.summary.critical_type.reset();
  result.summary.error_estimate.reset();
  result.summary.at_critical.reset();
  // without a minimum of the stiffness the softest point was the withdrawn critical point
  if (result.summary.softest && result.summary.softest->stiffness_ratio == 0.0)
    result.summary.softest.reset();
}

void fail(Result& result, const char* code, const std::string& detail) {
  result.failure = Failure{code, detail};
  result.summary.termination = code;
  result.summary.message = detail;
}

Mode mode_at(const Structure& structure, EquilibriumProblem& problem, const CriticalEvent& event,
             const Analysis& analysis) {
  Mode mode = mode_displacements(structure, mode_of(problem, event), analysis.output.points_per_member);
  scale_to_largest(mode);
  return mode;
}

}  // namespace snapthrough
