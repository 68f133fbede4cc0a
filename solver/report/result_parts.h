#pragma once
/// @file
/// What analyses of every kind write into their results.

#include <string>

#include "solver/discrete/structure.h"
#include "solver/events/critical_event.h"
#include "solver/model/analysis.h"
#include "solver/model/model.h"
#include "solver/path/path_point.h"
#include "solver/problem/equilibrium_problem.h"
#include "solver/result.h"

namespace snapthrough {

/// @brief The mode of a critical point as results report it, at the analysis' points of each member.
/// @param problem of `structure`; factorised anew
[[nodiscard]] Mode mode_at(const Structure& structure, const Model& model, EquilibriumProblem& problem,
                           const CriticalEvent& event, const Analysis& analysis);

/// Adds the counts of a path to those of a result.
void add_statistics(const PathStatistics& statistics, Result& result);
/// Reports the mesh that the reported loads are from, and how often it was refined.
void report_mesh(const Structure& structure, int refinements, Result& result);
/// Reports the mesh of a path: how many were followed up to it, and where its elements end.
void report_path_mesh(const Structure& structure, int paths, Result& result);
/// A critical load that finer meshes do not confirm is none.
void withdraw_critical_load(Result& result);
/// Makes a result that of a failed analysis.
void fail(Result& result, const char* code, const std::string& detail);

}  // namespace snapthrough
