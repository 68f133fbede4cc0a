#pragma once
/// @file
/// The kinds of analysis, each from a checked request to its result. Called by solve().

#include <functional>
#include <optional>
#include <stop_token>
#include <vector>

#include "solver/discrete/capacity_balance.h"
#include "solver/discrete/structure.h"
#include "solver/events/critical_event.h"
#include "solver/hooks.h"
#include "solver/model/analysis.h"
#include "solver/path/path_start.h"
#include "solver/problem/structural_problem.h"
#include "solver/resolve/resolved_model.h"
#include "solver/result.h"
#include "solver/sensitivity/exact_point.h"

namespace snapthrough {

/// Receives each critical point of a path, after its load was compared with finer meshes. The structure is
/// that of the reported load.
using CriticalVisitor = std::function<void(const Structure& structure, const LocatedPoint& at,
                                           const CriticalPoint& point, int& factorisations)>;

/// Receives the state of a row of a static analysis: scaled unknowns and load factor.
using StateVisitor = std::function<void(std::size_t row, const Eigen::VectorXd& y, double lambda)>;

/// Load factors of a static analysis that supports hold.
struct HeldRows {
  std::vector<char> factors;               ///< one entry per load factor: whether it is computed
  const CapacityEnds* capacity = nullptr;  ///< limit loads of the model's supports; null: there are none
};

/// Runs the analyses `path` and `critical`: follows the equilibrium path.
/// @param visit may be empty
/// @param capacity limit loads of the model's supports; null: there are none
void run_path(const Analysis& analysis, const Structure& structure, const CapacityEnds* capacity,
              const Hooks& hooks, Result& result, const CriticalVisitor& visit = {});
/// Runs the analysis `static`: equilibrium at given load factors, with large or small displacements.
/// @param held loads that are computed: the others are reported as not reached
/// @param visit receives each state; may be empty
void run_static(const Analysis& analysis, const Structure& structure, const HeldRows& held,
                const Hooks& hooks, Result& result, const StateVisitor& visit = {});
/// Runs the analysis `vibration`: small free vibrations about the equilibria at given load factors.
/// @param held as in run_static()
void run_vibration(const Analysis& analysis, const Structure& structure, const HeldRows& held,
                   const Hooks& hooks, Result& result);
/// Runs the analysis `buckling`: linearised buckling loads about the reference load.
/// @param first structure on the mesh to begin with
void run_buckling(const Analysis& analysis, const Structure& first, Result& result);

/// @brief Runs `buckling` for a straight column by its differential equation.
/// @return false, with `result` unchanged, when the model is no such column or the request fixes a mesh
[[nodiscard]] bool run_exact_column(const ResolvedModel& model, const Analysis& analysis, const Hooks& hooks,
                                    Result& result);

/// @brief Tolerances for locating critical points: near rounding on a fixed mesh, a small part of the
/// accuracy otherwise. Imperfections caused by rounding or by the mesh do not break a bifurcation.
[[nodiscard]] LocateOptions locate_options(const ResolvedModel& model, const Analysis& analysis);

/// Buckling loads for one sense of the proportional actions.
struct FoundLoads {
  std::vector<double> loads;  ///< multiples of the actions in this sense, ascending
  std::vector<Mode> modes;
  std::vector<std::optional<double>> errors;  ///< relative error estimate per load
  int negative_at_start = 0;
};
/// @brief Fills summary, loads and modes; no loads when the constant actions alone exceed a buckling load.
/// @param reversed loads of the opposite actions; empty when not requested
void report_buckling(const Analysis& analysis, FoundLoads found, FoundLoads reversed, Result& result);

/// @brief Offsets of the model's mode imperfections, from linearised buckling of the model without
/// imperfections; empty when the model has none.
/// @throws std::runtime_error when the structure has fewer modes than an imperfection asks for
[[nodiscard]] ModeOffsets mode_offsets(const ResolvedModel& model, const Analysis& analysis,
                                       const std::stop_token& stop = {});

/// Initial sense of the load factor along the primary path: 1 growing, -1 falling.
[[nodiscard]] double path_direction(const Analysis& analysis);
/// @brief Whether stability is first lost at a critical point of the primary path, at a load factor of the
/// path's initial sense.
[[nodiscard]] bool is_loss_of_stability(const Analysis& analysis, const CriticalPoint& point);

/// @brief Id of the node at which a motion is largest.
/// @param motion scaled unknowns of the structure's problem, not zero
[[nodiscard]] const std::string& node_of_largest(const Structure& structure, const Eigen::VectorXd& motion);

/// @brief Start of the path: the unloaded state, or the equilibrium under the constant actions; of a
/// structure that only tension stiffens, the equilibrium under constant actions or a little load.
///
/// Constant actions are applied along a separate path from zero to their full size.
/// @param on_unloaded receives the unloaded state with its modes; may be empty
/// @return without a point, with the failure in `result`, when there is no such state or it is not stable
[[nodiscard]] PathStart start_of_path(const Structure& structure, StructuralProblem& problem,
                                      PointSolver& solver, double direction, const Hooks& hooks,
                                      Result& result,
                                      const std::function<void(const PathPoint&)>& on_unloaded = {});

/// @brief Start of the path at Analysis::start, corrected on the structure's mesh.
/// @return without a point, with the failure `no_start` in `result`, when no equilibrium is within a fiftieth
/// of the given displacement gradients
/// @pre analysis.start
[[nodiscard]] PathStart start_at_state(const Structure& structure, PointSolver& solver,
                                       const Analysis& analysis, Result& result);

}  // namespace snapthrough
