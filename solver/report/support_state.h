#pragma once
/// @file
/// Forces of supports, springs, foundations and loads on the structure in a state.

#include <Eigen/Core>

#include "solver/discrete/structure.h"
#include "solver/resolve/resolved_model.h"
#include "solver/result.h"

namespace snapthrough {

/// Limits of a state that may be reported; ratios. Source: rounding leaves 1e-12 in random structures.
struct StateLimits {
  static constexpr double imbalance = 1e-9;  ///< sum of all actions and reactions, see imbalance()
};

/// @brief Fills `supports`, `springs`, `loads` and the resultants of `foundations` in a state.
///
/// Reactions follow from equilibrium of the nodes along constrained directions: member end forces (unknowns
/// of the solution) plus spring forces minus loads. All forces therefore sum to zero up to rounding on any
/// mesh.
/// @param y unknowns of the structure's problem in equilibrium at `lambda`, with the constant actions in full
/// @param state with the model's foundations in their order
/// @return what is left of the sum of all forces and moments on the structure, over the largest force and
/// the largest moment that acts on it; zero where nothing acts
double add_forces_on_structure(const Structure& structure, const Eigen::VectorXd& y, double lambda,
                               State& state);

}  // namespace snapthrough
