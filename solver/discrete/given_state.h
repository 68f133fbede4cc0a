#pragma once
/// @file
/// Unknowns of a structure from displacements and section forces given along its members.

#include <Eigen/Core>

#include "solver/discrete/structure.h"
#include "solver/model/analysis.h"
#include "solver/resolve/resolved_model.h"

namespace snapthrough {

/// @brief Interpolates a given state by cubic splines onto the mesh of a structure.
/// @param state one shape for each member of the model, in the user's units
/// @return scaled unknowns, near an equilibrium if the state is one of the same model
/// @throws std::invalid_argument when two places of a member coincide
[[nodiscard]] Eigen::VectorXd unknowns_of(const Structure& structure, const StartState& state);

}  // namespace snapthrough
