#pragma once
/// @file
/// The kinds of analysis, each from a checked request to its result. Called by solve().

#include <functional>
#include <optional>
#include <stop_token>
#include <vector>

#include "solver/discrete/structure.h"
#include "solver/events/critical_event.h"
#include "solver/hooks.h"
#include "solver/model/analysis.h"
#include "solver/model/model.h"
#include "solver/path/path_start.h"
#include "solver/problem/structural_problem.h"
#include "solver/result.h"

namespace snapthrough {

/// `path` and `critical`: follows the equilibrium path.
void run_path(const Model& model, const Analysis& analysis, const Structure& structure, const Hooks& hooks,
              Result& result);
/// `static`: equilibrium at given load factors, small displacements or not.
/// @param held for each of them, whether it is computed; the others are listed as not reached
void run_static(const Model& model, const Analysis& analysis, const Structure& structure,
                const std::vector<char>& held, const Hooks& hooks, Result& result);
/// `buckling`: linearised eigenvalues about the reference load.
void run_buckling(const Model& model, const Analysis& analysis, const Structure& structure, Result& result);

/// @brief `buckling` of a straight column by its differential equation.
/// @return false, with nothing in `result`, when the model is no such column or asks for a mesh
[[nodiscard]] bool run_exact_column(const Model& model, const Analysis& analysis, const Hooks& hooks,
                                    Result& result);

/// @brief How critical points are located: a fixed mesh is read to the last digit, a chosen one to a small
/// part of the accuracy; imperfections that only rounding or the mesh makes do not break a bifurcation.
[[nodiscard]] LocateOptions locate_options(const Model& model, const Analysis& analysis);

/// Buckling loads of one sense of the proportional actions: as they are, or reversed.
struct FoundLoads {
  std::vector<double> loads;  ///< multiples of the actions in that sense, ascending
  std::vector<Mode> modes;
  std::vector<std::optional<double>> errors;  ///< relative, one a load
  int negative_at_start = 0;
};
/// @brief Fills the summary and the list of modes: none where the constant actions exceed buckling loads.
/// @param reversed loads of the opposite actions; empty where they were not asked for
void report_buckling(const Analysis& analysis, FoundLoads found, FoundLoads reversed, Result& result);

/// @brief Offsets of the model's mode imperfections, from the linearised buckling of the same model without
/// imperfections; empty when it has none.
/// @throws std::runtime_error when the structure has fewer modes than an imperfection names
[[nodiscard]] ModeOffsets mode_offsets(const Model& model, const Analysis& analysis,
                                       const std::stop_token& stop = {});

/// Sense in which the load factor begins to change along the primary path: 1 growing, -1 falling.
[[nodiscard]] double path_direction(const Analysis& analysis);
/// @brief Whether a critical point leads the primary path from a stable state to an unstable one, with loads
/// of the sense that the path begins with.
[[nodiscard]] bool is_loss_of_stability(const Analysis& analysis, const CriticalPoint& point);

/// @brief The start of the path: the unloaded state, or the equilibrium under the constant actions.
///
/// Constant actions are put on by a path of their own, from nothing to their full size.
/// @param on_unloaded receives that path's first point, the unloaded structure, with its modes; may be empty
/// @return without a point, with the failure in `result`, when there is no such state or it is not stable
[[nodiscard]] PathStart start_of_path(const Model& model, const Structure& structure,
                                      StructuralProblem& problem, PointSolver& solver, double direction,
                                      const Hooks& hooks, Result& result,
                                      const std::function<void(const PathPoint&)>& on_unloaded = {});

/// @brief The start of a path at Analysis::start, corrected on the structure's mesh.
/// @return without a point, with the failure `no_start` in `result`, when no equilibrium is within a fiftieth
/// of the given displacement gradients
/// @pre analysis.start
[[nodiscard]] PathStart start_at_state(const Model& model, const Structure& structure, PointSolver& solver,
                                       const Analysis& analysis, Result& result);

}  // namespace snapthrough
