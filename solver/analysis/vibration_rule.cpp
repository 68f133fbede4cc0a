#include "solver/analysis/vibration_rule.h"

#include "solver/discrete/mass_matrix.h"

namespace snapthrough {

std::function<StepVibrations(const PathPoint&, const PathPoint&)> vibration_rule(
    const Model& model, const Structure& structure, PointSolver& solver, double tolerance,
    std::optional<FlutterSearch>& flutter) {
  if (!structure.unsymmetric()) return {};
  if (has_mass(model)) flutter.emplace(structure, model);
  return [&, tolerance](const PathPoint& from, const PathPoint& to) {
    return flutter ? flutter->on_step(solver, from, to, tolerance) : divergence_on_step(solver, from, to);
  };
}

void warn_of_untested_flutter(const Model& model, const Structure& structure, Result& result) {
  if (!structure.unsymmetric() || has_mass(model)) return;
  result.warnings.push_back({"flutter_not_tested",
                             "some loads follow the structure and have no potential: it may begin to flutter "
                             "while it is stable by every static test. Only divergence was tested, because "
                             "the model has no masses"});
}

}  // namespace snapthrough
