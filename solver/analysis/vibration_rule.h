#pragma once
/// @file
/// What analyses along a path do about loads that have no potential.

#include <functional>
#include <optional>

#include "solver/events/flutter.h"
#include "solver/path/path_start.h"
#include "solver/result.h"

namespace snapthrough {

/// @brief Rule of a trace (TraceRules::vibrations) that follows the natural motions of a structure.
/// @param flutter set where the model has masses; has to live as long as the rule
/// @param stage actions that the load factor multiplies
/// @return empty where every load has a potential
[[nodiscard]] std::function<StepVibrations(const PathPoint&, const PathPoint&)> vibration_rule(
    const Structure& structure, PointSolver& solver, double tolerance, std::optional<FlutterSearch>& flutter,
    StructuralProblem::Stage stage = StructuralProblem::Stage::proportional);

/// @brief Warns of vibrations that grow where the load begins to grow.
/// @param start of the path
void warn_of_growth_at_start(const PathStart& start, Result& result);

/// Warns of loads without a potential whose vibrations could not be tested.
void warn_of_untested_flutter(const Structure& structure, Result& result);

}  // namespace snapthrough
