#include "solver/analysis/vibration_rule.h"

#include "solver/discrete/mass_matrix.h"
#include "solver/events/massless.h"
#include "solver/numeric/number_text.h"

namespace snapthrough {

std::function<StepVibrations(const PathPoint&, const PathPoint&)> vibration_rule(
    const Structure& structure, PointSolver& solver, double tolerance, std::optional<FlutterSearch>& flutter,
    StructuralProblem::Stage stage) {
  if (structure.traits.symmetric) return {};
  if (structure.traits.has_mass) flutter.emplace(structure, stage);
  return [&, tolerance](const PathPoint& from, const PathPoint& to) {
    return flutter ? flutter->on_step(solver, from, to, tolerance) : divergence_on_step(solver, from, to);
  };
}

void warn_of_growth_at_start(const PathStart& start, Result& result) {
  if (!start.grows_from) return;
  result.warnings.push_back({"unstable", "vibrations grow (flutter) before the load grows, from " +
                                             rounded(*start.grows_from) + " of the constant actions on"});
}

void warn_of_untested_flutter(const Structure& structure, Result& result) {
  if (structure.traits.symmetric) return;
  if (structure.traits.has_mass) {
    const MassMatrix masses = make_mass_matrix(structure);
    if (has_massless_elements(masses) && follows_without_mass(structure, masses))
      result.warnings.push_back({"massless_place",
                                 "a load that has no potential acts where the structure has no mass: with a "
                                 "small mass there it may begin to flutter at a lower load"});
    return;
  }
  result.warnings.push_back({"flutter_not_tested",
                             "some loads follow the structure and have no potential: it may begin to flutter "
                             "while it is stable by every static test. Only divergence was tested, because "
                             "the model has no masses"});
}

}  // namespace snapthrough
