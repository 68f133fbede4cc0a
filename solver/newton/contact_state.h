#pragma once
/// @file
/// Equilibrium at a given load when the contact of one-sided supports is unknown.

#include <Eigen/Core>
#include <optional>

#include "solver/newton/corrector.h"

namespace snapthrough {

/// Equilibrium state with the tangent report of its last factorisation.
struct ContactState {
  Eigen::VectorXd y;
  TangentReport tangent;
  double relative_residual = 0.0;
};

/// @brief Solves F(y, lambda) = 0 at fixed lambda from the unloaded state.
///
/// Newton's method starts from `guess`, then from the response with all supports bilateral, then from that
/// without one-sided supports. If these fail, one-sided supports are first softened and then stiffened step
/// by step (contact ends move slowly on stiff supports). Last, all one-sided supports also react bilaterally
/// without gap, with a share of their stiffness ("grip") that falls from one to zero in adaptive steps; each
/// of these problems is strictly monotone and starts from the previous solution.
///
/// @param guess first starting point; may be null
/// @param small_displacements linearises strains about the stress-free axis
/// @param factorisations incremented by the number of factorisations
/// @return empty when no equilibrium was found
[[nodiscard]] std::optional<ContactState> find_contact_state(EquilibriumProblem& problem,
                                                             const PathMetric& metric, double lambda,
                                                             Workspace& work, int& factorisations,
                                                             const Eigen::VectorXd* guess = nullptr,
                                                             bool small_displacements = false);

}  // namespace snapthrough
