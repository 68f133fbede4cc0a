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
/// soft and hardened by steps. Where nothing holds the structure until a gap closes, the supports get a grip:
/// they also react, in both directions and without gap, with a share of their stiffness. The share falls from
/// one to nothing by steps that shrink when Newton's method fails; each problem on the way is strictly
/// monotone and starts next to the last one's solution.
///
/// @param guess tried first, if given
/// @param small_displacements strains are linearised about the stress-free axis
/// @param options its limits on iterations and corrections are the caller's to widen
/// @param factorisations counts are added to it
/// @return empty when no equilibrium was found
[[nodiscard]] std::optional<ContactState> find_contact_state(EquilibriumProblem& problem,
                                                             const PathMetric& metric, double lambda,
                                                             Workspace& work, int& factorisations,
                                                             const Eigen::VectorXd* guess = nullptr,
                                                             bool small_displacements = false);

}  // namespace snapthrough
