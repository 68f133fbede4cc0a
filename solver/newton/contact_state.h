#pragma once
/// @file
/// Equilibrium at a given load when nothing is known of which one-sided supports act.

#include <Eigen/Core>
#include <optional>

#include "solver/newton/corrector.h"

namespace snapthrough {

/// An equilibrium and what its factorisation said.
struct ContactState {
  Eigen::VectorXd y;
  TangentReport tangent;
  double relative_residual = 0.0;
};

/// @brief Solves F(y, lambda) = 0 at fixed lambda from the unloaded state.
///
/// Newton's method from the response of the structure glued to its supports, and from that without them, ends
/// in most cases with the right contact. On supports so stiff that contact ends move slowly, they are made
/// soft and hardened by steps, each of which starts next to the last one's solution.
///
/// @param guess tried first, if given
/// @param options its limits on iterations and corrections are the caller's to widen
/// @param factorisations counts are added to it
/// @return empty when no equilibrium was found
[[nodiscard]] std::optional<ContactState> find_contact_state(EquilibriumProblem& problem,
                                                             const PathMetric& metric, double lambda,
                                                             Workspace& work, int& factorisations,
                                                             const Eigen::VectorXd* guess = nullptr);

}  // namespace snapthrough
