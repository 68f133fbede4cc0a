#pragma once
/// @file
/// The unknowns of a structure from displacements and section forces that are given at places along its
/// members.

#include <Eigen/Core>

#include "solver/discrete/structure.h"
#include "solver/model/analysis.h"
#include "solver/model/model.h"

namespace snapthrough {

/// @brief Interpolates a given state by cubic splines onto the mesh of a structure.
/// @param state one shape for each member of the model; in the user's units
/// @return scaled unknowns: near an equilibrium where the state is one of the same model
/// @throws std::invalid_argument where two places of a member can't be told apart
[[nodiscard]] Eigen::VectorXd unknowns_of(const Structure& structure, const Model& model,
                                          const StartState& state);

}  // namespace snapthrough
