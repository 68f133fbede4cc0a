#pragma once
/// @file
/// What a state's supports, springs, foundations and loads put on the structure.

#include <Eigen/Core>

#include "solver/discrete/structure.h"
#include "solver/model/model.h"
#include "solver/result.h"

namespace snapthrough {

/// @brief Fills `supports`, `springs`, `loads` and the resultants of `foundations`.
///
/// Reactions are what equilibrium of their nodes asks for: the forces at the ends of members, which are
/// unknowns of the solution, and those of springs, less the loads, along the directions that are held. So
/// nothing is differentiated, and everything adds up to zero to rounding on any mesh.
/// @param y unknowns of the structure's problem at `lambda`, in equilibrium, constant actions on
/// @param state its foundations are those of the model, in that order
void add_forces_on_structure(const Structure& structure, const Model& model, const Eigen::VectorXd& y,
                             double lambda, State& state);

}  // namespace snapthrough
