#pragma once
/// @file
/// Parts of results that all kinds of analysis write.

#include <Eigen/Core>
#include <string>
#include <vector>

#include "solver/discrete/structure.h"
#include "solver/events/critical_event.h"
#include "solver/model/analysis.h"
#include "solver/path/path_point.h"
#include "solver/problem/equilibrium_problem.h"
#include "solver/resolve/resolved_model.h"
#include "solver/result.h"

namespace snapthrough {

/// Values of the monitors, in the model's units, at scaled unknowns y.
[[nodiscard]] std::vector<NamedValue> monitor_values(const Structure& structure, const Eigen::VectorXd& y);

/// @brief Mode of a critical point at the requested points of each member.
/// @param problem problem of `structure`; factorised again
[[nodiscard]] Mode mode_at(const Structure& structure, EquilibriumProblem& problem,
                           const CriticalEvent& event, const Analysis& analysis);

/// Adds the steps, corrections and factorisations of a path to the diagnostics of a result, and keeps the
/// larger of their largest residuals.
void add_statistics(const PathStatistics& statistics, Result& result);
/// Reports the mesh of the reported loads and its number of refinements.
void report_mesh(const Structure& structure, int refinements, Result& result);
/// Reports the mesh of a path, the number of paths followed, and the element ends.
void report_path_mesh(const Structure& structure, int paths, Result& result);
/// Removes a critical load that finer meshes do not confirm.
void withdraw_critical_load(Result& result);
/// Marks a result as failed, with code and message.
void fail(Result& result, const char* code, const std::string& detail);

}  // namespace snapthrough
