#pragma once
/// @file
/// The kinds of analysis, each from a checked request to its result. Called by solve().

#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "solver/assembly/structural_problem.h"
#include "solver/assembly/structure.h"
#include "solver/path/continuation.h"
#include "solver/path/path_point.h"
#include "solver/solve.h"
#include "solver/stability/locate.h"

namespace snapthrough {

/// `path` and `critical`: follows the equilibrium path.
void run_path(const Model& model, const Analysis& analysis, const Structure& structure, const Hooks& hooks,
              Result& result);
/// `static`: equilibrium at given load factors, small displacements or not.
void run_static(const Model& model, const Analysis& analysis, const Structure& structure, const Hooks& hooks,
                Result& result);
/// `buckling`: linearised eigenvalues about the reference load.
void run_buckling(const Model& model, const Analysis& analysis, const Structure& structure, Result& result);

/// @brief `buckling` of a straight column by its differential equation.
/// @return false, with nothing in `result`, when the model is no such column or asks for a mesh
[[nodiscard]] bool run_exact_column(const Model& model, const Analysis& analysis, const Hooks& hooks,
                                    Result& result);

/// Buckling loads as results report them.
struct FoundLoads {
  std::vector<double> loads;  ///< load factors of the model, ascending
  std::vector<Mode> modes;
  std::vector<std::optional<double>> errors;  ///< relative, one a load
  int negative_at_start = 0;
};
/// Fills the summary and the list of modes.
void report_buckling(const Analysis& analysis, FoundLoads found, Result& result);

/// @brief Offsets of the model's mode imperfections, from the linearised buckling of the same model without
/// imperfections; empty when it has none.
/// @throws std::runtime_error when the structure has fewer modes than an imperfection names
[[nodiscard]] ModeOffsets mode_offsets(const Model& model, const Analysis& analysis,
                                       const std::stop_token& stop = {});

/// @brief The mode of a critical point as results report it, at the analysis' points of each member.
/// @param problem of `structure`; factorised anew
[[nodiscard]] Mode mode_at(const Structure& structure, const Model& model, EquilibriumProblem& problem,
                           const CriticalEvent& event, const Analysis& analysis);

/// A number in a message: the fewest digits that read back to the same value, as in the result document.
[[nodiscard]] std::string number(double value);
/// A size in a message that no field of the document repeats: three significant digits.
[[nodiscard]] std::string rounded(double value);
/// Copies the counts of a continuation into a result, adding to what is there.
void add_statistics(const ContinuationStatistics& statistics, Result& result);
/// Reports the mesh that the reported loads are from, and how often it was refined.
void report_mesh(const Structure& structure, int refinements, Result& result);
/// A critical load that finer meshes do not confirm is none.
void withdraw_critical_load(Result& result);
/// Makes a result that of a failed analysis.
void fail(Result& result, const char* code, const std::string& detail);

/// @brief The start of the path: the unloaded state, or the equilibrium under the constant actions.
///
/// Constant actions are put on by a path of their own, from nothing to their full size.
/// @return empty, with the failure in `result`, when there is no such state or it is not stable
[[nodiscard]] std::optional<PathPoint> start_of_path(const Model& model, const Structure& structure,
                                                     StructuralProblem& problem, Continuation& continuation,
                                                     double direction, const Hooks& hooks, Result& result);

}  // namespace snapthrough
