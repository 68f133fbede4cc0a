#pragma once
/// @file
/// Error estimates of equilibrium states at given load factors, and refinement to an accuracy.

#include <Eigen/Core>
#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "solver/discrete/structure.h"
#include "solver/model/analysis.h"
#include "solver/problem/point_context.h"
#include "solver/resolve/resolved_model.h"
#include "solver/result.h"

namespace snapthrough {

/// Equilibrium of a structure at one load factor.
struct StaticState {
  std::size_t row = 0;   ///< index among the requested load factors
  Eigen::VectorXd y;     ///< scaled unknowns
  double lambda = 0.0;   ///< scaled load factor
  int negative = 0;      ///< negative eigenvalues of the tangent stiffness
  PointContext context;  ///< springs on motions without stiffness, and what supports remember
};

/// Function that finds the states anew on another mesh of the same model, at the rows of `states`; fewer
/// states when the mesh does not have all of them.
using FindStates = std::function<std::vector<StaticState>(const Structure& structure,
                                                          const std::vector<StaticState>& states)>;

/// A FindStates for states that only Newton's method may find: it finds none.
[[nodiscard]] std::vector<StaticState> no_other_states(const Structure& structure,
                                                       const std::vector<StaticState>& states);

/// States on a mesh that meets an accuracy.
struct RefinedStates {
  std::shared_ptr<const Structure> structure;
  std::vector<StaticState> states;
  /// Largest relative error of all states, see relative_error(); empty: no finer mesh was tried, or it
  /// does not have the states.
  std::optional<double> error;
  int refinements = 0;  ///< meshes after the first one
  int factorizations = 0;
  std::optional<double> missing;  ///< load factor of a state that a finer mesh does not have
};

/// @brief Compares states with those of halved elements, and refines the mesh where these differ until the
/// differences are within the accuracy.
///
/// The finer mesh's state follows from the transferred one by Newton's method at the same load factor. Twice
/// its difference estimates the error of the coarser mesh's state, which is the reported one. Elements are
/// halved where the finer mesh's section forces and gradients are not polynomials of the coarser mesh; the
/// first refinement also resolves the bending decay length sqrt(EI / N) of the tension that was found.
/// @param structure structure of `states`; must outlive the result
/// @param states one or more
/// @param find called where Newton's method does not lead from the transferred state to one of the same
/// inertia
[[nodiscard]] RefinedStates refine_states(const Discretization& asked, const Structure& structure,
                                          const std::vector<StaticState>& states, const FindStates& find);

/// @brief Writes mesh, error estimate and the work for them into a result; fails with `not_confirmed` where
/// the estimate exceeds the accuracy or a finer mesh does not have a state.
void report_accuracy(const RefinedStates& refined, const Discretization& asked, Result& result);

}  // namespace snapthrough
